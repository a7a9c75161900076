// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/cells.h"
#include "core/parallel.h"
#include "core/random_streams.h"
#include "maps/halved.h"

namespace exemplar {
namespace {

/// Keeps the draws of regions apart from those of layers.
constexpr std::uint64_t kRegionDraws = 7000;

/// Two regions, the cell's own first.
using RegionPair = std::pair<std::uint8_t, std::uint8_t>;
using PairCells = std::map<RegionPair, std::vector<Vec3i>>;

/// The boundary cells between each two regions: of the regions beside a cell the lowest other one.
PairCells boundaryPairs(const LayerVolume& map, bool wraps) {
  PairCells pairs;
  std::size_t at = 0;
  forEachCell(map.size(), [&](const Vec3i& p) {
    const std::uint8_t own = map.data()[at];
    std::uint8_t other = 255;
    forEachBeside(map.size(), wraps, p, at, [&](std::size_t beside) {
      if (map.data()[beside] != own) other = std::min(other, map.data()[beside]);
    });
    if (other != 255) pairs[{own, other}].push_back(p);
    ++at;
  });
  return pairs;
}

std::int64_t boundaryCellsOf(const LayerVolume& map, bool wraps) {
  std::int64_t count = 0;
  for (const auto& [pair, cells] : boundaryPairs(map, wraps))
    count += static_cast<std::int64_t>(cells.size());
  return count;
}

std::vector<std::int64_t> countsOf(const LayerVolume& map, int regions) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(regions) + 1);
  for (const std::uint8_t k : map.values()) ++counts[k];
  return counts;
}

std::vector<Shape> planesOf(const LayerVolume& map, int regions) {
  std::vector<Shape> planes;
  for (int k = 1; k <= regions; ++k) {
    Shape plane(map.size());
    for (std::size_t p = 0; p < map.count(); ++p) plane.data()[p] = map.data()[p] == k;
    planes.push_back(std::move(plane));
  }
  return planes;
}
/// A cell that differs is in one plane of each: halves make one.
ShapePlanes comparedPlanes(const std::vector<Shape>& planes) {
  std::vector<const Shape*> all;
  for (const Shape& plane : planes) all.push_back(&plane);
  return {std::move(all), 0};
}

/// The example at one resolution.
struct RegionExample {
  LayerVolume map;
  std::map<RegionPair, BoundaryPatches> patches;
  double boundary = 0;  ///< share of cells on a boundary
};

RegionExample regionExample(const LayerVolume& map, int regions, const ShapeOptions& options,
                            const Random& random) {
  RegionExample example{map, {}, 0};
  example.boundary = static_cast<double>(boundaryCellsOf(map, options.exampleWraps)) /
                     static_cast<double>(map.count());
  const std::vector<Shape> planes = planesOf(map, regions);
  const ShapePlanes compared = comparedPlanes(planes);
  for (auto& [pair, cells] : boundaryPairs(map, options.exampleWraps)) {
    const std::vector<Vec3i> centers =
        servingCenters(std::move(cells), map.size(), nullptr, options,
                       random.fork(pair.first * 16u + pair.second));
    if (centers.empty()) continue;
    example.patches[pair] =
        BoundaryPatches(compared, centers, options.patch, options.turns, options.exampleWraps);
  }
  return example;
}

/// Half the resolution: of each block the region that has most of it, the lowest among equals.
LayerVolume halvedRegions(const LayerVolume& map, int regions) {
  LayerVolume half;
  Array3D<float> most;
  for (int k = 1; k <= regions; ++k) {
    Array3D<float> part(map.size());
    for (std::size_t p = 0; p < map.count(); ++p) part.data()[p] = map.data()[p] == k ? 1.0f : 0.0f;
    part = halved(part, false);
    if (k == 1) {
      most = part;
      half = LayerVolume(part.size(), 1);
      continue;
    }
    for (std::size_t p = 0; p < part.count(); ++p) {
      if (part.data()[p] <= most.data()[p]) continue;
      most.data()[p] = part.data()[p];
      half.data()[p] = static_cast<std::uint8_t>(k);
    }
  }
  return half;
}

LayerVolume enlargedRegions(const LayerVolume& map, const Vec3i& size) {
  LayerVolume large(size);
  std::size_t at = 0;
  forEachCell(size, [&](const Vec3i& p) {
    large.data()[at++] = map[map.clamped({p.x / 2, p.y / 2, size.z == 1 ? 0 : p.z / 2})];
  });
  return large;
}

/// The weights of pasted patches for each region.
using RegionVotes = std::vector<Array3D<float>>;

