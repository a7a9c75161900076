// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/nearest_neighbor_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/loop_progress.h"
#include "core/parallel.h"
#include "core/random.h"
#include "search/block_match.h"
#include "search/patch_tree.h"

namespace exemplar {

namespace {

using Candidate = PatchTree::Candidate;
using Window = PatchTree::Window;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr Candidate kNothing{std::numeric_limits<float>::infinity(), kNone,
                             std::numeric_limits<float>::infinity()};

// Target patches are worked on in cubes of this side; one cube is one task, whatever the threads.
constexpr int kTile = 12;

void check(const PatchSet& source, const PatchSet& target, const Channels& sourceChannels,
           const Channels& targetChannels, const NearestNeighborFieldOptions& options) {
  if (sourceChannels.size() != targetChannels.size())
    throw InputError("source and target of a nearest-neighbor field differ in their channels");
  if (std::min({options.stride.x, options.stride.y, options.stride.z}) < 1)
    throw InputError("the stride of a nearest-neighbor field must be at least 1");
  if (options.iterations < 1)
    throw InputError("the iterations of a nearest-neighbor field must be at least 1");
  if (options.allowed && options.allowed->size() != source.size())
    throw InputError("the mask of allowed positions differs in size from the source");
  if (options.sourceWeight) {
    if (options.sourceWeight->size() != source.size())
      throw InputError("the source weights differ in size from the source");
    for (float w : options.sourceWeight->values())
      if (!(w > 0) || !std::isfinite(w))
        throw InputError("source weights must be above 0 and finite");
  }
  (void)target;
}

// One computation: what the options mean for each target patch, and the candidates' costs.
class Field {
 public:
  Field(const Channels& source, const Channels& target, const NearestNeighborFieldOptions& options,
        const Progress& progress)
      : options_(options),
        progress_(progress),
        source_(source, options.patch),
        target_(target, options.patch) {
    check(source_, target_, source, target, options);
    const Vec3i positions = target_.positions();
    for (int axis = 0; axis < 3; ++axis)
      shape_[axis] = (positions[axis] + options.stride[axis] - 1) / options.stride[axis];
    best_ = Array3D<Candidate>(shape_, kNothing);
    for (int axis = 0; axis < 3; ++axis) windowed_ = windowed_ || options.window[axis] >= 0;
    findAllowed();
    if (options.start && options.start->position.size() != shape_)
      throw InputError("the start of a nearest-neighbor field has another shape");
    if (options.placeOf) {
      windowed_ = true;
      checkPlaces();
    }
    if (options.wanted && (!options.start || options.wanted->size() != shape_))
      throw InputError("wanted patches need a start, and a mask of the field's shape");
  }

  NearestNeighborField run() {
    if (options_.method == NeighborMethod::Exact) {
      searchExactly();
    } else {
      searchByCoherence();
    }
    NearestNeighborField field;
    field.stride = options_.stride;
    field.position = Array3D<Vec3i>(shape_);
    field.distance = Array3D<float>(shape_);
    for (std::size_t i = 0; i < best_.count(); ++i) {
      const Candidate& c = best_.data()[i];
      field.position.data()[i] = source_.position(c.index == kNone ? firstAllowed_ : c.index);
      field.distance.data()[i] =
          c.sum / static_cast<float>(options_.patch.x * options_.patch.y * options_.patch.z);
    }
    return field;
  }

 private:
  void checkPlaces() const {
    if (options_.placeOf->size() != shape_)
      throw InputError("the places of a nearest-neighbor field have another shape");
    const Vec3i positions = source_.positions();
    for (const CellBox& place : options_.places)
      if (volume(place.size()) == 0 || min(place.begin, place.end) != place.begin ||
          max(place.begin, Vec3i{0, 0, 0}) != place.begin || min(place.end, positions) != place.end)
        throw InputError("a place of a nearest-neighbor field is empty or outside the source");
    for (const std::uint16_t place : options_.placeOf->values())
      if (place >= options_.places.size())
        throw InputError("a place of a nearest-neighbor field is none of those given");
  }

  void findAllowed() {
    forEachCell(source_.positions(), [&](const Vec3i& p) {
      if (options_.allowed && !(*options_.allowed)[p]) return;
      const std::uint32_t index = source_.index(p);
      if (firstAllowed_ == kNone) firstAllowed_ = index;
      if (options_.allowed) allowed_.push_back(index);
    });
    if (firstAllowed_ == kNone)
      throw InputError("no source position of the nearest-neighbor field is allowed");
  }

  Vec3i patchPosition(const Vec3i& patch) const { return scaled(patch, options_.stride); }

