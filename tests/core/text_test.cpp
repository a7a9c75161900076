// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "core/warnings.h"

namespace exemplar {
namespace {

TEST(OneLine, HasNoControlCharacterWhateverANameHolds) {
  EXPECT_EQ(oneLine("a\nb\t\x1b[31mc\r\x7f"), "a b  [31mc  ");
  EXPECT_EQ(oneLine("B\xC3\xA4lle"), "B\xC3\xA4lle");
  EXPECT_STREQ(InputError("unknown kind 'a\nb'").what(), "unknown kind 'a b'");
  Warnings warnings;
  warn(&warnings, "texture 'a\nb' is left out");
  warn(&warnings, "texture 'a\nb' is left out");
  EXPECT_EQ(warnings, Warnings{"texture 'a b' is left out"});
}

TEST(NearestName, IsTheOneThatWasMeant) {
  const std::vector<std::string> names{"--scale", "--scene-seed", "--seed", "--size", "--sides"};
  EXPECT_EQ(nearestName("--sacle", names), "--scale");  // swapped
  EXPECT_EQ(nearestName("--scal", names), "--scale");   // left out
  EXPECT_EQ(nearestName("--sseed", names), "--seed");   // put in
  EXPECT_EQ(nearestName("--sire", names), "--size");    // replaced, the first of two
  EXPECT_EQ(nearestName("--scnee", names), "--scale");  // within a third of the letters
  EXPECT_EQ(nearestName("--frobnicate", names), "");
  EXPECT_EQ(nearestName("", names), "");
  EXPECT_EQ(nearestName("x", std::vector<std::string>{"y"}), "y");
  EXPECT_EQ(nearestName("xy", std::vector<std::string>{"ab"}), "");
  EXPECT_EQ(nearestName("scale", {}), "");
}

}  // namespace
}  // namespace exemplar
