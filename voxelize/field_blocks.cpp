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

namespace exemplar {

namespace {

constexpr int kUsualBlock = 8;
constexpr int kSmallestSplit = 28;  // axes shorter than this are one block
constexpr int kMostLabels = 1 << 16;
constexpr double kRepeats = 0.6;    // of the surface, for a step to count as a period
constexpr double kAsGoodAs = 0.97;  // of the best step's share: a shorter one is preferred

void check(const FieldBlocksOptions& options) {
  for (int axis = 0; axis < 3; ++axis) {
    const int side = options.block[axis];
    if (side != 0 && (side < 2 || side > 64)) {
      throw InputError("blocks of " + std::to_string(side) +
                       " samples a side are out of range; 2 to 64 is right");
    }
  }
  if (!(options.tolerance >= 0))
    throw InputError("a tolerance of blocks must be at least 0 voxels");
  if (!(options.truncation > 0))
    throw InputError("blocks must be compared within more than 0 voxels");
}

// The first sample of a cell's block, from that of the first cell.
Vec3i corner(const Vec3i& cell, const Vec3i& block) {
  return {cell.x * block.x, cell.y * block.y, cell.z * block.z};
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
double sameAfter(const Array3D<float>& values, const Vec3i& step, double tolerance) {
  const Vec3i size = values.size() - step;
  std::int64_t near = 0, same = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const float a = values(i, j, k), b = values(i + step.x, j + step.y, k + step.z);
        if (std::abs(a) > 1 && std::abs(b) > 1) continue;
        ++near;
        same += std::abs(a - b) <= tolerance;
      }
  return near == 0 ? 0 : static_cast<double>(same) / static_cast<double>(near);
}

// The labels of the whole blocks at a phase.
struct Labelled {
  Vec3i cells{};
  std::vector<int> label;    // of each cell
  std::vector<Vec3i> first;  // of each label, its first cell
  double repetition() const {
    return label.empty()
               ? 0
               : 1 - static_cast<double>(first.size()) / static_cast<double>(label.size());
  }
};

bool sameBlock(const Array3D<float>& values, const Vec3i& a, const Vec3i& b, const Vec3i& block,
               float tolerance) {
  for (int k = 0; k < block.z; ++k)
    for (int j = 0; j < block.y; ++j) {
      const float* p = &values(a.x, a.y + j, a.z + k);
      const float* q = &values(b.x, b.y + j, b.z + k);
      for (int i = 0; i < block.x; ++i)
        if (std::abs(p[i] - q[i]) > tolerance) return false;
    }
  return true;
}

Labelled label(const Array3D<float>& values, const Vec3i& block, const Vec3i& phase,
               double tolerance) {
  Labelled result;
  for (int axis = 0; axis < 3; ++axis)
    result.cells[axis] = (values.size()[axis] - phase[axis]) / block[axis];
  const Array3D<std::uint8_t> cells(result.cells);
  const auto start = [&](const Vec3i& cell) { return phase + corner(cell, block); };
  result.label.resize(cells.count());
  for (std::size_t c = 0; c < cells.count(); ++c) {
    const Vec3i cell = cells.ijk(c);
    std::size_t l = 0;
    while (l < result.first.size() && !sameBlock(values, start(result.first[l]), start(cell), block,
                                                 static_cast<float>(tolerance)))
      ++l;
    if (l == result.first.size()) {
      if (l == static_cast<std::size_t>(kMostLabels)) {
        throw InputError(
            "the example has more than 65,536 different blocks; use larger ones, a "
            "larger tolerance or a smaller example");
      }
      result.first.push_back(cell);
    }
    result.label[c] = static_cast<int>(l);
  }
  return result;
}

// Axis after axis, twice: the phase at which most blocks are repeated.
Vec3i findPhase(const Array3D<float>& values, const Vec3i& block, double tolerance,
                const Progress& progress) {
  Vec3i best{};
  double repetition = label(values, block, best, tolerance).repetition();
  for (int round = 0; round < 2; ++round)
    for (int axis = 0; axis < 3; ++axis) {
      progress.report("finding how blocks repeat", (3 * round + axis) / 6.0);
      // No phase that would leave the axis without a whole block.
      const int phases = std::min(block[axis], values.size()[axis] - block[axis] + 1);
      std::vector<double> found(static_cast<std::size_t>(phases));
      parallelFor(0, found.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
          if (progress.cancelled()) return;
          Vec3i phase = best;
          phase[axis] = static_cast<int>(p);
          found[p] = label(values, block, phase, tolerance).repetition();
        }
      });
      if (progress.cancelled()) return best;
      for (int p = 0; p < phases; ++p)
        if (found[static_cast<std::size_t>(p)] > repetition) {
          repetition = found[static_cast<std::size_t>(p)];
          best[axis] = p;
        }
    }
  return best;
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

std::vector<Vec3i> findMedoids(const Array3D<float>& values, const FieldBlocks& blocks) {
  std::vector<Vec3i> medoids(blocks.members.size());
  parallelFor(0, medoids.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      const std::vector<Vec3i>& members = blocks.members[l];
      const std::size_t step = (members.size() + kCompared - 1) / kCompared;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t m = 0; m < members.size(); m += step) {
        double sum = 0;
        for (std::size_t n = 0; n < members.size(); n += step)
          sum += squaredDifference(values, blocks.phase + corner(members[m], blocks.block),
                                   blocks.phase + corner(members[n], blocks.block), blocks.block);
        if (sum >= least) continue;
        least = sum;
        medoids[l] = members[m];
      }
    }
  });
  return medoids;
}

}  // namespace

