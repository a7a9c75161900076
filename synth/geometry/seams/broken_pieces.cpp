// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/broken_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/figure_constants.h"
#include "core/parallel.h"
#include "search/lattice_cut.h"
#include "synth/geometry/seams/regions.h"

namespace exemplar {
namespace {

/// Samples that one task works on at least.
constexpr std::size_t kGrain = 1 << 14;

/// Which samples count as one of the two sides: those whose value, with `sign`, is below -`depth`
/// world units. Solid has sign 1, air -1.
Array3D<std::uint8_t> side(const Array3D<float>& values, float sign, double depth) {
  const auto limit = static_cast<float>(-depth);
  Array3D<std::uint8_t> mask(values.size());
  parallelFor(0, mask.count(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const float v = values.values()[s];
      // A sample on the surface is air.
      mask.values()[s] = sign > 0 ? v < limit : v >= -limit;
    }
  });
  return mask;
}

/// What origins copy.
Array3D<float> copied(const DistanceField& example, const Origins& origins) {
  Array3D<float> values(origins.size());
  parallelFor(0, values.count(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      values.values()[s] = example.values[origins.values()[s].cell()];
    }
  });
  return values;
}

/// The connected regions of a mask.
struct Pieces {
  Regions regions;
  /// Of each region: how many samples of the mask (none for what is outside of it), and whether it
  /// touches no side of the box.
  std::vector<std::size_t> samples;
  std::vector<std::uint8_t> whole;

  explicit Pieces(const Array3D<std::uint8_t>& mask)
      : regions(findRegions(mask.size(), [&](const Vec3i& p) { return mask[p] != 0; })),
        samples(regions.count),
        whole(regions.count, 1) {
    const Vec3i n = mask.size();
    regions.forEachRun([&](const Regions::Run& run, const Vec3i& first) {
      if (!mask[first]) return;
      samples[run.region] += static_cast<std::size_t>(run.end - run.begin);
      if (run.begin == 0 || run.end == n.x || first.y == 0 || first.y == n.y - 1 || first.z == 0 ||
          first.z == n.z - 1) {
        whole[run.region] = 0;
      }
    });
  }
};

/// What the example falls into.
struct ExamplePieces {
  std::size_t largest = 0, smallest = std::numeric_limits<std::size_t>::max();  // whole ones
  std::size_t inWhole = 0, all = 0;                                             // samples

  bool mostlyWhole() const {
    return static_cast<double>(inWhole) >= kMostlyWhole * static_cast<double>(all);
  }
  /// Pieces of fewer samples are broken: a share of the smallest whole piece's, or of the largest's
  /// if none is whole.
  double least() const {
    return kBrokenShare * static_cast<double>(inWhole > 0 ? smallest : largest);
  }
};

ExamplePieces piecesOf(const Array3D<std::uint8_t>& mask) {
  const Pieces pieces(mask);
  ExamplePieces found;
  for (std::uint32_t n = 0; n < pieces.regions.count; ++n) {
    const std::size_t size = pieces.samples[n];
    if (size == 0) continue;
    found.all += size;
    found.largest = std::max(found.largest, size);
    if (!pieces.whole[n]) continue;
    found.inWhole += size;
    found.smallest = std::min(found.smallest, size);
  }
  return found;
}

/// The sample of the example that is least far on the other side, the first of several.
std::optional<Vec3i> nearestOther(const DistanceField& example, float sign,
                                  const Array3D<std::uint8_t>* usable) {
  std::optional<Vec3i> cell;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    const float v = example.values.values()[s];
    if ((v < 0) == (sign > 0) || std::abs(v) >= least || (usable && !usable->values()[s])) continue;
    least = std::abs(v);
    cell = example.values.ijk(s);
  }
  return cell;
}

constexpr std::uint8_t kBroken = 1, kWhole = 2;  // marks; 0 for what is on the other side

/// Marks the samples of `mask`: those of whole pieces with fewer than `least` samples are broken,
/// unless any of them is fixed.
Array3D<std::uint8_t> judge(const Array3D<std::uint8_t>& mask, double least,
                            const Array3D<std::uint8_t>* fixed) {
  const Pieces pieces(mask);
  std::vector<std::uint8_t> marks(pieces.regions.count);
  for (std::uint32_t n = 0; n < marks.size(); ++n) {
    if (pieces.samples[n] == 0) continue;
    const bool broken = pieces.whole[n] && static_cast<double>(pieces.samples[n]) < least;
    marks[n] = broken ? kBroken : kWhole;
  }
  if (fixed) {
    pieces.regions.forEachRun([&](const Regions::Run& run, Vec3i p) {
      if (marks[run.region] != kBroken) return;
      for (; p.x < run.end; ++p.x) {
        if ((*fixed)[p]) marks[run.region] = kWhole;
      }
    });
  }
  Array3D<std::uint8_t> marked(mask.size());
  pieces.regions.parallelForEachRun([&](const Regions::Run& run, const Vec3i& first) {
    std::fill_n(&marked[first], run.end - run.begin, marks[run.region]);
  });
  return marked;
}

