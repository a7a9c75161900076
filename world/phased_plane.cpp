// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/phased_plane.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace exemplar {
namespace {

/// Copies the columns that are in both boxes from one to the other.
void copyColumns(const PlaneBox& from, std::string_view source, const PlaneBox& to,
                 std::string& target, std::size_t columnBytes) {
  const PlaneBox both = from & to;
  if (both.empty()) return;
  const auto at = [&](const PlaneBox& box, std::int64_t x) {
    return static_cast<std::size_t>((x - box.begin.x) * box.size(1) + both.begin.y - box.begin.y) *
           columnBytes;
  };
  const std::size_t length = static_cast<std::size_t>(both.size(1)) * columnBytes;
  for (std::int64_t x = both.begin.x; x < both.end.x; ++x)
    std::copy_n(source.data() + at(from, x), length, target.data() + at(to, x));
}

/// The parts of a box between a phase's windows, that none of them may change.
std::vector<PlaneBox> separators(const WindowLattice& lattice, int phase, const PlaneBox& box) {
  std::vector<PlaneBox> strips;
  for (int axis = 0; axis < 2; ++axis) {
    const std::int64_t first = floorDivide(box.begin[axis] - lattice.shift(phase), lattice.pitch);
    for (std::int64_t n = first;; ++n) {
      PlaneBox strip = box;
      const std::int64_t at = lattice.shift(phase) + n * lattice.pitch;
      if (at >= box.end[axis]) break;
      strip.begin[axis] = std::max(strip.begin[axis], at);
      strip.end[axis] = std::min(strip.end[axis], at + lattice.separator);
      if (!strip.empty()) strips.push_back(strip);
    }
  }
  return strips;
}

}  // namespace

PhasedPlane::PhasedPlane(const WindowLattice& lattice, PlaneRules rules, WindowCache& cache)
    : lattice_(lattice), rules_(std::move(rules)), cache_(cache) {}

std::string PhasedPlane::columns(const PlaneBox& box, const Progress& progress) const {
  makeMissing(box, progress);
  return state(WindowLattice::phases, box, progress);
}

/// The plane after a phase, at a box.
std::string PhasedPlane::state(int phase, const PlaneBox& box, const Progress& progress) const {
  std::string columns(static_cast<std::size_t>(box.columns()) * rules_.columnBytes, '\0');
  if (phase == 0) {
    rules_.start(box, columns);
    return columns;
  }
  for (const PlanePoint& n : lattice_.touching(phase, box)) {
    const PlaneBox free = lattice_.free(phase, n);
    if ((free & box).empty()) continue;
    copyColumns(free, *window({phase, n}, progress), box, columns, rules_.columnBytes);
  }
  for (const PlaneBox& strip : separators(lattice_, phase, box))
    copyColumns(strip, state(phase - 1, strip, progress), box, columns, rules_.columnBytes);
  return columns;
}

/// The free columns of a window.
WindowCache::Bytes PhasedPlane::window(const WindowKey& key, const Progress& progress) const {
  if (WindowCache::Bytes bytes = cache_.find(key)) return bytes;
  progress.check();
  const PlaneBox whole = lattice_.whole(key.phase, key.window);
  const PlaneBox free = lattice_.free(key.phase, key.window);
  std::string columns = state(key.phase - 1, whole, progress);
  rules_.make(key.phase, key.window, whole, columns, progress);
  std::string made(static_cast<std::size_t>(free.columns()) * rules_.columnBytes, '\0');
  copyColumns(whole, columns, free, made, rules_.columnBytes);
  return cache_.put(key, std::move(made));
}

/// Makes the windows that a box needs, phase after phase, so that none is made twice by threads
/// that wait for the same one.
void PhasedPlane::makeMissing(const PlaneBox& box, const Progress& progress) const {
  std::vector<std::vector<PlanePoint>> missing(WindowLattice::phases + 1);
  std::vector<PlaneBox> seen{box};
  std::size_t all = 0;
  for (int phase = WindowLattice::phases; phase > 0; --phase) {
    std::set<PlanePoint> touched;
    for (const PlaneBox& part : seen) {
      for (const PlanePoint& n : lattice_.touching(phase, part))
        if (!(lattice_.free(phase, n) & part).empty()) touched.insert(n);
    }
    std::vector<PlaneBox> before;
    for (const PlaneBox& part : seen) {
      const std::vector<PlaneBox> strips = separators(lattice_, phase, part);
      before.insert(before.end(), strips.begin(), strips.end());
    }
    for (const PlanePoint& n : touched) {
      if (cache_.find({phase, n})) continue;
      missing[phase].push_back(n);
      before.push_back(lattice_.whole(phase, n));
    }
    all += missing[phase].size();
    seen = std::move(before);
  }
  std::atomic<std::size_t> made{0};
  // Only this thread reports, between phases.
  for (int phase = 1; phase <= WindowLattice::phases; ++phase) {
    if (all > 0)
      progress.report("making windows", static_cast<double>(made) / static_cast<double>(all));
    parallelFor(0, missing[phase].size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n, ++made)
        window({phase, missing[phase][n]}, progress);
    });
  }
}

}  // namespace exemplar
