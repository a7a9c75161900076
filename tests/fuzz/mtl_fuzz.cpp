// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <cmath>

#include "fuzz_reader.h"
#include "mesh/mtl.h"

namespace {
void read(std::string_view bytes) {
  exemplar::Warnings warnings;
  for (const auto& m : exemplar::parseMtl(bytes, "f.mtl", &warnings)) {
    if (!std::isfinite(m.material.roughness) || !std::isfinite(m.material.baseColor[0]))
      __builtin_trap();
  }
}
}  // namespace

EXEMPLAR_FUZZ_READER(read)
