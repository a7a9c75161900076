// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/optimize.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/random.h"
#include "sdf/resample.h"
#include "search/nearest_neighbor_field.h"
#include "synth/geometry/broken_pieces.h"
#include "synth/geometry/even_seams.h"
#include "synth/geometry/seams.h"

namespace exemplar {
namespace {

constexpr std::uint32_t kStartStream = 0x0b71, kSearchStream = 0x0b72;
/// Samples along the longest side of the coarsest level, about.
constexpr int kCoarsestSide = 16;
/// Above this many pairs of patches the search is by PatchMatch.
constexpr double kExactPairs = 3e6;
/// Iterations of PatchMatch: from random blocks, and from a field that is nearly right.
constexpr int kFirstIterations = 8, kIterations = 2;
/// Distance of neighbouring patches where the search is by PatchMatch.
constexpr int kStride = 2;
/// Seams see distances up to here, in voxels: one through air or through solid is free.
constexpr float kSeamTruncation = 4;
/// Seams of the coarser levels, where a few samples reach far: pieces grow into large ones.
constexpr SeamOptions kCoarseSeams{.reach = 16, .length = 0.05};
constexpr SeamOptions kFineSeams{.passes = 1, .length = 0.005};

/// One level of the pyramid: the example, shrunk, in voxels of the level, framed by air on the
/// sides where the example ends in air.
struct Level {
  Array3D<float> source;
  Vec3i patch;
  Vec3i low, high;    ///< samples of air added before and after
  Vec3i exampleSize;  ///< of the shrunk example, without the frame
  Vec3i targetSize;   ///< of the result at this level, without the frame
  Vec3i slack;        ///< samples added at the target's end, so that patches at kStride cover it
  Vec3i framedTarget() const { return targetSize + low + high + slack; }
};

/// Which of the example's six sides are air all over: bit 2 * axis for the low side, + 1 for the
/// high.
int airSides(const DistanceField& example) {
  const Vec3i n = example.size();
  int sides = 0b111111;
  for (std::size_t s = 0; s < example.values.count(); ++s) {
    if (example.values.values()[s] > 0) continue;
    const Vec3i p = example.values.ijk(s);
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] == 0) sides &= ~(1 << (2 * axis));
      if (p[axis] == n[axis] - 1) sides &= ~(2 << (2 * axis));
    }
  }
  return sides;
}

Level makeLevel(const DistanceField& example, int sides, int shrink,
                const OptimizeOptions& options) {
  const DistanceField shrunk = shrink == 1 ? example : blockAverage(example, shrink);
  const float limit = static_cast<float>(options.truncation);
  Level level;
  level.exampleSize = shrunk.size();
  for (int axis = 0; axis < 3; ++axis) {
    level.targetSize[axis] = (options.size[axis] + shrink - 1) / shrink;
    level.low[axis] = sides >> (2 * axis) & 1 ? options.patch / 2 : 0;
    level.high[axis] = sides >> (2 * axis) & 2 ? options.patch / 2 : 0;
  }
  level.source = Array3D<float>(shrunk.size() + level.low + level.high, limit);
  level.patch = min(Vec3i{options.patch, options.patch, options.patch}, level.source.size());
  level.patch = min(level.patch, level.framedTarget());
  for (int axis = 0; axis < 3; ++axis) {
    level.slack[axis] = (level.framedTarget()[axis] - level.patch[axis]) % kStride;
  }
  for (std::size_t s = 0; s < shrunk.values.count(); ++s) {
    const float voxels = shrunk.values.values()[s] / static_cast<float>(shrunk.voxelSize);
    level.source[shrunk.values.ijk(s) + level.low] = std::clamp(voxels, -limit, limit);
  }
  return level;
}

/// Where each sample of the (framed) target comes from in the (framed) source, as an offset-bearing
/// cell.
using Sources = Array3D<Vec3i>;

Array3D<float> gather(const Level& level, const Sources& sources) {
  Array3D<float> target(sources.size());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    target.values()[s] = level.source[sources.values()[s]];
  }
  return target;
}

