// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Both families on one example: exemplar compare.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

class CompareCommand : public testing::Test {
 protected:
  // Hills that repeat every eight samples: model synthesis knows how to go on.
  CompareCommand() {
    std::string pgm = "P2\n32 32\n255\n";
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        pgm += std::to_string(40 + 5 * std::abs(x % 8 - 4) + 4 * std::abs(y % 8 - 3)) + "\n";
    writeFile(folder_ / "hills.pgm", pgm);
  }
  /// The hills as a volume: height maps are compared as terrain.
  std::string hills(int resolution) const {
    const std::string name = "hills" + std::to_string(resolution) + ".vdb";
    if (!fs::exists(folder_ / name)) {
      const CommandResult run =
          runExemplar("sdf hills.pgm --cell-size 1 --height-scale 0.2 -q -o " + name +
                          " --resolution " + std::to_string(resolution),
                      folder_.path());
      EXPECT_EQ(run.status, 0) << run.err;
    }
    return name;
  }
  CommandResult compare(const std::string& more, int resolution = 32) const {
    return runExemplar("compare " + hills(resolution) + " -o made --size 120x90 --samples 1 " +
                           (more.find("--scale") == std::string::npos ? "--scale 2,2,1 " : "") +
                           more,
                       folder_.path());
  }
  fs::path file(const std::string& name) const { return folder_ / "made" / name; }
  json read(const std::string& name) const { return json::parse(readFile(file(name))); }

  TestFolder folder_;
};

TEST_F(CompareCommand, RunsEveryEngineAndSaysWhatItFound) {
  const CommandResult outcome = compare("--seeds 2");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json comparison = read("compare.json");
  ASSERT_EQ(comparison.at("runs").size(), 6u);
  for (const json& run : comparison.at("runs")) {
    SCOPED_TRACE(run.dump(1));
    const std::string name =
        run.at("engine").get<std::string>() + "-" + std::to_string(run.at("seed").get<int>());
    EXPECT_EQ(run.at("status"), "complete");
    EXPECT_TRUE(fs::exists(file(name + ".glb")));
    EXPECT_TRUE(fs::exists(file(name + ".png")));
    EXPECT_TRUE(run.at("figures").at("likeness").at("lp_dense").is_number());
    if (run.at("engine") == "model") {
      EXPECT_EQ(run.at("adjacency_violations"), 0);
    }
  }
}

TEST_F(CompareCommand, SaysHowFarSeedsAreApart) {
  const CommandResult outcome = compare("--seeds 2 --engines blocks,model");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("after the best roll"));
  const json seeds = read("compare.json").at("seeds");
  ASSERT_EQ(seeds.size(), 2u);
  for (const json& engine : seeds) {
    EXPECT_EQ(engine.at("results"), 2);
    EXPECT_LE(engine.at("rolled_diversity"), engine.at("diversity"));
    // Two that are less than a tenth apart are warned of.
    EXPECT_EQ(engine.at("equal").empty(), engine.at("rolled_diversity") >= 0.1);
  }
  EXPECT_THAT(readFile(file("report.html")), HasSubstr("after the best roll"));
}

TEST_F(CompareCommand, SaysWhyAnEngineMadeNothing) {
  // One block along x: the example does not show what could be beside it.
  ASSERT_EQ(compare("--seeds 1 --engines model", 16).status, 0);
  const json run = read("compare.json").at("runs")[0];
  EXPECT_NE(run.at("status"), "complete");
  EXPECT_FALSE(run.at("why").get<std::string>().empty());
  EXPECT_THAT(readFile(file("report.html")), HasSubstr(run.at("status").get<std::string>()));
}

TEST_F(CompareCommand, TakesExamplesTooSmallToMeasure) {
  const CommandResult outcome = compare("--seeds 1 --engines optimize,blocks", 6);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json runs = read("compare.json").at("runs");
  ASSERT_EQ(runs[0].at("status"), "complete");
  // Too few patches for a distribution: null, and the comparison goes on.
  EXPECT_TRUE(runs[0].at("figures").at("likeness").at("fpd").is_null());
  // A block of 16 does not fit, which is a finding.
  EXPECT_EQ(runs[1].at("status"), "refused");
  EXPECT_THAT(runs[1].at("why").get<std::string>(), HasSubstr("`block` 16"));
}

// Such names are rare and legal.
TEST_F(CompareCommand, TakesAnExampleWhoseNameIsNotUtf8) {
  fs::copy_file(folder_ / hills(8), folder_ / "we\xffird.vdb");
  const CommandResult outcome = runExemplar(
      "compare we\xffird.vdb -o made --seeds 1 --engines blocks:block=4 --size 60x40 --samples 1",
      folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(read("compare.json").dump(), HasSubstr("we\xef\xbf\xbdird.vdb"));
}

TEST_F(CompareCommand, MakesADamagedRunAgain) {
  const std::string once = "--seeds 1 --engines blocks:block=4";
  ASSERT_EQ(compare(once, 8).status, 0);
  const fs::path run = file("blocks-block-4-0.json");
  const std::string whole = readFile(run);
  std::string numbers = whole;
  numbers.replace(numbers.find("\"complete\""), 10, "12");
  for (const std::string& damaged :
       {std::string("{"), std::string("[3]"), whole.substr(0, whole.size() / 2), numbers}) {
    writeFile(run, damaged);
    const CommandResult outcome = compare(once, 8);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(json::parse(readFile(run)).at("status"), "complete");
  }
}

TEST_F(CompareCommand, SweepsOverSettings) {
  const CommandResult outcome =
      compare("--seeds 1 --engines blocks:block=8,blocks:block=4:levels=2", 24);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json runs = read("compare.json").at("runs");
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].at("engine"), "blocks:block=8");
  EXPECT_EQ(runs[1].at("engine"), "blocks:block=4:levels=2");
  // The settings were used, and each result is a file of its own.
  EXPECT_NE(readFile(file("blocks-block-8-0.vdb")),
            readFile(file("blocks-block-4-levels-2-0.vdb")));

  for (const char* wrong : {"best", "blocks:", "blocks:block", "blocks:block=", "blocks:patch=7",
                            "blocks:block=x", "model:block=8=9"}) {
    const CommandResult refused = compare(std::string("--seeds 1 --engines ") + wrong);
    EXPECT_EQ(refused.status, 2) << wrong;
    EXPECT_THAT(refused.err, HasSubstr("--engines")) << wrong;
  }
}

