// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/slice_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/array3d.h"
#include "core/parallel.h"
#include "core/random.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// What a joint costs that fits, and what it costs besides that it does not.
constexpr double kJoint = 0.5, kMisfit = 12;
/// Joints are at least this far apart, slices, or a share of the example.
constexpr int kShortestRun = 6;
constexpr double kRun = 1.0 / 12;
/// Paths that are longer pay this for each slice that is used more often than is needed, and this
/// often the price of the slices that are is raised.
constexpr double kOveruse = 0.15;
constexpr int kRaises = 5;
/// Parts are repeated only where a slice is at least so much of the mean: copies that touch with
/// their ends are not one object.
constexpr double kThinnest = 0.4;
/// Joints of one seed are up to this much dearer than those of another.
constexpr double kNoise = 0.8;
/// What it costs to stretch a prism, beside 1 for what faces along the axis; by so much what
/// stretches is dearer or cheaper at random.
constexpr double kStiffness = 0.3;
constexpr double kStretchNoise = 0.4;
/// What is random: the modes of where parts move, and the price of joints.
constexpr std::uint32_t kMode = 0, kPrice = 1;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Whether there may be a joint before which `usual` is replaced by `next`.
bool mayJoin(const SliceDocking& docking, int usual, int next) {
  const int begin = docking.solidBegin() + 1, end = docking.solidEnd();
  return usual >= begin && usual < end && next >= begin && next < end;
}

int shortestRun(const SliceDocking& docking) {
  const int solid = docking.solidEnd() - docking.solidBegin();
  return std::max(2, std::min(kShortestRun, static_cast<int>(solid * kRun) + 1));
}

void judge(const SliceDocking& docking, SlicePath& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.source.size(); ++i) {
    const int usual = path.source[i - 1] + 1;
    if (path.source[i] == usual || !mayJoin(docking, usual, path.source[i])) continue;
    const double cost = docking.cost(usual, path.source[i]);
    ++path.joints;
    sum += cost;
    path.worstCost = std::max(path.worstCost, cost);
  }
  path.meanCost = path.joints == 0 ? 0 : sum / path.joints;
}

/// A smooth function, 0 at both ends, of mean 0 and at most 1.
std::vector<double> smoothMotion(int count, std::uint64_t draw) {
  const Random random(draw, stream::kSlices);
  const double sign = random.uniform(0, kMode) < 0.5 ? -1 : 1;
  const double odd = random.uniform(-0.6, 0.6, 1, kMode),
               fine = random.uniform(-0.4, 0.4, 2, kMode);
  std::vector<double> motion(static_cast<std::size_t>(count));
  double most = 0;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double t = std::numbers::pi * (static_cast<double>(i) + 0.5) / count;
    motion[i] = sign * std::sin(2 * t) + odd * (std::sin(t) - 3 * std::sin(3 * t)) / 3 +
                fine * std::sin(4 * t);
    most = std::max(most, std::abs(motion[i]));
  }
  for (double& m : motion) m /= std::max(1e-9, most);
  return motion;
}

/// Where a result of `length` slices is solid; the air at both ends has its share of them.
struct ResultSlices {
  int made, ahead;  ///< slices that are solid, and those before

  ResultSlices(const SliceDocking& docking, int length) {
    const int n = docking.slices(), begin = docking.solidBegin();
    const int solid = docking.solidEnd() - begin;
    made = static_cast<int>(std::lround(static_cast<double>(solid) * length / n));
    ahead = n == solid ? 0 : (length - made) * begin / (n - solid);
  }
};

}  // namespace