/// Pins the frame to air.
void pinFrame(const Level& level, float air, Array3D<float>& target) {
  const Vec3i end = level.low + level.targetSize;
  for (std::size_t s = 0; s < target.count(); ++s) {
    const Vec3i p = target.ijk(s);
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < level.low[axis] || p[axis] >= end[axis]) target.values()[s] = air;
    }
  }
}

/// A sample's place along an axis on which the example is not stationary.
int proportional(int p, int target, int source) {
  return target <= 1
             ? 0
             : static_cast<int>(std::llround(static_cast<double>(p) * (source - 1) / (target - 1)));
}

/// The coarsest level's start: blocks of random content, kept to their place along axes that are
/// not stationary.
Sources startFromRandomBlocks(const Level& level, const StationaryAxes& stationary,
                              const OptimizeOptions& options) {
  const Random random(options.seed, kStartStream);
  const Vec3i size = level.framedTarget(), source = level.source.size();
  const Vec3i block = max(level.patch, Vec3i{2, 2, 2});
  const Vec3i blocks{(size.x + block.x - 1) / block.x, (size.y + block.y - 1) / block.y,
                     (size.z + block.z - 1) / block.z};
  Sources sources(size);
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s);
    Vec3i cell;
    for (int axis = 0; axis < 3; ++axis) {
      const int b = p[axis] / block[axis];
      const std::uint64_t key =
          (static_cast<std::uint64_t>(p.z / block.z) * blocks.y + p.y / block.y) * blocks.x +
          p.x / block.x;
      if (stationary[axis]) {
        const int range = std::max(1, source[axis] - block[axis] + 1);
        cell[axis] = static_cast<int>(random.below(range, key, axis)) + p[axis] - b * block[axis];
      } else {
        cell[axis] = proportional(p[axis], size[axis], source[axis]);
      }
      cell[axis] = std::clamp(cell[axis], 0, source[axis] - 1);
    }
    sources[p] = cell;
  }
  return sources;
}

/// The next finer level's start: the same pieces, twice as large.
Sources refine(const Level& coarse, const Sources& from, const Level& fine) {
  Sources sources(fine.framedTarget());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s);
    Vec3i cell;
    for (int axis = 0; axis < 3; ++axis) {
      const int inner = p[axis] - fine.low[axis];  // may lie in the frame
      const int half = inner >> 1;
      const int c = std::clamp(half + coarse.low[axis], 0, from.size()[axis] - 1);
      cell[axis] = c;
      (void)half;
    }
    const Vec3i origin = from[cell];
    for (int axis = 0; axis < 3; ++axis) {
      const int inner = p[axis] - fine.low[axis];
      cell[axis] = std::clamp(2 * (origin[axis] - coarse.low[axis]) + (inner & 1) + fine.low[axis],
                              0, fine.source.size()[axis] - 1);
    }
    sources[p] = cell;
  }
  return sources;
}

/// The field that a level's search starts from: each patch at where its middle comes from.
NearestNeighborField startField(const Level& level, const Sources& sources, const Vec3i& stride) {
  NearestNeighborField field;
  const Vec3i last = sources.size() - level.patch;
  const Vec3i lastMatch = level.source.size() - level.patch;
  const Vec3i half{level.patch.x / 2, level.patch.y / 2, level.patch.z / 2};
  field.stride = stride;
  field.position =
      Array3D<Vec3i>({last.x / stride.x + 1, last.y / stride.y + 1, last.z / stride.z + 1});
  for (std::size_t s = 0; s < field.position.count(); ++s) {
    const Vec3i middle = scaled(field.position.ijk(s), stride) + half;
    field.position.values()[s] = max(Vec3i{0, 0, 0}, min(sources[middle] - half, lastMatch));
  }
  return field;
}

