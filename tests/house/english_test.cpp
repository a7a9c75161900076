// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// One spelling (American, as the field's terms are: neighbor, color) and the field's own words.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// What is written otherwise here, in any case, and what is written instead. `stem` is in all that
/// `pattern` matches: it is found much sooner.
struct Word {
  const char* stem;
  const char* pattern;
  const char* instead;
};
constexpr Word kWords[] = {
    {"neighbour", "neighbour", "neighbor"},
    {"colour", "colour", "color"},
    {"grey", "\\bgrey", "gray"},
    {"centre", "\\bcentre", "center"},
    {"metre", "\\b(milli|centi|kilo)?metres?\\b", "meter"},
    {"behaviour", "behaviour", "behavior"},
    {"honour", "honour", "honor"},
    {"licence", "licence", "license"},
    {"labell", "labell(ed|ing)", "labeled, labeling"},
    {"modell", "modell(ed|ing)", "modeled, modeling"},
    {"is",
     "\\b(optim|synthes|quant|normal|vector|recogn|organ|discret|parallel|visual|minim|maxim|"
     "initial|general|special|random|local|summar|serial)is(e[ds]?|ing|ation)\\b",
     "-ize"},
    {"tell", "\\btells?\\b", "says, reports"},
    {"told", "\\btold\\b", "said, specified, reported"},
    {"stand", "\\bstands? (beside|there|in|at|where|side|still)\\b", "is"},
    {"to nothing", "\\b(came|comes?) to nothing\\b", "fails"},
};

/// "FILE:LINE: word" for each word of the list in a text.
std::vector<std::string> wordsOf(std::istream& text, const std::string& name) {
  static const std::vector<std::regex> patterns = [] {
    std::vector<std::regex> all;
    for (const Word& word : kWords) all.emplace_back(word.pattern, std::regex::optimize);
    return all;
  }();
  std::vector<std::string> found;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    for (char& c : line)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    for (std::size_t n = 0; n < patterns.size(); ++n) {
      std::smatch match;
      if (line.find(kWords[n].stem) != line.npos && std::regex_search(line, match, patterns[n]))
        found.push_back(name + ":" + std::to_string(number) + ": '" + match.str() + "'; write " +
                        kWords[n].instead);
    }
  }
  return found;
}

TEST(English, IsAmericanAndTheFieldsOwn) {
  int files = 0;
  const fs::path root = EXEMPLAR_SOURCE_DIR;
  for (auto entry = fs::recursive_directory_iterator(root);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = fs::relative(entry->path(), root).string();
    if (name == "build" || name == "out" || name == ".git" || name == "tests/fuzz/corpus" ||
        name == "LICENSES" || entry->path().filename() == "node_modules") {
      entry.disable_recursion_pending();
      continue;
    }
    const std::string ending = entry->path().extension().string();
    const bool source = ending == ".h" || ending == ".cpp" || ending == ".md" || ending == ".js" ||
                        ending == ".sh" || ending == ".cmake" || ending == ".txt";
    // This file has all of these words.
    if (!source || name == "tests/house/english_test.cpp") continue;
    ++files;
    std::ifstream text(entry->path());
    for (const std::string& word : wordsOf(text, name)) ADD_FAILURE() << word;
  }
  EXPECT_GT(files, 300);
}

TEST(English, AWordOfTheListIsFound) {
  std::istringstream text("a fine day\nNeighbours tell of colours\n");
  EXPECT_EQ(wordsOf(text, "f").size(), 3u);
}

}  // namespace