TEST_F(CompareCommand, CountsViolationsOfEveryEngine) {
  ASSERT_EQ(compare("--seeds 1").status, 0);
  for (const json& run : read("compare.json").at("runs")) {
    SCOPED_TRACE(run.dump(1));
    const auto pairs = run.at("adjacency_pairs").get<std::int64_t>();
    const auto violations = run.at("adjacency_violations").get<std::int64_t>();
    EXPECT_GT(pairs, 0);
    EXPECT_LE(violations, pairs);
    if (run.at("engine") == "model") {
      EXPECT_EQ(violations, 0);
      EXPECT_EQ(run.at("unknown_blocks"), 0.0);
    }
    EXPECT_GT(run.at("peak_memory_bytes").get<std::int64_t>(), 1'000'000);
  }
}

TEST_F(CompareCommand, TakesAScenesPiecesAsTheyAre) {
  const CommandResult outcome =
      runExemplar("compare " + std::string(EXEMPLAR_SOURCE_DIR) +
                      "/scenes/gears.toml -o made --resolution 24 --seeds 1 --engines model --size "
                      "120x90 --samples 1",
                  folder_.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json run = read("compare.json").at("runs")[0];
  ASSERT_EQ(run.at("status"), "complete");
  EXPECT_GT(run.at("labels"), 10);
  EXPECT_EQ(run.at("adjacency_violations"), 0);
  EXPECT_TRUE(run.at("figures").at("likeness").at("lp_dense").is_number());
  EXPECT_TRUE(fs::exists(file("model-0.glb")));
  EXPECT_FALSE(fs::exists(file("model-0-origins.vdb")));  // pieces have none
}

TEST_F(CompareCommand, NeverMakesAFinishedRunAgain) {
  ASSERT_EQ(compare("--seeds 1 --engines blocks").status, 0);
  const auto made = fs::last_write_time(file("blocks-0.glb"));
  const json before = read("compare.json");
  ASSERT_EQ(compare("--seeds 2 --engines blocks").status, 0);
  EXPECT_EQ(fs::last_write_time(file("blocks-0.glb")), made);
  EXPECT_EQ(read("compare.json").at("runs")[0], before.at("runs")[0]);
  EXPECT_EQ(read("compare.json").at("runs").size(), 2u);

  // Another request, a broken file or a missing one, and it is.
  ASSERT_EQ(compare("--seeds 1 --engines blocks --scale 1").status, 0);
  EXPECT_NE(fs::last_write_time(file("blocks-0.glb")), made);
  writeFile(file("blocks-0.json"), "{");
  EXPECT_EQ(compare("--seeds 1 --engines blocks").status, 0);
  fs::remove(file("blocks-0.glb"));
  EXPECT_EQ(compare("--seeds 1 --engines blocks").status, 0);
  EXPECT_TRUE(fs::exists(file("blocks-0.glb")));
}

TEST_F(CompareCommand, WritesAPageThatStandsAlone) {
  ASSERT_EQ(compare("--seeds 1 --engines blocks,model").status, 0);
  const std::string page = readFile(file("report.html"));
  EXPECT_THAT(page, HasSubstr("data:image/jpeg;base64,/9j/"));
  EXPECT_THAT(page, HasSubstr("lp_dense"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy\" content=\"default-src 'none'"));
  for (const char* elsewhere : {"src=\"http", "href=", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(elsewhere)));
  for (const json& run : read("compare.json").at("runs")) {
    EXPECT_TRUE(run.at("marks").is_array());
    if (run.contains("view")) {
      EXPECT_TRUE(fs::exists(file(run.at("view").get<std::string>())));
    }
  }
}

TEST_F(CompareCommand, RefusesWhatItCannotDo) {
  writeFile(folder_ / "file", "not a folder");
  const auto refused = [](const CommandResult& run, const char* says) {
    EXPECT_EQ(run.status, 2) << says;
    EXPECT_THAT(run.err, HasSubstr(says));
  };
  refused(compare("--seeds 0"), "--seeds");
  refused(compare("--engines best"), "--engines best: --engine best: expected geometry");
  refused(compare("--engines blocks:seed=3"), "is the same for all engines");
  refused(compare("--scale 1,0,1"), "--scale 1,0,1");
  refused(runExemplar("compare " + hills(32) + " -o file", folder_.path()),
          "cannot be made a folder");
  refused(runExemplar("compare none.obj -o made", folder_.path()), "none.obj: no such file");
}

}  // namespace
}  // namespace exemplar
