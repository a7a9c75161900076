// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <utility>

#include "core/huge_pages.h"
#include "core/vec.h"

namespace exemplar {

/// A dense box of samples, x fastest: sample `ijk` is at `(k * size.y + j) * size.x + i`.
template <class T>
class Array3D {
 public:
  Array3D() = default;
  explicit Array3D(const Vec3i& size, const T& value = T{})
      : size_(size), data_(static_cast<std::size_t>(volume(size)), value) {}
  /// Of values in the samples' order, as many as there are samples: `filled` (core/stoppable.h)
  /// makes gigabytes of them.
  static Array3D of(const Vec3i& size, HugeVector<T> values) {
    assert(values.size() == static_cast<std::size_t>(volume(size)));
    Array3D array;
    array.size_ = size;
    array.data_ = std::move(values);
    return array;
  }

  const Vec3i& size() const { return size_; }
  std::size_t count() const { return data_.size(); }
  bool empty() const { return data_.empty(); }

  std::size_t index(int i, int j, int k) const {
    assert(contains({i, j, k}));
    return (static_cast<std::size_t>(k) * size_.y + j) * size_.x + i;
  }
  std::size_t index(const Vec3i& ijk) const { return index(ijk.x, ijk.y, ijk.z); }
  /// The inverse of `index`.
  Vec3i ijk(std::size_t index) const {
    const std::size_t nx = size_.x, ny = size_.y;
    return {static_cast<int>(index % nx), static_cast<int>(index / nx % ny),
            static_cast<int>(index / (nx * ny))};
  }
  bool contains(const Vec3i& p) const {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < size_.x && p.y < size_.y && p.z < size_.z;
  }
  /// `ijk` moved to the nearest sample inside the box.
  Vec3i clamped(const Vec3i& ijk) const {
    return max(Vec3i{0, 0, 0}, min(ijk, size_ - Vec3i{1, 1, 1}));
  }

  T& operator()(int i, int j, int k) { return data_[index(i, j, k)]; }
  const T& operator()(int i, int j, int k) const { return data_[index(i, j, k)]; }
  T& operator[](const Vec3i& ijk) { return data_[index(ijk)]; }
  const T& operator[](const Vec3i& ijk) const { return data_[index(ijk)]; }

  std::span<T> values() { return data_; }
  std::span<const T> values() const { return data_; }
  T* data() { return data_.data(); }
  const T* data() const { return data_.data(); }

  bool operator==(const Array3D&) const = default;

 private:
  Vec3i size_{};
  HugeVector<T> data_;
};

}  // namespace exemplar
