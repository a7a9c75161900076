// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/scan_texture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "core/error.h"
#include "core/simd.h"

namespace exemplar {
namespace {

constexpr std::size_t kMostPlaces = 60000;  // of the example that are looked among
constexpr std::size_t kLeaf = 12;           // places in a leaf of the tree
constexpr int kLeavesLookedAt = 24;         // for one pixel

EXEMPLAR_MULTIVERSION
float squaredDistance(const float* a, const float* b, std::size_t count) {
  float lanes[8] = {}, rest = 0;
  std::size_t v = 0;
  for (; v + 8 <= count; v += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const float d = a[v + lane] - b[v + lane];
      lanes[lane] += d * d;
    }
  for (; v < count; ++v) rest += (a[v] - b[v]) * (a[v] - b[v]);
  return lanes[0] + lanes[1] + lanes[2] + lanes[3] + lanes[4] + lanes[5] + lanes[6] + lanes[7] +
         rest;
}

/// A binary tree over vectors, split at the middle of the coordinate that varies most; searched
/// leaf by leaf, the nearest boxes first (Beis, Lowe 1997).
class VectorTree {
 public:
  VectorTree(std::vector<float> vectors, std::size_t length)
      : vectors_(std::move(vectors)), length_(length), order_(vectors_.size() / length) {
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, order_.size());
  }

  /// The nearest vector found, and its squared distance.
  std::pair<std::uint32_t, float> nearest(const float* query) const {
    std::uint32_t best = order_.front();
    float least = std::numeric_limits<float>::infinity();
    using Waiting = std::pair<float, std::uint32_t>;  // least distance to the box, node
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
    waiting.push({0, 0});
    for (int leaves = 0; !waiting.empty() && leaves < kLeavesLookedAt; ++leaves) {
      auto [bound, at] = waiting.top();
      waiting.pop();
      if (bound >= least) break;
      while (nodes_[at].below != 0) {
        const Node& node = nodes_[at];
        const float past = query[node.axis] - node.split;
        const std::uint32_t near = past < 0 ? at + 1 : node.below;
        const std::uint32_t far = past < 0 ? node.below : at + 1;
        waiting.push({std::max(bound, past * past), far});
        at = near;
      }
      for (std::uint32_t n = nodes_[at].first; n < nodes_[at].last; ++n) {
        const float distance = squaredDistance(query, vector(order_[n]), length_);
        if (distance < least || (distance == least && order_[n] < best)) {
          least = distance;
          best = order_[n];
        }
      }
    }
    return {best, least};
  }

 private:
  struct Node {
    std::uint32_t first, last, axis = 0, below = 0;  // the second child; the first comes next
    float split = 0;
  };
  const float* vector(std::uint32_t n) const { return &vectors_[n * length_]; }

  void build(std::size_t first, std::size_t last) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)});
    if (last - first <= kLeaf) return;
    const std::size_t step = std::max<std::size_t>(1, (last - first) / 100);
    std::size_t axis = 0;
    double most = 0;
    for (std::size_t d = 0; d < length_; ++d) {
      double sum = 0, squares = 0, count = 0;
      for (std::size_t n = first; n < last; n += step, ++count) {
        const double v = vector(order_[n])[d];
        sum += v;
        squares += v * v;
      }
      const double variance = squares / count - sum / count * (sum / count);
      if (variance <= most) continue;
      most = variance;
      axis = d;
    }
    if (!(most > 0)) return;  // all alike: a leaf
    const std::size_t middle = (first + last) / 2;
    const auto begin = order_.begin();
    std::nth_element(
        begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
        begin + static_cast<std::ptrdiff_t>(last), [&](std::uint32_t a, std::uint32_t b) {
          const float va = vector(a)[axis], vb = vector(b)[axis];
          return va != vb ? va < vb : a < b;
        });
    nodes_[at].axis = static_cast<std::uint32_t>(axis);
    nodes_[at].split = vector(order_[middle])[axis];
    build(first, middle);
    nodes_[at].below = static_cast<std::uint32_t>(nodes_.size());
    build(middle, last);
  }

  std::vector<float> vectors_;
  std::size_t length_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// Makes one resolution.
