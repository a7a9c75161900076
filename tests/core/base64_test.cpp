// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/base64.h"

#include <gtest/gtest.h>

namespace exemplar {
namespace {

TEST(Base64, IsWhatTheStandardSays) {
  // RFC 4648, section 10.
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(encodeBase64(bytes), text);
    EXPECT_EQ(decodeBase64(text), bytes);
  }
  EXPECT_EQ(encodeBase64(std::string("\0\xff\x10", 3)), "AP8Q");
}

TEST(Base64, TakesLineEndsAndMissingPaddingAndNothingElse) {
  EXPECT_EQ(decodeBase64("Zm9v\r\nYg"), "foob");
  EXPECT_EQ(decodeBase64("Zm9v?"), std::nullopt);
}

}  // namespace
}  // namespace exemplar
