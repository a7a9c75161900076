// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <sys/mman.h>
#include <unistd.h>

#include <string>

#include "fuzz_reader.h"
#include "sdf/vdb_file.h"
#include "voxelize/label_file.h"

namespace {

/// A file without a name that holds the bytes, as a path.
std::string fileOf(std::string_view bytes) {
  static const int file = memfd_create("f.vdb", 0);
  if (file < 0 || ftruncate(file, 0) != 0 ||
      pwrite(file, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    __builtin_trap();
  return "/proc/self/fd/" + std::to_string(file);
}

void read(std::string_view bytes) {
  using exemplar::fuzz::tolerate;
  const std::string file = fileOf(bytes);
  // What is refused as one kind of content may be another.
  tolerate(
      [&](std::string_view) {
        exemplar::Turn turn;
        exemplar::Axes wraps;
        exemplar::Warnings warnings;
        exemplar::readVdb(file, {.warnings = &warnings, .turn = &turn}, &wraps);
      },
      bytes);
  tolerate([&](std::string_view) { exemplar::readOriginsVdb(file); }, bytes);
  tolerate([&](std::string_view) { exemplar::validate(exemplar::readLabelsVdb(file), "f.vdb"); },
           bytes);
}

}  // namespace

EXEMPLAR_FUZZ_READER(read)
