// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/text.h"
#include "core/text_scanner.h"
#include "maps/height_formats.h"

namespace exemplar {

/// Words of a text, wherever its lines end.
class Words {
 public:
  /// With `gluedComments`, a comment may follow a word without a blank ("500#wide").
  Words(const HeightFile& source, bool gluedComments)
      : in_(source.bytes, source.name, {.comments = true}),
        progress_(source.progress),
        gluedComments_(gluedComments) {
    in_.nextLine();
  }

  /// The next word; empty at the end.
  std::string_view next() {
    if (count_++ % 65536 == 0) progress_.report("reading", in_.fraction());
    const std::string_view word = in_.wordAhead();
    const std::size_t comment = word.find('#');
    if (!gluedComments_ || comment == std::string_view::npos) return word;
    in_.rest();
    return word.substr(0, comment);
  }
  /// The next word as a number from `low` to `high`; `what` is what errors call it.
  template <class Number>
  Number number(const std::string& what, Number low, Number high) {
    const std::string_view word = next();
    if (word.empty()) fail("the file ends before " + what);
    return parse<Number>(word, what, low, high);
  }
  template <class Number>
  Number parse(std::string_view word, const std::string& what, Number low, Number high) {
    const std::optional<double> value = parseNumber(word);
    if (!value || !(*value >= low && *value <= high) ||
        *value != static_cast<double>(static_cast<Number>(*value))) {
      fail(what + " is \"" + TextScanner::shown(word) + "\"; it must be a number from " +
           exactNumber(low) + " to " + exactNumber(high));
    }
    return static_cast<Number>(*value);
  }
  [[noreturn]] void fail(const std::string& what) const { in_.fail(what); }
  std::size_t bytesLeft() const { return in_.bytesLeft(); }

 private:
  TextScanner in_;
  const Progress& progress_;
  bool gluedComments_;
  std::uint64_t count_ = 0;
};

}  // namespace exemplar