/// The completeness term: how welcome each position of the source is, 1 / (alpha + the distance of
/// its patch to the nearest in the target). `reverse`, the field that this is found by, is kept
/// from round to round.
Array3D<float> welcome(const Level& level, const Array3D<float>& target, double alpha,
                       NearestNeighborFieldOptions search, NearestNeighborField& reverse,
                       const Progress& progress) {
  const NearestNeighborField previous = std::move(reverse);
  search.method = NeighborMethod::PatchMatch;
  search.stride = {1, 1, 1};
  search.sourceWeight = nullptr;
  search.start = previous.position.empty() ? nullptr : &previous;
  search.iterations = search.start ? 2 : 5;
  reverse = nearestNeighborField({target}, {level.source}, search, progress);
  Array3D<float> weight(level.source.size(), 1.0f);
  for (std::size_t s = 0; s < reverse.distance.count(); ++s) {
    // Times alpha, which changes nothing, so that it stays a number for any alpha.
    weight[reverse.distance.ijk(s)] =
        static_cast<float>(std::max(1e-6, 1 / (1 + reverse.distance.values()[s] / alpha)));
  }
  return weight;
}

std::vector<float> gaussian(int patch) {
  std::vector<float> weights(patch);
  const double sigma = patch / 3.0;
  for (int n = 0; n < patch; ++n) {
    const double d = n - (patch - 1) / 2.0;
    weights[n] = static_cast<float>(std::exp(-d * d / (2 * sigma * sigma)));
  }
  return weights;
}

/// How much a patch's say weighs (recipe of Kwatra 2005, section 3.2, softened near zero).
float confidence(float distance) { return 1.0f / (0.05f + distance); }

/// The patches whose samples cover one coordinate: first and one past the last index along an axis.
struct Covering {
  int begin, end;
};
Covering covering(int p, int patch, int stride, int patches) {
  const int first = p - patch + 1;
  return {first <= 0 ? 0 : (first + stride - 1) / stride, std::min(p / stride + 1, patches)};
}

/// Each sample becomes the mean of what the patches that cover it say.
Array3D<float> vote(const Level& level, const NearestNeighborField& field, const Vec3i& size) {
  Array3D<float> target(size);
  const auto gx = gaussian(level.patch.x), gy = gaussian(level.patch.y),
             gz = gaussian(level.patch.z);
  const Vec3i n = field.position.size();
  const std::size_t rows = static_cast<std::size_t>(size.y) * size.z;
  parallelFor(0, rows, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<float> sum(size.x), weight(size.x);
    for (std::size_t row = begin; row < end; ++row) {
      const int j = static_cast<int>(row % size.y), k = static_cast<int>(row / size.y);
      std::fill(sum.begin(), sum.end(), 0.0f);
      std::fill(weight.begin(), weight.end(), 0.0f);
      const Covering cy = covering(j, level.patch.y, field.stride.y, n.y);
      const Covering cz = covering(k, level.patch.z, field.stride.z, n.z);
      for (int c = cz.begin; c < cz.end; ++c) {
        const int dz = k - c * field.stride.z;
        for (int b = cy.begin; b < cy.end; ++b) {
          const int dy = j - b * field.stride.y;
          for (int a = 0; a < n.x; ++a) {
            const Vec3i from = field.position(a, b, c);
            const float w = confidence(field.distance(a, b, c)) * gy[dy] * gz[dz];
            const float* values = &level.source(from.x, from.y + dy, from.z + dz);
            float* s = &sum[static_cast<std::size_t>(a) * field.stride.x];
            float* t = &weight[static_cast<std::size_t>(a) * field.stride.x];
            for (int i = 0; i < level.patch.x; ++i) {
              s[i] += w * gx[i] * values[i];
              t[i] += w * gx[i];
            }
          }
        }
      }
      for (int i = 0; i < size.x; ++i) target(i, j, k) = sum[i] / weight[i];
    }
  });
  return target;
}

