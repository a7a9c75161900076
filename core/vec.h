// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace exemplar {

/// Three numbers: a point or direction in world space (`Vec3d`, `Vec3f`), or an integer index `ijk`
/// or a size in samples (`Vec3i`). World space is right-handed with z up.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr const T& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  constexpr bool operator==(const Vec3&) const = default;

  constexpr Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
  constexpr Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
  constexpr Vec3& operator*=(T s) { return *this = *this * s; }

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {T(a.x + b.x), T(a.y + b.y), T(a.z + b.z)};
  }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {T(a.x - b.x), T(a.y - b.y), T(a.z - b.z)};
  }
  friend constexpr Vec3 operator-(const Vec3& a) { return {T(-a.x), T(-a.y), T(-a.z)}; }
  friend constexpr Vec3 operator*(const Vec3& a, T s) { return {T(a.x * s), T(a.y * s), T(a.z * s)}; }
  friend constexpr Vec3 operator*(T s, const Vec3& a) { return a * s; }
  friend constexpr Vec3 operator/(const Vec3& a, T s) { return {T(a.x / s), T(a.y / s), T(a.z / s)}; }
};

using Vec3d = Vec3<double>;
using Vec3f = Vec3<float>;
using Vec3i = Vec3<int>;

/// Texture coordinates.
struct Vec2f {
  float x{}, y{};
  constexpr bool operator==(const Vec2f&) const = default;
};

template <class To, class From>
constexpr Vec3<To> cast(const Vec3<From>& a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}

/// `a` scaled to length 1; the zero vector stays zero.
template <class T>
Vec3<T> normalized(const Vec3<T>& a) {
  const T l = length(a);
  return l > T(0) ? a / l : a;
}

/// The component-wise minimum, maximum and product.
template <class T>
constexpr Vec3<T> min(const Vec3<T>& a, const Vec3<T>& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <class T>
constexpr Vec3<T> max(const Vec3<T>& a, const Vec3<T>& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
template <class T>
constexpr Vec3<T> scaled(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

template <class T>
bool isFinite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The number of samples in a box of `size`; 64-bit, so that it cannot wrap.
constexpr std::int64_t volume(const Vec3i& size) {
  return std::int64_t{size.x} * size.y * size.z;
}

/// An axis-aligned box in world space; empty (`min > max`) until something is added.
struct Box3d {
  Vec3d min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Vec3d max{-min};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  Vec3d size() const { return empty() ? Vec3d{} : max - min; }
  Vec3d center() const { return (min + max) * 0.5; }
  void add(const Vec3d& p) {
    min = exemplar::min(min, p);
    max = exemplar::max(max, p);
  }
  bool contains(const Vec3d& p) const {
    return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y &&
           p.z <= max.z;
  }
};

}  // namespace exemplar
