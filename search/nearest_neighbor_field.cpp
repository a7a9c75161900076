// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/nearest_neighbor_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/simd.h"

namespace exemplar {
namespace {

constexpr int kLanes = 8;
constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kSearchStream = 0x9a7c;

/// A patch copied out, each row padded to whole lanes, so that one patch is compared with many.
struct PackedPatch {
  std::vector<float> samples;
};

/// How patches lie in the arrays that are compared.
struct PatchShape {
  Vec3i patch;
  int chunks;                ///< of kLanes lanes a row
  std::vector<float> known;  ///< 1 for lanes of the patch, 0 beyond its row: chunks * kLanes

  explicit PatchShape(const Vec3i& size)
      : patch(size), chunks((size.x + kLanes - 1) / kLanes), known(chunks * kLanes, 0.0f) {
    std::fill_n(known.begin(), size.x, 1.0f);
  }
  std::size_t packedSlice() const { return static_cast<std::size_t>(chunks) * kLanes * patch.y; }
};

/// The sum of squared differences of one slice (one k of one channel) of a packed patch and of the
/// source at `from`; over-reads the source by less than kLanes samples.
EXEMPLAR_MULTIVERSION
float sliceDistance(const float* packed, const float* from, std::ptrdiff_t sourceRow, int rows,
                    int chunks, const float* known) {
  float sums[kLanes] = {};
  for (int j = 0; j < rows; ++j, from += sourceRow) {
    for (int c = 0; c < chunks; ++c, packed += kLanes) {
      const float* s = from + c * kLanes;
      const float* m = known + c * kLanes;
      for (int l = 0; l < kLanes; ++l) {
        const float d = (s[l] - packed[l]) * m[l];
        sums[l] += d * d;
      }
    }
  }
  float sum = 0;
  for (int l = 0; l < kLanes; ++l) sum += sums[l];
  return sum;
}

/// The positions of a source that one target patch may use.
struct Reach {
  Vec3i low, high;  ///< inclusive
  bool contains(const Vec3i& p) const {
    return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y &&
           p.z <= high.z;
  }
};

class Search {
 public:
  Search(const Channels& source, const Channels& target, const NearestNeighborFieldOptions& options)
      : options_(options), target_(target), shape_(options.patch) {
    size_ = source.front().size();
    places_ = size_ - options.patch + Vec3i{1, 1, 1};
    targetPlaces_ = target.front().size() - options.patch + Vec3i{1, 1, 1};
    for (const Array3D<float>& channel : source) {
      std::vector<float> padded(channel.values().begin(), channel.values().end());
      padded.resize(padded.size() + kLanes, 0.0f);
      source_.push_back(std::move(padded));
    }
    scale_ = 1.0f / static_cast<float>(volume(options.patch));
    const Vec3i n{(targetPlaces_.x - 1) / options.stride.x + 1,
                  (targetPlaces_.y - 1) / options.stride.y + 1,
                  (targetPlaces_.z - 1) / options.stride.z + 1};
    field_.stride = options.stride;
    field_.position = Array3D<Vec3i>(n);
    field_.distance = Array3D<float>(n, kInfinite);
    cost_ = Array3D<float>(n, kInfinite);
    if (options.allowed) {
      for (std::size_t s = 0; s < options.allowed->count(); ++s) {
        const Vec3i p = options.allowed->ijk(s);
        if (options.allowed->values()[s] && inPlaces(p)) allowedList_.push_back(p);
      }
      if (allowedList_.empty()) {
        throw InputError("nearest-neighbor field: no source position is allowed");
      }
    }
  }

  NearestNeighborField run(const Progress& progress) {
    const std::size_t patches = field_.position.count();
    if (options_.method == NeighborMethod::Exact) {
      forPatches(
          patches, 16, [&](std::size_t q, PackedPatch& packed) { searchAll(q, packed); }, progress);
    } else {
      forPatches(
          patches, 256, [&](std::size_t q, PackedPatch& packed) { begin(q, packed); }, progress);
      for (int iteration = 0; iteration < options_.iterations && !progress.cancelled();
           ++iteration) {
        // Patches of one parity look at neighbours of the other only, an odd number of steps away.
        for (int parity = 0; parity < 2; ++parity) {
          forPatches(
              patches, 256,
              [&](std::size_t q, PackedPatch& packed) {
                const Vec3i p = field_.position.ijk(q);
                if (((p.x + p.y + p.z) & 1) == parity) improve(q, iteration, packed);
              },
              progress);
        }
      }
    }
    field_.complete = !progress.cancelled();
    return std::move(field_);
  }

