// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/quilting/repetition.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/parallel.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// How far steps are looked at, and basis vectors may reach, of the example's length.
constexpr double kFarthest = 0.7, kLongest = 0.6;
/// Steps shorter than this along all axes are no repetition, samples.
constexpr int kShortest = 3;
/// Differences count up to here, samples.
constexpr float kLimit = 2;
/// About how many samples near the surface are compared, and how many must be.
constexpr std::size_t kCompared = 1024, kFewest = 100;
/// A step repeats the example if it is less unlike than this, of the median of all steps; and the
/// combinations of such steps must be, by so large a share, less unlike than that.
constexpr double kRepeats = 0.45, kCombination = 0.65, kShare = 0.8;
/// Half a basis vector is more unlike than a whole by this much of the median: where the example
/// only continues, as a bar does along itself, no step repeats it.
constexpr double kContrast = 0.2;
/// Steps this much more unlike than their neighbors, of the median, are minima too: of those that
/// are all alike the shortest should be found.
constexpr double kAlike = 0.01;
/// The least volume of the unit vectors along a basis: no two are nearly parallel.
constexpr double kIndependent = 0.3;
/// Combinations of basis vectors have coefficients up to here.
constexpr int kCoefficient = 6;
/// A vector is along an axis if no larger share of it is aside.
constexpr double kAside = 0.1;

/// How unlike an example is to itself after each step.
class Unlikeness {
 public:
  explicit Unlikeness(const Array3D<float>& values) {
    const Vec3i n = values.size();
    for (int axis = 0; axis < 3; ++axis) reach_[axis] = static_cast<int>(n[axis] * kFarthest);
    std::vector<Vec3i> surface;
    for (std::size_t s = 0; s < values.count(); ++s) {
      if (std::abs(values.values()[s]) < 1) surface.push_back(values.ijk(s));
    }
    if (surface.size() < kFewest) return;
    const std::size_t every = (surface.size() + kCompared - 1) / kCompared;
    std::vector<Vec3i> some;
    for (std::size_t s = every / 2; s < surface.size(); s += every) some.push_back(surface[s]);

    table_ = Array3D<float>(reach_ * 2 + Vec3i{1, 1, 1}, kUnknown);
    // A step and its opposite compare the same samples: half of the table gives the other half.
    const std::size_t half = table_.count() / 2 + 1;
    parallelFor(0, half, 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const Vec3i step = table_.ijk(t) - reach_;
        double sum = 0;
        std::size_t count = 0;
        for (const Vec3i& p : some) {
          const Vec3i q = p + step;
          if (!values.contains(q)) continue;
          sum += std::abs(std::clamp(values[q], -kLimit, kLimit) - values[p]);
          ++count;
        }
        if (count >= kFewest / 2) table_.values()[t] = static_cast<float>(sum / count);
      }
    });
    for (std::size_t t = 0; t < half; ++t)
      table_.values()[table_.count() - 1 - t] = table_.values()[t];
    std::vector<float> known;
    for (std::size_t t = 0; t < table_.count(); ++t) {
      const float v = table_.values()[t];
      if (v < kUnknown && longestOf(table_.ijk(t) - reach_) >= kShortest) known.push_back(v);
    }
    if (known.empty()) return;
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    median_ = *middle;
  }

  double median() const { return median_; }
  bool knows(const Vec3i& step) const {
    return table_.contains(step + reach_) && table_[step + reach_] < kUnknown;
  }
  double at(const Vec3i& step) const { return table_[step + reach_]; }

  /// The least unlike step within a sample of this one.
  std::optional<Vec3i> leastNear(const Vec3d& step) const {
    std::optional<Vec3i> best;
    const Vec3i middle = rounded(step);
    for (int n = 0; n < 27; ++n) {
      const Vec3i near = middle + Vec3i{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      if (knows(near) && (!best || at(near) < at(*best))) best = near;
    }
    return best;
  }

  /// The steps that repeat the example, one of each pair of opposites, the shortest first.
  std::vector<Vec3i> repeats() const {
    std::vector<Vec3i> steps;
    for (std::size_t t = 0; t < table_.count(); ++t) {
      const Vec3i step = table_.ijk(t) - reach_;
      const bool half = step.x > 0 || (step.x == 0 && (step.y > 0 || (step.y == 0 && step.z > 0)));
      if (!half || longestOf(step) < kShortest || !knows(step)) continue;
      const std::optional<Vec3i> least = leastNear(cast<double>(step));
      if (at(step) < kRepeats * median_ && at(step) <= at(*least) + kAlike * median_) {
        steps.push_back(step);
      }
    }
    std::stable_sort(steps.begin(), steps.end(),
                     [](const Vec3i& a, const Vec3i& b) { return dot(a, a) < dot(b, b); });
    return steps;
  }

  /// A step's place between samples along each axis: where straight lines of equal slope through
  /// the neighbors meet.
  Vec3d between(const Vec3i& step) const {
    Vec3d place = cast<double>(step);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3i one{};
      one[axis] = 1;
      if (!knows(step - one) || !knows(step + one)) continue;
      const double before = at(step - one), here = at(step), after = at(step + one);
      const double rise = std::max(before, after) - here;
      if (rise > 0) place[axis] += std::clamp((before - after) / (2 * rise), -0.5, 0.5);
    }
    return place;
  }

  static Vec3i rounded(const Vec3d& v) {
    return {static_cast<int>(std::lround(v.x)), static_cast<int>(std::lround(v.y)),
            static_cast<int>(std::lround(v.z))};
  }
  static int longestOf(const Vec3i& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  }

 private:
  static constexpr float kUnknown = std::numeric_limits<float>::max();

  Vec3i reach_;
  Array3D<float> table_;  // of steps from -reach_ to reach_
  double median_ = 0;
};

