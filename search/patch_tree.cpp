// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "search/patch_tree.h"

#include <tbb/parallel_invoke.h>

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
constexpr int kWide = PatchTree::kWide;
constexpr float kInfinite = std::numeric_limits<float>::infinity();
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
  float total[kWide] = {};
  for (std::size_t r = 0; r < count; ++r) {
    float row[kWide] = {};
    const float* a = values + rows[r];
    for (int i = 0; i < length; ++i, basis += kWide)
      for (int b = 0; b < kWide; ++b) row[b] += (a[i] - center) * basis[b];
    for (int b = 0; b < kWide; ++b) total[b] += row[b];
  }
  for (int b = 0; b < kWide; ++b) products[b] = total[b];
}

// Squared distance from q to each of sixteen boxes.
EXEMPLAR_MULTIVERSION void boxBounds(const float (*low)[kWide], const float (*high)[kWide],
                                     const float* q, float* bounds) {
  float sum[kWide] = {};
  for (int d = 0; d < kWide; ++d)
    for (int c = 0; c < kWide; ++c) {
      const float below = low[d][c] - q[d], above = q[d] - high[d][c];
      float gap = below > above ? below : above;
      gap = gap > 0 ? gap : 0;
      sum[c] += gap * gap;
    }
  for (int c = 0; c < kWide; ++c) bounds[c] = sum[c];
}

// Squared distance from q to each of sixteen points.
EXEMPLAR_MULTIVERSION void pointBounds(const float (*value)[kWide], const float* q, float* bounds) {
  float sum[kWide] = {};
  for (int d = 0; d < kWide; ++d)
    for (int c = 0; c < kWide; ++c) {
      const float gap = value[d][c] - q[d];
      sum[c] += gap * gap;
    }
  for (int c = 0; c < kWide; ++c) bounds[c] = sum[c];
}

}  // namespace

