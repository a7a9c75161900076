// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/band.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/sample_distances.h"

namespace exemplar::surface {
namespace {

/// How far from the surface of the example the result is asked, samples.
constexpr double kMargin = 3;
/// Placements that meet at a seam are mixed where they differ by less, samples.
constexpr double kAgree = 1.5;
/// How many rounds weights spread from node to node across seams.
constexpr int kBlendRounds = 2;
constexpr int kBlock = 8;
constexpr std::size_t kChunk = 1024;  // triangles

/// The few placements of a node, with their weights.
struct Weights {
  static constexpr int kMost = 6;
  std::array<std::pair<std::uint32_t, float>, kMost> part{};
  int count = 0;

  void add(std::uint32_t placement, float weight) {
    for (int k = 0; k < count; ++k) {
      if (part[k].first != placement) continue;
      part[k].second += weight;
      return;
    }
    if (count < kMost) part[count++] = {placement, weight};
  }
  float of(std::uint32_t placement) const {
    for (int k = 0; k < count; ++k)
      if (part[k].first == placement) return part[k].second;
    return 0;
  }
};

/// Who is how much at each node: owners, averaged over neighbors.
std::vector<Weights> blendedOwners(const Sheet& sheet, const Placements& placements) {
  std::vector<Weights> weights(sheet.positions.size()), next(weights.size());
  for (std::size_t v = 0; v < weights.size(); ++v) weights[v].add(placements.owner[v], 1);
  for (int round = 0; round < kBlendRounds; ++round) {
    parallelFor(0, weights.size(), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const auto links = sheet.links(static_cast<std::uint32_t>(v));
        const float share = 1.0f / static_cast<float>(links.size() + 1);
        Weights sum;
        for (int k = 0; k < weights[v].count; ++k)
          sum.add(weights[v].part[k].first, share * weights[v].part[k].second);
        for (const Sheet::Link& link : links) {
          const Weights& there = weights[link.node];
          for (int k = 0; k < there.count; ++k)
            sum.add(there.part[k].first, share * there.part[k].second);
        }
        next[v] = sum;
      }
    });
    weights.swap(next);
  }
  return weights;
}

/// What is asked of the example at a foot.
struct Shown {
  double value = 0;  ///< samples
  std::uint32_t placement = 0;
  Vec2d source{};
  bool any = false;
};

Shown shownAt(std::span<const SheetContent::Part> parts, const Foot& foot, double z,
              const Slab& slab) {
  Shown shown;
  double most = 0;
  std::array<double, Weights::kMost> values{}, weights{};
  std::size_t count = 0, main = 0;
  for (const SheetContent::Part& part : parts) {
    double weight = 0;
    Vec2d source{};
    for (int c = 0; c < 3; ++c) {
      weight += foot.weights[c] * static_cast<double>(part.weight[c]);
      source += part.source[c] * foot.weights[c];
    }
    if (count == values.size() || (weight <= 0 && parts.size() > 1)) continue;
    values[count] = slab.value(source, z);
    weights[count] = weight;
    if (!shown.any || weight > most) {
      most = weight;
      main = count;
      shown.placement = part.placement;
      shown.source = source;
      shown.any = true;
    }
    ++count;
  }
  if (!shown.any) return shown;
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (k != main && std::abs(values[k] - values[main]) > kAgree) continue;
    const double weight = std::max(weights[k], 1e-9);
    sum += weight * values[k];
    total += weight;
  }
  shown.value = sum / total;
  return shown;
}

/// How far the example reaches from the surface, and where on its z axis the surface is, samples.
struct Reach {
  double zero = 0, up = 0, down = 0, bottom = 0;

