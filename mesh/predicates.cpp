// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/predicates.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace exemplar {
namespace {

/// A number as the exact sum of doubles that do not overlap, the smallest first. `N` is the most
/// there can be.
template <int N>
struct Expansion {
  std::array<double, N> terms;
  int count = 0;

  void add(double term) {
    if (term != 0) terms[count++] = term;
  }
  std::span<const double> values() const { return {terms.data(), static_cast<std::size_t>(count)}; }
};

/// a + b as a rounded sum and its exact error (Shewchuk, theorem 7).
void twoSum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double bRounded = sum - a, aRounded = sum - bRounded;
  error = (a - aRounded) + (b - bRounded);
}

/// Half of a double's digits, rounded (Shewchuk, theorem 17).
void split(double a, double& high, double& low) {
  const double c = 134217729.0 * a;  // 2^27 + 1
  high = c - (c - a);
  low = a - high;
}

/// a * b as a rounded product and its exact error (Shewchuk, theorem 18).
void twoProduct(double a, double b, double& product, double& error) {
  product = a * b;
  double aHigh, aLow, bHigh, bLow;
  split(a, aHigh, aLow);
  split(b, bHigh, bLow);
  error = aLow * bLow - (((product - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow);
}

Expansion<2> difference(double a, double b) {
  Expansion<2> d;
  double sum, error;
  twoSum(a, -b, sum, error);
  d.add(error);
  d.add(sum);
  return d;
}

/// `to` += `term` (Shewchuk, theorem 10).
template <int N>
void grow(Expansion<N>& to, double term) {
  double sum = term;
  int kept = 0;
  for (int i = 0; i < to.count; ++i) {
    double error;
    twoSum(sum, to.terms[i], sum, error);
    if (error != 0) to.terms[kept++] = error;
  }
  if (sum != 0) to.terms[kept++] = sum;
  to.count = kept;
}

template <int M, int N>
Expansion<2 * M * N> product(const Expansion<M>& a, const Expansion<N>& b) {
  Expansion<2 * M * N> p;
  for (const double x : a.values()) {
    for (const double y : b.values()) {
      double high, low;
      twoProduct(x, y, high, low);
      grow(p, low);
      grow(p, high);
    }
  }
  return p;
}

template <int M, int N>
Expansion<M + N> sum(const Expansion<M>& a, const Expansion<N>& b, double sign) {
  Expansion<M + N> s;
  for (const double x : a.values()) s.add(x);
  for (const double y : b.values()) grow(s, sign * y);
  return s;
}

int signOf(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

int exactOrientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const auto minor = [&](const Vec3d& p, const Vec3d& q) {
    return sum(product(difference(p.x, d.x), difference(q.y, d.y)),
               product(difference(q.x, d.x), difference(p.y, d.y)), -1);
  };
  const auto whole = sum(sum(product(minor(b, c), difference(a.z, d.z)),
                             product(minor(c, a), difference(b.z, d.z)), 1),
                         product(minor(a, b), difference(c.z, d.z)), 1);
  // The largest term comes last and outweighs all others.
  return whole.count == 0 ? 0 : signOf(whole.terms[whole.count - 1]);
}

/// Turns a triangle so that its first corner is alone on its side of a plane. `side` are the
/// corners' sides, of which one is 1 and one is -1; they turn along.
void putLoneCornerFirst(std::array<const Vec3d*, 3>& corner, std::array<int, 3>& side) {
  const auto isAlone = [&](int i) {
    return side[i] != 0 && side[(i + 1) % 3] != side[i] && side[(i + 2) % 3] != side[i];
  };
  const int lone = isAlone(0) ? 0 : isAlone(1) ? 1 : 2;
  std::rotate(corner.begin(), corner.begin() + lone, corner.end());
  std::rotate(side.begin(), side.begin() + lone, side.end());
}

bool isOnBothSides(const std::array<int, 3>& side) {
  return std::max({side[0], side[1], side[2]}) == 1 && std::min({side[0], side[1], side[2]}) == -1;
}

}  // namespace

int orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const Vec3d ad = a - d, bd = b - d, cd = c - d;
  const double bc = bd.x * cd.y, cb = cd.x * bd.y;
  const double ca = cd.x * ad.y, ac = ad.x * cd.y;
  const double ab = ad.x * bd.y, ba = bd.x * ad.y;
  const double determinant = ad.z * (bc - cb) + bd.z * (ca - ac) + cd.z * (ab - ba);
  const double permanent = (std::abs(bc) + std::abs(cb)) * std::abs(ad.z) +
                           (std::abs(ca) + std::abs(ac)) * std::abs(bd.z) +
                           (std::abs(ab) + std::abs(ba)) * std::abs(cd.z);
  constexpr double kEpsilon = 0x1p-53;
  constexpr double kBound = (7 + 56 * kEpsilon) * kEpsilon;  // Shewchuk's o3derrboundA
  // His determinant is positive where d lies below a, b, c as seen from their counterclockwise
  // side.
  if (std::abs(determinant) > kBound * permanent) return -signOf(determinant);
  return -exactOrientation(a, b, c, d);
}

// P. Guigue, O. Devillers: "Fast and robust triangle-triangle overlap test using orientation
// predicates", Journal of Graphics Tools 8(1), 2003, doi:10.1080/10867651.2003.10487580. Both
// triangles cut the line that their planes have in common; they cross where the two pieces overlap.
// What differs: a corner on the other's plane does not make a triangle lie on both sides of it, and
// pieces that have only an end in common do not overlap.
bool trianglesCross(const Vec3d (&first)[3], const Vec3d (&second)[3]) {
  std::array<int, 3> side1, side2;
  for (int i = 0; i < 3; ++i) side1[i] = orientation(second[0], second[1], second[2], first[i]);
  if (!isOnBothSides(side1)) return false;
  for (int i = 0; i < 3; ++i) side2[i] = orientation(first[0], first[1], first[2], second[i]);
  if (!isOnBothSides(side2)) return false;
  std::array<const Vec3d*, 3> t1{&first[0], &first[1], &first[2]};
  std::array<const Vec3d*, 3> t2{&second[0], &second[1], &second[2]};
  putLoneCornerFirst(t1, side1);
  putLoneCornerFirst(t2, side2);
  if (side1[0] < 0) std::swap(t2[1], t2[2]);
  if (side2[0] < 0) std::swap(t1[1], t1[2]);
  return orientation(*t1[0], *t1[1], *t2[0], *t2[1]) < 0 &&
         orientation(*t1[0], *t1[2], *t2[2], *t2[0]) < 0;
}

}  // namespace exemplar
