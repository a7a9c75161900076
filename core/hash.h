// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace exemplar {

/// XXH3 of some bytes, 64 bits: shows whether contents differ, or are damaged, on every machine
/// alike. No protection against somebody who wants two contents to be taken for equal.
std::uint64_t contentHash(std::string_view bytes);

/// 16 hexadecimal digits, as hashes are written in files.
std::string hashText(std::uint64_t hash);

}  // namespace exemplar
