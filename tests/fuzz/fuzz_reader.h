// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/error.h"

/// What a fuzzer calls: reads bytes that may be anything. Only `InputError` may come out of a
/// reader, in one line.
#define EXEMPLAR_FUZZ_READER(read)                                                           \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n) {           \
    try {                                                                                    \
      read(std::string_view(reinterpret_cast<const char*>(data), n));                        \
    } catch (const exemplar::InputError& e) {                                                \
      if (std::string_view(e.what()).find('\n') != std::string_view::npos) __builtin_trap(); \
    }                                                                                        \
    return 0;                                                                                \
  }
