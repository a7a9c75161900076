// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>

namespace exemplar {

/// Memory that can be taken now without swapping, in bytes (Linux: MemAvailable, and the control
/// group's limit where that is lower).
std::uint64_t availableMemoryBytes();

/// The largest resident size that this process has had, in bytes.
std::uint64_t peakResidentBytes();

/// Restarts `peakResidentBytes` from what is resident now, after memory that nothing uses
/// was given back. False where the system does not offer it (other than Linux): the peak stays.
bool resetPeakResident();

/// Throws `InputError` when `bytes` is more than is available: "WHAT needs 512 GB and 21 GB are
/// available; ADVICE". Ask before taking memory whose size follows from the user's input.
void requireMemory(double bytes, const std::string& what, const std::string& advice);

}  // namespace exemplar
