// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/encode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace exemplar {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Deflated, ComesBack) {
  std::string text(100000, 'a');
  for (std::size_t n = 0; n < text.size(); n += 7) text[n] = static_cast<char>(n);
  const std::string packed = deflated(text);
  EXPECT_LT(packed.size(), text.size());
  std::string back(text.size(), '\0');
  uLongf size = back.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(back.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(size, text.size());
  EXPECT_EQ(back, text);
}

TEST(EscapedHtml, LeavesNothingThatCouldBeMarkup) {
  EXPECT_EQ(escapedHtml("a<b>&\"c'"), "a&lt;b&gt;&amp;&quot;c&#39;");
  EXPECT_EQ(escapedHtml("schön – 岩"), "schön – 岩");
}

TEST(EscapedHtml, ReplacesWhatIsNotText) {
  const std::string replacement = "\xEF\xBF\xBD";
  EXPECT_EQ(escapedHtml(std::string_view("a\0b", 3)), "a" + replacement + "b");
  EXPECT_EQ(escapedHtml("\xff.obj"), replacement + ".obj");
  EXPECT_EQ(escapedHtml("\xc0\xaf"), replacement + replacement);                    // overlong
  EXPECT_EQ(escapedHtml("\xed\xa0\x80"), replacement + replacement + replacement);  // a surrogate
  EXPECT_EQ(escapedHtml("\xe5\xb2"), replacement + replacement);                    // cut off
  EXPECT_EQ(escapedHtml("a\tb\n"), "a\tb\n");
}

TEST(EscapedJson, CannotEndAScriptAndMeansTheSame) {
  const nlohmann::json value = {{"</script><script>alert(1)//", "<!--&\xE2\x80\xA8\xE2\x80\xA9>"},
                                {"plain", 1.5}};
  const std::string safe = escapedJson(value.dump());
  EXPECT_THAT(safe, Not(HasSubstr("<")));
  EXPECT_THAT(safe, Not(HasSubstr(">")));
  EXPECT_THAT(safe, Not(HasSubstr("&")));
  EXPECT_THAT(safe, Not(HasSubstr("\xE2\x80\xA8")));
  EXPECT_EQ(nlohmann::json::parse(safe), value);
}

}  // namespace
}  // namespace exemplar
