// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/field_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "voxelize/overlap.h"

namespace exemplar {

namespace {

constexpr int kUsualBlock = 8;
constexpr int kSmallestSplit = 28;    // axes shorter than this are one block
constexpr int kMostBlocks = 1 << 16;  // labels
constexpr int kMostOverlapping = 1 << 14;
constexpr int kGoodOverlapping = 1 << 12;  // with more, fewer places are taken
constexpr std::size_t kJudged = 64;        // blocks by which a phase of a result is judged
constexpr double kRepeats = 0.6;           // of the surface, for a step to count as a period
constexpr double kAsGoodAs = 0.97;         // of the best step's share: a shorter one is preferred

void check(const FieldBlocksOptions& options) {
  for (int axis = 0; axis < 3; ++axis) {
    const int side = options.block[axis];
    if (side != 0 && (side < 2 || side > 64)) {
      throw InputError("`block` " + std::to_string(side) +
                       ": each side must be 2 to 64 samples, or 0 to find it");
    }
  }
  if (!(options.tolerance >= 0)) throw InputError("`tolerance`: must be 0 voxels or more");
  if (!(options.truncation > 0)) throw InputError("`truncation`: must be more than 0 voxels");
  if (options.overlap < 0 || options.overlap > 63)
    throw InputError("`overlap` " + std::to_string(options.overlap) + ": must be 0 to 63 samples");
}

// The first sample of a cell's block, from that of the first cell.
Vec3i corner(const Vec3i& cell, const Vec3i& step) {
  return {cell.x * step.x, cell.y * step.y, cell.z * step.z};
}

// The field in voxels, clamped.
Array3D<float> truncated(const DistanceField& field, double truncation) {
  Array3D<float> values(field.size());
  const float scale = static_cast<float>(1 / field.voxelSize);
  const float most = static_cast<float>(truncation);
  for (std::size_t s = 0; s < values.count(); ++s)
    values.data()[s] = std::clamp(field.values.data()[s] * scale, -most, most);
  return values;
}

// Of the samples next to the surface the share that is the same, within `tolerance`, a step later.
double sameAfter(const Array3D<float>& values, const Vec3i& step, double tolerance,
                 const Progress& progress) {
  const Vec3i size = values.size() - step;
  std::int64_t near = 0, same = 0;
  for (int k = 0; k < size.z; ++k) {
    progress.check();
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const float a = values(i, j, k), b = values(i + step.x, j + step.y, k + step.z);
        if (std::abs(a) > 1 && std::abs(b) > 1) continue;
        ++near;
        same += std::abs(a - b) <= tolerance;
      }
  }
  return near == 0 ? 0 : static_cast<double>(same) / static_cast<double>(near);
}

bool sameBlock(const Array3D<float>& p, const Vec3i& a, const Array3D<float>& q, const Vec3i& b,
               const Vec3i& block, float tolerance) {
  for (int k = 0; k < block.z; ++k)
    for (int j = 0; j < block.y; ++j) {
      const float* row = &p(a.x, a.y + j, a.z + k);
      const float* other = &q(b.x, b.y + j, b.z + k);
      for (int i = 0; i < block.x; ++i)
        if (std::abs(row[i] - other[i]) > tolerance) return false;
    }
  return true;
}

// Where blocks are taken from a field.
struct Lattice {
  Vec3i block{}, step{}, phase{};