/// Gives what lies above the depth to the piece that is fewest steps away, whole ones first.
void addSkin(const Array3D<std::uint8_t>& all, const Array3D<std::uint8_t>* fixed,
             Array3D<std::uint8_t>& marks) {
  constexpr int kThick = 2;  // steps: half a voxel deep, but for edges and corners
  for (int step = 0; step < kThick; ++step) {
    const Array3D<std::uint8_t> before = marks;
    parallelForEachCell(all.size(), [&](const Vec3i& p) {
      if (!all[p] || before[p] || (fixed && (*fixed)[p])) return;
      for (const Vec3i& d : kFaceSteps) {
        const Vec3i q = p + d;
        if (all.contains(q)) marks[p] = std::max(marks[p], before[q]);
      }
    });
  }
}

/// Whether the example shows the other side at `cell`, and may be copied there.
class OtherSide {
 public:
  OtherSide(const DistanceField& example, float sign, const Array3D<std::uint8_t>* usable)
      : example_(example), usable_(usable), solid_(sign < 0) {}

  bool at(const Vec3i& cell) const {
    return example_.values.contains(cell) && (example_.values[cell] < 0) == solid_ &&
           (!usable_ || (*usable_)[cell]);
  }

 private:
  const DistanceField& example_;
  const Array3D<std::uint8_t>* usable_;
  bool solid_;
};

/// Gives each broken sample the offset of a neighbor that shows the other side there: from outside
/// in, a ring of samples at a time takes the offsets of the one around it.
void takeFromAround(const DistanceField& example, const Vec3i& other, const OtherSide& otherSide,
                    Array3D<std::uint8_t>& broken, std::vector<std::size_t> left,
                    Origins& origins) {
  std::vector<std::size_t> later;
  std::vector<std::pair<std::size_t, Origin>> ring;
  while (!left.empty()) {
    ring.clear();
    later.clear();
    for (const std::size_t s : left) {
      const Vec3i p = origins.ijk(s);
      std::vector<Vec3i> cells;
      float sum = 0;
      int count = 0;
      for (const Vec3i& step : kLatticeSteps) {
        const Vec3i q = p + step;
        if (!origins.contains(q) || broken[q]) continue;
        const Vec3i there = origins[q].cell();
        sum += example.values[there];
        ++count;
        const Vec3i cell = there - step;
        if (otherSide.at(cell)) cells.push_back(cell);
      }
      if (cells.empty()) {
        later.push_back(s);
        continue;
      }
      const float around = sum / static_cast<float>(count);
      ring.emplace_back(s, *std::min_element(cells.begin(), cells.end(), [&](auto& a, auto& b) {
                          return std::abs(example.values[a] - around) <
                                 std::abs(example.values[b] - around);
                        }));
    }
    if (ring.empty()) {
      for (const std::size_t s : later) ring.emplace_back(s, Origin(other));
      later.clear();
    }
    for (const auto& [s, origin] : ring) {
      origins.values()[s] = origin;
      broken.values()[s] = 0;
    }
    left.swap(later);
  }
}

/// Moves the broken pieces of one side of `values`, as seen at a depth, to the other.
std::int64_t dropSide(const DistanceField& example, const Array3D<float>& values, float sign,
                      double depth, double least, Origins& origins,
                      const BrokenPiecesOptions& options) {
  const std::optional<Vec3i> other = nearestOther(example, sign, options.usable);
  if (!other) return 0;
  Array3D<std::uint8_t> marks = judge(side(values, sign, depth), least, options.fixed);
  if (depth > 0) addSkin(side(values, sign, 0), options.fixed, marks);
  std::vector<std::size_t> left;
  for (std::size_t s = 0; s < marks.count(); ++s) {
    marks.values()[s] = marks.values()[s] == kBroken;
    if (marks.values()[s]) left.push_back(s);
  }
  const auto changed = static_cast<std::int64_t>(left.size());
  const OtherSide otherSide(example, sign, options.usable);
  takeFromAround(example, *other, otherSide, marks, std::move(left), origins);
  return changed;
}

}  // namespace

std::int64_t dropBrokenPieces(const DistanceField& example, Origins& origins,
                              const BrokenPiecesOptions& options, const Progress& progress) {
  progress.report("clearing broken pieces", 0);
  const Array3D<float> values = options.values ? *options.values : copied(example, origins);
  ExamplePieces solid = piecesOf(side(example.values, 1, 0));
  double depth = 0;
  if (!solid.mostlyWhole()) {
    const double contact = kContactDepth * example.voxelSize;
    const ExamplePieces deeper = piecesOf(side(example.values, 1, contact));
    if (deeper.inWhole > 0 && deeper.mostlyWhole()) {
      solid = deeper;
      depth = contact;
    }
  }
  const double bubble = piecesOf(side(example.values, -1, 0)).least();
  progress.report("clearing broken pieces", 0.2);
  std::int64_t changed = dropSide(example, values, 1, 0, solid.least(), origins, options);
  progress.report("clearing broken pieces", 0.4);
  if (depth > 0 && options.values) {
    changed += dropSide(example, values, 1, depth, solid.least(), origins, options);
  }
  progress.report("clearing broken pieces", 0.7);
  return changed + dropSide(example, values, -1, 0, bubble, origins, options);
}

}  // namespace exemplar