  Reach(const Slab& slab, const BandOptions& options) {
    constexpr double kBoxBottom = -0.5;
    bottom = slab.grounded() ? kBoxBottom : slab.low();
    switch (options.base) {
      case Base::None:
        zero = slab.grounded() ? slab.low() : (slab.low() + slab.top()) / 2;
        break;
      case Base::Under:
        // What stands on nothing sinks in by a sample, so that it is held.
        zero = slab.grounded() ? slab.low() : slab.low() + 1;
        break;
      case Base::Carve:
        zero = slab.high();
        break;
    }
    if (options.base != Base::Carve) up = std::max((slab.top() - zero) * options.height, 0.0);
    if (options.base != Base::Under) down = std::max((zero - bottom) * options.height, 0.0);
  }
};

/// Fills the surroundings of a sheet, sample by sample. All lengths are voxels but where it is
/// said.
class BandFilling {
 public:
  BandFilling(const Sheet& sheet, const FootFinder& feet, const SheetContent& content,
              const Placements& placements, const Slab& slab, int symmetry,
              const BandOptions& options)
      : sheet_(sheet),
        feet_(feet),
        content_(content),
        placements_(placements),
        slab_(slab),
        options_(options),
        reach_(slab, options),
        voxel_(options.voxel),
        quarters_(4 % symmetry == 0 ? 4 / symmetry : 0) {
    const double largest = *std::max_element(sheet.sizes.begin(), sheet.sizes.end());
    const double most = options.sample * largest / voxel_;
    outward_ = reach_.up * most + kMargin;
    inward_ = reach_.down * most + kMargin;
    limit_ = std::max(outward_, inward_) * voxel_;
  }

  Band run(const Progress& progress) {
    setUp();
    forBlocks(band_.field.size(), kBlock, progress, "filling the surface's surroundings",
              [&](const Vec3i& low, const Vec3i& high) { fillBlock(low, high); });
    band_.samples = asked_;
    fillFar();
    return std::move(band_);
  }

 private:
  static constexpr float kUnknown = std::numeric_limits<float>::max();

  /// An empty field around all that may be asked.
  void setUp() {
    Box3d box;
    for (const Vec3d& p : sheet_.positions) box.add(p);
    if (options_.body)
      for (const Vec3d& p : options_.body->sheet.positions) box.add(p);
    const double margin = (outward_ + 1) * voxel_;
    const Vec3d sides = (box.size() + Vec3d{1, 1, 1} * (2 * margin)) / voxel_;
    constexpr double kMostSide = 32767;
    constexpr double kBytesPerSample = 40;  // with what contouring takes
    requireMemory(kBytesPerSample * sides.x * sides.y * sides.z,
                  "a result of " + std::to_string(static_cast<long long>(sides.x)) + " x " +
                      std::to_string(static_cast<long long>(sides.y)) + " x " +
                      std::to_string(static_cast<long long>(sides.z)) + " samples",
                  "use a lower `resolution` or a larger `span`");
    if (std::max({sides.x, sides.y, sides.z}) > kMostSide)
      throw InputError("the result would be more than 32,767 samples long; use a larger `span`");
    Vec3i size;
    for (int axis = 0; axis < 3; ++axis) size[axis] = static_cast<int>(std::ceil(sides[axis])) + 1;
    band_.zero = reach_.zero;
    band_.limit = limit_;
    band_.field.values = Array3D<float>(size, kUnknown);
    band_.field.voxelSize = voxel_;
    band_.field.origin = box.min - Vec3d{1, 1, 1} * margin;
    band_.field.truncation = static_cast<float>(kMargin * voxel_);
    band_.origins = Origins(size);
  }

