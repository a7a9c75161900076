// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.h"

namespace exemplar {

/// Reads a text file line by line, each as words and numbers. Errors are `InputError`s of the form
/// "NAME:LINE: MESSAGE". The text must outlive the scanner. Reads about 200 MB of numbers a second.
class TextScanner {
 public:
  /// With `continued`, a backslash at a line's end joins the next line to it.
  TextScanner(std::string_view text, std::string name, bool continued = false)
      : cursor_(text.data()),
        lineEnd_(cursor_),
        next_(cursor_),
        end_(cursor_ + text.size()),
        name_(std::move(name)),
        continued_(continued) {
    if (text.starts_with("\xef\xbb\xbf")) next_ += 3;  // the byte-order mark of UTF-8
  }

  /// Moves to the next line; false at the file's end.
  bool nextLine() {
    if (next_ == end_) return false;
    takeLine();
    return true;
  }
  /// Moves to the next line with anything on it before a '#'; false at the file's end.
  bool nextFilledLine() {
    while (nextLine()) {
      if (!atLineEnd() && *cursor_ != '#') return true;
    }
    return false;
  }

  /// Whether only blanks are left on the line.
  bool atLineEnd() {
    skipBlanks();
    return cursor_ == lineEnd_;
  }
  /// The next character that is not blank, without moving; '\0' at the line's end.
  char peek() { return atLineEnd() ? '\0' : *cursor_; }
  /// The character where the scanner stands, blank or not; '\0' at the line's end.
  char peekHere() const { return cursor_ == lineEnd_ ? '\0' : *cursor_; }
  /// Whether a word that begins before where the scanner stands ends there.
  bool atWordEnd() const { return endsWord(cursor_); }
  /// The next word; empty at the line's end.
  std::string_view word() {
    skipBlanks();
    const char* begin = cursor_;
    while (cursor_ != lineEnd_ && !isBlank(*cursor_)) ++cursor_;
    return {begin, static_cast<std::size_t>(cursor_ - begin)};
  }
  /// The capital letters that come next, with no blanks skipped.
  std::string_view letters() {
    const char* begin = cursor_;
    while (cursor_ != lineEnd_ && *cursor_ >= 'A' && *cursor_ <= 'Z') ++cursor_;
    return {begin, static_cast<std::size_t>(cursor_ - begin)};
  }
  /// The rest of the line without blanks around it.
  std::string_view rest() {
    skipBlanks();
    const char* begin = cursor_;
    const char* end = lineEnd_;
    while (end != begin && isBlank(end[-1])) --end;
    cursor_ = lineEnd_;
    return {begin, static_cast<std::size_t>(end - begin)};
  }
  /// Takes the next character when it is `c`, with no blanks skipped.
  bool take(char c) {
    if (cursor_ == lineEnd_ || *cursor_ != c) return false;
    ++cursor_;
    return true;
  }

  /// The next number; `what` is what errors call it.
  double number(const char* what) {
    skipBlanks();
    const char* begin = cursor_ != lineEnd_ && *cursor_ == '+' ? cursor_ + 1 : cursor_;
    double value = 0;
    const auto [end, error] = std::from_chars(begin, lineEnd_, value);
    if (error == std::errc::result_out_of_range) {
      value = outOfRange({begin, static_cast<std::size_t>(end - begin)}, what);
    } else if (error != std::errc{}) {
      failAtWord(what, "a number");
    }
    if (!endsWord(end)) failAtWord(what, "a number");
    cursor_ = end;
    return value;
  }
  /// The next whole number.
  std::int64_t integer(const char* what) {
    const std::int64_t value = integerPrefix(what);
    if (!endsWord(cursor_)) failAtWord(what, "a whole number");
    return value;
  }
  /// The next whole number, whatever character comes after it.
  std::int64_t integerPrefix(const char* what) {
    skipBlanks();
    const char* begin = cursor_ != lineEnd_ && *cursor_ == '+' ? cursor_ + 1 : cursor_;
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(begin, lineEnd_, value);
    if (error != std::errc{}) failAtWord(what, "a whole number");
    cursor_ = end;
    return value;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(name_ + ":" + std::to_string(line_) + ": " + message);
  }

  /// A word from the file, fit for a one-line message.
  static std::string shown(std::string_view word) {
    std::string text;
    for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return word.size() > 40 ? text + "..." : text;
  }

  const std::string& name() const { return name_; }
  /// What comes after the current line.
  std::string_view afterLine() const { return {next_, static_cast<std::size_t>(end_ - next_)}; }
  /// Bytes from where the scanner stands to the end of the file.
  std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - cursor_); }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  bool endsWord(const char* p) const {
    return p == lineEnd_ || isBlank(*p) || (continued_ && *p == '\\');
  }

  void takeLine() {
    cursor_ = next_;
    const void* found = std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_));
    lineEnd_ = found ? static_cast<const char*>(found) : end_;
    next_ = found ? lineEnd_ + 1 : end_;
    ++line_;
  }

  void skipBlanks() {
    for (;;) {
      while (cursor_ != lineEnd_ && isBlank(*cursor_)) ++cursor_;
      if (!continued_ || cursor_ == lineEnd_ || *cursor_ != '\\') return;
      const char* after = cursor_ + 1;
      while (after != lineEnd_ && isBlank(*after)) ++after;
      if (after != lineEnd_ || next_ == end_) return;
      takeLine();
    }
  }

  /// Too small becomes 0; too large is an error.
  double outOfRange(std::string_view digits, const char* what) const {
    const std::size_t exponent = digits.find_first_of("eE");
    const std::string_view mantissa = digits.substr(digits.starts_with('-') ? 1 : 0, exponent);
    const bool small = exponent != std::string_view::npos
                           ? digits.substr(exponent + 1).starts_with('-')
                           : mantissa.starts_with('0');
    if (!small) fail(std::string(what) + " is too large: " + shown(digits));
    return 0;
  }

  [[noreturn]] void failAtWord(const char* what, const char* wanted) {
    const std::string_view found = word();
    if (found.empty()) fail(std::string(what) + " is missing: the line ends before it");
    fail(std::string(what) + " should be " + wanted + ", not '" + shown(found) + "'");
  }

  const char* cursor_;
  const char* lineEnd_;
  const char* next_;
  const char* end_;
  std::string name_;
  std::int64_t line_ = 0;
  bool continued_;
};

}  // namespace exemplar