/// Gives regions that have no cell those that votes want most.
void seedMissing(LayerVolume& map, const std::vector<std::int64_t>& targets,
                 const RegionVotes& votes, const Random& random) {
  const std::vector<std::int64_t> counts = countsOf(map, static_cast<int>(targets.size()) - 1);
  for (std::size_t k = 1; k < targets.size(); ++k) {
    if (counts[k] > 0 || targets[k] == 0) continue;
    std::vector<std::pair<std::pair<float, std::uint64_t>, std::size_t>> wishes;
    for (std::size_t p = 0; p < map.count(); ++p)
      wishes.push_back({{-votes[k].data()[p], random.bits(p, static_cast<std::uint32_t>(k))}, p});
    const auto seeds = static_cast<std::ptrdiff_t>(targets[k]);
    std::ranges::nth_element(wishes, wishes.begin() + seeds - 1);
    for (std::ptrdiff_t n = 0; n < seeds; ++n)
      map.data()[wishes[static_cast<std::size_t>(n)].second] = static_cast<std::uint8_t>(k);
  }
}

/// Moves cells between regions along their contours, those that votes want most first, until each
/// has as many as it should, or no contour is left between one that has too many and one that has
/// too few.
void setAreas(LayerVolume& map, const std::vector<std::int64_t>& targets, const RegionVotes& votes,
              const Random& random) {
  constexpr int kRounds = 60;
  const auto regions = static_cast<int>(targets.size()) - 1;
  seedMissing(map, targets, votes, random);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::int64_t> missing = countsOf(map, regions);
    std::int64_t wrong = 0;
    for (std::size_t k = 1; k < missing.size(); ++k) {
      missing[k] = targets[k] - missing[k];
      wrong += std::abs(missing[k]);
    }
    if (wrong == 0) return;
    struct Move {
      float wish;
      std::uint64_t order;
      std::size_t cell;
      std::uint8_t to;
    };
    std::vector<Move> moves;
    std::size_t at = 0;
    forEachCell(map.size(), [&](const Vec3i& p) {
      const std::size_t cell = at++;
      const std::uint8_t own = map.data()[cell];
      // Down a slope of what is missing, so that cells pass through regions between.
      std::uint8_t to = 0;
      forEachBeside(map.size(), true, p, cell, [&](std::size_t beside) {
        const std::uint8_t other = map.data()[beside];
        if (missing[other] > missing[own] + 1 && (to == 0 || missing[other] > missing[to]))
          to = other;
      });
      if (to == 0) return;
      const float wish = votes[to].data()[cell] - votes[own].data()[cell];
      moves.push_back({-wish, random.bits(cell, static_cast<std::uint32_t>(round)), cell, to});
    });
    if (moves.empty()) return;
    std::ranges::sort(moves, [](const Move& a, const Move& b) {
      return std::tie(a.wish, a.order, a.cell) < std::tie(b.wish, b.order, b.cell);
    });
    for (const Move& move : moves) {
      const std::uint8_t own = map.data()[move.cell];
      if (missing[move.to] <= missing[own] + 1) continue;
      map.data()[move.cell] = move.to;
      --missing[move.to];
      ++missing[own];
    }
  }
}

/// Each cell as the votes that are certain enough want it.
LayerVolume votedFor(const LayerVolume& map, const RegionVotes& votes, float threshold) {
  LayerVolume changed = map;
  for (std::size_t p = 0; p < map.count(); ++p) {
    float all = 0, most = 0;
    std::uint8_t best = map.data()[p];
    for (std::size_t k = 1; k < votes.size(); ++k) {
      const float weight = votes[k].data()[p];
      all += weight;
      if (weight <= most) continue;
      most = weight;
      best = static_cast<std::uint8_t>(k);
    }
    if (all >= threshold && all > 0) changed.data()[p] = best;
  }
  return changed;
}

