// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/patch_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/simd.h"
#include "search/block_match.h"

namespace exemplar {

namespace {

constexpr int kLanes = 8;
constexpr int kDirections = PatchTree::kDirections;
constexpr double kHalf = 16384;   // the number of projection 0
constexpr double kReach = 16000;  // of the largest projection
// Half a unit in the last place of 1.
constexpr float kUlp = 0x1p-24f;

template <int width>
inline __attribute__((always_inline)) float sumRows(const float* values, const float* gathered,
                                                    const std::uint32_t* rows,
                                                    const std::uint32_t* order, std::size_t count,
                                                    const float* inside, std::size_t anyWidth,
                                                    float limit) {
  const std::size_t w = width ? width : anyWidth;
  float lanes[kLanes] = {};
  float total = 0;
  for (std::size_t r = 0; r < count;) {
    const std::size_t end = std::min(count, r + 8);
    for (; r < end; ++r) {
      const float* a = values + rows[order[r]];
      const float* q = gathered + order[r] * w;
      for (std::size_t i = 0; i < w; i += kLanes)
        for (int l = 0; l < kLanes; ++l) {
          const float d = a[i + l] * inside[i + l] - q[i + l];
          lanes[l] += d * d;
        }
    }
    total = ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
            ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
    if (total > limit) break;
  }
  return total;
}

EXEMPLAR_MULTIVERSION float sumPatch(const float* values, const float* gathered,
                                     const std::uint32_t* rows, const std::uint32_t* order,
                                     std::size_t count, const float* inside, std::size_t width,
                                     float limit) {
  if (width == 8) return sumRows<8>(values, gathered, rows, order, count, inside, width, limit);
  return sumRows<0>(values, gathered, rows, order, count, inside, width, limit);
}

// Row by row, then over rows: the rounding error grows with their numbers' sum, not their product.
EXEMPLAR_MULTIVERSION void projectPatch(const float* values, const std::uint32_t* rows,
                                        std::size_t count, int length, float center,
                                        const float* basis, float* products) {
  float total[kDirections] = {};
  for (std::size_t r = 0; r < count; ++r) {
    float row[kDirections] = {};
    const float* a = values + rows[r];
    for (int i = 0; i < length; ++i, basis += kDirections)
      for (int b = 0; b < kDirections; ++b) row[b] += (a[i] - center) * basis[b];
    for (int b = 0; b < kDirections; ++b) total[b] += row[b];
  }
  for (int b = 0; b < kDirections; ++b) products[b] = total[b];
}

}  // namespace

PatchSet::PatchSet(const Channels& channels, const Vec3i& patch) : patch_(patch) {
  if (channels.empty()) throw InputError("a nearest-neighbor field needs at least one channel");
  size_ = channels[0].size();
  blockPositions(size_, patch);
  if (static_cast<double>(channels.size()) * static_cast<double>(channels[0].count()) > 0x1p31)
    throw InputError("the channels of a nearest-neighbor field have more than 2^31 samples");
  for (const auto& channel : channels) {
    if (channel.size() != size_)
      throw InputError("the channels of a nearest-neighbor field differ in size");
    values_.insert(values_.end(), channel.values().begin(), channel.values().end());
  }
  width_ = (static_cast<std::size_t>(patch.x) + kLanes - 1) / kLanes * kLanes;
  inside_.assign(width_, 0);
  std::fill_n(inside_.begin(), patch.x, 1.0f);
  values_.resize(values_.size() + width_, 0);
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (int k = 0; k < patch.z; ++k)
      for (int j = 0; j < patch.y; ++j)
        rows_.push_back(index({0, j, k}) + static_cast<std::uint32_t>(c * channels[0].count()));
  // Steps of about the golden ratio spread over the patch from the start on.
  const std::size_t n = rows_.size();
  std::size_t step = static_cast<std::size_t>(0.618 * static_cast<double>(n)) | 1;
  while (n > 1 && std::gcd(step, n) != 1) ++step;
  for (std::size_t r = 0, at = 0; r < n; ++r, at = (at + step) % n)
    order_.push_back(static_cast<std::uint32_t>(at));
}

Vec3i PatchSet::position(std::uint32_t index) const {
  const std::uint32_t nx = static_cast<std::uint32_t>(size_.x);
  const std::uint32_t ny = static_cast<std::uint32_t>(size_.y);
  return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
          static_cast<int>(index / nx / ny)};
}

void PatchSet::gather(std::uint32_t index, float* patch) const {
  std::fill_n(patch, gatheredLength(), 0.0f);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    std::copy_n(values_.data() + index + rows_[r], patch_.x, patch + r * width_);
}

float PatchSet::sum(const float* gathered, std::uint32_t index, float limit) const {
  return sumPatch(values_.data() + index, gathered, rows_.data(), order_.data(), rows_.size(),
                  inside_.data(), width_, limit);
}

