// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "maps/distance_transform.h"

#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// The lower envelope of the parabolas (x - q)² + values[q], at every x of one line.
class Envelope {
 public:
  /// `values` becomes the envelope.
  void apply(std::vector<double>& values) {
    const auto n = static_cast<int>(values.size());
    roots_.clear();
    from_.clear();
    for (int q = 0; q < n; ++q) {
      if (values[static_cast<std::size_t>(q)] == kFar) continue;
      double from = -kFar;
      while (!roots_.empty() && (from = meeting(values, roots_.back(), q)) <= from_.back()) {
        roots_.pop_back();
        from_.pop_back();
        from = -kFar;
      }
      roots_.push_back(q);
      from_.push_back(from);
    }
    if (roots_.empty()) return;
    result_.resize(values.size());
    std::size_t k = 0;
    for (int x = 0; x < n; ++x) {
      while (k + 1 < roots_.size() && from_[k + 1] < x) ++k;
      const double step = x - roots_[k];
      result_[static_cast<std::size_t>(x)] =
          step * step + values[static_cast<std::size_t>(roots_[k])];
    }
    values = result_;
  }

 private:
  static double meeting(const std::vector<double>& values, int a, int b) {
    const double fa = values[static_cast<std::size_t>(a)] + static_cast<double>(a) * a;
    const double fb = values[static_cast<std::size_t>(b)] + static_cast<double>(b) * b;
    return (fb - fa) / (2.0 * (b - a));
  }

  std::vector<int> roots_;
  std::vector<double> from_, result_;
};

/// Applies the envelope to a line of `n` values; on a circle, to three turns of it.
void applyToLine(Envelope& envelope, std::vector<double>& line, bool wraps) {
  if (!wraps) return envelope.apply(line);
  const std::size_t n = line.size();
  std::vector<double> thrice;
  for (int turn = 0; turn < 3; ++turn) thrice.insert(thrice.end(), line.begin(), line.end());
  envelope.apply(thrice);
  for (std::size_t x = 0; x < n; ++x) line[x] = thrice[n + x];
}

}  // namespace

Array3D<float> distanceTo(const Shape& shape, bool wraps) {
  const Vec3i& size = shape.size();
  Array3D<double> squared(size);
  for (std::size_t p = 0; p < shape.count(); ++p) squared.data()[p] = shape.data()[p] ? 0 : kFar;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = size[axis];
    if (n == 1) continue;
    const Vec3i along{axis == 0, axis == 1, axis == 2};
    Vec3i lines = size;
    lines[axis] = 1;
    const Array3D<std::uint8_t> starts(lines);
    parallelFor(0, starts.count(), 32, [&](std::size_t first, std::size_t last) {
      Envelope envelope;
      std::vector<double> line(static_cast<std::size_t>(n));
      for (std::size_t l = first; l < last; ++l) {
        const Vec3i start = starts.ijk(l);
        for (int x = 0; x < n; ++x) line[static_cast<std::size_t>(x)] = squared[start + along * x];
        applyToLine(envelope, line, wraps);
        for (int x = 0; x < n; ++x) squared[start + along * x] = line[static_cast<std::size_t>(x)];
      }
    });
  }
  Array3D<float> distance(size);
  for (std::size_t p = 0; p < shape.count(); ++p)
    distance.data()[p] = static_cast<float>(std::sqrt(squared.data()[p]));
  return distance;
}

}  // namespace exemplar