  Window window(const Vec3i& patch) const {
    const CellBox place = options_.placeOf ? options_.places[(*options_.placeOf)[patch]]
                                           : CellBox::of(source_.positions());
    const Vec3i first = place.begin, last = place.end - Vec3i{1, 1, 1};
    const Vec3i targetLast = target_.positions() - Vec3i{1, 1, 1};
    Window window{first, last};
    const Vec3i p = patchPosition(patch);
    for (int axis = 0; axis < 3; ++axis)
      if (options_.window[axis] >= 0) {
        const int length = last[axis] - first[axis];
        const int center =
            first[axis] + (targetLast[axis] == 0
                               ? length / 2
                               : static_cast<int>(std::lround(static_cast<double>(p[axis]) *
                                                              length / targetLast[axis])));
        window.first[axis] = std::max(first[axis], center - options_.window[axis]);
        window.last[axis] = std::min(last[axis], center + options_.window[axis]);
      }
    return window;
  }

  bool mayUse(const Vec3i& p, const Window& window) const {
    if (max(p, window.first) != p || min(p, window.last) != p) return false;
    return !options_.allowed || (*options_.allowed)[p] != 0;
  }

  // Takes the source patch at `p` if it may be used and comes before `best`.
  void offer(const float* gathered, const Vec3i& p, const Window& window, Candidate& best) const {
    if (!mayUse(p, window)) return;
    const std::uint32_t index = source_.index(p);
    if (index == best.index) return;
    const float w = options_.sourceWeight ? options_.sourceWeight->data()[index] : 1.0f;
    const float limit = best.cost / w * 1.00001f;
    const float sum = source_.sum(gathered, index, limit);
    const Candidate candidate{w * sum, index, sum};
    if (sum <= limit && candidate.before(best)) best = candidate;
  }

  // Cuts the target into tiles and works on them in parallel.
  template <class Work>
  void forTiles(double from, double to, const Work& work) {
    const Vec3i tiles{(shape_.x + kTile - 1) / kTile, (shape_.y + kTile - 1) / kTile,
                      (shape_.z + kTile - 1) / kTile};
    const std::size_t count = static_cast<std::size_t>(volume(tiles));
    LoopProgress done(progress_.part(from, to), "matching", count);
    parallelFor(0, count, 1, [&](std::size_t begin, std::size_t end) {
      std::vector<float> gathered(target_.gatheredLength());
      for (std::size_t t = begin; t < end; ++t) {
        done.check();
        const Vec3i tile{static_cast<int>(t % tiles.x), static_cast<int>(t / tiles.x % tiles.y),
                         static_cast<int>(t / tiles.x / tiles.y)};
        const Vec3i first = tile * kTile;
        work(CellBox{first, min(first + Vec3i{kTile, kTile, kTile}, shape_)}, gathered.data());
        done.advance();
      }
    });
  }

  bool wanted(const Vec3i& patch) const { return !options_.wanted || (*options_.wanted)[patch]; }

  // The match of a patch that is not wanted: the start's, even where it could not be found.
  void keepStart(const float* gathered, const Vec3i& patch, Candidate& best) const {
    const Vec3i last = source_.positions() - Vec3i{1, 1, 1};
    const Vec3i p = max(Vec3i{0, 0, 0}, min(options_.start->position[patch], last));
    const std::uint32_t index = source_.index(p);
    const float sum = source_.sum(gathered, index, std::numeric_limits<float>::infinity());
    best = {sum, index, sum};
  }

  void offerStart(const float* gathered, const Vec3i& patch, const Window& window,
                  Candidate& best) const {
    if (options_.start) offer(gathered, options_.start->position[patch], window, best);
  }

  void searchExactly() {
    progress_.report("matching", 0);
    const PatchTree tree(source_, {options_.allowed, options_.sourceWeight, windowed_});
    const float norm = target_.largestNorm(tree.center());
    forTiles(0, 1, [&](const CellBox& tile, float* gathered) {
      forEachCell(tile, [&](const Vec3i& patch) {
        if (patch.x == tile.begin.x) progress_.check();
        const std::uint32_t index = target_.index(patchPosition(patch));
        target_.gather(index, gathered);
        if (!wanted(patch)) {
          keepStart(gathered, patch, best_[patch]);
          return;
        }
        const kernels::QueryFeatures features = tree.features(target_, index, norm);
        const Window limits = window(patch);
        Candidate best = kNothing;
        // The neighbors' matches, moved along, are first upper bounds.
        for (int axis = 0; axis < 3; ++axis) {
          Vec3i before = patch;
          if (--before[axis] < tile.begin[axis]) continue;
          Vec3i p = source_.position(best_[before].index);
          p[axis] += options_.stride[axis];
          offer(gathered, p, limits, best);
        }
        offerStart(gathered, patch, limits, best);
        best = tree.nearest(gathered, features, best, windowed_ ? &limits : nullptr);
        // A window without an allowed position does not count.
        if (best.index == kNone) best = tree.nearest(gathered, features, best, nullptr);
        best_[patch] = best;
      });
    });
  }