PatchSet::PatchSet(const Channels& channels, const Vec3i& patch) : patch_(patch) {
  if (channels.empty()) throw InputError("a nearest-neighbour field needs at least one channel");
  size_ = channels[0].size();
  blockPositions(size_, patch);
  if (static_cast<double>(channels.size()) * static_cast<double>(channels[0].count()) > 0x1p31)
    throw InputError("the channels of a nearest-neighbour field have more than 2^31 samples");
  for (const auto& channel : channels) {
    if (channel.size() != size_)
      throw InputError("the channels of a nearest-neighbour field differ in size");
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
    : set_(set), weight_(choice.weight) {
  const Vec3i positions = set.positions();
  std::vector<std::uint32_t> points;
  for (int k = 0; k < positions.z; ++k)
    for (int j = 0; j < positions.y; ++j)
      for (int i = 0; i < positions.x; ++i)
        if (!choice.allowed || (*choice.allowed)(i, j, k)) points.push_back(set.index({i, j, k}));
  if (points.empty()) return;
  lowest_ = points.front();

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
  points_ = std::move(points);
  center_ = set.center();
  norm_ = set.largestNorm(center_);
  std::vector<float> values(points_.size() * kWide);
  parallelFor(0, points_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      set.project(basis_.data(), center_, points_[p], values.data() + p * kWide);
  });
  permutation_.resize(points_.size());
  std::iota(permutation_.begin(), permutation_.end(), 0u);
  split(0, points_.size(), values);
  build(values);
}

void PatchTree::findDirections(std::span<const std::uint32_t> points) {
  // Leading principal components of a sample of the patches, by subspace iteration in double. Any
  // orthonormal directions keep the search exact; good ones make it fast.
  const std::size_t terms = static_cast<std::size_t>(set_.terms());
  const std::size_t count = std::min<std::size_t>(points.size(), 2048);
  const Random random(0, 0x7063);
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
  std::vector<double> basis(terms * kWide), next(terms * kWide);
  for (std::size_t i = 0; i < basis.size(); ++i) basis[i] = random.normal(i);
  const auto orthonormalize = [&](std::vector<double>& m) {
    for (int b = 0; b < kWide; ++b)
      for (int pass = 0; pass < 2; ++pass) {
        for (int a = 0; a < b; ++a) {
          double product = 0;
          for (std::size_t t = 0; t < terms; ++t) product += m[t * kWide + a] * m[t * kWide + b];
          for (std::size_t t = 0; t < terms; ++t) m[t * kWide + b] -= product * m[t * kWide + a];
        }
        double norm = 0;
        for (std::size_t t = 0; t < terms; ++t) norm += m[t * kWide + b] * m[t * kWide + b];
        // More directions than terms or than the patches span: the rest stay zero.
        const double scale = norm > 1e-18 ? 1 / std::sqrt(norm) : 0;
        for (std::size_t t = 0; t < terms; ++t) m[t * kWide + b] *= scale;
      }
  };
  orthonormalize(basis);
  for (int iteration = 0; iteration < 8; ++iteration) {
    std::ranges::fill(next, 0.0);
    for (std::size_t s = 0; s < count; ++s) {
      const double* x = samples.data() + s * terms;
      double products[kWide] = {};
      for (std::size_t t = 0; t < terms; ++t)
        for (int b = 0; b < kWide; ++b) products[b] += x[t] * basis[t * kWide + b];
      for (std::size_t t = 0; t < terms; ++t)
        for (int b = 0; b < kWide; ++b) next[t * kWide + b] += x[t] * products[b];
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

void PatchTree::split(std::size_t begin, std::size_t end, const std::vector<float>& values) {
  if (end - begin <= kWide) {
    std::sort(permutation_.begin() + begin, permutation_.begin() + end);
    return;
  }
  // Leaves hold sixteen points, and aligned groups of 16^k leaves form the nodes, so cut at the
  // largest power of two of leaves that leaves something on the right.
  const std::size_t leaves = (end - begin + kWide - 1) / kWide;
  const std::size_t left = std::bit_ceil(leaves) / 2 * kWide;
  double best = -1;
  int axis = 0;
  for (int d = 0; d < kWide; ++d) {
    double sum = 0, squares = 0;
    for (std::size_t p = begin; p < end; ++p) {
      const double v = values[std::size_t{permutation_[p]} * kWide + d];
      sum += v;
      squares += v * v;
    }
    const double spread = squares - sum * sum / static_cast<double>(end - begin);
    if (spread > best) {
      best = spread;
      axis = d;
    }
  }
  std::nth_element(permutation_.begin() + begin, permutation_.begin() + begin + left,
                   permutation_.begin() + end, [&](std::uint32_t a, std::uint32_t b) {
                     const float va = values[std::size_t{a} * kWide + axis];
                     const float vb = values[std::size_t{b} * kWide + axis];
                     return va != vb ? va < vb : a < b;
                   });
  if (end - begin > 8192)
    tbb::parallel_invoke([&] { split(begin, begin + left, values); },
                         [&] { split(begin + left, end, values); });
  else {
    split(begin, begin + left, values);
    split(begin + left, end, values);
  }
}

void PatchTree::build(const std::vector<float>& values) {
  const std::size_t leaves = (points_.size() + kWide - 1) / kWide;
  leaves_.resize(leaves);
  std::vector<std::uint32_t> sorted(leaves * kWide, std::numeric_limits<std::uint32_t>::max());
  for (std::size_t p = 0; p < leaves * kWide; ++p) {
    const bool there = p < points_.size();
    for (int d = 0; d < kWide; ++d) {
      const float v = there ? values[std::size_t{permutation_[p]} * kWide + d] : kInfinite;
      leaves_[p / kWide].value[d][p % kWide] = v;
    }
    if (there) sorted[p] = points_[permutation_[p]];
  }
  points_ = std::move(sorted);
  permutation_.clear();

  // The boxes of leaves, and then of nodes, sixteen at a time.
  std::size_t below = leaves;
  do {
    const bool overLeaves = levels_.empty();
    std::vector<Node> nodes((below + kWide - 1) / kWide);
    for (std::size_t c = 0; c < nodes.size() * kWide; ++c) {
      Node& node = nodes[c / kWide];
      const std::size_t lane = c % kWide;
      float low[kWide], high[kWide];
      std::ranges::fill(low, kInfinite);
      std::ranges::fill(high, -kInfinite);
      float weight = kInfinite;
      std::uint32_t lowest = std::numeric_limits<std::uint32_t>::max();
      Vec3i first{1 << 30, 1 << 30, 1 << 30}, last{-1, -1, -1};
      for (int i = 0; c < below && i < kWide; ++i) {
        if (overLeaves) {
          const std::uint32_t point = points_[c * kWide + i];
          if (point == std::numeric_limits<std::uint32_t>::max()) continue;
          for (int d = 0; d < kWide; ++d) {
            low[d] = std::min(low[d], leaves_[c].value[d][i]);
            high[d] = std::max(high[d], leaves_[c].value[d][i]);
          }
          weight = std::min(weight, weight_ ? weight_->data()[point] : 1.0f);
          lowest = std::min(lowest, point);
          first = min(first, set_.position(point));
          last = max(last, set_.position(point));
        } else {
          const Node& child = levels_.back()[c];
          for (int d = 0; d < kWide; ++d) {
            low[d] = std::min(low[d], child.low[d][i]);
            high[d] = std::max(high[d], child.high[d][i]);
          }
          weight = std::min(weight, child.weight[i]);
          lowest = std::min(lowest, child.lowest[i]);
          first = min(first, child.first[i]);
          last = max(last, child.last[i]);
        }
      }
      for (int d = 0; d < kWide; ++d) {
        node.low[d][lane] = low[d];
        node.high[d][lane] = high[d];
      }
      node.weight[lane] = weight;
      node.lowest[lane] = lowest;
      node.first[lane] = first;
      node.last[lane] = last;
    }
    below = nodes.size();
    levels_.push_back(std::move(nodes));
  } while (below > 1);
}

void PatchTree::project(const PatchSet& from, std::uint32_t index, float* projection) const {
  from.project(basis_.data(), center_, index, projection);
}

PatchTree::Candidate PatchTree::nearest(const float* gathered, const float* projection,
                                        float queryNorm, const Candidate& start,
                                        const Window* window) const {
  Candidate best = start;
  // How far rounding may carry a projected distance above the true one: sums of rows and of a row's
  // samples, in each direction, of both patches. The sum itself may come out too small by its own
  // rounding.
  const float rows = static_cast<float>(set_.terms()) / static_cast<float>(set_.patch().x);
  const float steps = rows + static_cast<float>(set_.patch().x) + 8;
  const float slack = 4 * steps * kUlp * (norm_ + queryNorm);
  const float relative = 1 + (static_cast<float>(set_.terms()) + 64) * kUlp;
  // Beyond this bound a patch of weight `w` costs more than the best.
  const auto farthest = [&](float w) {
    const float root = std::sqrt(best.cost / w * relative) + slack;
    return root * root * 1.00001f;
  };
  float limit = farthest(1);
  const auto hopeless = [&](float bound, float w, std::uint32_t lowest) {
    if (bound > (weight_ ? farthest(w) : limit)) return true;
    return best.cost == 0 && lowest > best.index;
  };

  struct Open {
    float bound;
    int level;
    std::uint32_t node;
    float weight;
    std::uint32_t lowest;
  };
  Open stack[kWide * 9];
  int open = 0;
  stack[open++] = {0, static_cast<int>(levels_.size()) - 1, 0, 0, 0};
  if (weight_)
    stack[0].weight = *std::min_element(levels_.back()[0].weight, levels_.back()[0].weight + kWide);
  else
    stack[0].weight = 1;
  while (open > 0) {
    const Open at = stack[--open];
    if (hopeless(at.bound, at.weight, at.lowest)) continue;
    float bounds[kWide];
    int order[kWide], count = 0;
    const auto insert = [&](int child) {
      int i = count++;
      for (; i > 0 && bounds[order[i - 1]] > bounds[child]; --i) order[i] = order[i - 1];
      order[i] = child;
    };
    if (at.level < 0) {
      pointBounds(leaves_[at.node].value, projection, bounds);
      const std::uint32_t* points = points_.data() + std::size_t{at.node} * kWide;
      for (int c = 0; c < kWide; ++c)
        if (bounds[c] < kInfinite && !hopeless(bounds[c], weight_ ? at.weight : 1, points[c]))
          insert(c);
      for (int o = 0; o < count; ++o) {
        const std::uint32_t point = points[order[o]];
        const float w = weight_ ? weight_->data()[point] : 1;
        if (hopeless(bounds[order[o]], w, point)) continue;
        if (window) {
          const Vec3i p = set_.position(point);
          if (max(p, window->first) != p || min(p, window->last) != p) continue;
        }
        const float sum = set_.sum(gathered, point, best.cost / w * relative);
        const Candidate candidate{w * sum, point, sum};
        if (candidate.before(best)) {
          best = candidate;
          limit = farthest(1);
        }
      }
      continue;
    }
    const Node& node = levels_[at.level][at.node];
    boxBounds(node.low, node.high, projection, bounds);
    for (int c = 0; c < kWide; ++c) {
      if (!(bounds[c] < kInfinite) || hopeless(bounds[c], node.weight[c], node.lowest[c])) continue;
      if (window && (max(node.last[c], window->first) != node.last[c] ||
                     min(node.first[c], window->last) != node.first[c]))
        continue;
      insert(c);
    }
    while (count > 0) {
      const int c = order[--count];
      stack[open++] = {bounds[c], at.level - 1, at.node * kWide + static_cast<std::uint32_t>(c),
                       node.weight[c], node.lowest[c]};
    }
  }
  return best;
}

}  // namespace exemplar
