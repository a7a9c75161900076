// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/error.h"

namespace exemplar::fuzz {

/// Reads bytes that may be anything. Only `InputError` may come out of a reader, in one line.
template <class Read>
void tolerate(const Read& read, std::string_view bytes) {
  try {
    read(bytes);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
}

/// For the test that reads the kept corpora again, with any compiler.
bool addReplay(const char* name, void (*read)(std::string_view));

}  // namespace exemplar::fuzz

#ifdef EXEMPLAR_REPLAY
#define EXEMPLAR_FUZZ_READER(read)                                                \
  [[maybe_unused]] static const bool replayed =                                   \
      exemplar::fuzz::addReplay(EXEMPLAR_REPLAY, [](std::string_view bytes) {     \
        exemplar::fuzz::tolerate([](std::string_view all) { read(all); }, bytes); \
      });
#else
/// What a fuzzer calls.
#define EXEMPLAR_FUZZ_READER(read)                                                      \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n) {      \
    exemplar::fuzz::tolerate([](std::string_view all) { read(all); },                   \
                             std::string_view(reinterpret_cast<const char*>(data), n)); \
    return 0;                                                                           \
  }
#endif
