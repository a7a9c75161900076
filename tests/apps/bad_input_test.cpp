// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Bad input gets one clear line and exit status 2, never a crash, never a file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/file.h"
#include "mesh/mesh_file.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct BadInput {
  const char* name;       ///< of the test
  const char* file;       ///< the example's name
  const char* content;    ///< of the example
  const char* arguments;  ///< after `synth FILE`
  const char* says;       ///< in the error
};

void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n";

class BadInputTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, GetsOneLineAndStatusTwoAndNoFile) {
  const TestFolder folder;
  const BadInput& bad = GetParam();
  std::ofstream(folder / bad.file, std::ios::binary) << bad.content;
  const auto result =
      runExemplar(std::string("synth ") + bad.file + " " + bad.arguments, folder.path());
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_THAT(result.err, HasSubstr(bad.says));
  const std::string last = result.err.substr(result.err.find("exemplar: "));
  EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << result.err;
  EXPECT_EQ(folder.files(), bad.file);
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, BadInputTest,
    testing::Values(
        BadInput{"EmptyFile", "e.obj", "", "-o o.obj", "e.obj: the file is empty"},
        BadInput{"NoTriangles", "e.obj", "v 0 0 0\n", "-o o.obj", "e.obj"},
        BadInput{"NaN", "e.obj", "v 0 nan 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n", "-o o.obj", "e.obj"},
        BadInput{"Infinite", "e.obj", "v 0 inf 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n", "-o o.obj",
                 "e.obj"},
        BadInput{"MissingVertex", "e.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "-o o.obj", "e.obj:3"},
        BadInput{"TruncatedGlb", "e.glb", "glTF\2", "-o o.obj", "e.glb"},
        BadInput{"TruncatedStl", "e.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0",
                 "-o o.obj", "e.stl"},
        BadInput{"NotAVdb", "e.vdb", "not a grid", "-o o.obj", "e.vdb"},
        BadInput{"NotAPng", "e.png", "not a picture", "-o o.obj", "e.png"},
        BadInput{"ShortPgm", "e.pgm", "P2 3 3 255\n1 2 3", "-o o.obj", "e.pgm"},
        BadInput{"BadScene", "e.toml", "kind = \"unheard of\"\n", "-o o.obj", "e.toml"},
        BadInput{"BrokenToml", "e.toml", "kind = = 3\n", "-o o.obj", "e.toml"},
        BadInput{"UnknownKind", "e.xyz", "1 2 3", "-o o.obj", "e.xyz: not a kind of example"},
        BadInput{"UnknownOutput", "e.obj", kTriangle, "-o o.xyz", "o.xyz"},
        BadInput{"NoSuchFolder", "e.obj", kTriangle, "-o no/o.obj", "no/o.obj: cannot be written"},
        BadInput{"PreviewNotPng", "e.obj", kTriangle, "-o o.obj --preview p.jpg", "p.jpg"},
        BadInput{"ZeroScale", "e.obj", kTriangle, "-o o.obj --scale 0,1,1", "--scale 0,1,1"},
        BadInput{"NegativeScale", "e.obj", kTriangle, "-o o.obj --scale=-2", "--scale -2"},
        BadInput{"TwoScales", "e.obj", kTriangle, "-o o.obj --scale 2,2", "--scale 2,2"},
        BadInput{"EndlessScale", "e.obj", kTriangle, "-o o.obj --scale inf", "--scale inf"},
        BadInput{"HugeScale", "e.obj", kTriangle, "-o o.obj --scale 500", "--scale"},
        BadInput{"HugeResult", "e.obj", kTriangle, "-o o.obj --scale 400", "memory"},
        BadInput{"HugeResolution", "e.obj", kTriangle, "-o o.obj --resolution 99999",
                 "--resolution"},
        BadInput{"UnknownMethod", "e.obj", kTriangle, "-o o.obj --method magic", "--method"},
        BadInput{"BadView", "e.obj", kTriangle, "-o o.obj --preview p.png --view sideways",
                 "sideways"},
        BadInput{"BadPictureSize", "e.obj", kTriangle, "-o o.obj --preview p.png --size 0x9",
                 "--size 0x9"}),
    [](const auto& test) { return test.param.name; });

TEST(BadCommand, MissingFileIsNamed) {
  const TestFolder folder;
  const auto result = runExemplar("synth none.obj -o o.obj", folder.path());
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("none.obj: no such file"));
}

