// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "core/progress.h"
#include "world/window_cache.h"
#include "world/window_lattice.h"

namespace exemplar {

/// How a plane is made: where it begins, and what a window does to it.
struct PlaneRules {
  std::size_t columnBytes = 0;  ///< of one column, >= 1
  /// The plane before the first phase, at a box: a function of position alone. Columns x outermost.
  std::function<void(const PlaneBox& box, std::span<char> columns)> start;
  /// Makes a window of a phase: `columns` are those of `box`, free ones and rim, as the phase
  /// before left them; what it does to the rim is forgotten. The same arguments must give the same
  /// bytes, whatever was made before.
  std::function<void(int phase, const PlanePoint& window, const PlaneBox& box,
                     std::span<char> columns, const Progress& progress)>
      make;
};

/// An unbounded plane of columns that is a pure function of its rules: the last phase of a
/// `WindowLattice`. Any part of it can be made alone: a box needs the windows of the last phase
/// that it touches, these the windows of the phase before that they touch, and so on. A box of
/// k x k windows that are aligned with the last phase needs k² + (k + 1)² + (k + 2)², and large
/// ones three for each window's area. Windows that were made are found in the cache.
///
/// Thread-safe. Windows of one phase are made in parallel.
class PhasedPlane {
 public:
  /// `cache` must outlive the plane.
  PhasedPlane(const WindowLattice& lattice, PlaneRules rules, WindowCache& cache);

  /// The columns of a box, x outermost. Throws `Cancelled`.
  std::string columns(const PlaneBox& box, const Progress& progress = {}) const;
  const WindowLattice& lattice() const { return lattice_; }

 private:
  std::string state(int phase, const PlaneBox& box, const Progress& progress) const;
  WindowCache::Bytes window(const WindowKey& key, const Progress& progress) const;
  void makeMissing(const PlaneBox& box, const Progress& progress) const;

  WindowLattice lattice_;
  PlaneRules rules_;
  WindowCache& cache_;
};

}  // namespace exemplar