class Scan {
 public:
  Scan(TextureFeatures example, TextureFeatures result, const ScannedLevel* coarser,
       const Shape* hole, int level, const TextureOptions& options, const Random& random)
      : made_{std::move(example), std::move(result), {}},
        coarser_(coarser),
        hole_(hole),
        options_(options),
        random_(random),
        half_(options.patch / 2),
        slack_(1 + static_cast<float>(std::pow(0.5, level) * options.coherence)) {
    made_.origins = TextureOrigins(made_.result.size);
    for (int dy = -half_; dy <= half_; ++dy)
      for (int dx = -half_; dx <= half_; ++dx)
        falloff_.push_back(std::exp(-0.5f * static_cast<float>(dx * dx + dy * dy) /
                                    static_cast<float>(half_ * half_)));
  }

  ScannedLevel run(const Progress& progress) {
    choosePlaces();
    start();
    const VectorTree tree = treeOfPlaces();
    const Vec3i size = made_.result.size;
    std::vector<float> query(length());
    for (int y = 0; y < size.y; ++y) {
      progress.report("following the layers", static_cast<double>(y) / size.y);
      for (int x = 0; x < size.x; ++x) {
        const Vec3i at{x, y, 0};
        if (hole_ && !(*hole_)[at]) continue;
        describe(made_.result, coarser_ ? &coarser_->result : nullptr, at, options_.wraps,
                 query.data());
        const auto [place, distance] = tree.nearest(query.data());
        const Vec3i found = coherent(at, query, places_[place], distance);
        put(at, found);
      }
    }
    return std::move(made_);
  }

 private:
  std::size_t length() const {
    const auto window = static_cast<std::size_t>(options_.patch * options_.patch);
    const auto planes = static_cast<std::size_t>(made_.example.values - made_.example.guides);
    return window * static_cast<std::size_t>(made_.example.guides) + window / 2 * planes +
           (coarser_ ? 9 * planes : 0);
  }

