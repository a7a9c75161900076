// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Linux, with the C library of GNU.

#include <fcntl.h>
#include <gnu/libc-version.h>
#include <malloc.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/platform.h"

namespace exemplar::platform {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(int error) { throw std::system_error(error, std::generic_category()); }

/// The whole number that a text begins with, after blanks.
std::optional<std::uint64_t> numberIn(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  return number;
}

/// The first number in a file; nothing where there is none ("max", no such file).
std::optional<std::uint64_t> readNumber(const char* path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return numberIn(line);
}

/// What a file of lines "NAME:   NUMBER kB", as Linux describes memory in, gives for a name, in
/// bytes; nothing where it does not.
std::optional<std::uint64_t> readBytes(const char* path, std::string_view name) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(name)) continue;
    const auto kilobytes = numberIn(std::string_view(line).substr(name.size()));
    if (kilobytes) return *kilobytes * 1024;
  }
  return std::nullopt;
}

/// A hidden name beside `place`, of this process alone.
fs::path besideName(const fs::path& place) {
  static std::atomic<unsigned> counter{0};
  return fs::path(place).replace_filename("." + place.stem().string() + "." +
                                          std::to_string(processId()) + "." +
                                          std::to_string(counter++) + place.extension().string());
}

std::string linkOf(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// A file without a name in the folder of `place`, or -1 where that cannot be.
int openNameless(const fs::path& place) {
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return -1;
  // It is named through /proc, which is not everywhere.
  if (access(linkOf(descriptor).c_str(), F_OK) == 0) return descriptor;
  close(descriptor);
  return -1;
}

/// Gives a file without a name one; false, with `errno`, where that name is taken or cannot be.
bool nameIt(int descriptor, const fs::path& name) {
  return linkat(AT_FDCWD, linkOf(descriptor).c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) ==
         0;
}

}  // namespace

std::string_view name() { return "linux"; }

std::uint64_t processId() { return static_cast<std::uint64_t>(getpid()); }

std::optional<std::uint64_t> availableMemory() {
  std::uint64_t available = readBytes("/proc/meminfo", "MemAvailable:")
                                .value_or(static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                          static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
  if (const auto limit = readNumber("/sys/fs/cgroup/memory.max")) {
    const std::uint64_t used = readNumber("/sys/fs/cgroup/memory.current").value_or(*limit);
    available = std::min(available, used < *limit ? *limit - used : 0);
  }
  return available;
}

std::optional<std::uint64_t> peakResident() {
  // `ru_maxrss` would count what ran in this process before it became this program, too.
  if (const auto peak = readBytes("/proc/self/status", "VmHWM:")) return *peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

bool resetPeakResident() {
  malloc_trim(0);
  std::ofstream out("/proc/self/clear_refs");
  out << 5;
  return static_cast<bool>(out.flush());
}

void* allocateAligned(std::size_t bytes, std::size_t alignment) {
  void* memory = nullptr;
  return posix_memalign(&memory, alignment, bytes) == 0 ? memory : nullptr;
}

void freeAligned(void* memory) noexcept { std::free(memory); }

void adviseHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

std::optional<fs::path> programFile() {
  std::error_code error;
  fs::path file = fs::read_symlink("/proc/self/exe", error);
  if (error) return std::nullopt;
  return file;
}

bool isTerminal(std::FILE* stream) { return isatty(fileno(stream)) != 0; }

bool openOnDesktop(const fs::path& file) {
  std::string opener = "xdg-open", name = fs::absolute(file).string();
  char* words[] = {opener.data(), name.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, opener.c_str(), &actions, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0;
}

std::string arithmetic() {
  std::string text = std::string("glibc ") + gnu_get_libc_version();
#if defined(__x86_64__)
  text += ", x86-64";
  if (__builtin_cpu_supports("avx2")) text += " avx2";
  if (__builtin_cpu_supports("fma")) text += " fma";
  if (__builtin_cpu_supports("avx512f")) text += " avx512f";
#elif defined(__aarch64__)
  text += ", aarch64";
#endif
  return text;
}

std::error_code mayWrite(const fs::path& file) {
  if (faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) == 0) return {};
  return {errno, std::generic_category()};
}

struct UnseenFile::State {
  fs::path place;
  fs::path hidden;  ///< its name before it has its place; empty where it has none
  int descriptor = -1;
};

UnseenFile::UnseenFile(const fs::path& place) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.place = place;
  s.descriptor = openNameless(place);
  if (s.descriptor >= 0) return;
  const fs::path hidden = besideName(place);
  s.descriptor = open(hidden.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (s.descriptor < 0) fail(errno);
  s.hidden = hidden;
}

UnseenFile::~UnseenFile() {
  if (state_->descriptor >= 0) close(state_->descriptor);
  std::error_code ignored;
  if (!state_->hidden.empty()) fs::remove(state_->hidden, ignored);
}

void UnseenFile::setPermissions(fs::perms permissions) {
  std::ignore = fchmod(state_->descriptor, static_cast<mode_t>(permissions));
}

void UnseenFile::clear() {
  const int file = state_->descriptor;
  if (ftruncate(file, 0) != 0 || lseek(file, 0, SEEK_SET) != 0) fail(errno);
}

void UnseenFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(state_->descriptor, bytes.data(), bytes.size());
    if (n == 0) fail(EIO);
    if (n < 0 && errno != EINTR) fail(errno);
    if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void UnseenFile::moveIntoPlace() {
  State& s = *state_;
  if (s.hidden.empty() && !nameIt(s.descriptor, s.place)) {
    // Something is there: it is replaced at once, by a file that has a name beside it.
    const fs::path hidden = besideName(s.place);
    if (!nameIt(s.descriptor, hidden)) fail(errno);
    s.hidden = hidden;
  }
  if (!s.hidden.empty()) fs::rename(s.hidden, s.place);
  s.hidden.clear();
  // Some file systems say only now that a disk is full.
  const int closed = close(std::exchange(s.descriptor, -1));
  if (closed != 0 && errno != EINTR) {
    const int reason = errno;
    std::error_code ignored;
    fs::remove(s.place, ignored);
    fail(reason);
  }
}

}  // namespace exemplar::platform
