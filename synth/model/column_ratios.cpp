// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/column_ratios.h"

#include <algorithm>
#include <map>
#include <unordered_set>

namespace exemplar {

ColumnRatios::ColumnRatios(const PatchSource& source, const Vec3i& size,
                           const std::array<bool, 2>& ends, bool whole, const Vec3i& reach)
    : source_(&source), ends_(ends), whole_(whole), reach_(reach) {
  const Vec3i n = source.size;
  for (int x = 0; x < n.x; ++x) {
    for (int y = 0; y < n.y; ++y) {
      const Label* first = source.labels.data() + source.position({x, y, 0}, 0);
      columns_.emplace_back(first, first + static_cast<std::size_t>(n.z) * source.frames);
    }
  }
  findColumnsOfSides();
  single_ = share({1, 1, 1}, n, size).each;
}

void ColumnRatios::findColumnsOfSides() {
  const Vec3i n = source_->size;
  std::unordered_set<char16_t> inside;
  for (int x = 0; x < n.x; ++x) {
    for (int y = 0; y < n.y; ++y) {
      const std::u16string& labels = columns_[column(x, y)];
      if (!onRing(0, x) && !onRing(1, y)) inside.insert(labels.begin(), labels.end());
    }
  }
  for (const std::u16string& labels : columns_) {
    ofSide_.push_back(
        std::ranges::any_of(labels, [&](char16_t label) { return !inside.contains(label); }));
  }
}

/// How much of what is along an axis each place of a block stands for: each pixel counts for as
/// much as the others, in equal parts for all blocks that show it. 1 on average.
std::vector<double> ColumnRatios::standsFor(int axis, int wide, int from) const {
  std::vector<double> parts(static_cast<std::size_t>(from), 1.0);
  if (ends_[axis] || reach_[axis] == 0) return parts;
  const int shows = wide + reach_[axis], pixels = from + shows - 1;
  for (int place = 0; place < from; ++place) {
    parts[place] = 0;
    for (int p = place; p < place + shows; ++p)
      parts[place] += 1.0 / std::min({p + 1, pixels - p, shows, from});
    parts[place] *= double(from) / pixels;
  }
  return parts;
}

ColumnRatios::Shares ColumnRatios::share(const Vec3i& wide, const Vec3i& from,
                                         const Vec3i& to) const {
  std::array<bool, 2> sides{};
  for (int axis = 0; axis < 2; ++axis)
    sides[axis] = ends_[axis] && from[axis] >= 3 && to[axis] >= 3;
  const auto onSide = [&](int axis, int at) {
    return sides[axis] && (at == 0 || at == from[axis] - 1);
  };
  const auto along = [&](int axis, int at) {
    if (!sides[axis]) return double(to[axis]) / from[axis];
    return onSide(axis, at) ? 1 : double(to[axis] - 2) / (from[axis] - 2);
  };
  const std::vector<double> alongX = standsFor(0, wide.x, from.x);
  const std::vector<double> alongY = standsFor(1, wide.y, from.y);
  Shares all;
  all.left = double(to.x) * to.y;
  double parts = 0;
  for (int x = 0; x < from.x; ++x) {
    for (int y = 0; y < from.y; ++y) {
      bool ofSide = false;
      for (int i = x; i < x + wide.x && (onSide(0, x) || onSide(1, y)); ++i) {
        for (int j = y; j < y + wide.y; ++j) ofSide = ofSide || ofSide_[column(i, j)];
      }
      all.ratio.push_back(ofSide ? along(0, x) * along(1, y) : 0);
      all.left -= all.ratio.back();
      if (ofSide) continue;
      all.others.push_back(x * from.y + y);
      parts += alongX[x] * alongY[y];
    }
  }
  if (!all.others.empty()) all.each = std::max(all.left, 0.0) / parts;
  for (const int place : all.others)
    all.ratio[place] = all.each * alongX[place / from.y] * alongY[place % from.y];
  return all;
}

/// Where blocks of equal columns begin, of those columns of which there are most such blocks.
std::vector<int> ColumnRatios::groundBlocks(const Vec3i& wide, const Vec3i& from) const {
  std::map<std::u16string, std::vector<int>> alike;
  for (int x = 0; x < from.x; ++x) {
    for (int y = 0; y < from.y; ++y) {
      const std::u16string& first = columns_[column(x, y)];
      bool same = true;
      for (int i = x; i < x + wide.x; ++i) {
        for (int j = y; j < y + wide.y; ++j) same = same && columns_[column(i, j)] == first;
      }
      if (same) alike[first].push_back(x * from.y + y);
    }
  }
  std::vector<int> most;
  for (auto& [labels, places] : alike)
    if (places.size() > most.size()) most = std::move(places);
  return most;
}

std::vector<double> ColumnRatios::of(const Vec3i& wide, const Vec3i& from, const Vec3i& to) const {
  Shares all = share(wide, from, to);
  if (wide.x * wide.y == 1 || !whole_) return std::move(all.ratio);
  const std::vector<int> ground = groundBlocks(wide, from);
  if (ground.empty()) return std::move(all.ratio);
  for (const int place : all.others) all.ratio[place] = single_;
  const double remains = all.left - single_ * static_cast<double>(all.others.size());
  for (const int place : ground) {
    double& ratio = all.ratio[place];
    ratio = std::max(0.0, ratio + remains / static_cast<double>(ground.size()));
  }
  return std::move(all.ratio);
}

}  // namespace exemplar
