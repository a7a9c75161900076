// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/memory.h"

#include <charconv>
#include <limits>

#include "core/error.h"
#include "core/platform.h"

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

}  // namespace

// What a system does not say is no reason to stop.
std::uint64_t availableMemoryBytes() {
  return platform::availableMemory().value_or(std::numeric_limits<std::uint64_t>::max());
}

std::uint64_t peakResidentBytes() { return platform::peakResident().value_or(0); }

bool resetPeakResident() { return platform::resetPeakResident(); }

void requireMemory(double bytes, const std::string& what, const std::string& advice) {
  const double available = static_cast<double>(availableMemoryBytes());
  if (!(bytes <= available)) {
    throw InputError(what + " needs about " + readable(bytes) + " of memory and " +
                     readable(available) + " are available; " + advice);
  }
}

}  // namespace exemplar
