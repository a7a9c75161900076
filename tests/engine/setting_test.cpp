// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/setting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

enum class Color { Red, Blue };
struct Options {
  int count = 3;
  std::optional<int> levels;
  double weight = 0.25;
  bool mirrored = false;
  Vec3i block{8, 8, 4};
  std::optional<Vec3d> cell;
  std::optional<Axes> stationary;
  Axes periodic;
  Color color = Color::Blue;
  std::uint64_t seed = 0;
};

const SettingTable<Options>& table() {
  using O = Options;
  static const SettingTable<O> settings{
      settingRow<O>("count", &O::count, "how many", {1, 9}, "cells"),
      settingRow<O>("levels", &O::levels, "levels", {1, 8}, "", "by size"),
      settingRow<O>("weight", &O::weight, "weight", kAboveZero),
      settingRow<O>("mirrored", &O::mirrored, "mirrored"),
      settingRow<O>("block", &O::block, "block", {2, 64}, "samples"),
      settingRow<O>("cell", &O::cell, "cell", kAboveZero, "", "none"),
      settingRow<O>("stationary", &O::stationary, "axes", {}, "", "auto"),
      settingRow<O>("periodic", &O::periodic, "axes"),
      choiceRow<O, Color>("color", &O::color, "color",
                          {{"red", Color::Red}, {"blue", Color::Blue}}),
      settingRow<O>("seed", &O::seed, "seed")};
  return settings;
}

Options applied(const Settings& given) {
  Options options;
  table().apply(given, options);
  return options;
}

TEST(SettingTable, DefaultsAreThoseOfTheOptions) {
  std::map<std::string, std::string> usual;
  for (const Setting& setting : table().settings()) usual[setting.key] = setting.byDefault;
  EXPECT_EQ(usual["count"], "3");
  EXPECT_EQ(usual["levels"], "by size");
  EXPECT_EQ(usual["weight"], "0.25");
  EXPECT_EQ(usual["mirrored"], "false");
  EXPECT_EQ(usual["block"], "8,8,4");
  EXPECT_EQ(usual["periodic"], "none");
  EXPECT_EQ(usual["color"], "blue");
}

TEST(SettingTable, WritesWhatWasGivenAndNothingElse) {
  const Options o = applied({{"count", "7"},
                             {"levels", "2"},
                             {"weight", "1e-3"},
                             {"mirrored", "true"},
                             {"block", "16"},
                             {"cell", "1,2.5,3"},
                             {"periodic", "xz"},
                             {"color", "red"},
                             {"seed", "18446744073709551615"},
                             {"unheard-of", "1"}});
  EXPECT_EQ(o.count, 7);
  EXPECT_EQ(o.levels, 2);
  EXPECT_EQ(o.weight, 1e-3);
  EXPECT_TRUE(o.mirrored);
  EXPECT_EQ(o.block, (Vec3i{16, 16, 16}));
  EXPECT_EQ(o.cell, (Vec3d{1, 2.5, 3}));
  EXPECT_FALSE(o.stationary);
  EXPECT_EQ(o.periodic, (Axes{true, false, true}));
  EXPECT_EQ(o.color, Color::Red);
  EXPECT_EQ(o.seed, ~std::uint64_t{0});
}

TEST(SettingTable, AutoLeavesAxesOpen) {
  EXPECT_FALSE(applied({{"stationary", "auto"}}).stationary);
  EXPECT_EQ(applied({{"stationary", "none"}}).stationary, Axes{});
}

TEST(SettingTable, TheLastTextCounts) {
  EXPECT_EQ(applied({{"count", "7"}, {"count", "8"}}).count, 8);
  Settings settings{{"count", "7"}};
  settings.set("count", 2);
  EXPECT_EQ(applied(settings).count, 2);
  EXPECT_EQ(settings.texts("count").size(), 1u);
}

struct Wrong {
  const char *key, *text, *says;
};

TEST(SettingTable, WhatCannotBeIsNamedWithWhatWouldBeRight) {
  for (const Wrong& wrong : {Wrong{"count", "0", "`count` 0: expected 1 to 9 cells"},
                             {"count", "10", "1 to 9"},
                             {"count", "3.5", "`count` 3.5: expected 1 to 9 cells"},
                             {"count", "", "expected 1 to 9"},
                             {"count", "4 ", "expected 1 to 9"},
                             {"weight", "0", "`weight` 0: expected a number above 0"},
                             {"weight", "nan", "is not a number"},
                             {"weight", "1,5", "'1,5' is not a number"},
                             {"mirrored", "yes", "expected true or false"},
                             {"block", "3,4", "expected one number or three"},
                             {"block", "1,4,4", "expected whole numbers of samples, 2 to 64"},
                             {"block", "2.5", "expected whole numbers"},
                             {"cell", "0,1,1", "expected numbers above 0"},
                             {"cell", "inf", "is not a number"},
                             {"periodic", "xw", "`periodic` xw: expected axes"},
                             {"color", "green", "`color` green: expected red or blue"}}) {
    EXPECT_THAT(
        [&] {
          applied({{wrong.key, wrong.text}});
        },
        ThrowsMessage<InputError>(HasSubstr(wrong.says)))
        << wrong.key << " " << wrong.text;
  }
}

TEST(Settings, NumbersComeBackToTheBit) {
  Settings settings;
  for (const double value : {0.1, 1e300, 5e-324, -2.5, 1.0 / 3}) {
    settings.set("x", value);
    const Setting any{.key = "x", .type = SettingType::Number};
    EXPECT_EQ(readNumber(any, settings.text("x")), value);
  }
}

TEST(Spelled, ReplacesNamesInBackticks) {
  const auto option = [](std::string_view key) { return "--" + std::string(key); };
  EXPECT_EQ(spelled("`field-block` 3: use `size`", option), "--field-block 3: use --size");
  EXPECT_EQ(spelled("no names", option), "no names");
  // What is no name of a setting stays: a file may be called anything.
  EXPECT_EQ(spelled("a`b.obj: and `c d` and `e", option), "a`b.obj: and `c d` and `e");
}

}  // namespace
}  // namespace exemplar
