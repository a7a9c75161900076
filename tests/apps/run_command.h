// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace exemplar {

/// What a run of the `exemplar` command came to.
struct CommandResult {
  int status = -1;  ///< exit status; -1 when a signal ended it
  std::string out, err;
  double cpuSeconds = 0;  ///< of an interrupted run, from the signal to its end, on all cores
};

/// Runs `exemplar ARGUMENTS` through the shell in `folder`.
CommandResult runExemplar(const std::string& arguments, const std::filesystem::path& folder);

/// Runs `exemplar ARGUMENTS... --progress json` in `folder`, and sends it a signal a while after it
/// has said that it began.
CommandResult interruptExemplar(const std::vector<std::string>& arguments,
                                const std::filesystem::path& folder, int signal,
                                std::chrono::milliseconds after);

/// An empty folder of its own for the running test, removed with it.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// The names of the files in it, sorted and joined by spaces.
  std::string files() const;

 private:
  std::filesystem::path path_;
};

}  // namespace exemplar
