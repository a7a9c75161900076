// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "fuzz_reader.h"
#include "maps/height_map_file.h"

namespace {
// Grids and, where the bytes begin like one, .pgm pictures.
void read(std::string_view bytes) {
  exemplar::Warnings warnings;
  const char* name = bytes.starts_with("P") ? "f.pgm" : "f.asc";
  exemplar::readHeightMap(bytes, name, {.warnings = &warnings});
}
}  // namespace

EXEMPLAR_FUZZ_READER(read)