  // Barnes, Shechtman, Finkelstein, Goldman: "PatchMatch", SIGGRAPH 2009,
  // doi:10.1145/1531326.1531330. Within a tile propagation is sequential as there; from other tiles
  // it takes the previous round's matches, so that tiles are independent and the threads do not
  // matter.
  void searchByCoherence() {
    const Random random(options_.seed, stream::kPatchMatch);
    const Vec3i positions = source_.positions();
    const int widest = std::max({positions.x, positions.y, positions.z});
    const auto cell = [&](const Vec3i& patch) {
      return static_cast<std::uint64_t>(best_.index(patch));
    };
    forTiles(0, 0.1, [&](const CellBox& tile, float* gathered) {
      forEachCell(tile, [&](const Vec3i& patch) {
        target_.gather(target_.index(patchPosition(patch)), gathered);
        if (!wanted(patch)) {
          keepStart(gathered, patch, best_[patch]);
          return;
        }
        const Window limits = window(patch);
        Candidate best = kNothing;
        offerStart(gathered, patch, limits, best);
        for (std::uint32_t draw = 0; best.index == kNone && draw < 64; ++draw)
          offer(gathered, randomPosition(random, cell(patch), 3 * draw, limits), limits, best);
        if (best.index == kNone) best = fallback(gathered, limits);
        best_[patch] = best;
      });
    });
    for (int round = 0; round < options_.iterations; ++round) {
      const Array3D<Candidate> previous = best_;
      const int direction = round % 2 == 0 ? 1 : -1;
      const double from = 0.1 + 0.9 * round / options_.iterations;
      forTiles(from, from + 0.9 / options_.iterations, [&](const CellBox& tile, float* gathered) {
        const Vec3i first = tile.begin, last = tile.end;
        const Vec3i size = last - first;
        for (int n = 0; n < size.x * size.y * size.z; ++n) {
          Vec3i patch{n % size.x, n / size.x % size.y, n / size.x / size.y};
          patch = direction > 0 ? first + patch : last - Vec3i{1, 1, 1} - patch;
          if (!wanted(patch)) continue;
          target_.gather(target_.index(patchPosition(patch)), gathered);
          const Window limits = window(patch);
          Candidate best = best_[patch];
          for (int axis = 0; axis < 3; ++axis)
            for (int side : {-1, 1}) {
              Vec3i neighbor = patch;
              neighbor[axis] += side;
              if (!best_.contains(neighbor)) continue;
              const bool inTile = neighbor[axis] >= first[axis] && neighbor[axis] < last[axis];
              // Those of this tile that come later have the previous round's match still.
              Vec3i p = source_.position(inTile ? best_[neighbor].index : previous[neighbor].index);
              p[axis] -= side * options_.stride[axis];
              offer(gathered, p, limits, best);
            }
          std::uint32_t draw = 1000 * static_cast<std::uint32_t>(round + 1);
          for (int radius = widest; radius >= 1; radius /= 2, draw += 3) {
            const Vec3i around = source_.position(best.index);
            Window near{max(limits.first, around - Vec3i{radius, radius, radius}),
                        min(limits.last, around + Vec3i{radius, radius, radius})};
            // A match outside the window (none was inside) has no neighborhood in it.
            if (min(near.first, near.last) != near.first) break;
            offer(gathered, uniform(random, cell(patch), draw, near), limits, best);
          }
          best_[patch] = best;
        }
      });
    }
  }

  static Vec3i uniform(const Random& random, std::uint64_t cell, std::uint32_t draw,
                       const Window& window) {
    Vec3i p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = window.first[axis] +
                static_cast<int>(random.below(
                    static_cast<std::uint32_t>(window.last[axis] - window.first[axis] + 1), cell,
                    draw + static_cast<std::uint32_t>(axis)));
    return p;
  }

  Vec3i randomPosition(const Random& random, std::uint64_t cell, std::uint32_t draw,
                       const Window& limits) const {
    if (!options_.allowed || windowed_) return uniform(random, cell, draw, limits);
    return source_.position(
        allowed_[random.below(static_cast<std::uint32_t>(allowed_.size()), cell, draw)]);
  }

  // For windows with few allowed positions or none: the first one, or the first of all.
  Candidate fallback(const float* gathered, const Window& limits) const {
    Candidate best = kNothing;
    for (std::uint32_t index : allowed_) {
      offer(gathered, source_.position(index), limits, best);
      if (best.index != kNone) return best;
    }
    offer(gathered, source_.position(firstAllowed_),
          {{0, 0, 0}, source_.positions() - Vec3i{1, 1, 1}}, best);
    return best;
  }

  const NearestNeighborFieldOptions& options_;
  const Progress& progress_;
  PatchSet source_, target_;
  Vec3i shape_{};
  bool windowed_ = false;
  std::uint32_t firstAllowed_ = kNone;
  std::vector<std::uint32_t> allowed_;  // where a mask is given
  Array3D<Candidate> best_;
};

}  // namespace

NearestNeighborField nearestNeighborField(const Channels& source, const Channels& target,
                                          const NearestNeighborFieldOptions& options,
                                          const Progress& progress) {
  return Field(source, target, options, progress).run();
}

}  // namespace exemplar