/// A vector's coefficients along the basis, of the point of its span that is nearest.
std::vector<double> coefficients(const std::vector<Vec3d>& basis, const Vec3d& v) {
  // The normal equations, by elimination: the Gram matrix of independent vectors needs no pivots.
  const std::size_t n = basis.size();
  double m[3][4] = {};
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < n; ++c) m[r][c] = dot(basis[r], basis[c]);
    m[r][3] = dot(basis[r], v);
  }
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t r = p + 1; r < n; ++r) {
      const double factor = m[r][p] / m[p][p];
      for (std::size_t c = p; c < n; ++c) m[r][c] -= factor * m[p][c];
      m[r][3] -= factor * m[p][3];
    }
  }
  std::vector<double> found(n);
  for (std::size_t r = n; r-- > 0;) {
    double rest = m[r][3];
    for (std::size_t c = r + 1; c < n; ++c) rest -= m[r][c] * found[c];
    found[r] = rest / m[r][r];
  }
  return found;
}

bool independent(const std::vector<Vec3d>& basis) {
  const auto unit = [&](std::size_t n) { return normalized(basis[n]); };
  if (basis.size() < 2) return true;
  const Vec3d normal = cross(unit(0), unit(1));
  if (basis.size() == 2) return length(normal) >= kIndependent;
  return std::abs(dot(normal, unit(2))) >= kIndependent;
}

/// Calls `body` for all combinations of a basis but 0 that are known, with their coefficients.
template <class Body>
void forCombinations(const Unlikeness& unlikeness, const std::vector<Vec3d>& basis,
                     const Body& body) {
  constexpr int kSide = 2 * kCoefficient + 1;
  const std::size_t rank = basis.size();
  for (int n = 0; n < kSide * kSide * kSide; ++n) {
    const Vec3i c = Vec3i{n % kSide, n / kSide % kSide, n / kSide / kSide} -
                    Vec3i{kCoefficient, kCoefficient, kCoefficient};
    if (c == Vec3i{0, 0, 0} || (rank < 2 && c.y != 0) || (rank < 3 && c.z != 0)) continue;
    Vec3d step{};
    for (std::size_t b = 0; b < rank; ++b) step += basis[b] * c[static_cast<int>(b)];
    if (unlikeness.knows(Unlikeness::rounded(step))) body(step, c);
  }
}

bool combinationsRepeat(const Unlikeness& unlikeness, const std::vector<Vec3d>& basis) {
  int all = 0, repeat = 0;
  forCombinations(unlikeness, basis, [&](const Vec3d& step, const Vec3i&) {
    const std::optional<Vec3i> least = unlikeness.leastNear(step);
    ++all;
    repeat += least && unlikeness.at(*least) < kCombination * unlikeness.median();
  });
  // A step and its opposite alone are no evidence.
  return all > 2 && repeat >= kShare * all;
}