  Vec3i cells(const Vec3i& size) const {
    Vec3i cells;
    for (int axis = 0; axis < 3; ++axis)
      cells[axis] = (size[axis] - phase[axis] - block[axis]) / step[axis] + 1;
    return cells;
  }
  Vec3i start(const Vec3i& cell) const { return phase + corner(cell, step); }
};

// The labels of a field's blocks.
struct Labeled {
  Vec3i cells{};
  std::vector<int> label;    // of each cell
  std::vector<Vec3i> first;  // of each label, its first cell
  double repetition() const {
    return label.empty()
               ? 0
               : 1 - static_cast<double>(first.size()) / static_cast<double>(label.size());
  }
};

// Nothing for more than `most` labels.
std::optional<Labeled> label(const Array3D<float>& values, const Lattice& lattice, double tolerance,
                             int most, const Progress& progress) {
  Labeled result;
  result.cells = lattice.cells(values.size());
  const Array3D<std::uint8_t> cells(result.cells);
  result.label.resize(cells.count());
  for (std::size_t c = 0; c < cells.count(); ++c) {
    if (c % 64 == 0) progress.check();
    const Vec3i cell = cells.ijk(c);
    std::size_t l = 0;
    while (l < result.first.size() &&
           !sameBlock(values, lattice.start(result.first[l]), values, lattice.start(cell),
                      lattice.block, static_cast<float>(tolerance)))
      ++l;
    if (l == result.first.size()) {
      if (l == static_cast<std::size_t>(most)) return std::nullopt;
      result.first.push_back(cell);
    }
    result.label[c] = static_cast<int>(l);
  }
  return result;
}

[[noreturn]] void refuseLabels(int most) {
  throw InputError("the example has more than " + std::to_string(most) +
                   " different blocks; use a larger `block`, a larger `tolerance`, or a smaller "
                   "example");
}

Labeled labelOrThrow(const Array3D<float>& values, const Lattice& lattice, double tolerance,
                     const Progress& progress) {
  std::optional<Labeled> labeled = label(values, lattice, tolerance, kMostBlocks, progress);
  if (!labeled) refuseLabels(kMostBlocks);
  return std::move(*labeled);
}

// Axis after axis, twice: the phase at which most blocks are repeated.
Vec3i findPhase(const Array3D<float>& values, const Vec3i& block, double tolerance,
                const Progress& progress) {
  const auto repetition = [&](const Vec3i& phase) {
    return labelOrThrow(values, {block, block, phase}, tolerance, progress).repetition();
  };
  Vec3i best{};
  double highest = repetition(best);
  for (int round = 0; round < 2; ++round)
    for (int axis = 0; axis < 3; ++axis) {
      progress.report("finding how blocks repeat", (3 * round + axis) / 6.0);
      // No phase that would leave the axis without a whole block.
      const int phases = std::min(block[axis], values.size()[axis] - block[axis] + 1);
      std::vector<double> found(static_cast<std::size_t>(phases));
      parallelFor(0, found.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
          Vec3i phase = best;
          phase[axis] = static_cast<int>(p);
          found[p] = repetition(phase);
        }
      });
      for (int p = 0; p < phases; ++p)
        if (found[static_cast<std::size_t>(p)] > highest) {
          highest = found[static_cast<std::size_t>(p)];
          best[axis] = p;
        }
    }
  return best;
}

// Blocks that overlap are taken as densely as the number of labels allows.
Labeled labelOverlapping(const Array3D<float>& values, const Vec3i& stride, double tolerance,
                         Lattice& lattice, const Progress& progress) {
  for (int densest = 1;; densest *= 2) {
    // Each try has a fraction of what is left.
    progress.report("taking overlapping blocks", 1 - 1.0 / densest);
    // Steps that divide the stride, so that the example's own neighbors are among the pairs.
    for (int axis = 0; axis < 3; ++axis) {
      const bool overlaps = stride[axis] < lattice.block[axis];
      int step = overlaps ? std::min(densest, stride[axis]) : stride[axis];
      while (stride[axis] % step != 0) --step;
      lattice.step[axis] = step;
    }
    const bool sparsest = lattice.step == stride;
    const int most = sparsest ? kMostOverlapping : kGoodOverlapping;
    std::optional<Labeled> labeled = label(values, lattice, tolerance, most, progress);
    if (labeled) return std::move(*labeled);
    if (sparsest) refuseLabels(kMostOverlapping);
  }
}

double squaredDifference(const Array3D<float>& values, const Vec3i& a, const Vec3i& b,
                         const Vec3i& block) {
  double sum = 0;
  for (int k = 0; k < block.z; ++k)
    for (int j = 0; j < block.y; ++j)
      for (int i = 0; i < block.x; ++i) {
        const Vec3i o{i, j, k};
        const double d = static_cast<double>(values[a + o]) - values[b + o];
        sum += d * d;
      }
  return sum;
}

