// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/assembly.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/cells.h"
#include "synth/geometry/pyramid/source_part.h"
#include "synth/geometry/seams/broken_pieces.h"
#include "synth/geometry/seams/even_seams.h"
#include "synth/geometry/seams/level_seams.h"

namespace exemplar {
namespace {

/// Many small steps rather than a few that show. What is copied is near
/// enough to what was wanted.
constexpr SeamOptions kFineSeams{
    .passes = 1, .fidelity = 0, .length = 0.005, .slope = 2, .squared = true};
/// How far beyond its box a periodic result's seams are evened out with it, in voxels.
constexpr int kWrapMargin = 12;

class Assembly {
 public:
  Assembly(const std::vector<SourcePart>& parts, const PyramidLevel& level, const Vec3i& size,
           const Array3D<std::uint8_t>* kept, bool clearKept)
      : parts_(parts),
        level_(level),
        size_(size),
        kept_(kept),
        whole_(clearKept ? nullptr : kept),
        sheet_(parts) {}

  SynthesisResult run(const PyramidSources& sources, const Array3D<float>& target,
                      const Progress& progress) {
    progress.report("cutting seams", 0);
    Origins origins(size_);
    parallelForEachCell(size_, [&](const Vec3i& p) {
      const Vec3i cell = sources[p + level_.target.margin.before];
      const std::size_t part = level_.source.partOf(cell);
      const Vec3i inside =
          parts_[part].field.values.clamped(cell - level_.source.parts[part].begin);
      origins[p] = Origin(inside + Vec3i{sheet_.first[part], 0, 0});
    });
    Array3D<float> copied = sheet_.field.values;
    for (float& v : copied.values()) v /= static_cast<float>(sheet_.field.voxelSize);
    SeamOptions seams = kFineSeams;
    seams.fixed = kept_;
    if (!sheet_.usable.empty()) seams.usable = &sheet_.usable;
    Array3D<std::uint8_t> air = level_.airSamples();
    if (!air.empty()) {
      air = withoutMargins(level_, air);
      seams.air = &air;
    }
    alignPieces(copied, origins, 1, seams, progress);
    refineSeamsAround(copied, withoutMargins(level_, target), level_.target.periodic, seams,
                      origins, progress.part(0.1, 0.5));

    dropBrokenPieces(sheet_.field, origins, {seams.usable, whole_}, progress.part(0.5, 0.6));
    SynthesisResult result;
    result.field = even(origins, seams, progress.part(0.6, 0.8));
    // What is thin may have come apart below the surface: that goes as well, and what little is
    // left after evening once more goes as it is copied.
    BrokenPiecesOptions pieces{seams.usable, whole_, &result.field.values};
    if (dropBrokenPieces(sheet_.field, origins, pieces, progress.part(0.8, 0.85)) > 0) {
      result.field = even(origins, seams, progress.part(0.85, 0.95));
      const Origins before = origins;
      dropBrokenPieces(sheet_.field, origins, pieces, progress.part(0.95, 1));
      parallelForEachCell(size_, [&](const Vec3i& p) {
        if (origins[p] == before[p]) return;
        result.field.values[p] = sheet_.field.values[origins[p].cell()];
      });
    }
    parallelForEachCell(size_,
                        [&](const Vec3i& p) { origins[p] = sheet_.toExample(parts_, origins[p]); });
    result.origins = std::move(origins);
    return result;
  }

 private:
  DistanceField even(const Origins& origins, const SeamOptions& seams,
                     const Progress& progress) const {
    EvenSeamsOptions options;
    options.fixed = seams.fixed;
    options.usable = seams.usable;
    const Axes& periodic = level_.target.periodic;
    if (!periodic.any()) return evenSeams(sheet_.field, origins, options, progress);
    // With a margin that shows what lies at the other side, cut off again.
    Vec3i margin{0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
      if (periodic[axis]) margin[axis] = std::min(kWrapMargin, origins.size()[axis]);
    }
    const Vec3i n = origins.size();
    Origins around(n + margin * 2);
    Array3D<std::uint8_t> fixed;
    if (seams.fixed) {
      fixed = Array3D<std::uint8_t>(around.size());
      options.fixed = &fixed;
    }
    parallelForEachCell(around.size(), [&](const Vec3i& cell) {
      Vec3i p = cell - margin;
      for (int axis = 0; axis < 3; ++axis) p[axis] = (p[axis] + n[axis]) % n[axis];
      around[cell] = origins[p];
      if (seams.fixed) fixed[cell] = (*seams.fixed)[p];
    });
    DistanceField field = evenSeams(sheet_.field, around, options, progress);
    Array3D<float> inner(n);
    parallelForEachCell(n, [&](const Vec3i& p) { inner[p] = field.values[p + margin]; });
    field.values = std::move(inner);
    return field;
  }

  const std::vector<SourcePart>& parts_;
  const PyramidLevel& level_;
  Vec3i size_;
  const Array3D<std::uint8_t>* kept_;
  const Array3D<std::uint8_t>* whole_;  ///< where nothing is cleared away; or none
  SourceSheet sheet_;
};

}  // namespace

SynthesisResult assemble(const std::vector<SourcePart>& parts, const PyramidLevel& level,
                         const PyramidSources& sources, const Array3D<float>& target,
                         const Vec3i& size, const Array3D<std::uint8_t>* kept,
                         const Progress& progress, bool clearKept) {
  return Assembly(parts, level, size, kept, clearKept).run(sources, target, progress);
}

}  // namespace exemplar