void PatchSet::project(const float* basis, float center, std::uint32_t index,
                       float* products) const {
  projectPatch(values_.data() + index, rows_.data(), rows_.size(), patch_.x, center, basis,
               products);
}

float PatchSet::largestNorm(float center) const {
  float largest = 0;
  for (std::size_t i = 0; i + width_ < values_.size(); ++i)
    largest = std::max(largest, std::abs(values_[i] - center));
  return largest * std::sqrt(static_cast<float>(terms()));
}

float PatchSet::center() const {
  double sum = 0;
  for (float v : values_) sum += v;
  return static_cast<float>(sum / static_cast<double>(values_.size()));
}

bool PatchSet::same(std::uint32_t a, std::uint32_t b) const {
  return std::ranges::all_of(rows_, [&](std::uint32_t row) {
    return std::memcmp(values_.data() + a + row, values_.data() + b + row,
                       static_cast<std::size_t>(patch_.x) * sizeof(float)) == 0;
  });
}

std::vector<std::uint64_t> PatchSet::hashes() const {
  // Polynomials of the bits, axis after axis.
  const std::size_t count = static_cast<std::size_t>(volume(size_));
  const std::size_t channels = rows_.size() / (static_cast<std::size_t>(patch_.y) * patch_.z);
  const std::size_t strides[3] = {1, static_cast<std::size_t>(size_.x),
                                  static_cast<std::size_t>(size_.x) * size_.y};
  std::vector<std::uint64_t> hash(count, 0);
  for (std::size_t c = 0; c < channels; ++c)
    parallelFor(0, count, 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        std::uint64_t bits = std::bit_cast<std::uint32_t>(values_[c * count + i]) + c;
        bits = (bits ^ bits >> 15) * 0x9e3779b97f4a7c15u;
        hash[i] = (hash[i] ^ bits ^ bits >> 31) * 0xd6e8feb86659fd93u;
      }
    });
  constexpr std::uint64_t kFactor[3] = {0x9fb21c651e98df25u, 0xa0761d6478bd642fu,
                                        0xe7037ed1a0b428dbu};
  std::vector<std::uint64_t> along(count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t length = static_cast<std::size_t>(patch_[axis]), stride = strides[axis];
    parallelFor(0, count, 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        std::uint64_t h = 0;
        for (std::size_t l = 0; l < length && i + l * stride < count; ++l)
          h = (h + hash[i + l * stride]) * kFactor[axis];
        along[i] = h ^ h >> 32;
      }
    });
    std::swap(hash, along);
  }
  return hash;
}

PatchTree::PatchTree(const PatchSet& set, const PatchChoice& choice)
    : set_(set), weight_(choice.weight), windowed_(choice.windowed) {
  const Vec3i positions = set.positions();
  std::vector<std::uint32_t> points;
  for (int k = 0; k < positions.z; ++k)
    for (int j = 0; j < positions.y; ++j)
      for (int i = 0; i < positions.x; ++i)
        if (!choice.allowed || (*choice.allowed)(i, j, k)) points.push_back(set.index({i, j, k}));
  if (points.empty()) return;

  if (!choice.windowed) {
    // Of equal patches at equal weight only the lowest index can be an answer.
    const std::vector<std::uint64_t> hash = set.hashes();
    const auto key = [&](std::uint32_t p) {
      return std::pair(hash[p], weight_ ? weight_->data()[p] : 1.0f);
    };
    std::ranges::sort(points, [&](std::uint32_t a, std::uint32_t b) {
      const auto ka = key(a), kb = key(b);
      return ka != kb ? ka < kb : a < b;
    });
    std::vector<std::uint32_t> kept;
    std::uint32_t head = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const bool sameKey = p > 0 && key(points[p]) == key(head);
      if (sameKey && set.same(head, points[p])) continue;
      if (!sameKey) head = points[p];
      kept.push_back(points[p]);
    }
    points = std::move(kept);
    std::ranges::sort(points);
  }

  findDirections(points);
  center_ = set.center();
  norm_ = set.largestNorm(center_);
  // Projections as numbers. The largest decides the scale; a target's may be larger and count as
  // the largest, which takes nobody's distance beyond what it was.
  std::vector<float> projections(points.size() * kDirections);
  parallelFor(0, points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      set.project(basis_.data(), center_, points[p], projections.data() + p * kDirections);
  });
  // (Patches that are all the same have none to speak of.)
  float largest = std::max(1e-30f, 1e-4f * norm_);
  for (float v : projections) largest = std::max(largest, std::abs(v));
  scale_ = kReach / largest;
  const int margin = static_cast<int>(std::ceil(0.5 + roundingError(norm_)));
  std::vector<std::uint32_t> entries(points.size());
  std::iota(entries.begin(), entries.end(), 0u);
  tree_ = FeatureTree(
      entries,
      [&](std::uint32_t entry, std::int16_t* low, std::int16_t* high) {
        for (int d = 0; d < kDirections; ++d)
          low[d] = high[d] = static_cast<std::int16_t>(std::lround(
              projections[std::size_t{entry} * kDirections + static_cast<std::size_t>(d)] * scale_ +
              kHalf));
      },
      margin);
  points_ = std::move(points);

  // What else decides whether a child may be chosen from.
  const auto join = [](Child& a, const Child& b) {
    a.weight = std::min(a.weight, b.weight);
    a.first = min(a.first, b.first);
    a.last = max(a.last, b.last);
  };
  const Child nothing{
      std::numeric_limits<float>::infinity(), {1 << 30, 1 << 30, 1 << 30}, {-1, -1, -1}};
  if (!weight_ && !windowed_) return;
  below_.emplace_back(tree_.leaves(), nothing);
  for (std::size_t n = 0; n < tree_.leaves(); ++n)
    for (std::uint32_t entry : tree_.leaf(n).entry) {
      if (entry == FeatureTree::kNone) continue;
      const Vec3i p = set.position(points_[entry]);
      join(below_[0][n], {weight_ ? weight_->data()[points_[entry]] : 1.0f, p, p});
    }
  for (int level = 0; level < tree_.levels(); ++level) {
    std::vector<Child> nodes(tree_.nodes(level), nothing);
    for (std::size_t c = 0; c < below_.back().size(); ++c)
      join(nodes[c / FeatureTree::kWide], below_.back()[c]);
    below_.push_back(std::move(nodes));
  }
}

