// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/text_scanner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <vector>

namespace exemplar {
namespace {

using testing::ElementsAre;

/// `text`, ASCII, as UTF-16.
std::string utf16(const std::string& text, bool big, bool mark) {
  std::string bytes;
  const auto add = [&](char high, char low) {
    bytes += big ? high : low;
    bytes += big ? low : high;
  };
  if (mark) add('\xfe', '\xff');
  for (const char c : text) add('\0', c);
  return bytes;
}

/// The words of each line.
std::vector<std::vector<std::string>> wordsOf(const std::string& text,
                                              const TextScannerOptions& options = {}) {
  std::vector<std::vector<std::string>> lines;
  TextScanner in(text, "f", options);
  while (in.nextLine()) {
    auto& words = lines.emplace_back();
    while (!in.atLineEnd()) words.emplace_back(in.word());
  }
  return lines;
}

TEST(TextScanner, LinesEndInEveryWayThatIsInUse) {
  const auto lines = ElementsAre(ElementsAre("a", "b"), ElementsAre("c"), ElementsAre("d"));
  EXPECT_THAT(wordsOf("a b\nc\nd"), lines);
  EXPECT_THAT(wordsOf("a b\r\nc\r\nd\r\n"), lines);
  EXPECT_THAT(wordsOf("a b\rc\rd\r"), lines);
  EXPECT_THAT(wordsOf("a b\r\r\nc\r\r\nd\r\r\n"), lines) << "line ends converted twice";
  EXPECT_THAT(wordsOf("a b\nc\rd\r\n"), lines) << "mixed";
  TextScanner in("a\rb\r\rc", "f");
  while (in.nextLine()) {
  }
  EXPECT_EQ(in.line(), 4) << "lone returns count as lines";
}

TEST(TextScanner, UnderstandsMarksAndUtf16) {
  const std::string text = "v 1.5 2\nw";
  const auto lines = ElementsAre(ElementsAre("v", "1.5", "2"), ElementsAre("w"));
  EXPECT_THAT(wordsOf("\xef\xbb\xbf" + text), lines);
  for (const bool big : {false, true}) {
    for (const bool mark : {false, true}) EXPECT_THAT(wordsOf(utf16(text, big, mark)), lines);
  }
  // U+00E9, U+20AC and U+1F600 (a surrogate pair), then half a pair.
  std::string decoded;
  EXPECT_EQ(asUtf8(std::string("\xff\xfe\xe9\0\xac\x20\x3d\xd8\0\xde\x3d\xd8", 12), decoded),
            "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\xef\xbf\xbd");
}

TEST(TextScanner, ControlCharactersAreBlanks) {
  EXPECT_THAT(wordsOf(std::string("a\tb\v\f c\0\x1a", 9)), ElementsAre(ElementsAre("a", "b", "c")));
}

TEST(TextScanner, CommentsEndLinesOnlyWhereTheyAreAskedFor) {
  EXPECT_THAT(wordsOf("a #b\n"), ElementsAre(ElementsAre("a", "#b")));
  EXPECT_THAT(wordsOf("a # b\n# c\nd", {.comments = true}),
              ElementsAre(ElementsAre("a"), ElementsAre(), ElementsAre("d")));
  EXPECT_THAT(wordsOf("a#b", {.comments = true}), ElementsAre(ElementsAre("a#b")))
      << "within a name it is a letter";
  TextScanner in("3#4", "f", {.comments = true});
  in.nextLine();
  EXPECT_EQ(in.number("n"), 3);
  EXPECT_TRUE(in.atLineEnd());
}

TEST(TextScanner, ContinuedLinesAreOne) {
  EXPECT_THAT(wordsOf("a \\\nb \\\r\n c\nd", {.continued = true}),
              ElementsAre(ElementsAre("a", "b", "c"), ElementsAre("d")));
}

TEST(TextScanner, NumbersDoNotDependOnTheLocale) {
  const std::string old = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (!std::setlocale(LC_ALL, name)) continue;
    TextScanner in("1.5 -2.25e2 +0.125 1e-400 nan", "f");
    in.nextLine();
    EXPECT_EQ(in.number("n"), 1.5) << name;
    EXPECT_EQ(in.number("n"), -225) << name;
    EXPECT_EQ(in.number("n"), 0.125) << name;
    EXPECT_EQ(in.number("n"), 0) << name << ": too small for a double";
    EXPECT_TRUE(std::isnan(in.number("n"))) << name;
  }
  std::setlocale(LC_ALL, old.c_str());
}

TEST(TextScanner, ADecimalCommaIsUnderstoodAndAListIsNot) {
  TextScanner in("1,5 -0,25e1 1,2,3", "f");
  in.nextLine();
  EXPECT_EQ(in.number("n"), 1.5);
  EXPECT_EQ(in.number("n"), -2.5);
  EXPECT_THROW(in.number("n"), InputError);
}

TEST(TextScanner, NaNIsANumberHoweverItIsWritten) {
  TextScanner in("nan -nan(ind) -1.#IND 1.#QNAN00 1.#IN", "f");
  in.nextLine();
  for (int n = 0; n < 4; ++n) EXPECT_TRUE(std::isnan(in.number("n"))) << n;
  EXPECT_EQ(in.tryNumber(), std::nullopt);
}

TEST(TextScanner, WordsThatAreNoNumbersStayToBeTaken) {
  TextScanner in("red 1e999 7", "f");
  in.nextLine();
  EXPECT_EQ(in.tryNumber(), std::nullopt);
  EXPECT_EQ(in.word(), "red");
  EXPECT_EQ(in.tryNumber(), std::nullopt);
  EXPECT_EQ(in.peekWord(), "1e999");
  EXPECT_THROW(in.number("n"), InputError);
  in.word();
  EXPECT_EQ(in.tryNumber(), 7);
  EXPECT_EQ(in.tryNumber(), std::nullopt) << "the line has ended";
}

}  // namespace
}  // namespace exemplar