 private:
  template <class Body>
  void forPatches(std::size_t patches, std::size_t grain, const Body& body,
                  const Progress& progress) {
    parallelFor(0, patches, grain, [&](std::size_t first, std::size_t last) {
      if (progress.cancelled()) return;
      PackedPatch packed;
      for (std::size_t q = first; q < last; ++q) body(q, packed);
    });
  }

  bool inPlaces(const Vec3i& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < places_.x && p.y < places_.y &&
           p.z < places_.z;
  }

  std::size_t sourceIndex(const Vec3i& p) const {
    return (static_cast<std::size_t>(p.z) * size_.y + p.y) * size_.x + p.x;
  }

  Reach reach(std::size_t q) const {
    const Vec3i at = scaled(field_.position.ijk(q), options_.stride);
    Reach r{{0, 0, 0}, places_ - Vec3i{1, 1, 1}};
    for (int axis = 0; axis < 3; ++axis) {
      if (options_.window[axis] < 0) continue;
      const int span = targetPlaces_[axis] - 1;
      const int middle =
          span == 0 ? 0
                    : static_cast<int>((std::int64_t{2} * at[axis] * (places_[axis] - 1) + span) /
                                       (2 * std::int64_t{span}));
      r.low[axis] = std::max(0, middle - options_.window[axis]);
      r.high[axis] = std::min(places_[axis] - 1, middle + options_.window[axis]);
    }
    return r;
  }

  void pack(std::size_t q, PackedPatch& packed) const {
    const Vec3i at = scaled(field_.position.ijk(q), options_.stride);
    packed.samples.assign(shape_.packedSlice() * shape_.patch.z * target_.size(), 0.0f);
    float* to = packed.samples.data();
    for (const Array3D<float>& channel : target_) {
      for (int k = 0; k < shape_.patch.z; ++k) {
        for (int j = 0; j < shape_.patch.y; ++j, to += shape_.chunks * kLanes) {
          std::copy_n(&channel(at.x, at.y + j, at.z + k), shape_.patch.x, to);
        }
      }
    }
  }

  /// Considers source position `p` for patch `q`: takes it when it costs less, or as little at a
  /// lower index.
  void consider(std::size_t q, const Vec3i& p, const PackedPatch& packed) {
    const float weight = options_.sourceWeight ? (*options_.sourceWeight)[p] : 1.0f;
    const float bound = cost_.values()[q] / (weight * scale_);
    const float* samples = packed.samples.data();
    const std::ptrdiff_t row = size_.x, slice = row * size_.y;
    float sum = 0;
    for (const std::vector<float>& channel : source_) {
      const float* from = channel.data() + sourceIndex(p);
      for (int k = 0; k < shape_.patch.z; ++k, from += slice, samples += shape_.packedSlice()) {
        sum +=
            sliceDistance(samples, from, row, shape_.patch.y, shape_.chunks, shape_.known.data());
        if (sum > bound * 1.0001f) return;
      }
    }
    const float cost = sum * scale_ * weight;
    const bool tie =
        cost == cost_.values()[q] && sourceIndex(p) < sourceIndex(field_.position.values()[q]);
    if (cost < cost_.values()[q] || tie) {
      cost_.values()[q] = cost;
      field_.position.values()[q] = p;
      field_.distance.values()[q] = sum * scale_;
    }
  }

  bool isAllowed(const Vec3i& p) const { return !options_.allowed || (*options_.allowed)[p] != 0; }

  /// The start's position for patch `q`, where it has a usable one.
  void considerStart(std::size_t q, const Reach& r, const PackedPatch& packed) {
    if (!options_.start || !(options_.start->position.size() == field_.position.size())) return;
    const Vec3i p = options_.start->position.values()[q];
    if (r.contains(p) && isAllowed(p)) consider(q, p, packed);
  }

  void searchAll(std::size_t q, PackedPatch& packed) {
    const Reach r = reach(q);
    pack(q, packed);
    considerStart(q, r, packed);
    if (options_.allowed) {
      for (const Vec3i& p : allowedList_) {
        if (r.contains(p)) consider(q, p, packed);
      }
      return;
    }
    for (int k = r.low.z; k <= r.high.z; ++k)
      for (int j = r.low.y; j <= r.high.y; ++j)
        for (int i = r.low.x; i <= r.high.x; ++i) consider(q, {i, j, k}, packed);
  }

