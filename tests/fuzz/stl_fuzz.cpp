// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "fuzz_reader.h"
#include "mesh/mesh_formats.h"

namespace {
void read(std::string_view bytes) {
  exemplar::Warnings warnings;
  exemplar::validate(exemplar::parseStl(bytes, {.name = "f.stl", .warnings = &warnings}), "f.stl");
}
}  // namespace

EXEMPLAR_FUZZ_READER(read)