SlicePath variedPath(const SliceDocking& docking, double amplitude, double pull,
                     std::uint64_t draw) {
  const int n = docking.slices(), begin = docking.solidBegin(), end = docking.solidEnd();
  const int reach = static_cast<int>(amplitude), shifts = 2 * reach + 1;
  const int run = shortestRun(docking);
  SlicePath path;
  path.source.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) path.source[static_cast<std::size_t>(i)] = i;
  if (reach < 1 || end - begin < 2 * run) return path;

  const std::vector<double> motion = smoothMotion(end - begin, draw);
  const auto unplaced = [&](int i, int shift) {
    const double off = shift / amplitude - motion[static_cast<std::size_t>(i - begin)];
    return pull * kJoint * off * off / (end - begin);
  };
  // cost(i, s): of the best way to have slice i + s at i. Joints are followed by a whole run.
  const auto at = [&](int i, int shift) {
    return static_cast<std::size_t>(i - begin) * static_cast<std::size_t>(shifts) +
           static_cast<std::size_t>(shift + reach);
  };
  std::vector<double> cost(static_cast<std::size_t>(end - begin) * static_cast<std::size_t>(shifts),
                           kNever);
  std::vector<int> from(cost.size(), 0);
  for (int i = begin; i < end; ++i) {
    for (int s = -reach; s <= reach; ++s) {
      if (i + s < begin || i + s >= end || (i == begin && s != 0)) continue;
      double& best = cost[at(i, s)];
      if (i == begin) {
        best = 0;
        continue;
      }
      best = cost[at(i - 1, s)] + unplaced(i, s);
      from[at(i, s)] = s;
      const int first = i - run + 1;  // of the run
      if (first - 1 < begin) continue;
      double misplaced = 0;
      for (int j = first; j <= i; ++j) misplaced += unplaced(j, s);
      for (int before = -reach; before <= reach; ++before) {
        if (before == s || cost[at(first - 1, before)] >= kNever) continue;
        if (!mayJoin(docking, first + before, first + s)) continue;
        const double joint = kJoint + kMisfit * docking.cost(first + before, first + s);
        const double sum = cost[at(first - 1, before)] + joint + misplaced;
        if (sum >= best) continue;
        best = sum;
        from[at(i, s)] = before;
      }
    }
  }
  int s = 0;
  for (int i = end - 1; i > begin;) {
    const int before = from[at(i, s)];
    const int length = before == s ? 1 : run;
    for (int j = 0; j < length; ++j, --i) path.source[static_cast<std::size_t>(i)] = i + s;
    s = before;
  }
  judge(docking, path);
  return path;
}

SlicePath fittedPath(const SliceDocking& docking, int length, std::uint64_t draw,
                     std::span<const SliceRange> held) {
  const int n = docking.slices(), begin = docking.solidBegin(), end = docking.solidEnd();
  const int run = shortestRun(docking);
  const int solid = end - begin;
  const ResultSlices result(docking, length);
  const int made = result.made, ahead = result.ahead;
  SlicePath best;
  if (solid < 1 || made < 2 * run) return best;
  const Random random(draw, stream::kSlices);
  int once = 0;  // slices that are held, and so no part of what is repeated
  for (const SliceRange& range : held)
    once += std::max(0, std::min(end, range.end) - std::max(begin, range.begin));
  const double most =
      std::ceil(static_cast<double>(std::max(0, made - once)) / std::max(1, solid - once));
  const auto at = [&](int i, int slice) {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(solid) +
           static_cast<std::size_t>(slice);
  };
  std::vector<double> joint(static_cast<std::size_t>(solid) * static_cast<std::size_t>(solid),
                            kNever);
  for (int a = 0; a < solid; ++a) {
    for (int b = 0; b < solid; ++b) {
      if (a == b || !mayJoin(docking, begin + a, begin + b)) continue;
      const double section = std::min(docking.section(begin + a), docking.section(begin + b));
      if (section < kThinnest) continue;
      if (made > solid && b > a) continue;  // nothing is left out of what becomes longer
      // A joint repeats or leaves out what lies between its sides.
      const auto crosses = [&](const SliceRange& range) {
        return begin + std::min(a, b) < range.end && begin + std::max(a, b) > range.begin;
      };
      if (std::ranges::any_of(held, crosses)) continue;
      const double noise = 1 + kNoise * random.uniform(at(std::max(a, b), std::min(a, b)), kPrice);
      joint[at(a, b)] = (kJoint + kMisfit * docking.cost(begin + a, begin + b)) * noise;
    }
  }
  std::vector<double> price(static_cast<std::size_t>(solid), 0);
  double least = kNever;
  for (int raise = 0; raise < kRaises; ++raise) {
    std::vector<double> cost(static_cast<std::size_t>(made) * static_cast<std::size_t>(solid),
                             kNever);
    std::vector<int> from(cost.size(), -1);
    cost[at(0, 0)] = 0;
    std::vector<double> paid(static_cast<std::size_t>(solid) + 1, 0);  // up to each slice
    for (std::size_t a = 0; a < price.size(); ++a) paid[a + 1] = paid[a] + price[a];
    for (int i = 1; i < made; ++i) {
      parallelFor(0, static_cast<std::size_t>(solid), 16, [&](std::size_t low, std::size_t high) {
        for (std::size_t slice = low; slice < high; ++slice) {
          const int a = static_cast<int>(slice);
          double& here = cost[at(i, a)];
          if (a > 0) {
            here = cost[at(i - 1, a - 1)] + price[slice];
            from[at(i, a)] = a - 1;
          }
          const int first = a - run + 1, step = i - run + 1;  // where a run would begin
          if (first < 1 || step < 1) continue;
          const double paying = paid[slice + 1] - paid[static_cast<std::size_t>(first)];
          for (int before = 0; before + 1 < solid; ++before) {
            const double sum = cost[at(step - 1, before)] + joint[at(before + 1, first)] + paying;
            if (sum >= here) continue;
            here = sum;
            from[at(i, a)] = solid + before;
          }
        }
      });
    }
    if (cost[at(made - 1, solid - 1)] >= kNever) return best;
    SlicePath path;
    path.source.assign(static_cast<std::size_t>(length), 0);
    for (int i = 0; i < length; ++i) {
      path.source[static_cast<std::size_t>(i)] =
          std::clamp(i < ahead ? begin - (ahead - i) : end + i - ahead - made, 0, n - 1);
    }
    int slice = solid - 1;
    for (int i = made - 1; i >= 0;) {
      const int before = from[at(i, slice)];
      const int count = before >= solid ? run : 1;
      for (int j = 0; j < count; ++j, --i, --slice) {
        path.source[static_cast<std::size_t>(ahead + i)] = begin + slice;
      }
      if (before >= solid) slice = before - solid;
    }
    judge(docking, path);
    std::vector<int> used(static_cast<std::size_t>(solid));
    for (int i = 0; i < made; ++i) {
      ++used[static_cast<std::size_t>(path.source[static_cast<std::size_t>(ahead + i)] - begin)];
    }
    double total = path.joints * (kJoint + kMisfit * path.meanCost);
    for (std::size_t a = 0; a < used.size(); ++a) {
      const double over = std::max(0.0, used[a] - most);
      total += kOveruse * over;
      price[a] += kOveruse * over;
    }
    if (total >= least) continue;
    least = total;
    best = std::move(path);
  }
  return best;
}

