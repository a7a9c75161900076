// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Ctrl-C at several moments of the real command: status 4, one line, and no file that is not whole.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/random.h"
#include "tests/apps/run_command.h"

namespace exemplar {
namespace {

using nlohmann::json;
using testing::StartsWith;

std::string scene(const std::string& name) {
  return std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/" + name + ".toml";
}

/// Triangles in all directions, which cross: the sign of each sample is work.
void writeTangle(const std::filesystem::path& path, int triangles) {
  const Random random(1);
  std::ofstream out(path);
  for (int t = 0; t < triangles; ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      out << "v";
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::uint64_t>(t);
        const auto draw = static_cast<std::uint32_t>(3 * (corner + 1)) + axis;
        out << " " << 10 * random.uniform(cell, axis) + random.uniform(cell, draw);
      }
      out << "\n";
    }
  }
  for (int t = 0; t < triangles; ++t)
    out << "f " << 3 * t + 1 << " " << 3 * t + 2 << " " << 3 * t + 3 << "\n";
}

/// The events of `--progress json`, which must all be JSON.
std::vector<json> eventsOf(const std::string& text) {
  std::vector<json> events;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    events.push_back(json::parse(line, nullptr, false));
    EXPECT_FALSE(events.back().is_discarded()) << line;
  }
  return events;
}

/// Interrupts the command at moments up to a second after it began; returns how often it heard.
int interruptOften(const std::vector<std::string>& arguments, const TestFolder& folder,
                   const std::string& inputs) {
  int heard = 0;
  for (const int after : {0, 20, 60, 120, 250, 500, 1000}) {
    SCOPED_TRACE(after);
    const int signal = after % 40 == 0 ? SIGTERM : SIGINT;
    const CommandResult run =
        interruptExemplar(arguments, folder.path(), signal, std::chrono::milliseconds(after));
    const std::vector<json> events = eventsOf(run.err);
    EXPECT_EQ(events.front().at("event"), "start");
    double fraction = 0;
    for (const json& event : events) {
      if (event.at("event") != "progress") continue;
      EXPECT_GE(event.at("fraction"), fraction);
      fraction = event.at("fraction");
    }
    if (run.status == 0) {  // it was quicker
      EXPECT_EQ(events.back().at("event"), "done");
      for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        if (entry.path().filename() != inputs) std::filesystem::remove(entry.path());
      continue;
    }
    ++heard;
    EXPECT_EQ(run.status, 4) << run.err;
    EXPECT_EQ(events.back().at("event"), "error");
    EXPECT_EQ(events.back().at("status"), 4);
    EXPECT_THAT(events.back().at("text").get<std::string>(), StartsWith("interrupted; "));
    // Files that it says it has written are whole; there are no others.
    std::string written;
    for (const json& event : events)
      if (event.at("event") == "file") written += event.at("path").get<std::string>() + " ";
    if (written.empty()) {
      EXPECT_EQ(folder.files(), inputs);
      EXPECT_EQ(events.back().at("text"), "interrupted; no file was written");
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      if (entry.path().filename() != inputs) std::filesystem::remove(entry.path());
  }
  return heard;
}

TEST(Interrupt, WhileAnExampleIsSampled) {
  const TestFolder folder;
  writeTangle(folder / "e.obj", 400);
  EXPECT_GT(
      interruptOften({"synth", "e.obj", "-o", "o.obj", "--resolution", "96"}, folder, "e.obj"), 3);
}

TEST(Interrupt, OfGeometrySynthesis) {
  const TestFolder folder;
  EXPECT_GT(
      interruptOften({"synth", scene("balls"), "-o", "o.glb", "--preview", "o.png"}, folder, ""),
      3);
}

TEST(Interrupt, OfDetailAndBlocks) {
  const TestFolder folder;
  EXPECT_GT(interruptOften({"synth", scene("balls"), "--engine", "blocks", "--resolution", "32",
                            "--detail", "3", "-o", "o.ply"},
                           folder, ""),
            3);
}

TEST(Interrupt, OfModelSynthesisAndItsMesh) {
  const TestFolder folder;
  EXPECT_GT(
      interruptOften({"synth", scene("castle"), "--size", "300,300,12", "-o", "o.glb"}, folder, ""),
      3);
}

TEST(Interrupt, OfAComparisonSaysWhatIsInTheFolder) {
  const TestFolder folder;
  const CommandResult run = interruptExemplar(
      {"compare", scene("chainmail"), "-o", ".", "--engines", "geometry", "--resolution", "32",
       "--size", "40x30", "--samples", "1", "--seeds", "50"},
      folder.path(), SIGINT, std::chrono::milliseconds(2500));
  EXPECT_EQ(run.status, 4);
  const std::string text = eventsOf(run.err).back().at("text");
  EXPECT_EQ(text.find("no file was written") != text.npos, folder.files().empty()) << text;
}

TEST(Interrupt, OfAPicture) {
  const TestFolder folder;
  EXPECT_GT(
      interruptOften({"render", scene("chainmail"), "-o", "o.png", "--samples", "512"}, folder, ""),
      3);
}

}  // namespace
}  // namespace exemplar