/// Each sample takes the offset on which the patches that cover it agree most, by weight; the
/// lowest offset on ties.
Sources plurality(const Level& level, const NearestNeighborField& field, const Vec3i& size) {
  Sources sources(size);
  const auto gx = gaussian(level.patch.x), gy = gaussian(level.patch.y),
             gz = gaussian(level.patch.z);
  const Vec3i n = field.position.size();
  const std::size_t rows = static_cast<std::size_t>(size.y) * size.z;
  parallelFor(0, rows, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<Vec3i, float>> votes;
    for (std::size_t row = begin; row < end; ++row) {
      const int j = static_cast<int>(row % size.y), k = static_cast<int>(row / size.y);
      const Covering cy = covering(j, level.patch.y, field.stride.y, n.y);
      const Covering cz = covering(k, level.patch.z, field.stride.z, n.z);
      for (int i = 0; i < size.x; ++i) {
        const Covering cx = covering(i, level.patch.x, field.stride.x, n.x);
        votes.clear();
        for (int c = cz.begin; c < cz.end; ++c) {
          for (int b = cy.begin; b < cy.end; ++b) {
            for (int a = cx.begin; a < cx.end; ++a) {
              const Vec3i d = Vec3i{i, j, k} - scaled(Vec3i{a, b, c}, field.stride);
              const Vec3i cell = field.position(a, b, c) + d;
              const float w = confidence(field.distance(a, b, c)) * gx[d.x] * gy[d.y] * gz[d.z];
              const auto known = std::find_if(votes.begin(), votes.end(),
                                              [&](const auto& v) { return v.first == cell; });
              if (known == votes.end()) {
                votes.emplace_back(cell, w);
              } else {
                known->second += w;
              }
            }
          }
        }
        std::size_t best = 0;
        for (std::size_t v = 1; v < votes.size(); ++v) {
          if (votes[v].second > votes[best].second) best = v;
        }
        sources(i, j, k) = votes[best].first;
      }
    }
  });
  return sources;
}

Array3D<float> clamped(Array3D<float> values, float limit) {
  for (float& v : values.values()) v = std::clamp(v, -limit, limit);
  return values;
}

/// Moves seams to where both sides agree best, and then whole pieces and the seams once more: what
/// a level starts with was found on a grid twice as coarse, and half of the offsets lie between.
void cutSeams(const Level& level, const Array3D<float>& target, Sources& sources,
              const Progress& progress) {
  const Array3D<float> source = clamped(level.source, kSeamTruncation);
  Origins origins(sources.size());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    origins.values()[s] = Origin(sources.values()[s]);
  }
  refineSeams(source, clamped(target, kSeamTruncation), origins, kCoarseSeams, progress);
  if (!progress.cancelled() && alignPieces(source, origins) > 0) {
    for (std::size_t s = 0; s < sources.count(); ++s) {
      sources.values()[s] = origins.values()[s].cell();
    }
    refineSeams(source, clamped(gather(level, sources), kSeamTruncation), origins, kCoarseSeams,
                progress);
  }
  for (std::size_t s = 0; s < sources.count(); ++s) {
    sources.values()[s] = origins.values()[s].cell();
  }
}

void check(const DistanceField& example, const OptimizeOptions& options) {
  const auto fail = [](const std::string& what) { throw InputError(what); };
  if (volume(example.size()) == 0) fail("the example has no samples");
  for (int axis = 0; axis < 3; ++axis) {
    if (example.size()[axis] > 32767) fail("the example is longer than 32,767 samples");
    if (options.size[axis] < 1) fail("the result's size must be at least 1 sample along each axis");
  }
  if (options.patch < 3 || options.patch > 15)
    fail("patch " + std::to_string(options.patch) + ": expected 3 to 15");
  if (options.levels && (*options.levels < 1 || *options.levels > 8)) {
    fail("levels " + std::to_string(*options.levels) + ": expected 1 to 8");
  }
  if (options.rounds < 1 || options.rounds > 100)
    fail("rounds " + std::to_string(options.rounds) + ": expected 1 to 100");
  if (!(options.truncation > 0)) fail("truncation must be above 0");
  if (!(options.completeness > 0)) fail("completeness must be above 0");
  requireMemory(120.0 * static_cast<double>(volume(options.size)), "a result of this size",
                "use a lower resolution or a smaller scale");
}

int defaultLevels(const DistanceField& example) {
  const Vec3i n = example.size();
  const int longest = std::max({n.x, n.y, n.z});
  int levels = 1;
  while ((longest >> levels) >= kCoarsestSide && levels < 8) ++levels;
  return levels;
}

}  // namespace