/// The most frequent region of the 3 x 3 (in space 3 x 3 x 3) cells; the own one among equals.
LayerVolume smoothed(const LayerVolume& map) {
  LayerVolume smooth = map;
  const int depth = map.size().z == 1 ? 0 : 1;
  parallelForEachCell(map.size(), [&](const Vec3i& p) {
    std::array<int, kMostLayers + 1> count{};
    for (int dz = -depth; dz <= depth; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          ++count[map[wrappedPlace(p + Vec3i{dx, dy, dz}, map.size())]];
    std::uint8_t& own = smooth[p];
    for (std::uint8_t k = 0; k < count.size(); ++k)
      if (count[k] > count[own]) own = k;
  });
  return smooth;
}

/// Makes one map.
class Regions {
 public:
  Regions(const LayerVolume& example, const Vec3i& size, const LayerOptions& options)
      : size_(size),
        options_(options.shape),
        regions_(layerCount(example)),
        random_(Random(options.seed, stream::kLayers).fork(kRegionDraws)),
        shares_(layerShares(example, regions_)) {
    int side = std::min({example.size().x, example.size().y, size.x, size.y});
    if (size.z > 1) side = std::min({side, example.size().z, size.z});
    pyramid_.push_back(example);
    for (; static_cast<int>(pyramid_.size()) < options_.levels && side / 2 >= 8; side /= 2)
      pyramid_.push_back(halvedRegions(pyramid_.back(), regions_));
  }

  SynthesizedLayers run(const Progress& progress) {
    LayerVolume map;
    const double share = size_.z > 1 ? 0.125 : 0.25;
    for (int l = static_cast<int>(pyramid_.size()) - 1; l >= 0; --l) {
      const Random own = random_.fork(static_cast<std::uint64_t>(l));
      Vec3i size;
      for (int axis = 0; axis < 3; ++axis) size[axis] = std::max(1, size_[axis] >> l);
      map = map.empty() ? randomMap(size, own.fork(1)) : enlargedRegions(map, size);
      const double from = l + 1 == static_cast<int>(pyramid_.size()) ? 0 : std::pow(share, l + 1);
      optimize(map, pyramid_[static_cast<std::size_t>(l)], own.fork(2),
               progress.part(from, std::pow(share, l)));
    }
    SynthesizedLayers result{std::move(map), {}, dealtExactly_};
    const std::vector<double> made = layerShares(result.map, regions_);
    for (std::size_t k = 0; k < made.size(); ++k) result.areaErrors.push_back(made[k] - shares_[k]);
    return result;
  }

 private:
  std::vector<std::int64_t> targetsFor(const Vec3i& size) const {
    std::vector<std::int64_t> targets{0};
    std::int64_t left = volume(size);
    const auto cells = static_cast<double>(left);
    for (std::size_t k = 0; k + 1 < shares_.size(); ++k) {
      targets.push_back(std::min<std::int64_t>(left, std::llround(shares_[k] * cells)));
      left -= targets.back();
    }
    targets.push_back(left);
    return targets;
  }

  /// Of blurred noise for each region the strongest, moved until the areas are nearly right.
  LayerVolume randomMap(const Vec3i& size, const Random& random) {
    RegionVotes noise(1);
    for (int k = 1; k <= regions_; ++k) {
      Array3D<float> plane(size);
      for (std::size_t p = 0; p < plane.count(); ++p)
        plane.data()[p] = static_cast<float>(random.uniform(p, static_cast<std::uint32_t>(k)));
      noise.push_back(std::move(plane));
    }
    LayerVolume map(size);
    const std::vector<std::int64_t> targets = targetsFor(size);
    std::vector<double> moved(noise.size());
    for (int round = 0; round < 40; ++round) {
      for (std::size_t p = 0; p < map.count(); ++p) {
        std::uint8_t best = 1;
        for (std::size_t k = 2; k < noise.size(); ++k)
          if (noise[k].data()[p] + moved[k] > noise[best].data()[p] + moved[best])
            best = static_cast<std::uint8_t>(k);
        map.data()[p] = best;
      }
      const std::vector<std::int64_t> counts = countsOf(map, regions_);
      for (std::size_t k = 1; k < moved.size(); ++k)
        moved[k] +=
            0.5 * static_cast<double>(targets[k] - counts[k]) / static_cast<double>(map.count());
    }
    map = smoothed(map);
    setAreas(map, targets, noise, random.fork(1));
    return map;
  }

  /// Matching and voting in turns, on one resolution.
  void optimize(LayerVolume& map, const LayerVolume& exampleMap, const Random& random,
                const Progress& progress) {
    const RegionExample example = regionExample(exampleMap, regions_, options_, random.fork(0));
    if (example.patches.empty()) return;
    for (int n = 0; n < options_.iterations; ++n) {
      const Progress part = progress.part(static_cast<double>(n) / options_.iterations,
                                          static_cast<double>(n + 1) / options_.iterations);
      part.report("matching boundaries", 0);
      float median = 0;
      const RegionVotes votes =
          votesFor(map, example, random.fork(static_cast<std::uint64_t>(2 * n + 1)), median, part);
      LayerVolume best = adjusted(map, votes, median, example,
                                  random.fork(static_cast<std::uint64_t>(2 * n + 2)), part);
      std::size_t changes = 0;
      for (std::size_t p = 0; p < map.count(); ++p) changes += best.data()[p] != map.data()[p];
      map = std::move(best);
      const auto boundary = static_cast<double>(boundaryCellsOf(map, true));
      if (static_cast<double>(changes) < options_.settled * boundary) break;
    }
  }

  RegionVotes votesFor(const LayerVolume& map, const RegionExample& example, const Random& random,
                       float& median, const Progress& progress) {
    RegionVotes votes(static_cast<std::size_t>(regions_) + 1, Array3D<float>(map.size()));
    const std::vector<Shape> planes = planesOf(map, regions_);
    const ShapePlanes compared = comparedPlanes(planes);
    std::vector<Vec3i> all;
    for (auto& [pair, cells] : boundaryPairs(map, true)) {
      const BoundaryPatches* examples = patchesFor(pair, example);
      PlacedPatches placed{matchedCenters(std::move(cells), map.size()), {}};
      const Random draws = random.fork(pair.first * 16u + pair.second);
      const BoundaryPatches patches(compared, placed.boundary, options_.patch, 1, true);
      Assignment dealt = assignPatches(patches, *examples,
                                       fairUses(patches.count(), examples->count(), draws.fork(0)),
                                       options_.assignment, draws.fork(1), progress);
      placed.matches = std::move(dealt.matches);
      dealtExactly_ &= dealt.kind == AssignmentKind::Exact;
      forEachPasted(*examples, placed, map.size(), example.map.size(), options_.exampleWraps,
                    [&](std::size_t cell, std::size_t from, float weight) {
                      votes[example.map.data()[from]].data()[cell] += weight;
                    });
      all.insert(all.end(), placed.boundary.begin(), placed.boundary.end());
    }
    std::vector<float> weights;
    for (const Vec3i& p : all) {
      float sum = 0;
      for (std::size_t k = 1; k < votes.size(); ++k) sum += votes[k][p];
      weights.push_back(sum);
    }
    if (weights.empty()) return votes;
    const auto middle = weights.begin() + static_cast<std::ptrdiff_t>(weights.size() / 2);
    std::ranges::nth_element(weights, middle);
    median = *middle;
    return votes;
  }

  /// The example's patches between two regions; where those never touch there, between the first
  /// and any other, or any.
  static const BoundaryPatches* patchesFor(const RegionPair& pair, const RegionExample& example) {
    if (const auto found = example.patches.find(pair); found != example.patches.end())
      return &found->second;
    for (const auto& [other, patches] : example.patches)
      if (other.first == pair.first) return &patches;
    return &example.patches.begin()->second;
  }

  LayerVolume adjusted(const LayerVolume& map, const RegionVotes& votes, float median,
                       const RegionExample& example, const Random& random,
                       const Progress& progress) const {
    constexpr std::array<float, 6> kThresholds{0.01f, 0.05f, 0.12f, 0.2f, 0.3f, 0.5f};
    const std::vector<std::int64_t> targets = targetsFor(map.size());
    const double boundary = example.boundary * static_cast<double>(map.count());
    std::array<LayerVolume, 2 * kThresholds.size()> candidates;
    std::array<double, candidates.size()> errors{};
    parallelFor(0, candidates.size(), 1, [&](std::size_t first, std::size_t last) {
      progress.check();
      for (std::size_t c = first; c < last; ++c) {
        LayerVolume changed = votedFor(map, votes, kThresholds[c / 2] * median);
        if (c % 2 == 1) changed = smoothed(changed);
        setAreas(changed, targets, votes, random);
        errors[c] = std::abs(static_cast<double>(boundaryCellsOf(changed, true)) - boundary);
        candidates[c] = std::move(changed);
      }
    });
    return std::move(
        candidates[static_cast<std::size_t>(std::ranges::min_element(errors) - errors.begin())]);
  }

  Vec3i size_;
  const ShapeOptions& options_;
  int regions_;
  Random random_;
  std::vector<double> shares_;
  std::vector<LayerVolume> pyramid_;
  bool dealtExactly_ = true;
};

}  // namespace