// More members than this are compared with as many of them, evenly chosen.
constexpr std::size_t kCompared = 64;

std::vector<Vec3i> findMedoids(const Array3D<float>& values, const FieldBlocks& blocks,
                               const Progress& progress) {
  std::vector<Vec3i> medoids(blocks.members.size());
  parallelFor(0, medoids.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      const std::vector<Vec3i>& members = blocks.members[l];
      const std::size_t step = (members.size() + kCompared - 1) / kCompared;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t m = 0; m < members.size(); m += step) {
        progress.check();
        double sum = 0;
        for (std::size_t n = 0; n < members.size(); n += step)
          sum += squaredDifference(values, blocks.phase + corner(members[m], blocks.step),
                                   blocks.phase + corner(members[n], blocks.step), blocks.block);
        if (sum >= least) continue;
        least = sum;
        medoids[l] = members[m];
      }
    }
  });
  return medoids;
}

}  // namespace

Vec3i findBlockSize(const DistanceField& field, const FieldBlocksOptions& options,
                    const Progress& progress) {
  check(options);
  const Array3D<float> values = truncated(field, options.truncation);
  Vec3i block{};
  for (int axis = 0; axis < 3; ++axis) {
    progress.report("finding how blocks repeat", axis / 3.0);
    const int n = field.size()[axis];
    if (options.block[axis] != 0) {
      block[axis] = options.block[axis];
    } else if (n < kSmallestSplit) {
      block[axis] = n;
    } else {
      const int most = std::min(n / 2, 64);
      std::vector<double> same(static_cast<std::size_t>(most) + 1, 0.0);
      parallelFor(4, same.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
          Vec3i step{};
          step[axis] = static_cast<int>(p);
          same[p] = sameAfter(values, step, options.tolerance, progress);
        }
      });
      const double best = *std::ranges::max_element(same);
      block[axis] = std::min(kUsualBlock, most);
      if (best < kRepeats) continue;
      int p = 4;
      while (same[static_cast<std::size_t>(p)] < kAsGoodAs * best) ++p;
      block[axis] = p;
    }
  }
  return block;
}

FieldBlocks cutIntoBlocks(const DistanceField& field, const FieldBlocksOptions& options,
                          const Progress& progress) {
  check(options);
  FieldBlocks blocks;
  blocks.block = findBlockSize(field, options, progress.part(0, 0.2));
  for (int axis = 0; axis < 3; ++axis) {
    const int n = field.size()[axis], side = blocks.block[axis];
    if (side > n) {
      throw InputError("`block` " + std::to_string(side) + ": larger than the field, which is " +
                       std::to_string(n) + " samples; use a smaller one or a higher `resolution`");
    }
    if (options.phase && ((*options.phase)[axis] < 0 || (*options.phase)[axis] >= side ||
                          (*options.phase)[axis] + side > n)) {
      throw InputError("`phase` " + std::to_string((*options.phase)[axis]) +
                       ": out of range for blocks of " + std::to_string(side) +
                       " samples in a field of " + std::to_string(n));
    }
  }
  blocks.tolerance = options.tolerance;
  blocks.truncation = options.truncation;
  blocks.stride = blocks.block;
  if (options.overlap > 0) {
    for (int axis = 0; axis < 3; ++axis) {
      if (blocks.block[axis] == field.size()[axis]) continue;
      if (options.overlap >= blocks.block[axis]) {
        throw InputError("`overlap` " + std::to_string(options.overlap) + ": blocks of " +
                         std::to_string(blocks.block[axis]) +
                         " samples cannot share that many; use a larger `block` or a smaller "
                         "`overlap`");
      }
      blocks.stride[axis] = blocks.block[axis] - options.overlap;
    }
  }
  const Array3D<float> values = truncated(field, options.truncation);
  Lattice lattice{blocks.block, blocks.stride, options.phase.value_or(Vec3i{})};
  Labeled labeled;
  if (options.overlap > 0) {
    labeled = labelOverlapping(values, blocks.stride, options.tolerance, lattice,
                               progress.part(0.2, 0.6));
  } else {
    if (!options.phase)
      lattice.phase = findPhase(values, blocks.block, options.tolerance, progress.part(0.2, 0.6));
    progress.report("labeling blocks", 0.6);
    labeled = labelOrThrow(values, lattice, options.tolerance, progress);
  }
  blocks.phase = lattice.phase;
  blocks.step = lattice.step;
  blocks.repetition = labeled.repetition();
  blocks.grid.cells = Array3D<Label>(labeled.cells);
  blocks.members.resize(labeled.first.size());
  for (std::size_t c = 0; c < labeled.label.size(); ++c) {
    blocks.grid.cells.data()[c] = static_cast<Label>(labeled.label[c]);
    blocks.members[static_cast<std::size_t>(labeled.label[c])].push_back(blocks.grid.cells.ijk(c));
  }
  blocks.grid.labels.resize(labeled.first.size());
  blocks.grid.cellSize = cast<double>(blocks.stride) * field.voxelSize;
  const Vec3d half{0.5, 0.5, 0.5};
  blocks.grid.origin = field.position(cast<double>(blocks.phase) - half);
  progress.report("comparing blocks of one label", 0.7);
  blocks.medoid = findMedoids(values, blocks, progress);
  const Progress last = progress.part(0.85, 1);
  blocks.adjacency = options.overlap > 0 ? overlapAdjacency(values, blocks, last)
                                         : findAdjacency(blocks.grid, {}, last);
  return blocks;
}