SynthesisResult synthesizeOptimized(const DistanceField& example, const OptimizeOptions& options,
                                    const Progress& progress) {
  check(example, options);
  const StationaryAxes stationary = options.stationary.value_or(findStationaryAxes(example));
  const int levels = options.levels.value_or(defaultLevels(example));
  const int sides = airSides(example);
  const float air = static_cast<float>(options.truncation);

  SynthesisResult result;
  Level level = makeLevel(example, sides, 1 << (levels - 1), options);
  Sources sources = startFromRandomBlocks(level, stationary, options);
  Array3D<float> target;
  for (int l = levels - 1; l >= 0; --l) {
    if (l < levels - 1) {
      Level finer = makeLevel(example, sides, 1 << l, options);
      sources = refine(level, sources, finer);
      level = std::move(finer);
    }
    target = gather(level, sources);
    pinFrame(level, air, target);

    NearestNeighborFieldOptions search;
    search.patch = level.patch;
    for (int axis = 0; axis < 3; ++axis) {
      search.window[axis] = stationary[axis] ? -1 : std::max(1, level.source.size()[axis] / 32);
    }
    const Vec3i size = level.framedTarget();
    const Vec3i places = level.source.size() - level.patch + Vec3i{1, 1, 1};
    const bool exact =
        static_cast<double>(volume(size)) * static_cast<double>(volume(places)) < kExactPairs;
    search.method = exact ? NeighborMethod::Exact : NeighborMethod::PatchMatch;
    search.stride = exact ? Vec3i{1, 1, 1} : min(Vec3i{kStride, kStride, kStride}, level.patch);

    // The finest level only has detail to add, and most of the work.
    const int rounds = l > 0 ? options.rounds : (2 * options.rounds + 2) / 3;
    NearestNeighborField field, reverse;
    Array3D<float> weight;
    for (int round = 0; round < rounds; ++round) {
      progress.report(
          "optimising, level " + std::to_string(levels - l) + " of " + std::to_string(levels),
          static_cast<double>(round) / rounds);
      search.seed = Random(options.seed, kSearchStream).bits(l, round);
      search.iterations = round == 0 && l == levels - 1 ? kFirstIterations : kIterations;
      const NearestNeighborField previous =
          round == 0 ? startField(level, sources, search.stride) : std::move(field);
      search.start = &previous;
      if (std::isfinite(options.completeness) && (l > 0 || levels == 1)) {
        weight = welcome(level, target, options.completeness, search, reverse, progress);
        if (!reverse.complete) {
          result.status = SynthesisStatus::Cancelled;
          break;
        }
        search.sourceWeight = &weight;
      }
      field = nearestNeighborField({level.source}, {target}, search, progress);
      if (!field.complete || progress.cancelled()) {
        result.status = SynthesisStatus::Cancelled;
        break;
      }
      result.matches += volume(field.position.size());
      target = vote(level, field, size);
      pinFrame(level, air, target);
    }
    if (result.status == SynthesisStatus::Cancelled) break;
    sources = plurality(level, field, size);
    if (l > 0) cutSeams(level, target, sources, progress);
  }

  if (result.status == SynthesisStatus::Cancelled) return result;
  progress.report("cutting seams", 0);
  Origins origins(options.size);
  Array3D<float> wanted(options.size);
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const Vec3i p = origins.ijk(s);
    const Vec3i cell = sources[p + level.low] - level.low;
    origins[p] = Origin(example.values.clamped(cell));
    wanted[p] = target[p + level.low];
  }
  Array3D<float> copied = example.values;
  for (float& v : copied.values()) v /= static_cast<float>(example.voxelSize);
  copied = clamped(std::move(copied), kSeamTruncation);
  alignPieces(copied, origins, 1, kFineSeams);
  refineSeams(copied, clamped(std::move(wanted), kSeamTruncation), origins, kFineSeams, progress);
  if (progress.cancelled()) {
    result.status = SynthesisStatus::Cancelled;
    return result;
  }
  dropBrokenPieces(example, origins);
  result.field = evenSeams(example, origins);
  result.origins = std::move(origins);
  return result;
}

}  // namespace exemplar
