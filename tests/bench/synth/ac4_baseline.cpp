// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "ac4_baseline.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/random.h"

namespace exemplar::bench {
namespace {

class Ac4 {
 public:
  Ac4(const Adjacency& adjacency, const Vec3i& size) : labels_(adjacency.labelCount), size_(size) {
    for (int d = 0; d < 6; ++d) supported_[d].resize(labels_);
    for (int axis = 0; axis < 3; ++axis) {
      for (const LabelPair& p : adjacency.rules[axis].pairs) {
        supported_[2 * axis][p.first].push_back(p.second);
        supported_[2 * axis + 1][p.second].push_back(p.first);
      }
    }
    const std::size_t cells = static_cast<std::size_t>(volume(size));
    possible_.assign(cells * labels_, 1);
    left_.assign(cells, labels_);
    counters_.resize(cells * labels_ * 6);
    // A label's supports at a neighbor are what lists it as supported from there.
    for (std::size_t c = 0; c < cells; ++c) {
      for (int b = 0; b < labels_; ++b) {
        for (int d = 0; d < 6; ++d) {
          counters_[(c * labels_ + b) * 6 + d] =
              static_cast<std::uint16_t>(supported_[d][b].size());
        }
      }
    }
  }

  bool run(const Adjacency& adjacency, std::uint64_t seed) {
    const Random random(seed, 4);
    for (int x = 0; x < size_.x; ++x) {
      for (int y = 0; y < size_.y; ++y) {
        for (int z = 0; z < size_.z; ++z) {
          const Vec3i p{x, y, z};
          for (int b = 0; b < labels_; ++b) {
            bool keep = adjacency.frequency[b] > 0;
            for (int s = 4; s < 6; ++s) {
              const auto& side = adjacency.sides[s];
              if (z == (s == 4 ? 0 : size_.z - 1)) {
                keep = keep && std::binary_search(side.begin(), side.end(), b);
              }
            }
            for (int d = 0; d < 6; ++d) {
              const bool inside = contains(p + step(d));
              keep = keep && (!inside || !supported_[d][b].empty());
            }
            if (!keep && !ban(cell(p), b)) return false;
          }
        }
      }
    }
    if (!propagate()) return false;
    for (int x = 0; x < size_.x; ++x) {
      for (int y = 0; y < size_.y; ++y) {
        for (int z = 0; z < size_.z; ++z) {
          const std::size_t c = cell({x, y, z});
          int skip = static_cast<int>(random.below(left_[c], c));
          int chosen = 0;
          for (int b = 0; b < labels_; ++b) {
            if (possible_[c * labels_ + b] && skip-- == 0) chosen = b;
          }
          for (int b = 0; b < labels_; ++b) {
            if (b != chosen && possible_[c * labels_ + b] && !ban(c, b)) return false;
          }
          if (!propagate()) return false;
        }
      }
    }
    return true;
  }

  std::uint64_t bytes() const {
    return possible_.size() + 4 * left_.size() + 2 * counters_.size() +
           sizeof(removed_[0]) * removed_.capacity();
  }

 private:
  static Vec3i step(int d) {
    Vec3i v;
    v[d / 2] = d % 2 ? -1 : 1;
    return v;
  }
  bool contains(const Vec3i& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < size_.x && p.y < size_.y && p.z < size_.z;
  }
  std::size_t cell(const Vec3i& p) const {
    return (static_cast<std::size_t>(p.x) * size_.y + p.y) * size_.z + p.z;
  }
  bool ban(std::size_t c, int b) {
    if (!possible_[c * labels_ + b]) return true;
    possible_[c * labels_ + b] = 0;
    removed_.push_back({static_cast<std::int32_t>(c), b});
    return --left_[c] > 0;
  }
  bool propagate() {
    while (!removed_.empty()) {
      const auto [c, b] = removed_.back();
      removed_.pop_back();
      const int z = c % size_.z, y = c / size_.z % size_.y, x = c / (size_.y * size_.z);
      for (int d = 0; d < 6; ++d) {
        const Vec3i q = Vec3i{x, y, z} + step(d);
        if (!contains(q)) continue;
        const std::size_t far = cell(q);
        for (const Label l : supported_[d][b]) {
          std::uint16_t& counter = counters_[(far * labels_ + l) * 6 + (d ^ 1)];
          if (--counter == 0 && !ban(far, l)) return false;
        }
      }
    }
    return true;
  }

  int labels_;
  Vec3i size_;
  std::array<std::vector<std::vector<Label>>, 6> supported_;
  std::vector<std::uint8_t> possible_;
  std::vector<int> left_;
  std::vector<std::uint16_t> counters_;
  struct Removal {
    std::int32_t cell;
    int label;
  };
  std::vector<Removal> removed_;
};

}  // namespace

Ac4Result synthesizeByAc4(const Adjacency& adjacency, const Vec3i& size, std::uint64_t seed) {
  Ac4 ac4(adjacency, size);
  const bool complete = ac4.run(adjacency, seed);
  return {complete, ac4.bytes()};
}

}  // namespace exemplar::bench