RecognizedBlocks recognizeBlocks(const DistanceField& field, const DistanceField& example,
                                 const FieldBlocks& blocks, const Progress& progress) {
  if (blocks.stride != blocks.block)
    throw InputError("blocks that overlap cannot be recognized in a result; cut with `overlap` 0");
  for (int axis = 0; axis < 3; ++axis)
    if (field.size()[axis] < blocks.block[axis])
      throw InputError("the result is smaller than a block of " +
                       std::to_string(blocks.block[axis]) + " samples");
  const Array3D<float> values = truncated(field, blocks.truncation);
  const Array3D<float> known = truncated(example, blocks.truncation);
  const int labels = blocks.grid.labelCount();
  const auto labelAt = [&](const Vec3i& start) {
    int l = 0;
    while (l < labels &&
           !sameBlock(known, blocks.phase + corner(blocks.members[l][0], blocks.step), values,
                      start, blocks.block, static_cast<float>(blocks.tolerance)))
      ++l;
    return l;
  };
  // All phases, each judged by a few blocks all over the field: where nothing repeats, a phase that
  // is wrong along one axis says nothing of the others.
  const auto knownBlocks = [&](const Vec3i& phase) {
    const Lattice lattice{blocks.block, blocks.block, phase};
    const Array3D<std::uint8_t> cells(lattice.cells(field.size()));
    const std::size_t judged = std::min(cells.count(), kJudged);
    int found = 0;
    progress.check();
    for (std::size_t n = 0; n < judged; ++n)
      found += labelAt(lattice.start(cells.ijk(n * cells.count() / judged))) < labels;
    return static_cast<double>(found) / static_cast<double>(judged);
  };
  Vec3i phases;
  for (int axis = 0; axis < 3; ++axis)
    phases[axis] = std::min(blocks.block[axis], field.size()[axis] - blocks.block[axis] + 1);
  const Array3D<std::uint8_t> allPhases(phases);
  std::vector<double> share(allPhases.count());
  progress.report("recognizing blocks", 0);
  parallelFor(0, share.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) share[p] = knownBlocks(allPhases.ijk(p));
  });
  RecognizedBlocks result;
  result.phase =
      allPhases.ijk(static_cast<std::size_t>(std::ranges::max_element(share) - share.begin()));
  const Lattice lattice{blocks.block, blocks.block, result.phase};
  result.grid.cells = Array3D<Label>(lattice.cells(field.size()));
  result.grid.labels = blocks.grid.labels;
  result.grid.labels.push_back({});
  result.grid.labels.back().name = "not in the example";
  result.grid.cellSize = blocks.grid.cellSize;
  result.grid.origin = field.position(cast<double>(result.phase) - Vec3d{0.5, 0.5, 0.5});
  const std::size_t cells = result.grid.cells.count();
  for (std::size_t c = 0; c < cells; ++c) {
    if (c % 256 == 0) {
      progress.report("recognizing blocks",
                      0.5 + 0.5 * static_cast<double>(c) / static_cast<double>(cells));
    }
    const int l = labelAt(lattice.start(result.grid.cells.ijk(c)));
    result.grid.cells.data()[c] = static_cast<Label>(l);
    result.unknown += l == labels;
  }
  return result;
}

