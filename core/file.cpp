// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>

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

OutputFile::OutputFile(fs::path path) : path_(std::move(path)) {
  std::error_code error;
  if (path_.filename().empty() || fs::is_directory(path_, error)) {
    fail(path_, "cannot be written: it is a folder", 0);
  }
  static std::atomic<unsigned> counter{0};
  temporary_ = path_;
  temporary_.replace_filename("." + path_.stem().string() + "." + std::to_string(getpid()) + "." +
                              std::to_string(counter++) + path_.extension().string());
  const int descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
  if (descriptor < 0) fail(path_, "cannot be written", errno);
  close(descriptor);
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void OutputFile::write(std::string_view bytes, const Progress& progress) {
  const int descriptor = open(temporary_.c_str(), O_WRONLY | O_TRUNC);
  if (descriptor < 0) fail(path_, "cannot be written", errno);
  std::size_t done = 0;
  int error = 0;
  while (done < bytes.size() && !error && !progress.cancelled()) {
    const ssize_t n =
        ::write(descriptor, bytes.data() + done, std::min(bytes.size() - done, kPiece));
    if (n > 0) done += static_cast<std::size_t>(n);
    if (n == 0 || (n < 0 && errno != EINTR)) error = n == 0 ? EIO : errno;
  }
  if (close(descriptor) != 0 && !error) error = errno;
  if (error) fail(path_, "cannot be written", error);
  progress.report("writing", 1);
}

void OutputFile::commit() {
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) fail(path_, "cannot be written", error.value());
  temporary_.clear();
}

void writeFile(const fs::path& path, std::string_view bytes, const Progress& progress) {
  OutputFile out(path);
  out.write(bytes, progress);
  out.commit();
}

}  // namespace exemplar
