// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/blend_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "reconstruct/dilate.h"
#include "core/origin.h"

namespace exemplar {
namespace {

/// A sample beside one, and how much it counts.
struct Neighbour {
  Vec3i offset;
  double weight;
};

std::vector<Neighbour> neighbourhood(double width) {
  const auto r = static_cast<int>(std::ceil(width + 0.5)) - 1;
  std::vector<Neighbour> result;
  for (int k = -r; k <= r; ++k) {
    for (int j = -r; j <= r; ++j) {
      for (int i = -r; i <= r; ++i) {
        const double share = 1 - length(Vec3d{double(i), double(j), double(k)}) / (width + 0.5);
        // A smooth end, so that the blend starts without a crease of its own.
        if (share > 0) result.push_back({{i, j, k}, share * share * (3 - 2 * share)});
      }
    }
  }
  return result;
}

/// Samples within `reach` of where parts meet near the surface.
Array3D<std::uint8_t> seamSamples(const DistanceField& field, const Origins& origins, double near,
                                  int reach) {
  const Vec3i n = field.size();
  Array3D<std::uint8_t> marks(n);
  parallelFor(0, n.z, 1, [&](std::size_t k0, std::size_t k1) {
    for (int k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
      for (int j = 0; j < n.y; ++j) {
        for (int i = 0; i < n.x; ++i) {
          if (std::abs(field.values(i, j, k)) > near) continue;
          const OriginMotion own = motionAt(origins, {i, j, k});
          for (int axis = 0; axis < 3 && !marks(i, j, k); ++axis) {
            for (const int side : {-1, 1}) {
              Vec3i there{i, j, k};
              there[axis] += side;
              if (!origins.contains(there) || std::abs(field.values[there]) > near) continue;
              if (!(motionAt(origins, there) == own)) marks(i, j, k) = 1;
            }
          }
        }
      }
    }
  });
  return dilated(std::move(marks), reach);
}

void check(const DistanceField& field, const Origins& origins,
           std::span<const DistanceField* const> examples, const BlendSeamsOptions& options) {
  if (!(options.width >= 0.5 && options.width <= 8)) {
    throw InputError("blending seams: a width of " + std::to_string(options.width) +
                     " voxels is out of range; 0.5 to 8 is right");
  }
  if (!(options.agreement > 0)) {
    throw InputError("blending seams: an agreement of " + std::to_string(options.agreement) +
                     " voxels is out of range; more than 0 is right");
  }
  if (origins.size() != field.size()) {
    throw InputError("the origins are not of the field's size; use those of the same synthesis");
  }
  for (const Origin& o : origins.values()) {
    if (o.example >= examples.size()) {
      throw InputError("the origins name example " + std::to_string(o.example + 1) + " of " +
                       std::to_string(examples.size()) +
                       "; give all examples, in the order of the synthesis");
    }
  }
}

}  // namespace

DistanceField blendSeams(const DistanceField& field, const Origins& origins,
                         std::span<const DistanceField* const> examples,
                         const BlendSeamsOptions& options) {
  check(field, origins, examples, options);
  const std::vector<Neighbour> neighbours = neighbourhood(options.width);
  const double near = (options.width + 2) * field.voxelSize;
  const double agree = options.agreement * field.voxelSize;
  const Vec3i n = field.size();
  const Array3D<std::uint8_t> atSeam =
      seamSamples(field, origins, near, static_cast<int>(std::ceil(options.width)));
  DistanceField result = field;
  parallelFor(0, n.z, 1, [&](std::size_t k0, std::size_t k1) {
    struct Part {
      OriginMotion motion;
      double weight;
    };
    std::vector<Part> parts;
    for (int k = static_cast<int>(k0); k < static_cast<int>(k1); ++k) {
      for (int j = 0; j < n.y; ++j) {
        for (int i = 0; i < n.x; ++i) {
          const Vec3i at{i, j, k};
          if (!atSeam[at] || std::abs(field.values[at]) > near) continue;
          parts.clear();
          for (const Neighbour& neighbour : neighbours) {
            const Vec3i there = at + neighbour.offset;
            // Parts in the air have no surface to carry on.
            if (!origins.contains(there) || std::abs(field.values[there]) > near) continue;
            const OriginMotion motion = motionAt(origins, there);
            const auto known = std::find_if(parts.begin(), parts.end(),
                                            [&](const Part& p) { return p.motion == motion; });
            if (known == parts.end()) {
              parts.push_back({motion, neighbour.weight});
            } else {
              known->weight += neighbour.weight;
            }
          }
          if (parts.size() < 2) continue;
          double sum = 0, weights = 0;
          const OriginMotion own = motionAt(origins, at);
          for (const Part& part : parts) {
            // The field itself for its own part: it may have been averaged since it was copied.
            double value = field.values[at];
            if (!(part.motion == own)) {
              const DistanceField& example = *examples[part.motion.example];
              const Vec3i cell = part.motion.toExample(at);
              if (!example.values.contains(cell)) continue;
              value = example.values[cell] * (field.voxelSize / example.voxelSize);
            }
            const double apart = (value - field.values[at]) / agree;
            const double weight = part.weight * std::exp(-apart * apart);
            sum += weight * value;
            weights += weight;
          }
          result.values[at] = static_cast<float>(sum / weights);
        }
      }
    }
  });
  return result;
}

DistanceField blendSeams(const DistanceField& field, const Origins& origins,
                         const DistanceField& example, const BlendSeamsOptions& options) {
  const DistanceField* const list[]{&example};
  return blendSeams(field, origins, list, options);
}

}  // namespace exemplar
