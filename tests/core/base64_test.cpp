// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/base64.h"

#include <gtest/gtest.h>

namespace exemplar {
namespace {

TEST(Base64, IsWhatTheStandardSays) {
  // RFC 4648, section 10.
  EXPECT_EQ(encodeBase64(""), "");
  EXPECT_EQ(encodeBase64("f"), "Zg==");
  EXPECT_EQ(encodeBase64("fo"), "Zm8=");
  EXPECT_EQ(encodeBase64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encodeBase64(std::string_view("\xff\xfe\x00", 3)), "//4A");
}

TEST(Base64, ComesBack) {
  std::string bytes;
  for (int n = 0; n < 300; ++n) {
    EXPECT_EQ(decodeBase64(encodeBase64(bytes)), bytes);
    bytes += static_cast<char>(n * 37);
  }
  EXPECT_EQ(decodeBase64("Zm8"), "fo");
  EXPECT_EQ(decodeBase64("Zm!8"), std::nullopt);
}

}  // namespace
}  // namespace exemplar