double PatchTree::roundingError(double norm) const {
  // Sums of a row's samples, then of rows: each operation is off by at most 2^-24 of a value that
  // no patch's length exceeds. The directions themselves are rounded as well.
  const double rows = static_cast<double>(set_.terms()) / set_.patch().x;
  return (rows + set_.patch().x + 8) * kUlp * norm * scale_;
}

void PatchTree::findDirections(std::span<const std::uint32_t> points) {
  // Leading principal components of a sample of the patches, by subspace iteration in double. Any
  // orthonormal directions keep the search exact; good ones make it fast.
  const std::size_t terms = static_cast<std::size_t>(set_.terms());
  const std::size_t count = std::min<std::size_t>(points.size(), 2048);
  const Random random(0, stream::kPatchFeatures);
  std::vector<double> samples(count * terms);
  {
    std::vector<float> gathered(set_.gatheredLength());
    const std::size_t width = set_.gatheredLength() / (terms / set_.patch().x);
    for (std::size_t s = 0; s < count; ++s) {
      set_.gather(points[s * points.size() / count], gathered.data());
      for (std::size_t t = 0; t < terms; ++t)
        samples[s * terms + t] = gathered[t / set_.patch().x * width + t % set_.patch().x];
    }
    for (std::size_t t = 0; t < terms; ++t) {
      double mean = 0;
      for (std::size_t s = 0; s < count; ++s) mean += samples[s * terms + t];
      mean /= static_cast<double>(count);
      for (std::size_t s = 0; s < count; ++s) samples[s * terms + t] -= mean;
    }
  }
  std::vector<double> basis(terms * kDirections), next(terms * kDirections);
  for (std::size_t i = 0; i < basis.size(); ++i) basis[i] = random.normal(i);
  const auto orthonormalize = [&](std::vector<double>& m) {
    for (int b = 0; b < kDirections; ++b)
      for (int pass = 0; pass < 2; ++pass) {
        for (int a = 0; a < b; ++a) {
          double product = 0;
          for (std::size_t t = 0; t < terms; ++t)
            product += m[t * kDirections + a] * m[t * kDirections + b];
          for (std::size_t t = 0; t < terms; ++t)
            m[t * kDirections + b] -= product * m[t * kDirections + a];
        }
        double norm = 0;
        for (std::size_t t = 0; t < terms; ++t)
          norm += m[t * kDirections + b] * m[t * kDirections + b];
        // More directions than terms or than the patches span: the rest stay zero.
        const double scale = norm > 1e-18 ? 1 / std::sqrt(norm) : 0;
        for (std::size_t t = 0; t < terms; ++t) m[t * kDirections + b] *= scale;
      }
  };
  orthonormalize(basis);
  for (int iteration = 0; iteration < 8; ++iteration) {
    std::ranges::fill(next, 0.0);
    for (std::size_t s = 0; s < count; ++s) {
      const double* x = samples.data() + s * terms;
      double products[kDirections] = {};
      for (std::size_t t = 0; t < terms; ++t)
        for (int b = 0; b < kDirections; ++b) products[b] += x[t] * basis[t * kDirections + b];
      for (std::size_t t = 0; t < terms; ++t)
        for (int b = 0; b < kDirections; ++b) next[t * kDirections + b] += x[t] * products[b];
    }
    // The scale of what is negligible depends on the data.
    double largest = 0;
    for (double v : next) largest = std::max(largest, std::abs(v));
    if (largest > 0)
      for (double& v : next) v /= largest;
    orthonormalize(next);
    std::swap(basis, next);
  }
  basis_.assign(basis.begin(), basis.end());
}

