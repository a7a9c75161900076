// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Ctrl-C at several moments of the real command: status 4, one line, and no file that is not whole.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/file.h"
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

/// A run that is interrupted ends after so much CPU time, on all cores.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kMostCpuSeconds = 30;
#else
constexpr double kMostCpuSeconds = 0.3;
#endif

/// Interrupts the command at twenty random moments up to `longest` after it began; returns how
/// often it heard.
int interruptOften(const std::vector<std::string>& arguments, const TestFolder& folder,
                   const std::string& inputs, std::chrono::milliseconds longest) {
  int heard = 0;
  const Random random(5);
  for (std::uint64_t moment = 0; moment < 20; ++moment) {
    const std::chrono::milliseconds after(
        random.below(static_cast<std::uint32_t>(longest.count()), moment));
    SCOPED_TRACE(after.count());
    const int signal = moment % 2 == 0 ? SIGTERM : SIGINT;
    const CommandResult run = interruptExemplar(arguments, folder.path(), signal, after);
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
    EXPECT_LT(run.cpuSeconds, kMostCpuSeconds) << run.err;
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

using namespace std::chrono_literals;

TEST(Interrupt, WhileAnExampleIsSampled) {
  const TestFolder folder;
  writeTangle(folder / "e.obj", 400);
  EXPECT_GT(interruptOften({"synth", "e.obj", "-o", "o.obj", "--resolution", "96"}, folder, "e.obj",
                           1000ms),
            9);
}

TEST(Interrupt, OfGeometrySynthesis) {
  const TestFolder folder;
  EXPECT_GT(interruptOften({"synth", scene("balls"), "-o", "o.glb", "--preview", "o.png"}, folder,
                           "", 1500ms),
            9);
}

TEST(Interrupt, OfDetailAndBlocks) {
  const TestFolder folder;
  EXPECT_GT(interruptOften({"synth", scene("balls"), "--engine", "blocks", "--resolution", "32",
                            "--detail", "3", "-o", "o.ply"},
                           folder, "", 1500ms),
            9);
}

TEST(Interrupt, OfModelSynthesisAndItsMesh) {
  const TestFolder folder;
  EXPECT_GT(interruptOften({"synth", scene("castle"), "--size", "300,300,12", "-o", "o.glb"},
                           folder, "", 1000ms),
            9);
}

TEST(Interrupt, OfAComparisonSaysWhatIsInTheFolder) {
  const TestFolder folder;
  const CommandResult run = interruptExemplar(
      {"compare", scene("chainmail"), "-o", ".", "--engines", "geometry", "--resolution", "32",
       "--size", "40x30", "--samples", "1", "--seeds", "50"},
      folder.path(), SIGINT, 2500ms);
  EXPECT_EQ(run.status, 4);
  const std::string text = eventsOf(run.err).back().at("text");
  EXPECT_EQ(text.find("no file was written") != text.npos, folder.files().empty()) << text;
}

TEST(Interrupt, OfAPicture) {
  const TestFolder folder;
  EXPECT_GT(interruptOften({"render", scene("chainmail"), "-o", "o.png", "--samples", "512"},
                           folder, "", 800ms),
            9);
}

/// What a run has written, by name.
std::map<std::string, std::string> outputsIn(const TestFolder& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().filename() != "e.obj") files[entry.path().filename()] = readFile(entry.path());
  return files;
}

/// How many runs are killed; `scripts/kill_test.sh` asks for more.
int kills() {
  const char* wanted = std::getenv("EXEMPLAR_KILLS");
  return wanted ? std::atoi(wanted) : 40;
}

TEST(Kill, AtAnyMomentLeavesEveryFileWholeOrAbsentAndNothingElse) {
  const std::vector<std::string> arguments{
      "synth", "e.obj",     "--resolution", "16",        "-o", "o.glb",          "--preview",
      "o.png", "--origins", "o.vdb",        "--samples", "1",  "--picture-size", "64x48"};
  const TestFolder folder;
  writeFile(folder / "e.obj",
            "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 1\nv 4 0 1\nv 4 2 1\nv 0 2 1\n"
            "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const auto began = std::chrono::steady_clock::now();
  ASSERT_EQ(interruptExemplar(arguments, folder.path(), 0, 0ms).status, 0);
  const auto longest = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::steady_clock::now() - began);
  const auto whole = outputsIn(folder);
  ASSERT_EQ(whole.size(), 3u);
  const Random random(6);
  int killed = 0;
  for (int k = 0; k < kills(); ++k) {
    SCOPED_TRACE(k);
    // Every other run finds the files of the one before.
    if (k % 2 == 0)
      for (const auto& [name, bytes] : outputsIn(folder)) std::filesystem::remove(folder / name);
    const std::chrono::milliseconds after(
        random.below(static_cast<std::uint32_t>(longest.count()), static_cast<std::uint64_t>(k)));
    const CommandResult run = interruptExemplar(arguments, folder.path(), SIGKILL, after);
    killed += run.status == -1;
    for (const auto& [name, bytes] : outputsIn(folder)) {
      ASSERT_TRUE(whole.contains(name)) << name;
      EXPECT_TRUE(bytes == whole.at(name)) << name;
    }
  }
  EXPECT_GT(killed, kills() / 4);
}

}  // namespace
}  // namespace exemplar