std::vector<double> stretchedPath(const SliceDocking& docking, int length, std::uint64_t draw) {
  const int n = docking.slices(), begin = docking.solidBegin(), end = docking.solidEnd();
  const int count = end - begin;
  std::vector<double> path(static_cast<std::size_t>(length));
  if (count < 1) {
    for (int i = 0; i < length; ++i)
      path[static_cast<std::size_t>(i)] = std::clamp((i + 0.5) * n / length - 0.5, 0.0, n - 1.0);
    return path;
  }
  const ResultSlices result(docking, length);
  // How much longer each slice becomes: least squares with one sum.
  const std::vector<double> motion = smoothMotion(count, draw);
  std::vector<double> longer(static_cast<std::size_t>(count));
  double sum = 0;
  for (int s = 0; s < count; ++s) {
    const auto at = static_cast<std::size_t>(s);
    longer[at] = (1 + kStretchNoise * motion[at]) / (kStiffness + docking.change(begin + s));
    sum += longer[at];
  }
  for (double& l : longer) l *= (result.made - count) / sum;
  // Where each slice of the result lies among those of the example, laid out one after another.
  int slice = 0;
  double at = 0;  // of the slice's beginning in the result
  for (int i = 0; i < length; ++i) {
    double& place = path[static_cast<std::size_t>(i)];
    const int inside = i - result.ahead;
    if (inside < 0 || inside >= result.made) {
      place = std::clamp(inside < 0 ? begin + inside : end + inside - result.made, 0, n - 1);
      continue;
    }
    const double middle = inside + 0.5;
    while (slice + 1 < count && at + 1 + longer[static_cast<std::size_t>(slice)] <= middle)
      at += 1 + longer[static_cast<std::size_t>(slice++)];
    place = begin + slice - 0.5 +
            std::min(1.0, (middle - at) / (1 + longer[static_cast<std::size_t>(slice)]));
  }
  return path;
}

}  // namespace exemplar
