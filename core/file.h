// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/progress.h"

namespace exemplar {

namespace platform {
class UnseenFile;
}

/// The whole content of a file. Throws `InputError` when it is not a readable regular file, is
/// empty, or is longer than the memory that is available. Throws `Cancelled`.
std::string readFile(const std::filesystem::path& path, const Progress& progress = {});

/// A path's ending in lower case, with its dot: ".obj"; empty where there is none.
std::string lowerExtension(const std::filesystem::path& path);

/// A file that is whole or not there, whatever ends the program: until `commit` it has no name
/// where the file system can do without, else a hidden one beside its place. What is
/// there already stays until then and keeps its permissions; a link is followed.
///
///     OutputFile out(path);
///     out.write(bytes);
///     out.commit();
///
/// Every failure (no such folder, no permission, disk full, a device) is an `InputError` naming
/// `path`.
class OutputFile {
 public:
  /// Fails at once where a file could not be created.
  explicit OutputFile(std::filesystem::path path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Makes `bytes` the file's whole content. Throws `Cancelled`.
  void write(std::string_view bytes, const Progress& progress = {});
  /// Puts the file in its place.
  void commit();

 private:
  std::filesystem::path path_;  ///< as it was given
  std::unique_ptr<platform::UnseenFile> file_;
};

/// An `OutputFile` written and put in its place at once.
void writeFile(const std::filesystem::path& path, std::string_view bytes,
               const Progress& progress = {});

}  // namespace exemplar
