// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/copied_windows.h"

#include <algorithm>
#include <bit>

#include "core/parallel.h"

namespace exemplar {
namespace {

constexpr int kWide = 8;                                // columns
constexpr std::uint64_t kAlongX = 0x9E3779B97F4A7C15u;  // odd
constexpr std::uint64_t kAlongY = 0xD6E8FEB86659FD93u;

std::uint64_t mixed(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
  return v ^ (v >> 31);
}

/// Horner's rule: hashes of windows are polynomials in two odd numbers, summed along y first.
std::uint64_t along(const std::uint64_t* first, std::size_t step, int count, std::uint64_t by) {
  std::uint64_t sum = 0;
  for (int i = 0; i < count; ++i) sum = sum * by + first[static_cast<std::size_t>(i) * step];
  return sum;
}

int wrapped(int i, int n) { return ((i % n) + n) % n; }

}  // namespace

CopiedWindows::CopiedWindows(const ModelProblem& problem, std::span<const PatchSource> sources)
    : problem_(&problem),
      size_(problem.options().size),
      periodic_(problem.options().periodic),
      wideX_(std::min(kWide, size_.x)),
      wideY_(std::min(kWide, size_.y)),
      high_(size_.z),
      frames_(problem.options().frames) {
  for (const PatchSource& s : sources) {
    wideX_ = std::min(wideX_, s.size.x);
    wideY_ = std::min(wideY_, s.size.y);
    high_ = std::min(high_, s.size.z);
    frames_ = std::min(frames_, s.frames);
  }
  std::vector<std::uint64_t> found;
  for (const PatchSource& s : sources) {
    std::vector<std::uint64_t> columns;
    for (int c = 0; c < s.size.x * s.size.y; ++c) {
      columns.push_back(column(s.labels.data() + std::int64_t{c} * s.size.z * s.frames, s.frames));
    }
    for (int x = 0; x + wideX_ <= s.size.x; ++x) {
      for (int y = 0; y + wideY_ <= s.size.y; ++y) {
        std::uint64_t hash = 0;
        bool alike = true;
        const std::uint64_t* first = columns.data() + x * s.size.y + y;
        for (int i = 0; i < wideX_; ++i) {
          for (int j = 0; j < wideY_; ++j) alike = alike && first[i * s.size.y + j] == *first;
          hash = hash * kAlongX + along(first + i * s.size.y, 1, wideY_, kAlongY);
        }
        if (!alike) found.push_back(mixed(hash) | 1);
      }
    }
  }
  known_.assign(std::bit_ceil(2 * found.size() + 1), 0);
  for (const std::uint64_t hash : found) {
    std::size_t i = hash >> 1 & (known_.size() - 1);
    while (known_[i] != 0 && known_[i] != hash) i = (i + 1) & (known_.size() - 1);
    known_[i] = hash;
  }
}

std::uint64_t CopiedWindows::column(const Label* lowest, std::int64_t step) const {
  std::uint64_t hash = 0;
  for (int z = 0; z < high_; ++z) {
    for (int t = 0; t < frames_; ++t) hash = (hash + lowest[z * step + t] + 1) * kAlongX;
  }
  return mixed(hash);
}

bool CopiedWindows::shows(std::uint64_t hash) const {
  hash = mixed(hash) | 1;
  const std::size_t mask = known_.size() - 1;
  for (std::size_t i = hash >> 1 & mask; known_[i] != 0; i = (i + 1) & mask) {
    if (known_[i] == hash) return true;
  }
  return false;
}

void CopiedWindows::count(std::span<const Label> grid, const Progress& progress) {
  column_.assign(static_cast<std::size_t>(size_.x) * size_.y, 0);
  copied_.assign(column_.size(), 0);
  copies_ = 0;
  const std::int64_t frames = problem_->options().frames;
  parallelFor(0, column_.size(), 1024, [&](std::size_t begin, std::size_t end) {
    progress.check();
    for (std::size_t c = begin; c < end; ++c)
      column_[c] = column(grid.data() + static_cast<std::int64_t>(c) * size_.z * frames, frames);
  });
  Change change;
  constexpr int kStrip = 64;
  for (int x = 0; x < size_.x; x += kStrip) {
    progress.check();
    look(grid, {x, 0, 0}, {std::min(x + kStrip, size_.x), size_.y, 1}, change);
    keep(change);
  }
}

int CopiedWindows::look(std::span<const Label> grid, const Vec3i& low, const Vec3i& high,
                        Change& change) const {
  change.columns.clear();
  change.windows.clear();
  const std::int64_t frames = problem_->options().frames;
  // All columns of all windows that hold one of these.
  const Vec3i first = low - Vec3i{wideX_ - 1, wideY_ - 1, 0};
  const Vec3i end = high + Vec3i{wideX_ - 1, wideY_ - 1, 0};
  const int nx = end.x - first.x, ny = end.y - first.y;
  change.hashes.assign(static_cast<std::size_t>(nx) * ny, 0);
  for (int x = first.x; x < end.x; ++x) {
    if ((x < 0 || x >= size_.x) && !periodic_.x) continue;
    for (int y = first.y; y < end.y; ++y) {
      if ((y < 0 || y >= size_.y) && !periodic_.y) continue;
      const std::int64_t c = std::int64_t{wrapped(x, size_.x)} * size_.y + wrapped(y, size_.y);
      std::uint64_t& hash =
          change.hashes[static_cast<std::size_t>(x - first.x) * ny + (y - first.y)];
      hash = column_[c];
      if (x < low.x || x >= high.x || y < low.y || y >= high.y) continue;
      hash = column(grid.data() + c * size_.z * frames, frames);
      if (hash != column_[c]) change.columns.emplace_back(static_cast<std::int32_t>(c), hash);
    }
  }
  const int windowsX = nx - wideX_ + 1, windowsY = ny - wideY_ + 1;
  change.sums.resize(static_cast<std::size_t>(nx) * windowsY);
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < windowsY; ++y)
      change.sums[x * windowsY + y] = along(change.hashes.data() + x * ny + y, 1, wideY_, kAlongY);
  }
  int more = 0;
  for (int x = 0; x < windowsX; ++x) {
    const int px = first.x + x;
    if (!periodic_.x && (px < 0 || px + wideX_ > size_.x)) continue;
    for (int y = 0; y < windowsY; ++y) {
      const int py = first.y + y;
      if (!periodic_.y && (py < 0 || py + wideY_ > size_.y)) continue;
      const std::int32_t place = static_cast<std::int32_t>(
          std::int64_t{wrapped(px, size_.x)} * size_.y + wrapped(py, size_.y));
      const bool copied = shows(along(change.sums.data() + x * windowsY + y,
                                      static_cast<std::size_t>(windowsY), wideX_, kAlongX));
      if (copied == (copied_[place] != 0)) continue;
      change.windows.push_back({place, copied});
      more += copied ? 1 : -1;
    }
  }
  return more;
}

void CopiedWindows::keep(const Change& change) {
  for (const auto& [c, hash] : change.columns) column_[c] = hash;
  for (const Window& w : change.windows) {
    if ((copied_[w.place] != 0) == w.copied) continue;
    copied_[w.place] = w.copied;
    copies_ += w.copied ? 1 : -1;
  }
}

}  // namespace exemplar
