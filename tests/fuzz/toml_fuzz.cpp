// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <atomic>

#include "fuzz_reader.h"
#include "mesh/scene.h"

namespace {
void read(std::string_view bytes) {
  // Reading ends where making the scene begins.
  const std::atomic<bool> cancel{true};
  try {
    exemplar::readScene(bytes, "f.toml", {}, exemplar::Progress({}, &cancel));
  } catch (const exemplar::Cancelled&) {
  }
}
}  // namespace

EXEMPLAR_FUZZ_READER(read)
