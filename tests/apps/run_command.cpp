// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "tests/apps/run_command.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

namespace exemplar {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// What a process has spent so far, on all cores.
double cpuSecondsOf(pid_t process) {
  clockid_t clock = 0;
  timespec now{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &now) != 0) return 0;
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

CommandResult runExemplar(const std::string& arguments, const fs::path& folder) {
  const fs::path out = fs::temp_directory_path() / ("exemplar_out_" + std::to_string(getpid()));
  const fs::path err = fs::temp_directory_path() / ("exemplar_err_" + std::to_string(getpid()));
  const std::string line = "cd '" + folder.string() + "' && '" + EXEMPLAR_COMMAND "' " + arguments +
                           " >'" + out.string() + "' 2>'" + err.string() + "'";
  const int code = std::system(line.c_str());
  CommandResult result{WIFEXITED(code) ? WEXITSTATUS(code) : -1, contentOf(out), contentOf(err)};
  fs::remove(out);
  fs::remove(err);
  return result;
}

CommandResult interruptExemplar(const std::vector<std::string>& arguments, const fs::path& folder,
                                int signal, std::chrono::milliseconds after) {
  int err[2];
  if (pipe(err) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    std::vector<std::string> words{EXEMPLAR_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), {"--progress", "json"});
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    dup2(err[1], STDERR_FILENO);
    close(err[0]);
    close(err[1]);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    if (chdir(folder.c_str()) == 0) execv(EXEMPLAR_COMMAND, argv.data());
    _exit(127);
  }
  close(err[1]);
  CommandResult result;
  char bytes[4096];
  bool sent = false;
  double before = 0;
  for (ssize_t n; (n = read(err[0], bytes, sizeof bytes)) > 0;) {
    result.err.append(bytes, static_cast<std::size_t>(n));
    if (!sent && result.err.find('\n') != std::string::npos) {
      std::this_thread::sleep_for(after);
      before = cpuSecondsOf(child);
      kill(child, signal);
      sent = true;
    }
  }
  close(err[0]);
  int code = 0;
  rusage usage{};
  wait4(child, &code, 0, &usage);
  result.status = WIFEXITED(code) ? WEXITSTATUS(code) : -1;
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  result.cpuSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime) - before;
  return result;
}

TestFolder::TestFolder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("exemplar_") + test->test_suite_name() + "_" + test->name();
  for (char& c : name) {
    if (c == '/') c = '_';
  }
  path_ = fs::temp_directory_path() / (name + "_" + std::to_string(getpid()));
  fs::remove_all(path_);
  fs::create_directories(path_);
}

TestFolder::~TestFolder() { fs::remove_all(path_); }

std::string TestFolder::files() const {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) {
    names.insert(entry.path().filename().string());
  }
  std::string joined;
  for (const std::string& name : names) joined += (joined.empty() ? "" : " ") + name;
  return joined;
}

}  // namespace exemplar
