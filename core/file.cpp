// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// Read and written at once; a cancellation waits no longer than this takes.
constexpr std::size_t kPiece = 16 << 20;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
  throw InputError(path.string() + ": " + what +
                   (error ? std::string(": ") + std::strerror(error) : ""));
}

/// Where a path leads through links; itself where it is none.
fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links) {
    const fs::path to = fs::read_symlink(path, error);
    if (error) break;
    path = to.is_absolute() ? to : path.parent_path() / to;
  }
  return path;
}

/// A hidden name beside `place`, of this process alone.
fs::path besideName(const fs::path& place) {
  static std::atomic<unsigned> counter{0};
  return fs::path(place).replace_filename("." + place.stem().string() + "." +
                                          std::to_string(getpid()) + "." +
                                          std::to_string(counter++) + place.extension().string());
}

/// A file without a name in the folder of `place`, or -1 where that cannot be.
int openNameless([[maybe_unused]] const fs::path& place) {
#ifdef O_TMPFILE
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return -1;
  // It is named through /proc, which is not everywhere.
  if (access(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), F_OK) == 0) return descriptor;
  close(descriptor);
#endif
  return -1;
}

/// Gives a file without a name one; false, with `errno`, where that name is taken or cannot be.
bool nameIt(int descriptor, const fs::path& name) {
  const std::string file = "/proc/self/fd/" + std::to_string(descriptor);
  return linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

}  // namespace

std::string readFile(const fs::path& path, const Progress& progress) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail(path, "no such file", 0);
  if (error) fail(path, "cannot be read", error.value());
  if (status.type() == fs::file_type::directory) fail(path, "is a folder, not a file", 0);
  if (status.type() != fs::file_type::regular) fail(path, "is not a regular file", 0);
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) fail(path, "cannot be read", error.value());
  if (size == 0) fail(path, "the file is empty", 0);
  requireMemory(2.0 * static_cast<double>(size), path.string() + ": reading this file",
                "use a smaller file");
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(path, "cannot be read", errno);
  std::string bytes(size, '\0');
  for (std::uintmax_t done = 0; done < size; done += kPiece) {
    progress.report("reading", static_cast<double>(done) / static_cast<double>(size));
    const auto piece = static_cast<std::streamsize>(std::min<std::uintmax_t>(kPiece, size - done));
    if (!in.read(bytes.data() + done, piece)) fail(path, "could not be read to its end", 0);
  }
  return bytes;
}

std::string lowerExtension(const fs::path& path) { return lowerCase(path.extension().string()); }

OutputFile::OutputFile(fs::path path) : path_(std::move(path)), place_(followed(path_)) {
  std::error_code error;
  const fs::file_status there = fs::status(place_, error);
  if (there.type() == fs::file_type::none) fail(path_, "cannot be written", error.value());
  if (path_.filename().empty() || fs::is_directory(there))
    fail(path_, "cannot be written: it is a folder", 0);
  if (fs::exists(there) && !fs::is_regular_file(there))
    fail(path_, "cannot be written: it is not a regular file", 0);
  if (fs::exists(there) && faccessat(AT_FDCWD, place_.c_str(), W_OK, AT_EACCESS) != 0)
    fail(path_, "cannot be written", errno);
  descriptor_ = openNameless(place_);
  if (descriptor_ < 0) {
    temporary_ = besideName(place_);
    descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  }
  if (descriptor_ < 0) {
    temporary_.clear();
    fail(path_, "cannot be written", errno);
  }
  // What is overwritten keeps its permissions; where that is not possible it has the usual ones.
  if (fs::exists(there))
    std::ignore = fchmod(descriptor_, static_cast<mode_t>(there.permissions()));
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void OutputFile::write(std::string_view bytes, const Progress& progress) {
  if (ftruncate(descriptor_, 0) != 0 || lseek(descriptor_, 0, SEEK_SET) != 0)
    fail(path_, "cannot be written", errno);
  std::size_t done = 0;
  while (done < bytes.size()) {
    progress.report("writing", static_cast<double>(done) / static_cast<double>(bytes.size()));
    const ssize_t n =
        ::write(descriptor_, bytes.data() + done, std::min(bytes.size() - done, kPiece));
    if (n == 0) fail(path_, "cannot be written", EIO);
    if (n < 0 && errno != EINTR) fail(path_, "cannot be written", errno);
    if (n > 0) done += static_cast<std::size_t>(n);
  }
  progress.report("writing", 1);
}

void OutputFile::commit() {
  if (temporary_.empty() && !nameIt(descriptor_, place_)) {
    // Something is there: it is replaced at once, by a file that has a name beside it.
    temporary_ = besideName(place_);
    if (!nameIt(descriptor_, temporary_)) {
      const int error = errno;
      temporary_.clear();
      fail(path_, "cannot be written", error);
    }
  }
  std::error_code error;
  if (!temporary_.empty()) fs::rename(temporary_, place_, error);
  if (error) fail(path_, "cannot be written", error.value());
  temporary_.clear();
  // Some file systems say only now that a disk is full.
  const int closed = close(std::exchange(descriptor_, -1));
  if (closed != 0 && errno != EINTR) {
    const int reason = errno;
    fs::remove(place_, error);
    fail(path_, "cannot be written", reason);
  }
}

void writeFile(const fs::path& path, std::string_view bytes, const Progress& progress) {
  OutputFile out(path);
  out.write(bytes, progress);
  out.commit();
}

}  // namespace exemplar
