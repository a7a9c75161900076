// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The rows of docs/gallery, which scripts/gallery.sh makes: each panel is filled by what it shows.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/file.h"
#include "tests/preview/panels.h"

namespace exemplar {
namespace {

/// The names in `rows=(...)` of scripts/gallery.sh.
std::vector<std::string> rowNames() {
  const std::string script =
      readFile(std::filesystem::path(EXEMPLAR_SOURCE_DIR) / "scripts/gallery.sh");
  const std::size_t begin = script.find("rows=(");
  std::vector<std::string> names;
  std::string name;
  for (std::size_t at = begin + 6; begin != script.npos && script[at] != ')'; ++at) {
    if (std::isspace(static_cast<unsigned char>(script[at])) == 0) {
      name += script[at];
    } else if (!name.empty()) {
      names.push_back(std::exchange(name, {}));
    }
  }
  if (!name.empty()) names.push_back(name);
  return names;
}

TEST(Gallery, EachPanelOfARowIsFilled) {
  const std::vector<std::string> names = rowNames();
  ASSERT_GE(names.size(), 15u);
  double least = 1, sum = 0;
  int count = 0;
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const std::filesystem::path path =
        std::filesystem::path(EXEMPLAR_SOURCE_DIR) / "docs/gallery" / (name + ".png");
    EXPECT_LE(std::filesystem::file_size(path), 400u << 10);
    const std::vector<Panel> panels = panelsOf(decodeImage(readFile(path), name));
    EXPECT_GE(panels.size(), 2u);
    for (const Panel& panel : panels) {
      EXPECT_GT(panel.filled(), 0.6);
      least = std::min(least, panel.filled());
      sum += panel.filled();
      ++count;
    }
  }
  std::printf("%d panels, filled to %.2f in the mean and %.2f at least\n", count, sum / count,
              least);
}

}  // namespace
}  // namespace exemplar