TEST(BadCommand, WhatWasProbablyMeantIsSaid) {
  const TestFolder folder;
  writeFile(folder / "wall.obj", kTriangle);
  for (const auto& [arguments, says] : {
           std::pair{"frobnicate", "frobnicate: no such command, and no example"},
           {"sinth e.obj", "did you mean synth?"},
           {"wall.obj",
            "wall.obj: say what to do with it: exemplar synth wall.obj -o wall_more.obj"},
           {"chainmail", "chainmail: say what to do with it: exemplar synth chainmail -o"},
           {"--frobnicate", "--frobnicate"},
           {"synth e.obj -o o.obj --frobnicate", "--frobnicate: exemplar synth has no such option"},
           {"synth e.obj -o o.obj --sacle 2",
            "--sacle: exemplar synth has no such option; did you mean --scale?"},
           {"render e.obj -o o.png --veiw=top", "did you mean --view?"},
           {"synth e.obj", "--output is required"},
           {"synth chainmial -o o.obj", "or the scene chainmail"},
       }) {
    const auto run = runExemplar(arguments, folder.path());
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr(says)) << arguments;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
  }
}

/// The lines that are longer than 80 columns.
std::string tooLong(const std::string& text) {
  std::istringstream lines(text);
  std::string found;
  for (std::string line; std::getline(lines, line);)
    if (line.size() > 80) found += line + "\n";
  return found;
}

/// The words of the examples at the end of a help that have the form of options.
std::vector<std::vector<std::string>> optionsOfExamples(const std::string& help) {
  std::vector<std::vector<std::string>> examples;
  std::istringstream lines(help.substr(std::min(help.find("Examples:"), help.size())));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  exemplar ")) continue;
    examples.emplace_back();
    std::istringstream words(line);
    for (std::string word; words >> word;)
      if (word.size() > 1 && word[0] == '-') examples.back().push_back(word);
  }
  return examples;
}

TEST(BadCommand, EveryHelpFitsEightyColumnsAndHasThreeExamplesOfItsOptions) {
  const TestFolder folder;
  for (const std::string command :
       {"", "synth ", "sdf ", "mesh ", "render ", "scene ", "voxelize ", "info ", "engines ",
        "measure ", "compare ", "completion ", "world ", "world init ", "world index "}) {
    SCOPED_TRACE(command);
    const std::string brief = runExemplar(command + "--help", folder.path()).out;
    const std::string whole = runExemplar(command + "--help-all", folder.path()).out;
    EXPECT_EQ(tooLong(brief) + tooLong(whole), "");
    const auto examples = optionsOfExamples(brief);
    EXPECT_GE(examples.size(), 3u);
    if (command.empty() || command.starts_with("world")) continue;  // examples of other commands
    for (const auto& options : examples)
      for (const std::string& option : options) EXPECT_THAT(whole, HasSubstr("  " + option));
  }
  EXPECT_EQ(tooLong(std::string(80, 'x') + "\n" + std::string(81, 'y')),
            std::string(81, 'y') + "\n");
}

TEST(BadCommand, HelpAloneIsBriefAndHelpAllListsEveryOption) {
  const TestFolder folder;
  EXPECT_EQ(runExemplar("", folder.path()).out, runExemplar("--help", folder.path()).out);
  const std::string brief = runExemplar("synth --help", folder.path()).out;
  const std::string whole = runExemplar("synth --help-all", folder.path()).out;
  EXPECT_THAT(brief, AllOf(HasSubstr("Examples:"), HasSubstr("-s, --scale X,Y,Z"),
                           Not(HasSubstr("--completeness"))));
  EXPECT_THAT(whole, HasSubstr("--completeness"));
}

TEST(BadCommand, ThreeNumbersMayBeThreeWords) {
  const TestFolder folder;
  writeFile(folder / "e.txt", "one\ntwo\nthree\n2 2 1\n\n1 1\n1 1\n");
  EXPECT_EQ(runExemplar("synth e.txt -o o.txt --size 4 3 1", folder.path()).status, 0);
  EXPECT_EQ(runExemplar("synth e.txt -o s.txt -s 2,1.5,1", folder.path()).status, 0);
  EXPECT_EQ(readFile(folder / "o.txt"), readFile(folder / "s.txt"));
}

