// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace exemplar {

/// RFC 4648's base64, padded.
std::string encodeBase64(std::string_view bytes);

/// The bytes that base64 text encodes, padded or not; nothing when it is not base64. Blanks and
/// line ends within the text are skipped.
std::optional<std::string> decodeBase64(std::string_view text);

}  // namespace exemplar
