// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/landmarks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "core/array3d.h"
#include "core/figure_constants.h"
#include "core/parallel.h"
#include "core/random.h"

namespace exemplar {
namespace {

constexpr int kSide = kLikenessWindow;
constexpr int kHalf = kSide / 2;
/// Examples are at most this long where landmarks are looked for.
constexpr int kLongest = 72;
/// A landmark has at least so much of solid and of air: less looks alike by chance.
constexpr int kLeast = kSide * kSide * kSide / 20;

/// How many bits each row of a window has. Where no instruction counts them, `std::popcount` is a
/// call each time; windows are compared so often that this was a third of a whole run.
constexpr auto kBits = [] {
  std::array<std::uint8_t, std::size_t{1} << kSide> bits{};
  for (std::size_t row = 0; row < bits.size(); ++row)
    bits[row] = static_cast<std::uint8_t>(std::popcount(row));
  return bits;
}();

/// A volume, `shrink` times as coarse: solid where at least half of it is.
Array3D<std::uint8_t> shrunk(const Occupancy& volume, int shrink) {
  const Vec3i n = volume.size();
  Array3D<std::uint8_t> coarse({n.x / shrink, n.y / shrink, n.z / shrink});
  const int enough = (shrink * shrink * shrink + 1) / 2;
  parallelForEachCell(coarse.size(), [&](const Vec3i& p) {
    int solid = 0;
    for (int k = 0; k < shrink; ++k)
      for (int j = 0; j < shrink; ++j)
        solid += std::popcount(volume.bits(p.x * shrink, p.y * shrink + j, p.z * shrink + k) &
                               ((std::uint64_t{1} << shrink) - 1));
    coarse[p] = solid >= enough;
  });
  return coarse;
}

/// A volume cut into windows: for each first cell the bits of its row, and how much is solid.
struct Windows {
  Vec3i size;                   ///< of the volume
  Vec3i places;                 ///< windows along each axis
  Array3D<std::uint16_t> rows;  ///< 11 cells from each on
  Array3D<std::int16_t> solid;  ///< cells of each window

  explicit Windows(const Array3D<std::uint8_t>& volume)
      : size(volume.size()),
        places(max(size - Vec3i{kSide - 1, kSide - 1, kSide - 1}, Vec3i{0, 0, 0})) {
    if (places.x == 0 || places.y == 0 || places.z == 0) {
      places = {0, 0, 0};
      return;
    }
    rows = Array3D<std::uint16_t>({places.x, size.y, size.z});
    parallelForEachCell(rows.size(), [&](const Vec3i& p) {
      unsigned bits = 0;
      for (int i = 0; i < kSide; ++i) bits |= unsigned{volume(p.x + i, p.y, p.z)} << i;
      rows[p] = static_cast<std::uint16_t>(bits);
    });
    Array3D<std::int16_t> layer({places.x, places.y, size.z});
    parallelForEachCell(layer.size(), [&](const Vec3i& p) {
      int sum = 0;
      for (int j = 0; j < kSide; ++j) sum += kBits[rows(p.x, p.y + j, p.z)];
      layer[p] = static_cast<std::int16_t>(sum);
    });
    solid = Array3D<std::int16_t>(places);
    parallelForEachCell(places, [&](const Vec3i& p) {
      int sum = 0;
      for (int k = 0; k < kSide; ++k) sum += layer(p.x, p.y, p.z + k);
      solid[p] = static_cast<std::int16_t>(sum);
    });
  }
};

/// One window, by its rows.
struct Window {
  std::array<std::uint16_t, static_cast<std::size_t>(kSide) * kSide> rows{};
  int solid = 0;

  Window(const Windows& from, const Vec3i& at) : solid(from.solid[at]) {
    std::size_t row = 0;
    for (int k = 0; k < kSide; ++k)
      for (int j = 0; j < kSide; ++j) rows[row++] = from.rows(at.x, at.y + j, at.z + k);
  }

