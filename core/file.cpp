// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "core/file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/platform.h"
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

/// Does what the system may refuse with `std::system_error`.
template <class Step>
void attempt(const fs::path& path, const Step& step) {
  try {
    step();
  } catch (const std::system_error& e) {
    fail(path, "cannot be written", e.code().value());
  }
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
  const fs::path place = followed(path_);
  std::error_code error;
  const fs::file_status there = fs::status(place, error);
  if (there.type() == fs::file_type::none) fail(path_, "cannot be written", error.value());
  if (path_.filename().empty() || fs::is_directory(there))
    fail(path_, "cannot be written: it is a folder", 0);
  if (fs::exists(there) && !fs::is_regular_file(there))
    fail(path_, "cannot be written: it is not a regular file", 0);
  if (fs::exists(there)) {
    if (const std::error_code refused = platform::mayWrite(place))
      fail(path_, "cannot be written", refused.value());
  }
  attempt(path_, [&] { file_ = std::make_unique<platform::UnseenFile>(place); });
  // What is overwritten keeps its permissions; where that is not possible it has the usual ones.
  if (fs::exists(there)) file_->setPermissions(there.permissions());
}

OutputFile::~OutputFile() = default;

void OutputFile::write(std::string_view bytes, const Progress& progress) {
  attempt(path_, [&] { file_->clear(); });
  for (std::size_t done = 0; done < bytes.size(); done += kPiece) {
    progress.report("writing", static_cast<double>(done) / static_cast<double>(bytes.size()));
    attempt(path_, [&] { file_->append(bytes.substr(done, kPiece)); });
  }
  progress.report("writing", 1);
}

void OutputFile::commit() {
  attempt(path_, [&] { file_->moveIntoPlace(); });
}

void writeFile(const fs::path& path, std::string_view bytes, const Progress& progress) {
  OutputFile out(path);
  out.write(bytes, progress);
  out.commit();
}

}  // namespace exemplar