  /// What surrounds a place, weighted: the guide, the texture before it, the coarser texture.
  void describe(const TextureFeatures& features, const TextureFeatures* coarser, const Vec3i& at,
                bool wraps, float* to) const {
    const auto placed = [&](const Vec3i& p, const Vec3i& size) {
      return wraps ? wrappedPlace(p, size) : max(Vec3i{}, min(p, size - Vec3i{1, 1, 1}));
    };
    const int guides = features.guides, values = features.values;
    std::size_t n = 0;
    for (int dy = -half_; dy <= half_; ++dy) {
      for (int dx = -half_; dx <= half_; ++dx, ++n) {
        const float* from = features.at(placed(at + Vec3i{dx, dy, 0}, features.size));
        for (int v = 0; v < guides; ++v) *to++ = falloff_[n] * from[v];
        if (dy > 0 || (dy == 0 && dx >= 0)) continue;
        for (int v = guides; v < values; ++v) *to++ = falloff_[n] * from[v];
      }
    }
    if (!coarser) return;
    const Vec3i half{at.x / 2, at.y / 2, 0};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const float* from = coarser->at(placed(half + Vec3i{dx, dy, 0}, coarser->size));
        for (int v = guides; v < values; ++v) *to++ = from[v];
      }
    }
  }

  bool serves(const Vec3i& place) const {
    const Vec3i& size = made_.example.size;
    if (place.x < half_ || place.y < half_ || place.x >= size.x - half_ ||
        place.y >= size.y - half_)
      return false;
    if (!hole_) return true;
    for (int dy = -half_; dy <= half_; ++dy)
      for (int dx = -half_; dx <= half_; ++dx)
        if ((*hole_)[place + Vec3i{dx, dy, 0}]) return false;
    return true;
  }

  /// The places that are looked among: all, or as many as there may be, by lot.
  void choosePlaces() {
    const Vec3i& size = made_.example.size;
    for (int y = half_; y < size.y - half_; ++y)
      for (int x = half_; x < size.x - half_; ++x)
        if (serves({x, y, 0})) places_.push_back({x, y, 0});
    if (places_.empty())
      throw InputError("the hole leaves no whole patch of the example; make it smaller");
    if (places_.size() <= kMostPlaces) return;
    for (std::size_t n = 0; n < kMostPlaces; ++n)
      std::swap(places_[n],
                places_[n + random_.below(static_cast<std::uint32_t>(places_.size() - n), n)]);
    places_.resize(kMostPlaces);
  }

  VectorTree treeOfPlaces() const {
    std::vector<float> vectors(places_.size() * length());
    for (std::size_t n = 0; n < places_.size(); ++n)
      describe(made_.example, coarser_ ? &coarser_->example : nullptr, places_[n], false,
               &vectors[n * length()]);
    return {std::move(vectors), length()};
  }

  /// What is not made yet is what the coarser resolution says, or by lot.
  void start() {
    const Vec3i& size = made_.result.size;
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const Vec3i at{x, y, 0};
        if (hole_ && !(*hole_)[at]) {
          made_.origins[at] = at;
          continue;
        }
        Vec3i place = places_[random_.below(static_cast<std::uint32_t>(places_.size()),
                                            made_.origins.index(at), 1)];
        if (coarser_) {
          const Vec3i& from = coarser_->origins[coarser_->origins.clamped({x / 2, y / 2, 0})];
          const Vec3i there{2 * from.x + x % 2, 2 * from.y + y % 2, 0};
          if (serves(there)) place = there;
        }
        put(at, place);
      }
    }
  }

  /// The place that goes on beside a neighbor's, where it is hardly worse than the best.
  Vec3i coherent(const Vec3i& at, const std::vector<float>& query, const Vec3i& best,
                 float distance) const {
    std::vector<float> other(query.size());
    float least = distance * slack_;
    Vec3i found = best;
    for (int dy = -half_; dy <= 0; ++dy) {
      for (int dx = -half_; dx <= half_ && !(dy == 0 && dx >= 0); ++dx) {
        Vec3i neighbor = at + Vec3i{dx, dy, 0};
        if (options_.wraps) {
          neighbor = wrappedPlace(neighbor, made_.result.size);
        } else if (!made_.origins.contains(neighbor)) {
          continue;
        }
        const Vec3i place = made_.origins[neighbor] - Vec3i{dx, dy, 0};
        if (!serves(place)) continue;
        describe(made_.example, coarser_ ? &coarser_->example : nullptr, place, false,
                 other.data());
        const float price = squaredDistance(query.data(), other.data(), query.size());
        if (price > least) continue;
        least = price;
        found = place;
      }
    }
    return found;
  }

  void put(const Vec3i& at, const Vec3i& place) {
    made_.origins[at] = place;
    const float* from = made_.example.at(place);
    std::copy(from + made_.example.guides, from + made_.example.values,
              made_.result.at(at) + made_.example.guides);
  }

  ScannedLevel made_;
  const ScannedLevel* coarser_;
  const Shape* hole_;
  const TextureOptions& options_;
  Random random_;
  int half_;
  float slack_;
  std::vector<float> falloff_;
  std::vector<Vec3i> places_;
};

}  // namespace

ScannedLevel scanTexture(TextureFeatures example, TextureFeatures result,
                         const ScannedLevel* coarser, const Shape* hole, int level,
                         const TextureOptions& options, const Random& random,
                         const Progress& progress) {
  return Scan(std::move(example), std::move(result), coarser, hole, level, options, random)
      .run(progress);
}

}  // namespace exemplar
