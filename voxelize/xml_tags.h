// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace exemplar {

/// One tag of XML: `<name a="b">`, `</name>` or `<name/>`.
struct Tag {
  std::size_t begin = 0, end = 0;  // in the file
  std::string_view name;
  bool closes = false, alone = false;
  struct Attribute {
    std::string_view name, value;
    std::size_t begin;  // of the value
  };
  std::vector<Attribute> attributes;

  const Attribute* find(std::string_view key) const {
    const auto at = std::ranges::find(attributes, key, &Attribute::name);
    return at == attributes.end() ? nullptr : &*at;
  }
  std::string_view value(std::string_view key) const {
    const Attribute* a = find(key);
    return a ? a->value : std::string_view{};
  }
};

/// The tags of a file, one after the other; comments and declarations are passed over, and values
/// are as the file spells them. Both arguments must outlive this. Throws `InputError`
/// ("NAME:LINE: ...") where a tag is malformed.
class Tags {
 public:
  Tags(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  /// The next tag; false at the file's end.
  bool next(Tag& tag) {
    for (;;) {
      at_ = text_.find('<', at_);
      if (at_ == text_.npos) return false;
      if (pass("<!--", "-->") || pass("<![CDATA[", "]]>") || pass("<?", "?>") || pass("<!", ">"))
        continue;
      read(tag);
      return true;
    }
  }
  /// Throws, with the line of the tag that was read last.
  [[noreturn]] void fail(const std::string& message) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + std::min(at_, text_.size()), '\n');
    throw InputError(name_ + ":" + std::to_string(line) + ": " + message);
  }

 private:
  bool pass(std::string_view opens, std::string_view closes) {
    if (!text_.substr(at_).starts_with(opens)) return false;
    const std::size_t end = text_.find(closes, at_ + opens.size());
    if (end == text_.npos) fail("ends within " + std::string(opens));
    at_ = end + closes.size();
    return true;
  }
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  char here() const {
    if (at_ >= text_.size()) fail("ends within a tag");
    return text_[at_];
  }
  std::string_view word() {
    const std::size_t begin = at_;
    while (!blank(here()) && here() != '>' && here() != '/' && here() != '=') ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void read(Tag& tag) {
    tag = {};
    tag.begin = at_++;
    tag.closes = here() == '/';
    if (tag.closes) ++at_;
    tag.name = word();
    for (;;) {
      while (blank(here())) ++at_;
      if (here() == '>') break;
      if (here() == '/') {
        tag.alone = true;
        ++at_;
        continue;
      }
      const std::string_view key = word();
      while (blank(here())) ++at_;
      if (key.empty() || here() != '=')
        fail("expected name=\"value\" in <" + std::string(tag.name) + ">");
      ++at_;
      while (blank(here())) ++at_;
      const char quote = here();
      if (quote != '"' && quote != '\'')
        fail("expected a quoted value in <" + std::string(tag.name) + ">");
      const std::size_t begin = ++at_, end = text_.find(quote, begin);
      if (end == text_.npos) fail("ends within a value");
      tag.attributes.push_back({key, text_.substr(begin, end - begin), begin});
      at_ = end + 1;
    }
    tag.end = ++at_;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace exemplar
