// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

/// What differs between operating systems, and nothing else of it is anywhere in the program: a
/// test looks for their headers in other files. `platform_linux.cpp` is the one that is built on
/// Linux; `platform_standard.cpp` does with what C++ has, for systems without a file of their own
/// (`EXEMPLAR_PLATFORM` chooses). What a system cannot say has an empty answer, for which each
/// caller has a substitute.
namespace exemplar::platform {

/// "linux" or "standard": which of the two this is.
std::string_view name();

/// Distinguishes this process from all others that run now.
std::uint64_t processId();

/// Memory that can be taken without swapping, bytes, as far as the system and its limits on this
/// process say.
std::optional<std::uint64_t> availableMemory();
/// The largest resident size of this program, bytes; not of what ran in the process before it.
std::optional<std::uint64_t> peakResident();
/// Gives back memory that nothing uses, and restarts `peakResident`; false where that goes on.
bool resetPeakResident();

/// Memory aligned to a power of two, to be freed by `freeAligned`; null where there is none.
void* allocateAligned(std::size_t bytes, std::size_t alignment);
void freeAligned(void* memory) noexcept;
/// Asks for huge pages behind aligned memory. Advice: it changes nothing but speed.
void adviseHugePages(void* memory, std::size_t bytes);

/// The file of the running program.
std::optional<std::filesystem::path> programFile();
/// Whether a stream shows on a terminal.
bool isTerminal(std::FILE* stream);
/// Opens a file with the program that the desktop has for it, and goes on; false where none starts.
bool openOnDesktop(const std::filesystem::path& file);
/// What may make floating-point results differ from another machine's, for people: C library and
/// processor.
std::string arithmetic();

/// Whether this process may write to a file that is there; the reason, as `errno` has it, where
/// not.
std::error_code mayWrite(const std::filesystem::path& file);

/// A file that is being written and that nobody sees: without a name where the system can do so,
/// else hidden beside its place. It is gone where the object is, unless it was moved into place.
class UnseenFile {
 public:
  /// Creates it for a place in a folder that is there; throws `std::system_error`.
  explicit UnseenFile(const std::filesystem::path& place);
  UnseenFile(const UnseenFile&) = delete;
  UnseenFile& operator=(const UnseenFile&) = delete;
  ~UnseenFile();

  /// Gives it a file's permissions; left alone where that is refused.
  void setPermissions(std::filesystem::perms permissions);
  /// Empties it and goes to its beginning; throws `std::system_error`.
  void clear();
  /// Adds bytes; throws `std::system_error`.
  void append(std::string_view bytes);
  /// Closes it in its place, where it replaces at once what was there; throws `std::system_error`,
  /// and it is then nowhere.
  void moveIntoPlace();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace exemplar::platform
