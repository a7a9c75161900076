// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// The page of one result: exemplar synth --report and exemplar measure --report. What it shows is
// tested in a browser (tests/report/browser).

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

class ReportOption : public testing::Test {
 protected:
  ReportOption() {
    std::string pgm = "P2\n24 24\n255\n";
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x)
        pgm += std::to_string(40 + 5 * std::abs(x % 8 - 4) + 4 * std::abs(y % 8 - 3)) + "\n";
    writeFile(folder_ / "hills.pgm", pgm);
  }
  CommandResult run(const std::string& line) const { return runExemplar(line, folder_.path()); }
  /// What a page says.
  json read(const std::string& name) const {
    const std::string page = readFile(folder_ / name);
    const std::string open = "id=\"report\">";
    const std::size_t at = page.find(open) + open.size();
    return json::parse(page.substr(at, page.find("</script>", at) - at));
  }

  const std::string units_ = " --cell-size 1 --height-scale 0.2 ";
  TestFolder folder_;
};

TEST_F(ReportOption, OfSynthSaysWhatTheRunWas) {
  const CommandResult outcome =
      run("synth hills.pgm -o more.vdb --origins from.vdb --report r.html --method blocks --seed 5 "
          "--scale 1,1,1 --size 60x40 --samples 1" +
          units_);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json report = read("r.html");
  EXPECT_EQ(report.at("kind"), "result");
  EXPECT_EQ(report.at("title"), "hills");
  const json& made = report.at("runs").at(0);
  EXPECT_EQ(made.at("engine"), "blocks");
  EXPECT_EQ(made.at("seed"), 5);
  EXPECT_TRUE(made.at("marks").is_array());
  EXPECT_TRUE(made.at("figures").at("seams").at("seam_jump").is_number());

  // And measure says the same of the files.
  ASSERT_EQ(run("measure hills.pgm more.vdb --origins from.vdb --report m.html --size 60x40 "
                "--samples 1 --json m.json" +
                units_)
                .status,
            0);
  const json measured = read("m.html").at("runs").at(0);
  EXPECT_EQ(measured.at("figures"), json::parse(readFile(folder_ / "m.json")));
  EXPECT_EQ(measured.at("figures").at("seams"), made.at("figures").at("seams"));
  EXPECT_EQ(measured.at("marks"), made.at("marks"));
}

TEST_F(ReportOption, WithoutOriginsHasNoMarks) {
  ASSERT_EQ(run("measure hills.pgm hills.pgm --report m.html --size 60x40 --samples 1 -q" + units_)
                .status,
            0);
  const json report = read("m.html");
  EXPECT_EQ(report.at("has_origins"), false);
  EXPECT_FALSE(report.at("runs").at(0).contains("marks"));
}

TEST_F(ReportOption, IsRefusedBeforeAnyWork) {
  for (const std::string command :
       {"synth hills.pgm --engine geometry -o more.vdb", "measure hills.pgm hills.pgm",
        "synth hills.pgm --engine model -o more.obj"}) {
    const CommandResult outcome = run(command + " --report page.pdf");
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_THAT(outcome.err, HasSubstr(".html"));
    const CommandResult nowhere = run(command + " --report nowhere/page.html");
    EXPECT_EQ(nowhere.status, 2) << command;
    EXPECT_THAT(nowhere.err, HasSubstr("nowhere/page.html: cannot be written"));
  }
  EXPECT_THAT(folder_.files(), Not(HasSubstr("more")));
}

}  // namespace
}  // namespace exemplar
