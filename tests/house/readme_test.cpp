// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The code that README.md shows is code that the tests build and run.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace {

std::string textOf(const std::string& path) {
  std::ifstream file(std::string(EXEMPLAR_SOURCE_DIR) + "/" + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The text with each run of white space as one space: layouts may differ.
std::string words(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool space = c == ' ' || c == '\n';
    if (!space || (!result.empty() && result.back() != ' ')) result += space ? ' ' : c;
  }
  return result;
}

TEST(Readme, ShowsCodeThatIsBuiltAndRun) {
  const std::string readme = textOf("README.md"),
                    program = words(textOf("tests/consumer/program/more_balls.cpp")),
                    lists = words(textOf("tests/consumer/program/CMakeLists.txt"));
  std::size_t begin = readme.find("```cpp\n");
  ASSERT_NE(begin, std::string::npos);
  begin += 7;
  const std::string code = words(readme.substr(begin, readme.find("```", begin) - begin));
  EXPECT_GT(code.size(), 100u);
  EXPECT_NE(program.find(code), std::string::npos) << code;
  EXPECT_EQ(program.find(code + "x"), std::string::npos);
  const std::string find = "find_package(exemplar 0.1 REQUIRED)";
  EXPECT_NE(readme.find(find), std::string::npos);
  EXPECT_NE(lists.find(find), std::string::npos);
}

}  // namespace