  void fillBlock(const Vec3i& low, const Vec3i& high) {
    DistanceField& field = band_.field;
    const Vec3d first = field.position(cast<double>(low));
    const Vec3d last = field.position(cast<double>(high - Vec3i{1, 1, 1}));
    const Vec3d middle = (first + last) * 0.5;
    const double radius = length(last - first) / 2;
    std::uint32_t near = TriangleTree::kNone, nearBody = TriangleTree::kNone;
    const bool some = feet_.within(middle, limit_ + radius, near);
    const bool body =
        options_.body && options_.body->feet.within(middle, limit_ + radius, nearBody);
    if (!some && !body) return;
    std::int64_t count = 0;
    serpentine(low, high, [&](const Vec3i& ijk) {
      const Vec3d point = field.position(cast<double>(ijk));
      const std::optional<Foot> foot =
          some ? feet_.find(point, limit_, near) : std::optional<Foot>{};
      const std::optional<Foot> below =
          body ? options_.body->feet.find(point, limit_, nearBody) : std::optional<Foot>{};
      if (set(ijk, foot, below)) ++count;
    });
    asked_.fetch_add(count, std::memory_order_relaxed);
  }

  /// Sets a sample by its foot on the sheet, and by the one on the body; returns whether there is
  /// anything to set it by.
  bool set(const Vec3i& ijk, const std::optional<Foot>& foot, const std::optional<Foot>& below) {
    double value = 0;
    const bool asked =
        foot && foot->distance <= outward_ * voxel_ && foot->distance >= -inward_ * voxel_;
    if (asked) {
      value = shownBy(ijk, *foot);
      if (below) value = onBody(value, *foot, below->distance / voxel_);
    } else if (below) {
      value = below->distance / voxel_;
    } else {
      return false;
    }
    band_.field.values[ijk] = static_cast<float>(std::clamp(value, -kMargin, kMargin) * voxel_);
    return true;
  }

  /// What the example has at a foot, on its base; sets the sample's origin.
  double shownBy(const Vec3i& ijk, const Foot& foot) {
    // `sample` is one of the example here.
    const double sample = options_.sample * sheet_.sizeAt(foot.triangle, foot.weights) / voxel_;
    const double h = foot.height / voxel_, d = foot.distance / voxel_;
    const double z = reach_.zero + h / (sample * options_.height);
    const Shown shown = shownAt(content_.at(foot.triangle), foot, z, slab_);
    double value = shown.value * std::min(1.0, options_.height) * sample;
    const double bottom = h + (reach_.zero - reach_.bottom) * options_.height * sample;
    switch (options_.base) {
      case Base::None:
        if (slab_.grounded()) value = std::max(value, -bottom);
        break;
      case Base::Under:
        value = std::min(value, d);
        break;
      case Base::Carve:
        value = std::max(d, std::min(value, bottom));
        break;
    }
    const auto cell = [](double x, int n) {
      return std::clamp(static_cast<int>(std::lround(x)), 0, n - 1);
    };
    band_.origins[ijk] = Origin({cell(shown.source.x, slab_.size().x),
                                 cell(shown.source.y, slab_.size().y), cell(z, slab_.size().z)},
                                0, quarters_ * placements_.all[shown.placement].turn % 4);
    // A sheet of its own, and what stands on a base, end where the sheet does.
    if (foot.beyond > 0 && !(options_.body && options_.base == Base::Carve))
      value = std::max(value, foot.beyond / voxel_);
    return value;
  }

  /// Joins what is shown, which ends with the sheet, with the rest of the body, `d` away.
  double onBody(double value, const Foot& foot, double d) const {
    if (options_.base == Base::Under) return std::min(value, d);
    // Nothing is cut out beyond the sheet, nor of what is nearer than it.
    const double beyond = foot.beyond / voxel_;
    if (beyond > 0) return std::max(d, -std::max(beyond, -value));
    return std::abs(d) < std::abs(foot.distance / voxel_) - 1 ? d : value;
  }

  /// Far from the surface a sample is on the side on which its row comes from; all begin outside.
  void fillFar() {
    DistanceField& field = band_.field;
    const Vec3i size = field.size();
    const float far = field.truncation;
    const bool solidInside = options_.base != Base::None;
    parallelFor(0, static_cast<std::size_t>(size.y) * size.z, 64,
                [&](std::size_t begin, std::size_t end) {
                  for (std::size_t row = begin; row < end; ++row) {
                    float* value = field.values.data() + row * static_cast<std::size_t>(size.x);
                    float side = far;
                    for (int i = 0; i < size.x; ++i) {
                      if (value[i] == kUnknown) {
                        value[i] = side;
                      } else if (solidInside) {
                        side = value[i] < 0 ? -far : far;
                      }
                    }
                  }
                });
  }