kernels::QueryFeatures PatchTree::features(const PatchSet& from, std::uint32_t index,
                                           float norm) const {
  float projection[kDirections];
  from.project(basis_.data(), center_, index, projection);
  const double error = roundingError(norm);
  kernels::QueryFeatures features;
  features.weighted = false;
  features.detailPairs = kernels::kDetails / 2;
  for (int p = 0; p < features.detailPairs; ++p)
    features.detailPair[p] = static_cast<std::uint8_t>(p);
  for (int d = 0; d < kDirections; ++d) {
    const double v = projection[d] * scale_ + kHalf;
    const auto low = static_cast<std::int16_t>(std::clamp(std::floor(v - error), 0.0, 32767.0));
    const auto high = static_cast<std::int16_t>(std::clamp(std::ceil(v + error), 0.0, 32767.0));
    (d < kernels::kMeans ? features.meanLow[d] : features.detailLow[d - kernels::kMeans]) = low;
    (d < kernels::kMeans ? features.meanHigh[d] : features.detailHigh[d - kernels::kMeans]) = high;
  }
  return features;
}

// What the tree's search asks and finds.
struct PatchTree::Search {
  const PatchTree& tree;
  const float* gathered;
  const Window* window;
  Candidate best;
  float relative;  // a sum's own rounding
  std::uint32_t limit = kernels::kLargestBound;
  struct Found {
    std::uint32_t gap, entry;
  };
  Found found[FeatureTree::kWide * FeatureTree::kWide];
  int count = 0;

  // Sums of squared gaps above this belong to patches that, at weight `w`, cost more than the best.
  std::uint32_t boundAt(float w) const {
    const double bound = static_cast<double>(best.cost) / w * relative * tree.scale_ * tree.scale_;
    return bound < kernels::kLargestBound ? static_cast<std::uint32_t>(bound * (1 + 1e-9))
                                          : kernels::kLargestBound;
  }
  void update() { limit = boundAt(tree.weight_ ? tree.below_.back()[0].weight : 1.0f); }

  std::uint32_t bound() const { return limit; }
  bool hopeless(std::uint32_t lowest) const {
    return best.cost == 0 && tree.points_[lowest] > best.index;
  }
  bool inWindow(const Vec3i& first, const Vec3i& last) const {
    return !window || (max(last, window->first) == last && min(first, window->last) == first);
  }
  bool may(int level, std::size_t child, std::uint32_t gap) const {
    if (tree.below_.empty()) return true;
    const Child& c = tree.below_[static_cast<std::size_t>(level)][child];
    return inWindow(c.first, c.last) && (!tree.weight_ || gap <= boundAt(c.weight));
  }
  bool node() { return true; }
  void leaves(int) {}
  void add(std::uint32_t entry, std::uint32_t gap) {
    const std::uint32_t point = tree.points_[entry];
    if (window) {
      const Vec3i p = tree.set_.position(point);
      if (!inWindow(p, p)) return;
    }
    if (tree.weight_ && gap > boundAt(tree.weight_->data()[point])) return;
    found[count++] = {gap, point};
  }
  void flush() {
    // The nearest first: each may lower the limit for those behind it.
    std::sort(found, found + count, [](const Found& a, const Found& b) {
      return a.gap != b.gap ? a.gap < b.gap : a.entry < b.entry;
    });
    for (int f = 0; f < count && found[f].gap <= limit; ++f) offer(found[f].entry);
    count = 0;
  }
  void offer(std::uint32_t point) {
    const float w = tree.weight_ ? tree.weight_->data()[point] : 1.0f;
    const float sum = tree.set_.sum(gathered, point, best.cost / w * relative);
    const Candidate candidate{w * sum, point, sum};
    if (!candidate.before(best)) return;
    best = candidate;
    update();
  }
};

PatchTree::Candidate PatchTree::nearest(const float* gathered,
                                        const kernels::QueryFeatures& features,
                                        const Candidate& start, const Window* window) const {
  if (points_.empty()) return start;
  const float relative = 1 + (static_cast<float>(set_.terms()) + 64) * kUlp;
  Search search{*this, gathered, window, start, relative};
  search.update();
  if (start.index == FeatureTree::kNone && !window)
    search.offer(points_[likelyEntry(tree_, features)]);
  FeatureTreeSearch(tree_, features, search).run();
  return search.best;
}

}  // namespace exemplar
