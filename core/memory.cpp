// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/memory.h"

#ifdef __linux__
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

#include "core/error.h"

namespace exemplar {
namespace {

std::string readable(double bytes) {
  const char* units[] = {"bytes", "KB", "MB", "GB", "TB", "PB"};
  int unit = 0;
  while (bytes >= 1000 && unit < 5) {
    bytes /= 1000;
    ++unit;
  }
  char text[32];
  const auto [end, error] =
      std::to_chars(text, text + sizeof text, bytes, std::chars_format::fixed, bytes < 10 ? 1 : 0);
  return std::string(text, end) + " " + units[unit];
}

/// The whole number that a text begins with, after blanks.
std::optional<std::uint64_t> numberIn(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  return number;
}

/// The first number in a file, or the largest one where there is none ("max", no such file).
std::uint64_t readNumber(const char* path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return numberIn(line).value_or(std::numeric_limits<std::uint64_t>::max());
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

}  // namespace

std::uint64_t availableMemoryBytes() {
  std::uint64_t available = readBytes("/proc/meminfo", "MemAvailable:")
                                .value_or(static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                          static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
  const std::uint64_t limit = readNumber("/sys/fs/cgroup/memory.max");
  if (limit != std::numeric_limits<std::uint64_t>::max()) {
    const std::uint64_t used = readNumber("/sys/fs/cgroup/memory.current");
    available = std::min(available, used < limit ? limit - used : 0);
  }
  return available;
}

std::uint64_t peakResidentBytes() {
  // `ru_maxrss` would count what ran in this process before it became this program, too.
  if (const auto peak = readBytes("/proc/self/status", "VmHWM:")) return *peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<std::uint64_t>(usage.ru_maxrss);
#else
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
#endif
}

bool resetPeakResident() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  std::ofstream out("/proc/self/clear_refs");
  out << 5;
  return static_cast<bool>(out.flush());
}

void requireMemory(double bytes, const std::string& what, const std::string& advice) {
  const double available = static_cast<double>(availableMemoryBytes());
  if (!(bytes <= available)) {
    throw InputError(what + " needs about " + readable(bytes) + " of memory and " +
                     readable(available) + " are available; " + advice);
  }
}

}  // namespace exemplar