  /// How alike a window of another volume is: the IoU of what there is less of, solid or air.
  double alike(const Windows& other, const Vec3i& at) const {
    constexpr int kAll = kSide * kSide * kSide;
    const int there = other.solid[at];
    const bool air = 2 * solid > kAll;
    const int a = air ? kAll - solid : solid, b = air ? kAll - there : there;
    if (std::min(a, b) < kLandmarkAlike * std::max(a, b)) return 0;
    int differing = 0;
    // Both are a + b - common; what differs is a + b - 2 common.
    const int most = static_cast<int>((1 - kLandmarkAlike) * (a + b) / (1 + kLandmarkAlike));
    std::size_t row = 0;
    for (int k = 0; k < kSide; ++k) {
      for (int j = 0; j < kSide; ++j) {
        const unsigned unequal = unsigned{rows[row++]} ^ other.rows(at.x, at.y + j, at.z + k);
        differing += kBits[unequal];
      }
      if (differing > most) return 0;
    }
    const double common = (a + b - differing) / 2.0;
    return common / (a + b - common);
  }
};

bool near(const Vec3i& a, const Vec3i& b) {
  const Vec3i d = a - b;
  return std::abs(d.x) <= kHalf && std::abs(d.y) <= kHalf && std::abs(d.z) <= kHalf;
}

/// Where a window occurs, best first; what is near a better one is left out.
int occurrences(const Window& window, const Windows& in) {
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t s = 0; s < in.solid.count(); ++s) {
    const double alike = window.alike(in, in.solid.ijk(s));
    if (alike >= kLandmarkAlike) found.emplace_back(-alike, s);
  }
  std::ranges::sort(found);
  std::vector<Vec3i> places;
  for (const auto& [alike, s] : found) {
    const Vec3i at = in.solid.ijk(s);
    if (std::ranges::none_of(places, [&](const Vec3i& p) { return near(p, at); }))
      places.push_back(at);
  }
  return static_cast<int>(places.size());
}

bool occursElsewhere(const Window& window, const Windows& in, const Vec3i& at) {
  for (std::size_t s = 0; s < in.solid.count(); ++s) {
    const Vec3i p = in.solid.ijk(s);
    if (!near(p, at) && window.alike(in, p) >= kLandmarkAlike) return true;
  }
  return false;
}

/// Windows with enough of both solid and air, drawn at random, none near another.
std::vector<Vec3i> candidates(const Windows& example, const LandmarkOptions& options) {
  constexpr int kAll = kSide * kSide * kSide;
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  const Random random(options.seed, stream::kLandmarks);
  for (std::size_t s = 0; s < example.solid.count(); ++s) {
    const int solid = example.solid.values()[s];
    if (solid >= kLeast && solid <= kAll - kLeast) order.emplace_back(random.bits(s), s);
  }
  std::ranges::sort(order);
  std::vector<Vec3i> drawn;
  for (const auto& [key, s] : order) {
    if (drawn.size() >= static_cast<std::size_t>(options.candidates)) break;
    const Vec3i at = example.solid.ijk(s);
    if (std::ranges::none_of(drawn, [&](const Vec3i& p) { return near(p, at); }))
      drawn.push_back(at);
  }
  return drawn;
}

}  // namespace

int Landmarks::most() const {
  return occurrences.empty() ? 0 : *std::ranges::max_element(occurrences);
}
double Landmarks::mean() const {
  return occurrences.empty() ? 0
                             : std::accumulate(occurrences.begin(), occurrences.end(), 0.0) /
                                   static_cast<double>(occurrences.size());
}
double Landmarks::repeated() const {
  return occurrences.empty() ? 0
                             : static_cast<double>(std::ranges::count_if(
                                   occurrences, [&](int times) { return times > allowed; })) /
                                   static_cast<double>(occurrences.size());
}

Landmarks countLandmarks(const Occupancy& example, const Occupancy& result,
                         const LandmarkOptions& options, const Progress& progress) {
  Landmarks counted;
  counted.allowed = 2 * result.cells() >= 3 * example.cells() ? 2 : 1;
  const Vec3i n = example.size();
  int shrink = 1;
  while (std::max({n.x, n.y, n.z}) / shrink > kLongest) shrink *= 2;
  const Windows before(shrunk(example, shrink)), after(shrunk(result, shrink));
  progress.check();
  if (before.solid.count() == 0) return counted;

  const std::vector<Vec3i> asked = candidates(before, options);
  std::vector<std::uint8_t> once(asked.size());
  parallelFor(0, asked.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      progress.check();
      once[c] = !occursElsewhere(Window(before, asked[c]), before, asked[c]);
    }
  });
  std::vector<Vec3i> landmarks;
  for (std::size_t c = 0; c < asked.size(); ++c) {
    if (once[c] && landmarks.size() < static_cast<std::size_t>(options.landmarks))
      landmarks.push_back(asked[c]);
  }
  counted.occurrences.resize(landmarks.size());
  parallelFor(0, landmarks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t l = begin; l < end; ++l) {
      progress.check();
      counted.occurrences[l] = occurrences(Window(before, landmarks[l]), after);
    }
  });
  return counted;
}

}  // namespace exemplar
