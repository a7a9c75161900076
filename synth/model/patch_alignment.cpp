// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/patch_alignment.h"

#include <algorithm>

namespace exemplar {
namespace {

constexpr int kCandidates = 6;
constexpr int kAround = 2;         // columns around a core that should agree
constexpr int kNearSide = 4;       // cells
constexpr std::size_t kRare = 24;  // places in the examples
constexpr int kTriesForRare = 3;

int wrapped(int i, int n) { return ((i % n) + n) % n; }

}  // namespace

PatchAlignments::PatchAlignments(const ModelProblem& problem, std::span<const PatchSource> sources,
                                 const BlockCounts* counts)
    : problem_(problem), sources_(sources), counts_(counts) {}

/// Brings a cell back over periodic sides; false where it is outside.
bool PatchAlignments::within(Vec3i& p) const {
  const ModelOptions& o = problem_.options();
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] >= 0 && p[axis] < o.size[axis]) continue;
    if (!o.periodic[axis]) return false;
    p[axis] = wrapped(p[axis], o.size[axis]);
  }
  return true;
}

PatchMove::Alignment PatchAlignments::anywhere(Draws& draws,
                                               const PatchMove::Window& window) const {
  const ModelOptions& o = problem_.options();
  PatchMove::Alignment a;
  a.source = draws.below(static_cast<int>(sources_.size()));
  const PatchSource& source = sources_[a.source];
  a.frame = source.frames > 1 ? draws.below(source.frames) : 0;
  for (int axis = 0; axis < 2; ++axis) {
    const int c = window.center[axis], n = o.size[axis];
    a.cell[axis] = draws.below(source.size[axis]);
    if (o.periodic[axis]) continue;
    if (c < kNearSide && draws.below(4) > 0) a.cell[axis] = c;
    if (n - 1 - c < kNearSide && draws.below(4) > 0) a.cell[axis] = source.size[axis] - (n - c);
  }
  const bool up = o.periodic.z || (!o.sides[4].excludes() && !o.sides[5].excludes());
  a.cell.z = window.center.z;
  if (up) a.cell.z += draws.between(1 - source.size.z, o.size.z - 1);
  return a;
}

std::optional<PatchMove::Alignment> PatchAlignments::byBlock(Draws& draws,
                                                             const PatchMove::Window& window,
                                                             const CellBox& core) const {
  const Vec3i n = counts_->blockSize();
  for (int i = 0; i <= kTriesForRare; ++i) {
    const Vec3i step{draws.between(core.begin.x - n.x, core.end.x),
                     draws.between(core.begin.y - n.y, core.end.y),
                     draws.between(core.begin.z, core.end.z - 1)};
    Vec3i p = window.center + step;
    if (!within(p)) continue;
    const std::int32_t block = counts_->blockAt(problem_.position(p, window.frame));
    if (block == BlockCounts::kUnknown) continue;
    const auto places = counts_->places(block);
    if (i < kTriesForRare && places.size() > kRare) continue;
    const auto& place = places[draws.below(static_cast<int>(places.size()))];
    const PatchSource& source = sources_[place.source];
    PatchMove::Alignment a;
    a.source = place.source;
    a.frame = place.position % source.frames;
    const int column = place.position / source.frames / source.size.z;
    a.cell = Vec3i{column / source.size.y, column % source.size.y,
                   place.position / source.frames % source.size.z} -
             step;
    return a;
  }
  return std::nullopt;
}

double PatchAlignments::agreement(const PatchMove::Window& window,
                                  const PatchMove::Alignment& alignment, const CellBox& core,
                                  std::span<const Label> grid) const {
  const PatchSource& source = sources_[alignment.source];
  const Vec3i& size = problem_.options().size;
  const int frames = problem_.options().frames;
  // Heights that are within both; what is outside of one agrees with nothing.
  const int shift = alignment.cell.z - window.center.z;
  const int low = std::max({window.center.z + core.begin.z, 0, -shift});
  const int high = std::min({window.center.z + core.end.z, size.z, source.size.z - shift});
  if (high <= low) return -1;
  int same = 0, all = 0;
  bool differs = false;
  for (int x = core.begin.x - kAround; x < core.end.x + kAround; ++x) {
    for (int y = core.begin.y - kAround; y < core.end.y + kAround; ++y) {
      const bool inCore =
          x >= core.begin.x && x < core.end.x && y >= core.begin.y && y < core.end.y;
      if (inCore && differs) {
        y = core.end.y - 1;
        continue;
      }
      Vec3i p{window.center.x + x, window.center.y + y, low};
      const Vec3i q{alignment.cell.x + x, alignment.cell.y + y, low + shift};
      const bool here = within(p), there = source.contains(q, alignment.frame);
      if (!inCore && (here || there)) all += high - low;
      if (!here || !there) continue;
      const Label* a = grid.data() + problem_.position(p, window.frame);
      const Label* b = source.labels.data() + source.position(q, alignment.frame);
      int equal = 0;
      if (frames == 1 && source.frames == 1) {
        for (int z = 0; z < high - low; ++z) equal += a[z] == b[z];
      } else {
        for (int z = 0; z < high - low; ++z) equal += a[z * frames] == b[z * source.frames];
      }
      if (inCore) {
        differs = differs || equal < high - low;
      } else {
        same += equal;
      }
    }
  }
  return !differs ? -1 : all > 0 ? double(same) / all : 0;
}

std::optional<PatchMove::Alignment> PatchAlignments::find(Draws& draws,
                                                          const PatchMove::Window& window,
                                                          const CellBox& core,
                                                          std::span<const Label> grid,
                                                          double least) const {
  std::optional<PatchMove::Alignment> best;
  double most = least;
  for (int i = 0; i < kCandidates; ++i) {
    std::optional<PatchMove::Alignment> candidate;
    if (counts_ && i % 2 == 1) candidate = byBlock(draws, window, core);
    if (!candidate) candidate = anywhere(draws, window);
    const double agrees = agreement(window, *candidate, core, grid);
    if (agrees < 0 || agrees <= most) continue;
    most = agrees;
    best = candidate;
  }
  return best;
}

}  // namespace exemplar
