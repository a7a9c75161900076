// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "fuzz_reader.h"
#include "maps/height_map_file.h"

namespace {
void read(std::string_view bytes) {
  exemplar::Warnings warnings;
  exemplar::readHeightMap(bytes, "f.tif", {.warnings = &warnings});
}
}  // namespace

EXEMPLAR_FUZZ_READER(read)