  Vec3i randomPlace(const Reach& r, const Vec3i& middle, const Vec3i& radius, std::uint64_t key,
                    std::uint32_t draw) const {
    const Random random(options_.seed, kSearchStream);
    Vec3i p;
    for (int axis = 0; axis < 3; ++axis) {
      const int low = std::max(r.low[axis], middle[axis] - radius[axis]);
      const int high = std::min(r.high[axis], middle[axis] + radius[axis]);
      p[axis] = low >= high
                    ? std::clamp(middle[axis], r.low[axis], r.high[axis])
                    : low + static_cast<int>(random.below(high - low + 1, key, 3 * draw + axis));
    }
    return p;
  }

  void begin(std::size_t q, PackedPatch& packed) {
    const Reach r = reach(q);
    pack(q, packed);
    considerStart(q, r, packed);
    if (cost_.values()[q] < kInfinite) return;
    if (options_.allowed) {
      const Random random(options_.seed, kSearchStream);
      const auto n = static_cast<std::uint32_t>(allowedList_.size());
      consider(q, allowedList_[random.below(n, q, 0)], packed);
      return;
    }
    consider(q, randomPlace(r, r.low, places_, q, 0), packed);
  }

  void improve(std::size_t q, int iteration, PackedPatch& packed) {
    static constexpr std::array<int, 4> kJumps{3, 5, 9, 17};
    const Reach r = reach(q);
    pack(q, packed);
    const Vec3i at = field_.position.ijk(q);
    for (const int jump : {1, kJumps[iteration % kJumps.size()]}) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int step : {-jump, jump}) {
          Vec3i neighbor = at;
          neighbor[axis] += step;
          if (!field_.position.contains(neighbor)) continue;
          Vec3i p = field_.position[neighbor];
          p[axis] -= step * options_.stride[axis];
          if (r.contains(p) && p != field_.position.values()[q] && isAllowed(p)) {
            consider(q, p, packed);
          }
        }
      }
    }
    Vec3i radius = places_;
    for (std::uint32_t draw = 1; std::max({radius.x, radius.y, radius.z}) >= 1; ++draw) {
      const Vec3i p =
          randomPlace(r, field_.position.values()[q], radius,
                      q + field_.position.count() * (iteration + std::uint64_t{1}), draw);
      if (p != field_.position.values()[q] && isAllowed(p)) consider(q, p, packed);
      radius = Vec3i{radius.x / 2, radius.y / 2, radius.z / 2};
    }
  }

  const NearestNeighborFieldOptions& options_;
  const Channels& target_;
  PatchShape shape_;
  Vec3i size_, places_, targetPlaces_;
  std::vector<std::vector<float>> source_;  ///< channels, padded for over-reading
  std::vector<Vec3i> allowedList_;
  float scale_ = 1;
  NearestNeighborField field_;
  Array3D<float> cost_;
};

void check(const Channels& source, const Channels& target,
           const NearestNeighborFieldOptions& options) {
  const auto fail = [](const std::string& what) {
    throw InputError("nearest-neighbor field: " + what);
  };
  if (source.empty() || source.size() != target.size()) {
    fail("source and target need the same number of channels, at least one");
  }
  for (const Array3D<float>& channel : source) {
    if (channel.size() != source.front().size()) fail("the source's channels differ in size");
  }
  for (const Array3D<float>& channel : target) {
    if (channel.size() != target.front().size()) fail("the target's channels differ in size");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int patch = options.patch[axis];
    if (patch < 1 || patch > source.front().size()[axis] || patch > target.front().size()[axis]) {
      fail("a patch of " + std::to_string(patch) + " samples does not fit");
    }
    if (options.stride[axis] < 1) fail("the stride must be at least 1");
  }
  if (options.iterations < 1) fail("iterations must be at least 1");
  if (options.allowed && options.allowed->size() != source.front().size()) {
    fail("`allowed` must be of the source's size");
  }
  if (options.sourceWeight && options.sourceWeight->size() != source.front().size()) {
    fail("`sourceWeight` must be of the source's size");
  }
}

}  // namespace

NearestNeighborField nearestNeighborField(const Channels& source, const Channels& target,
                                          const NearestNeighborFieldOptions& options,
                                          const Progress& progress) {
  check(source, target, options);
  return Search(source, target, options).run(progress);
}

}  // namespace exemplar
