// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/phased_plane.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "core/random.h"

namespace exemplar {
namespace {

constexpr std::int64_t kPoison = std::numeric_limits<std::int64_t>::min();

std::int64_t mixed(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(
      Random(static_cast<std::uint64_t>(a)).bits(static_cast<std::uint64_t>(b)) >> 8);
}

/// Columns of one number each; a window mixes all that it sees into its free columns.
PlaneRules mixing() {
  PlaneRules rules;
  rules.columnBytes = sizeof(std::int64_t);
  rules.start = [](const PlaneBox& box, std::span<char> columns) {
    char* to = columns.data();
    for (std::int64_t x = box.begin.x; x < box.end.x; ++x)
      for (std::int64_t y = box.begin.y; y < box.end.y; ++y, to += sizeof x) {
        const std::int64_t value = mixed(x, y);
        std::memcpy(to, &value, sizeof value);
      }
  };
  rules.make = [](int phase, const PlanePoint& window, const PlaneBox&, std::span<char> columns,
                  const Progress&) {
    const std::size_t n = columns.size() / sizeof(std::int64_t);
    std::int64_t all = mixed(phase, mixed(window.x, window.y));
    for (std::size_t i = 0; i < n; ++i) {
      std::int64_t value = 0;
      std::memcpy(&value, columns.data() + i * sizeof value, sizeof value);
      EXPECT_NE(value, kPoison);
      all = mixed(all, value);
    }
    for (std::size_t i = 0; i < n; ++i) {
      // What it writes to its rim must not be seen by anybody.
      const std::int64_t value = mixed(all, static_cast<std::int64_t>(i));
      std::memcpy(columns.data() + i * sizeof value, &value, sizeof value);
    }
  };
  return rules;
}

const WindowLattice kLattice{.pitch = 12, .separator = 2};

TEST(PhasedPlane, APartIsTheSameWhateverIsMadeWithIt) {
  WindowCache all(1);
  const PhasedPlane plane(kLattice, mixing(), all);
  const PlaneBox region{{-40, -25}, {35, 50}};
  const std::string whole = plane.columns(region);
  for (std::uint64_t trial = 0; trial < 30; ++trial) {
    const Random random(trial);
    PlaneBox box;
    for (int axis = 0; axis < 2; ++axis) {
      const auto size = static_cast<std::uint32_t>(region.size(axis));
      const std::int64_t a = random.below(size, static_cast<std::uint64_t>(axis), 0);
      const std::int64_t b = random.below(size, static_cast<std::uint64_t>(axis), 1);
      box.begin[axis] = region.begin[axis] + std::min(a, b);
      box.end[axis] = region.begin[axis] + std::max(a, b) + 1;
    }
    WindowCache own(1, {.capacity = trial % 2 ? std::size_t{1} : std::size_t{1} << 20});
    const PhasedPlane alone(kLattice, mixing(), own);
    std::string part;
    tbb::task_arena arena(trial % 3 == 0 ? 1 : 8);
    arena.execute([&] { part = alone.columns(box); });
    const auto row = static_cast<std::size_t>(box.size(1)) * sizeof(std::int64_t);
    for (std::int64_t x = box.begin.x; x < box.end.x; ++x) {
      const std::size_t from = static_cast<std::size_t>((x - region.begin.x) * region.size(1) +
                                                        box.begin.y - region.begin.y) *
                               sizeof(std::int64_t);
      ASSERT_EQ(part.substr(static_cast<std::size_t>(x - box.begin.x) * row, row),
                whole.substr(from, row))
          << trial;
    }
  }
}

TEST(PhasedPlane, AWindowSeesNothingButItselfAndItsRim) {
  // The start is poisoned but for what the windows of a box see, over all phases.
  const PlaneBox box{{0, 0}, {12, 12}};
  const int reach = 2 * (kLattice.pitch + kLattice.separator) + kLattice.pitch;
  const PlaneBox seen{{-reach, -reach}, {box.end.x + reach, box.end.y + reach}};
  PlaneRules rules = mixing();
  rules.start = [&, start = rules.start](const PlaneBox& at, std::span<char> columns) {
    start(at, columns);
    char* to = columns.data();
    for (std::int64_t x = at.begin.x; x < at.end.x; ++x)
      for (std::int64_t y = at.begin.y; y < at.end.y; ++y, to += sizeof x)
        if (!seen.contains({x, y})) std::memcpy(to, &kPoison, sizeof kPoison);
  };
  WindowCache one(1), other(1);
  EXPECT_EQ(PhasedPlane(kLattice, rules, one).columns(box),
            PhasedPlane(kLattice, mixing(), other).columns(box));
}

TEST(PhasedPlane, ALoneWindowTakesFourteen) {
  int made = 0;
  PlaneRules rules = mixing();
  rules.make = [&, make = rules.make](int phase, const PlanePoint& window, const PlaneBox& box,
                                      std::span<char> columns, const Progress& progress) {
    ++made;
    make(phase, window, box, columns, progress);
  };
  WindowCache cache(1);
  const PhasedPlane plane(kLattice, rules, cache);
  tbb::task_arena arena(1);
  arena.execute([&] { plane.columns({{0, 0}, {12, 12}}); });
  EXPECT_EQ(made, 1 + 4 + 9);
  arena.execute([&] { plane.columns({{0, 0}, {12, 12}}); });
  EXPECT_EQ(made, 14) << "the cache has them";
}

TEST(PhasedPlane, EveryColumnDependsOnTheLastPhasesAndNotOnTheRimsThatWindowsWrote) {
  // Separators of the last phase are what the phase before left there.
  WindowCache cache(1);
  const PhasedPlane plane(kLattice, mixing(), cache);
  const std::string strip = plane.columns({{0, 2}, {2, 12}});
  const std::string with = plane.columns({{0, 2}, {12, 12}});
  EXPECT_EQ(strip, with.substr(0, strip.size()));
}

}  // namespace
}  // namespace exemplar
