// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Where files are read and written: full disks, pipes, folders, links, odd names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>

#include "core/file.h"
#include "mesh/image.h"
#include "tests/apps/run_command.h"
#include "tests/file_size_limit.h"

namespace exemplar {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kBox =
    "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 1\nv 4 0 1\nv 4 2 1\nv 0 2 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// One line, status 2.
void expectRefused(const CommandResult& run, const std::string& says) {
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_THAT(run.err, HasSubstr(says));
  const std::size_t at = run.err.find("exemplar: ");
  ASSERT_NE(at, std::string::npos) << run.err;
  EXPECT_EQ(run.err.find('\n', at), run.err.size() - 1) << run.err;
}

TEST(Places, AFullDiskIsSaidForEveryKindOfFileAndLeavesNone) {
  const TestFolder folder;
  writeFile(folder / "e.obj", kBox);
  const std::string synth = "synth e.obj --resolution 16 --samples 1 ";
  for (const std::string name : {"o.obj", "o.glb", "o.gltf", "o.ply", "o.stl", "o.off", "o.vdb"}) {
    SCOPED_TRACE(name);
    CommandResult run;
    {
      const FileSizeLimit limit(1500);
      run = runExemplar(synth + "-q -o " + name, folder.path());
    }
    expectRefused(run, "cannot be written: File too large");
    EXPECT_EQ(folder.files(), "e.obj");
  }
  // What was written before stays, and is whole.
  for (const std::string option :
       {"--preview o.png --picture-size 800x600", "--report o.html --picture-size 64x48"}) {
    SCOPED_TRACE(option);
    ASSERT_EQ(runExemplar(synth + "-o o.stl", folder.path()).status, 0);
    const std::string whole = readFile(folder / "o.stl");
    fs::remove(folder / "o.stl");
    CommandResult run;
    {
      const FileSizeLimit limit(whole.size());
      // The mesh is the smallest of them.
      run = runExemplar(synth + "-q -o o.stl " + option, folder.path());
    }
    expectRefused(run, "cannot be written: File too large");
    EXPECT_EQ(folder.files(), "e.obj o.stl");
    EXPECT_EQ(readFile(folder / "o.stl"), whole);
  }
}

TEST(Places, FoldersAndPipesAreNoFiles) {
  const TestFolder folder;
  writeFile(folder / "e.obj", kBox);
  fs::create_directory(folder / "d.obj");
  ASSERT_EQ(mkfifo((folder / "p.obj").c_str(), 0600), 0);
  expectRefused(runExemplar("synth d.obj -o o.obj", folder.path()), "d.obj: is a folder");
  expectRefused(runExemplar("synth p.obj -o o.obj", folder.path()), "p.obj: is not a regular file");
  expectRefused(runExemplar("synth e.obj -o d.obj", folder.path()),
                "d.obj: cannot be written: it is a folder");
  expectRefused(runExemplar("synth e.obj -o p.obj", folder.path()),
                "p.obj: cannot be written: it is not a regular file");
  EXPECT_EQ(folder.files(), "d.obj e.obj p.obj");
}

TEST(Places, OutputsFollowLinks) {
  const TestFolder folder;
  writeFile(folder / "e.obj", kBox);
  fs::create_directory(folder / "there");
  fs::create_symlink("there/o.stl", folder / "o.stl");
  ASSERT_EQ(runExemplar("synth e.obj -o o.stl --resolution 16", folder.path()).status, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "o.stl"));
  EXPECT_TRUE(fs::is_regular_file(folder / "there" / "o.stl"));
  // Through a link, too, nothing overwrites what is read.
  fs::create_symlink("e.obj", folder / "l.obj");
  expectRefused(runExemplar("synth e.obj -o l.obj --resolution 16", folder.path()), "l.obj");
  EXPECT_EQ(readFile(folder / "e.obj"), kBox);
}

/// A mesh's own library and pictures are read, too.
TEST(Places, WhatAnExampleNamesIsNotOverwritten) {
  const TestFolder folder;
  std::string named = kBox;
  named.insert(0, "mtllib o.mtl\nusemtl wood\n");
  writeFile(folder / "e.obj", named);
  const std::string library = "newmtl wood\nKd 1 0 0\nmap_Kd p_wood.png\n";
  writeFile(folder / "o.mtl", library);
  writePng(folder / "p_wood.png", Image8{1, 1, 3, {9, 99, 199}});
  const std::string picture = readFile(folder / "p_wood.png");
  for (const char* command : {"synth", "mesh"}) {
    const std::string run = std::string(command) + " e.obj --resolution 16 -o ";
    expectRefused(runExemplar(run + "o.obj", folder.path()), "would overwrite o.mtl");
    expectRefused(runExemplar(run + "p.obj", folder.path()), "would overwrite p_wood.png");
    EXPECT_EQ(runExemplar(run + "made.obj", folder.path()).status, 0);
  }
  EXPECT_EQ(readFile(folder / "o.mtl"), library);
  EXPECT_EQ(readFile(folder / "p_wood.png"), picture);
}

TEST(Places, NamesMayHaveSpacesQuotesAndUmlauts) {
  const TestFolder folder;
  const std::string name = "Grüße – aus $HOME \"1\".obj";
  writeFile(folder / name, kBox);
  const auto run = runExemplar("synth '" + name +
                                   "' -o 'Größe é.glb' --preview 'a b.png' --stats 'ß.json' "
                                   "--resolution 16 --samples 1 --picture-size 32x32",
                               folder.path());
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* made : {"Größe é.glb", "a b.png", "ß.json"})
    EXPECT_TRUE(fs::exists(folder / made)) << made;
  EXPECT_THAT(readFile(folder / "ß.json"), HasSubstr("Grüße – aus $HOME \\\"1\\\".obj"));
  EXPECT_EQ(runExemplar("info 'Größe é.glb'", folder.path()).status, 0);
}

}  // namespace
}  // namespace exemplar