TEST(BadCommand, HelpAndVersionAreStatusZero) {
  const TestFolder folder;
  EXPECT_EQ(runExemplar("--help", folder.path()).status, 0);
  EXPECT_THAT(runExemplar("synth --help", folder.path()).out, HasSubstr("--scale"));
  EXPECT_EQ(runExemplar("--version", folder.path()).status, 0);
}

TEST(BadCommand, AFullDiskLeavesNoFile) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TestFolder folder;
  const auto result = runExemplar("scene chainmail -o /dev/full", folder.path());
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("/dev/full"));
}

TEST(BadInput, OptionsAreCheckedBeforeAFileIsRead) {
  const TestFolder folder;
  // None of the files is there; what is wrong with the options is said all the same.
  for (const auto& [command, says] : std::vector<std::pair<std::string, std::string>>{
           {"synth no.obj -o o.ply --scale 2x2x1", "--scale 2x2x1"},
           {"synth no.obj -o o.ply --scale 2 --size 9", "--size and --scale"},
           {"synth no.obj -o o.ply --padding x", "--padding x"},
           {"synth no.obj -o o.ply --padding 1,2", "--padding 1,2"},
           {"synth no.obj -o o.ply --padding 0,4,2000", "--padding 0,4,2000"},
           {"synth no.obj -o o.ply --scatter --padding 2", "--scatter and --padding"},
           {"synth no.obj -o o.ply --align left", "--align left"},
           {"synth no.obj -o o.ply --resolution automatic", "4 to 4096 samples, or auto"},
           {"synth no.obj -o o.ply --seed -1", "--seed -1"},
           {"synth no.obj -o o.ply --seed 18446744073709551616", "--seed 18446744073709551616"},
           {"synth no.obj -o o.ply --guide-weight 2", "--guide-weight"},
           {"synth no.obj -o o.ply --mix 0.5", "--mix 0.5: there is no second example"},
           {"synth no.obj -o o.ply --with two.obj --mix 1.5", "expected shares of 0 to 1"},
           {"synth no.obj -o o.ply --with two.obj --mix 0.2,0.2", "expected 1 share"},
           {"synth no.obj -o o.ply --with two.obj --mix-map no.png", "no.png: no such file"},
           {"synth no.obj -o o.ply --engine quilting --mix 0.5", "--mix"},
           {"synth no.obj -o o.ply --keep grid.txt", "grid.txt: no such file"},
           {"synth no.obj -o o.ply --surface copy --triangles 9", "--triangles"},
           {"synth no.obj -o o.ply --surface copy --with two.obj", "--surface copy"},
           {"synth no.obj -o o.ply --engine blocks --block 7", "--block 7"},
           {"synth no.obj -o o.ply --engine model --cell 2 --resolution 9",
            "--cell and --resolution"},
           {"synth no.obj -o o.ply --engine model --weight wall=-1", "--weight wall=-1"},
           {"synth no.obj -o o.ply --engine model --side up=free", "--side up=free"},
           {"synth no.obj -o o.ply --engine model --count wall=many", "--count wall=many"},
           {"synth no.obj -o o.ply --engine model --loop", "--loop"},
           {"synth no.obj -o o.ply --engine model --pin 5,0,0=wall --size 4,4,1", "--pin 5,0,0"},
           {"synth no.obj -o o.ply --engine model --instances", "--instances"},
           {"synth no.obj -o o.gif --engine model", "--frames"},
           {"sdf no.obj -o o.vdb --padding 1,x,2", "--padding 1,x,2"},
           {"measure no.obj o.obj --scale 2 --origins a.vdb", "--scale"},
           {"voxelize no.obj -o o.vox --cell 1 --resolution 4", "--cell and --resolution"},
           {"compare no.obj -o dir --scale q", "--scale q"}}) {
    const auto result = runExemplar(command, folder.path());
    EXPECT_EQ(result.status, 2) << command;
    EXPECT_THAT(result.err, testing::HasSubstr(says)) << command;
    EXPECT_THAT(result.err, testing::Not(testing::HasSubstr("no.obj: no such file"))) << command;
  }
  EXPECT_EQ(folder.files(), "");
}

}  // namespace
}  // namespace exemplar