std::array<bool, 6> cutSides(const DistanceField& field) {
  std::array<bool, 6> cut{};
  const Vec3i last = field.size() - Vec3i{1, 1, 1};
  for (std::size_t s = 0; s < field.values.count(); ++s) {
    if (!(field.values.data()[s] < 0)) continue;
    const Vec3i p = field.values.ijk(s);
    for (int axis = 0; axis < 3; ++axis) {
      cut[2 * axis] = cut[2 * axis] || p[axis] == 0;
      cut[2 * axis + 1] = cut[2 * axis + 1] || p[axis] == last[axis];
    }
  }
  return cut;
}

PlacedBlocks placeBlocks(const DistanceField& example, const FieldBlocks& blocks,
                         const Array3D<Label>& labels, const Progress& progress) {
  if (labels.empty()) throw InputError("the grid of labels has no cells to put blocks in");
  for (Label l : labels.values())
    if (l >= blocks.members.size())
      throw InputError("label " + std::to_string(l) +
                       " is in the grid and no block of the example has it");
  const Vec3i size = corner(labels.size(), blocks.stride);
  requireMemory(static_cast<double>(labels.count()) * static_cast<double>(volume(blocks.stride)) *
                    (sizeof(float) + sizeof(Origin)),
                "the result", "use a smaller `size`");
  PlacedBlocks placed;
  placed.field.values = Array3D<float>(size);
  placed.field.voxelSize = example.voxelSize;
  placed.field.origin = example.origin;
  placed.field.truncation = example.truncation;
  placed.origins = Origins(size);

  // How little a block's continuation across a low face agrees with what is in place.
  const auto disagreement = [&](const Vec3i& from, const Vec3i& to, int axis, double limit) {
    Vec3i face = blocks.stride;
    face[axis] = 1;
    double sum = 0;
    for (int k = 0; k < face.z; ++k)
      for (int j = 0; j < face.y; ++j) {
        for (int i = 0; i < face.x; ++i) {
          const Vec3i o{i, j, k};
          Vec3i before = from + o;
          --before[axis];
          Vec3i there = to + o;
          --there[axis];
          // At the example's own side the block goes on as it begins.
          const float own = example.values[example.values.clamped(before)];
          const double d = static_cast<double>(own) - placed.field.values[there];
          sum += d * d;
        }
        if (sum > limit) return sum;
      }
    return sum;
  };
  for (std::size_t c = 0; c < labels.count(); ++c) {
    if (c % 64 == 0) {
      progress.report("placing blocks",
                      static_cast<double>(c) / static_cast<double>(labels.count()));
    }
    const Vec3i cell = labels.ijk(c), to = corner(cell, blocks.stride);
    const Label l = labels.data()[c];
    Vec3i best = blocks.medoid[l];
    if (cell != Vec3i{}) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3i& member : blocks.members[l]) {
        const Vec3i from = blocks.phase + corner(member, blocks.step);
        double sum = 0;
        for (int axis = 0; axis < 3 && sum < least; ++axis)
          if (cell[axis] > 0) sum += disagreement(from, to, axis, least - sum);
        if (sum >= least) continue;
        least = sum;
        best = member;
      }
    }
    const Vec3i from = blocks.phase + corner(best, blocks.step);
    for (int k = 0; k < blocks.stride.z; ++k)
      for (int j = 0; j < blocks.stride.y; ++j)
        for (int i = 0; i < blocks.stride.x; ++i) {
          const Vec3i o{i, j, k};
          placed.field.values[to + o] = example.values[from + o];
          placed.origins[to + o] = Origin(from + o);
        }
  }
  return placed;
}

}  // namespace exemplar
