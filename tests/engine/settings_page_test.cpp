// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/settings_page.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace exemplar {
namespace {

TEST(SettingsPage, IsTheOneInTheDocs) {
  std::ifstream file(std::string(EXEMPLAR_SOURCE_DIR) + "/docs/settings.md");
  const std::string docs{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(docs, settingsPage())
      << "write it anew: exemplar engines --markdown > docs/settings.md";
}

}  // namespace
}  // namespace exemplar