  const Sheet& sheet_;
  const FootFinder& feet_;
  const SheetContent& content_;
  const Placements& placements_;
  const Slab& slab_;
  const BandOptions& options_;
  const Reach reach_;
  const double voxel_;  // world units
  const int quarters_;
  double outward_ = 0, inward_ = 0;
  double limit_ = 0;  // world units
  Band band_;
  std::atomic<std::int64_t> asked_ = 0;
};

}  // namespace

SheetContent::SheetContent(const LocalMapper& mapper, const Placements& placements) {
  const Sheet& sheet = mapper.sheet();
  const std::vector<Weights> weights = blendedOwners(sheet, placements);
  const std::size_t triangles = sheet.triangles.size();
  const auto partsOf = [&](std::size_t t, std::vector<Part>& out) {
    out.clear();
    const auto& nodes = sheet.triangles[t];
    Weights here;
    for (const std::uint32_t v : nodes)
      for (int k = 0; k < weights[v].count; ++k) here.add(weights[v].part[k].first, 1);
    for (int k = 0; k < here.count; ++k) {
      const std::uint32_t p = here.part[k].first;
      const Placement& placement = placements.all[p];
      std::array<std::uint32_t, 3> number{};
      bool whole = true;
      for (int c = 0; c < 3 && whole; ++c) {
        const Placements::Membership* m = placements.find(nodes[c], p);
        whole = m != nullptr;
        if (m) number[c] = m->number;
      }
      for (int c = 0; c < 3 && whole; ++c) {
        const std::uint32_t e = sheet.sides[t][c];
        whole = mapper.joined(placement.map, number[c], number[(c + 1) % 3],
                              {nodes[(c + 1) % 3], e, sheet.edges[e].a == nodes[c]});
      }
      if (!whole) continue;
      Part part{.placement = p};
      for (int c = 0; c < 3; ++c) {
        part.source[c] = placement.source[number[c]];
        part.weight[c] = weights[nodes[c]].of(p);
      }
      out.push_back(part);
    }
    if (!out.empty()) return;
    // Behind all cuts: what one of its nodes shows, all over the triangle.
    const std::uint32_t p = placements.owner[nodes[0]];
    const Vec2d source = placements.all[p].source[placements.find(nodes[0], p)->number];
    out.push_back({p, {source, source, source}, {1, 1, 1}});
  };
  std::vector<std::vector<Part>> chunks((triangles + kChunk - 1) / kChunk);
  begin_.assign(triangles + 1, 0);
  parallelFor(0, chunks.size(), 1, [&](std::size_t c0, std::size_t c1) {
    std::vector<Part> own;
    for (std::size_t c = c0; c < c1; ++c) {
      for (std::size_t t = c * kChunk; t < std::min(triangles, (c + 1) * kChunk); ++t) {
        partsOf(t, own);
        begin_[t + 1] = static_cast<std::uint32_t>(own.size());
        chunks[c].insert(chunks[c].end(), own.begin(), own.end());
      }
    }
  });
  for (std::size_t t = 0; t < triangles; ++t) begin_[t + 1] += begin_[t];
  parts_.reserve(begin_.back());
  for (const std::vector<Part>& chunk : chunks)
    parts_.insert(parts_.end(), chunk.begin(), chunk.end());
}

Band fillBand(const Sheet& sheet, const FootFinder& feet, const SheetContent& content,
              const Placements& placements, const Slab& slab, int symmetry,
              const BandOptions& options, const Progress& progress) {
  return BandFilling(sheet, feet, content, placements, slab, symmetry, options).run(progress);
}

}  // namespace exemplar::surface