Vec3i findBlockSize(const DistanceField& field, const FieldBlocksOptions& options) {
  check(options);
  const Array3D<float> values = truncated(field, options.truncation);
  Vec3i block{};
  for (int axis = 0; axis < 3; ++axis) {
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
          same[p] = sameAfter(values, step, options.tolerance);
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
  progress.report("finding how blocks repeat", 0);
  FieldBlocks blocks;
  blocks.block = findBlockSize(field, options);
  for (int axis = 0; axis < 3; ++axis) {
    const int n = field.size()[axis], side = blocks.block[axis];
    if (side > n) {
      throw InputError("blocks of " + std::to_string(side) +
                       " samples do not fit into a field of " + std::to_string(n) +
                       "; use smaller blocks or a higher resolution");
    }
    if (options.phase && ((*options.phase)[axis] < 0 || (*options.phase)[axis] >= side ||
                          (*options.phase)[axis] + side > n)) {
      throw InputError("a phase of " + std::to_string((*options.phase)[axis]) +
                       " is out of range for blocks of " + std::to_string(side) + " samples");
    }
  }
  const Array3D<float> values = truncated(field, options.truncation);
  blocks.phase =
      options.phase ? *options.phase : findPhase(values, blocks.block, options.tolerance, progress);
  if (progress.cancelled()) return {};

  const Labelled labelled = label(values, blocks.block, blocks.phase, options.tolerance);
  blocks.repetition = labelled.repetition();
  blocks.grid.cells = Array3D<Label>(labelled.cells);
  blocks.members.resize(labelled.first.size());
  for (std::size_t c = 0; c < labelled.label.size(); ++c) {
    blocks.grid.cells.data()[c] = static_cast<Label>(labelled.label[c]);
    blocks.members[static_cast<std::size_t>(labelled.label[c])].push_back(blocks.grid.cells.ijk(c));
  }
  blocks.grid.labels.resize(labelled.first.size());
  blocks.grid.cellSize = cast<double>(blocks.block) * field.voxelSize;
  const Vec3d half{0.5, 0.5, 0.5};
  blocks.grid.origin = field.position(cast<double>(blocks.phase) - half);
  blocks.medoid = findMedoids(values, blocks);
  return blocks;
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
                         const Array3D<Label>& labels) {
  if (labels.empty()) throw InputError("there are no labels to put blocks in place of");
  for (Label l : labels.values())
    if (l >= blocks.members.size())
      throw InputError("label " + std::to_string(l) + " is not one of the blocks'");
  const Vec3i size = corner(labels.size(), blocks.block);
  requireMemory(static_cast<double>(labels.count()) * static_cast<double>(volume(blocks.block)) *
                    (sizeof(float) + sizeof(Origin)),
                "the result", "ask for a smaller one");
  PlacedBlocks placed;
  placed.field.values = Array3D<float>(size);
  placed.field.voxelSize = example.voxelSize;
  placed.field.origin = example.origin;
  placed.field.truncation = example.truncation;
  placed.origins = Origins(size);

  // How little a block's continuation across a low face agrees with what stands there.
  const auto disagreement = [&](const Vec3i& from, const Vec3i& to, int axis, double limit) {
    Vec3i face = blocks.block;
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
    const Vec3i cell = labels.ijk(c), to = corner(cell, blocks.block);
    const Label l = labels.data()[c];
    Vec3i best = blocks.medoid[l];
    if (cell != Vec3i{}) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3i& member : blocks.members[l]) {
        const Vec3i from = blocks.phase + corner(member, blocks.block);
        double sum = 0;
        for (int axis = 0; axis < 3 && sum < least; ++axis)
          if (cell[axis] > 0) sum += disagreement(from, to, axis, least - sum);
        if (sum >= least) continue;
        least = sum;
        best = member;
      }
    }
    const Vec3i from = blocks.phase + corner(best, blocks.block);
    for (int k = 0; k < blocks.block.z; ++k)
      for (int j = 0; j < blocks.block.y; ++j)
        for (int i = 0; i < blocks.block.x; ++i) {
          const Vec3i o{i, j, k};
          placed.field.values[to + o] = example.values[from + o];
          placed.origins[to + o] = Origin(from + o);
        }
  }
  return placed;
}

}  // namespace exemplar
