// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/detail.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/resample.h"
#include "synth/geometry/pyramid/source_part.h"
#include "synth/geometry/seams/even_seams.h"
#include "synth/geometry/seams/seams.h"

namespace exemplar {
namespace {

constexpr int kMostDetail = 16;
/// Seams see distances up to here, in fine voxels.
constexpr float kSeamTruncation = 4;
/// What a face of a seam costs in itself: as in the assembly of a synthesis.
constexpr double kSeamLength = 0.005;

}  // namespace

SynthesisResult addDetail(std::span<const DistanceField* const> fine, const Origins& origins,
                          int factor, const Progress& progress) {
  if (factor < 1 || factor > kMostDetail) {
    throw InputError("`detail` " + std::to_string(factor) + ": expected 1 to " +
                     std::to_string(kMostDetail));
  }
  requireMemory(40.0 * static_cast<double>(volume(origins.size())) * factor * factor * factor,
                "a result of this detail", "use less `detail`");
  // The parts that the origins name: examples in all their turns.
  std::map<std::pair<int, int>, std::size_t> numbers;
  for (const Origin& origin : origins.values()) numbers[{origin.example, origin.turns}] = 0;
  std::vector<SourcePart> parts;
  for (auto& [key, number] : numbers) {
    if (key.first >= static_cast<int>(fine.size())) {
      throw InputError("the origins name example " + std::to_string(key.first + 1) + " of " +
                       std::to_string(fine.size()));
    }
    number = parts.size();
    parts.push_back({turnedField(*fine[key.first], key.second), key.first, key.second, {}});
  }
  const SourceSheet sheet(parts);
  // Where the samples of each coarse cell begin on the sheet.
  Array3D<Vec3i> first(origins.size());
  forEachCell(origins.size(), [&](const Vec3i& p) {
    const Origin& from = origins[p];
    const std::size_t number = numbers.at({from.example, from.turns});
    const SourcePart& part = parts[number];
    const Vec3i n = part.field.size();
    const Vec3i coarse = turnedSize({n.x / factor, n.y / factor, n.z / factor}, part.turns);
    const Vec3i sample = turnedCell(from.cell(), coarse, part.turns) * factor;
    const Vec3i last = sample + Vec3i{1, 1, 1} * (factor - 1);
    if (!part.field.values.contains(sample) || !part.field.values.contains(last)) {
      throw InputError("the finer example does not fit the origins: they name cell " +
                       std::to_string(from.cell().x) + ", " + std::to_string(from.cell().y) + ", " +
                       std::to_string(from.cell().z) + "; sample the example as for the synthesis");
    }
    first[p] = sample + Vec3i{sheet.first[number], 0, 0};
  });
  progress.report("adding detail", 0.05);
  Origins pulled(origins.size() * factor);
  parallelForEachCell(pulled.size(), [&](const Vec3i& p) {
    const Vec3i coarse{p.x / factor, p.y / factor, p.z / factor};
    pulled[p] = Origin(first[coarse] + (p - coarse * factor));
  });

  Array3D<float> copied = sheet.field.values;
  for (float& v : copied.values()) {
    v = std::clamp(v / static_cast<float>(sheet.field.voxelSize), -kSeamTruncation,
                   kSeamTruncation);
  }
  Array3D<float> target(pulled.size());
  parallelForEachCell(target.size(), [&](const Vec3i& p) { target[p] = copied[pulled[p].cell()]; });
  SeamOptions seams;
  seams.passes = 1;
  seams.reach = 2 * factor;
  seams.length = kSeamLength;
  if (!sheet.usable.empty()) seams.usable = &sheet.usable;
  if (factor > 1) {
    refineSeams(copied, target, pulled, seams, progress.part(0.2, 0.7));
  }
  EvenSeamsOptions even;
  even.usable = seams.usable;
  SynthesisResult result;
  result.field = evenSeams(sheet.field, pulled, even, progress.part(0.7, 1));
  parallelForEachCell(pulled.size(),
                      [&](const Vec3i& p) { pulled[p] = sheet.toExample(parts, pulled[p]); });
  result.origins = std::move(pulled);
  return result;
}

DistanceField sampledFinely(const DistanceField& field, const DistanceField& like, int factor) {
  DistanceField fine;
  fine.values = Array3D<float>(like.size() * factor);
  fine.voxelSize = like.voxelSize / factor;
  const double half = (fine.voxelSize - like.voxelSize) / 2;
  fine.origin = like.origin + Vec3d{half, half, half};
  fine.truncation = field.truncation;
  parallelFor(0, fine.values.count(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      fine.values.values()[s] =
          sampleTrilinear(field, fine.position(cast<double>(fine.values.ijk(s))));
    }
  });
  return fine;
}

}  // namespace exemplar
