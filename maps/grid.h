// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace exemplar {

/// A dense rectangle of values, x fastest, rows from the top: the value at (x, y) has index
/// `y * width + x`.
template <class T>
class Grid {
 public:
  Grid() = default;
  Grid(int width, int height, const T& value = T{})
      : width_(width), height_(height), data_(static_cast<std::size_t>(width) * height, value) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t count() const { return data_.size(); }
  bool empty() const { return data_.empty(); }

  std::size_t index(int x, int y) const {
    assert(contains(x, y));
    return static_cast<std::size_t>(y) * width_ + x;
  }
  /// The index of a place on the torus; any x and y.
  std::size_t wrapped(int x, int y) const {
    x %= width_;
    y %= height_;
    return index(x < 0 ? x + width_ : x, y < 0 ? y + height_ : y);
  }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  template <class U>
  bool sameSize(const Grid<U>& other) const {
    return width_ == other.width() && height_ == other.height();
  }

  T& operator()(int x, int y) { return data_[index(x, y)]; }
  const T& operator()(int x, int y) const { return data_[index(x, y)]; }
  T& operator[](std::size_t index) { return data_[index]; }
  const T& operator[](std::size_t index) const { return data_[index]; }

  std::span<T> values() { return data_; }
  std::span<const T> values() const { return data_; }

  bool operator==(const Grid&) const = default;

 private:
  int width_ = 0, height_ = 0;
  std::vector<T> data_;
};

/// A place in a grid.
struct Pixel {
  int x = 0, y = 0;
  bool operator==(const Pixel&) const = default;
};

}  // namespace exemplar
