// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "core/text.h"

namespace exemplar {

/// Input that cannot be honored: an unreadable file, an option out of range, a size that would not
/// fit in memory, an output that cannot be written. The message is one line, whatever the file's
/// names that it quotes hold; it names the file (and line, where there is one) or the option, and
/// says what would be right. The command answers it with exit status 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string message) : std::runtime_error(oneLine(std::move(message))) {}
};

}  // namespace exemplar
