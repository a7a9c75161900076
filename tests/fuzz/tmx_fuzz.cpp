// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "fuzz_reader.h"
#include "voxelize/tiled_map.h"

namespace {
void read(std::string_view bytes) {
  exemplar::validate(exemplar::parseTiledMap(bytes, "f.tmx").grid, "f.tmx");
}
}  // namespace

EXEMPLAR_FUZZ_READER(read)
