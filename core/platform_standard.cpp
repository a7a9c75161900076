// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What C++'s own library has, for systems without a file of their own.

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include "core/platform.h"

namespace exemplar::platform {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category());
}

/// A hidden name beside `place`, of this process alone.
fs::path besideName(const fs::path& place) {
  static std::atomic<unsigned> counter{0};
  fs::path name = ".";
  name += place.stem();
  name += "." + std::to_string(processId()) + "." + std::to_string(counter++);
  name += place.extension();
  return fs::path(place).replace_filename(name);
}

}  // namespace

std::string_view name() { return "standard"; }

std::uint64_t processId() {
  // Two processes that start within a tick of the clock have their memory at different places.
  static const int here = 0;
  static const auto started = std::chrono::steady_clock::now().time_since_epoch().count();
  return static_cast<std::uint64_t>(started) ^ reinterpret_cast<std::uintptr_t>(&here);
}

std::optional<std::uint64_t> availableMemory() { return std::nullopt; }
std::optional<std::uint64_t> peakResident() { return std::nullopt; }
bool resetPeakResident() { return false; }

void* allocateAligned(std::size_t bytes, std::size_t alignment) {
  // What it was aligned to is needed to free it: that stands before it, in as many bytes.
  const auto align = std::align_val_t{alignment};
  auto* const memory =
      static_cast<std::byte*>(::operator new(bytes + alignment, align, std::nothrow));
  if (memory == nullptr) return nullptr;
  new (memory + alignment - sizeof alignment) std::size_t(alignment);
  return memory + alignment;
}

void freeAligned(void* memory) noexcept {
  if (memory == nullptr) return;
  auto* const bytes = static_cast<std::byte*>(memory);
  const std::size_t alignment =
      *std::launder(reinterpret_cast<const std::size_t*>(bytes - sizeof(std::size_t)));
  ::operator delete (bytes - alignment, std::align_val_t{alignment});
}

void adviseHugePages(void*, std::size_t) {}

std::optional<fs::path> programFile() { return std::nullopt; }
bool isTerminal(std::FILE*) { return false; }
bool openOnDesktop(const fs::path&) { return false; }
std::string arithmetic() { return "processor unknown"; }

std::error_code mayWrite(const fs::path& file) {
  const std::ofstream out(file, std::ios::binary | std::ios::app);
  return out ? std::error_code{} : std::error_code{EACCES, std::generic_category()};
}

struct UnseenFile::State {
  fs::path place;
  fs::path hidden;  ///< its name before it has its place; empty once it has that
  std::FILE* stream = nullptr;
};

UnseenFile::UnseenFile(const fs::path& place) : state_(std::make_unique<State>()) {
  const fs::path hidden = besideName(place);
  state_->place = place;
  state_->stream = std::fopen(hidden.string().c_str(), "wbx");
  if (state_->stream == nullptr) fail(errno);
  state_->hidden = hidden;
}

UnseenFile::~UnseenFile() {
  if (state_->stream != nullptr) std::fclose(state_->stream);
  std::error_code ignored;
  if (!state_->hidden.empty()) fs::remove(state_->hidden, ignored);
}

void UnseenFile::setPermissions(fs::perms permissions) {
  std::error_code ignored;
  fs::permissions(state_->hidden, permissions, ignored);
}

void UnseenFile::clear() {
  state_->stream = std::freopen(state_->hidden.string().c_str(), "wb", state_->stream);
  if (state_->stream == nullptr) fail(errno);
}

void UnseenFile::append(std::string_view bytes) {
  // Flushed, so that a full disk is said here.
  if (std::fwrite(bytes.data(), 1, bytes.size(), state_->stream) != bytes.size() ||
      std::fflush(state_->stream) != 0)
    fail(errno);
}

void UnseenFile::moveIntoPlace() {
  if (std::fclose(std::exchange(state_->stream, nullptr)) != 0) fail(errno);
  fs::rename(state_->hidden, state_->place);
  state_->hidden.clear();
}

}  // namespace exemplar::platform