/// Whether half of this step does not repeat the example, nor half of what is left of it after one
/// of the basis.
bool isBasic(const Unlikeness& unlikeness, const std::vector<Vec3d>& basis, const Vec3i& step) {
  std::vector<Vec3i> rest{step};
  forCombinations(unlikeness, basis, [&](const Vec3d& known, const Vec3i& c) {
    if (Unlikeness::longestOf(c) == 1) rest.push_back(step - Unlikeness::rounded(known));
  });
  return std::ranges::all_of(rest, [&](const Vec3i& r) {
    if (Unlikeness::longestOf(r) < kShortest) return false;
    const Vec3i half = Unlikeness::rounded(cast<double>(r) * 0.5);
    if (!unlikeness.knows(r) || !unlikeness.knows(half)) return true;
    return unlikeness.at(half) > unlikeness.at(r) + kContrast * unlikeness.median();
  });
}

/// A basis vector's place between samples, from the longest of its multiples that is known.
Vec3d refined(const Unlikeness& unlikeness, const Vec3i& vector) {
  Vec3d place = unlikeness.between(vector);
  for (int multiple = 2; multiple <= kCoefficient; ++multiple) {
    const Vec3d step = place * static_cast<double>(multiple);
    if (!unlikeness.knows(Unlikeness::rounded(step))) break;
    const std::optional<Vec3i> least = unlikeness.leastNear(step);
    if (!least) break;
    place = unlikeness.between(*least) / static_cast<double>(multiple);
  }
  return place;
}

}  // namespace

Vec3d Repetition::off(const Vec3i& step) const {
  const std::vector<double> c = coefficients(basis, cast<double>(step));
  Vec3d off{};
  for (std::size_t b = 0; b < basis.size(); ++b) off += basis[b] * (c[b] - std::round(c[b]));
  return off;
}

bool Repetition::holds(const Vec3i& step, double tolerance) const {
  const Vec3d by = off(step);
  return std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)}) <= tolerance;
}

Vec3i Repetition::nearest(const Vec3i& step) const {
  return Unlikeness::rounded(cast<double>(step) - off(step));
}

Repetition Repetition::refined(double factor) const {
  Repetition finer = *this;
  for (Vec3d& v : finer.basis) v *= factor;
  return finer;
}

double Repetition::periodAlong(int axis) const {
  double period = 0;
  for (const Vec3d& v : basis) {
    const double along = std::abs(v[axis]), all = length(v);
    if (along < kAside * all) continue;
    if (period > 0 || all * all - along * along > kAside * kAside * all * all) return 0;
    period = along;
  }
  return period;
}

bool Repetition::stretch(int axis, int length, int apart, double tolerance) {
  const double period = periodAlong(axis);
  if (period == 0) return false;
  const double stretched = length / std::max(1.0, std::round(length / period));
  if (std::abs(stretched / period - 1) * apart > tolerance) return false;
  for (Vec3d& v : basis) v[axis] *= stretched / period;
  return true;
}

Vec3i Repetition::cell() const {
  Vec3i cell{0, 0, 0};
  for (const Vec3d& v : basis) {
    for (int axis = 0; axis < 3; ++axis) {
      // A hundredth of a sample is not another sample.
      cell[axis] = std::max(cell[axis], static_cast<int>(std::ceil(std::abs(v[axis]) - 0.01)));
    }
  }
  return cell;
}

Repetition findRepetition(const Array3D<float>& values) {
  const Unlikeness unlikeness(values);
  Repetition found;
  if (unlikeness.median() == 0) return found;
  const Vec3i n = values.size();
  for (const Vec3i& step : unlikeness.repeats()) {
    if (found.basis.size() == 3) break;
    bool longest = false;
    for (int axis = 0; axis < 3; ++axis) longest |= std::abs(step[axis]) > kLongest * n[axis];
    if (longest) continue;
    if (!isBasic(unlikeness, found.basis, step)) continue;
    std::vector<Vec3d> basis = found.basis;
    basis.push_back(refined(unlikeness, step));
    if (!independent(basis) || !combinationsRepeat(unlikeness, basis)) continue;
    found.basis = std::move(basis);
  }
  return found;
}

}  // namespace exemplar