SynthesizedLayers synthesizeRegions(const LayerVolume& example, const Vec3i& size,
                                    const LayerOptions& options, const Progress& progress) {
  return Regions(example, size, options).run(progress);
}

double placedShare(const LayerVolume& map) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int half = map.size()[axis] / 2;
    if (half == 0) continue;
    std::array<std::int64_t, kMostLayers + 1> low{}, high{};
    std::int64_t lowCells = 0;
    forEachCell(map.size(), [&](const Vec3i& p) {
      lowCells += p[axis] < half;
      ++(p[axis] < half ? low : high)[map[p]];
    });
    const auto highCells = static_cast<std::int64_t>(map.count()) - lowCells;
    double differing = 0;
    for (std::size_t k = 0; k < low.size(); ++k)
      differing += std::abs(static_cast<double>(low[k]) / static_cast<double>(lowCells) -
                            static_cast<double>(high[k]) / static_cast<double>(highCells));
    most = std::max(most, differing / 2);
  }
  return most;
}

std::vector<Array3D<float>> regionGuides(const LayerVolume& map, int count) {
  const float apart = std::sqrt(0.5f);  // two planes differ
  std::vector<Array3D<float>> guides;
  for (int k = 1; k <= count; ++k) {
    Array3D<float> guide(map.size());
    for (std::size_t p = 0; p < map.count(); ++p) guide.data()[p] = map.data()[p] == k ? apart : 0;
    guides.push_back(std::move(guide));
  }
  return guides;
}

}  // namespace exemplar
