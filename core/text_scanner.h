// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/text.h"

namespace exemplar {

/// How a `TextScanner` takes a text apart.
struct TextScannerOptions {
  bool continued = false;  ///< a backslash at a line's end joins the next line to it
  bool comments = false;   ///< a '#' where a word or number could begin or has ended ends the line
};

/// Reads a text file line by line, each as words and numbers: the one reader of numbers in text,
/// whatever the locale. Lines end with LF, CR LF or CR; UTF-16 and byte-order marks are understood;
/// control characters count as blanks. Errors are `InputError`s of the form "NAME:LINE: MESSAGE".
/// The text must outlive the scanner. Reads about 200 MB of numbers a second.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string name, const TextScannerOptions& options = {})
      : text_(asUtf8(text, decoded_)),
        cursor_(text_.data()),
        lineEnd_(cursor_),
        next_(cursor_),
        end_(cursor_ + text_.size()),
        name_(std::move(name)),
        options_(options) {}
  TextScanner(const TextScanner&) = delete;
  TextScanner& operator=(const TextScanner&) = delete;

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
  /// The next character, blank or not; '\0' at the line's end.
  char peekHere() const { return cursor_ == lineEnd_ ? '\0' : *cursor_; }
  /// Whether a word that began before the next character ends here.
  bool atWordEnd() const { return endsWord(cursor_); }
  /// The next word; empty at the line's end.
  std::string_view word() {
    skipBlanks();
    const char* begin = cursor_;
    while (cursor_ != lineEnd_ && !isBlank(*cursor_)) ++cursor_;
    return {begin, static_cast<std::size_t>(cursor_ - begin)};
  }
  /// The next word, which may be on a later line; empty at the file's end.
  std::string_view wordAhead() {
    while (atLineEnd()) {
      if (!nextLine()) return {};
    }
    return word();
  }
  /// The ASCII letters that come next, with no blanks skipped.
  std::string_view letters() {
    const char* begin = cursor_;
    const auto isLetter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
    while (cursor_ != lineEnd_ && isLetter(*cursor_)) ++cursor_;
    return {begin, static_cast<std::size_t>(cursor_ - begin)};
  }
  /// The rest of the line without blanks around it; a comment in it stays.
  std::string_view rest() {
    skipBlanks();
    const char* begin = cursor_;
    const char* end = lineEnd_;
    while (end != begin && isBlank(end[-1])) --end;
    cursor_ = lineEnd_;
    return {begin, static_cast<std::size_t>(end - begin)};
  }
  /// The same, without moving; of a line that is continued as far as it goes.
  std::string_view peekRest() {
    const char* const here = cursor_;
    while (cursor_ != lineEnd_ && isBlank(*cursor_)) ++cursor_;
    const char* const begin = cursor_;
    const char* end = lineEnd_;
    while (end != begin && isBlank(end[-1])) --end;
    cursor_ = here;
    return {begin, static_cast<std::size_t>(end - begin)};
  }
  /// Takes the next character when it is `c`, with no blanks skipped.
  bool take(char c) {
    if (cursor_ == lineEnd_ || *cursor_ != c) return false;
    ++cursor_;
    return true;
  }

  /// The next word, without moving.
  std::string_view peekWord() {
    skipBlanks();
    const char* end = cursor_;
    while (end != lineEnd_ && !isBlank(*end)) ++end;
    return {cursor_, static_cast<std::size_t>(end - cursor_)};
  }

  /// The next number; `what` is what errors call it. Too small becomes 0; "nan" ("1.#QNAN",
  /// too) and "inf" are numbers.
  double number(const char* what) {
    if (const std::optional<double> value = tryNumber()) return *value;
    double ignored = 0;
    const std::string_view found = peekWord();
    const auto [end, error] = std::from_chars(cursor_, lineEnd_, ignored);
    if (error == std::errc::result_out_of_range)
      fail(std::string(what) + " is too large: " + shown(found));
    failAtWord(what, "a number");
  }
  /// The next number; nothing, without moving, where the next word is none, or one that no double
  /// can hold.
  std::optional<double> tryNumber() {
    skipBlanks();
    const char* begin = cursor_ != lineEnd_ && *cursor_ == '+' ? cursor_ + 1 : cursor_;
    double value = 0;
    const auto [end, error] = std::from_chars(begin, lineEnd_, value);
    if (error != std::errc{} || !endsWord(end)) return tryOddNumber(begin, end, error);
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

  [[noreturn]] void fail(const std::string& message) const { fail(line_, message); }
  [[noreturn]] void fail(std::int64_t line, const std::string& message) const {
    throw InputError(at(line) + message);
  }
  /// "NAME:LINE: ", which errors and warnings begin with.
  std::string at(std::int64_t line) const { return name_ + ":" + std::to_string(line) + ": "; }

  /// A word from the file, fit for a one-line message.
  static std::string shown(std::string_view word) {
    std::string text;
    for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
    return word.size() > 40 ? text + "..." : text;
  }

  const std::string& name() const { return name_; }
  /// The current line's number, from 1.
  std::int64_t line() const { return line_; }
  /// What comes after the current line.
  std::string_view afterLine() const { return {next_, static_cast<std::size_t>(end_ - next_)}; }
  /// Bytes from here to the end of the file.
  std::size_t bytesLeft() const { return static_cast<std::size_t>(end_ - cursor_); }
  /// The share of the text that has been read, 0..1.
  double fraction() const {
    return text_.empty() ? 1
                         : 1 - static_cast<double>(bytesLeft()) / static_cast<double>(text_.size());
  }

 private:
  static bool isBlank(char c) { return static_cast<unsigned char>(c) <= ' '; }

  bool endsWord(const char* p) const {
    if (p == lineEnd_ || isBlank(*p)) return true;
    return (options_.continued && *p == '\\') || (options_.comments && *p == '#');
  }

  void takeLine() {
    cursor_ = next_;
    ++line_;
    if (lineFeed_ < next_ || !lineFeed_) {
      const void* found = std::memchr(next_, '\n', static_cast<std::size_t>(end_ - next_));
      lineFeed_ = found ? static_cast<const char*>(found) : end_;
    }
    lineEnd_ = lineFeed_;
    next_ = lineFeed_ == end_ ? end_ : lineFeed_ + 1;
    if (return_ < cursor_ || !return_) {
      const void* found = std::memchr(cursor_, '\r', static_cast<std::size_t>(end_ - cursor_));
      return_ = found ? static_cast<const char*>(found) : end_;
    }
    if (return_ < lineFeed_) endLineAtReturn();
  }

  /// A carriage return ends a line, too: alone, or (doubled by careless copying) before the LF.
  [[gnu::noinline]] void endLineAtReturn() {
    const char* after = return_;
    lineEnd_ = after;
    while (after != lineFeed_ && *after == '\r') ++after;
    const bool withLineFeed = after == lineFeed_ && after != end_ && !returnsAlone_;
    if (!withLineFeed) next_ = lineEnd_ + 1;
    if (line_ == 1) returnsAlone_ = !withLineFeed;
  }

  void skipBlanks() {
    while (cursor_ != lineEnd_ && isBlank(*cursor_)) ++cursor_;
    if (cursor_ != lineEnd_ && (*cursor_ == '#' || *cursor_ == '\\')) skipMark();
  }

  /// Skips a comment, or the end of a line that is continued, where the next character begins one.
  [[gnu::noinline]] void skipMark() {
    do {
      if (*cursor_ == '#') {
        if (options_.comments) cursor_ = lineEnd_;
        return;
      }
      if (!options_.continued) return;
      const char* after = cursor_ + 1;
      while (after != lineEnd_ && isBlank(*after)) ++after;
      if (after != lineEnd_ || next_ == end_) return;
      takeLine();
      while (cursor_ != lineEnd_ && isBlank(*cursor_)) ++cursor_;
    } while (cursor_ != lineEnd_ && (*cursor_ == '#' || *cursor_ == '\\'));
  }

  /// What `tryNumber` gives where a word does not simply spell a number that a double can hold.
  [[gnu::noinline]] std::optional<double> tryOddNumber(const char* begin, const char* end,
                                                       std::errc error) {
    const char* last = begin;
    while (!endsWord(last)) ++last;
    if (isNanWord({begin, static_cast<std::size_t>(last - begin)})) {
      cursor_ = last;
      return std::numeric_limits<double>::quiet_NaN();
    }
    if (error == std::errc{}) {
      return !endsWord(end) && *end == ',' ? tryCommaNumber(begin, end) : std::nullopt;
    }
    const bool tiny = error == std::errc::result_out_of_range && endsWord(end) &&
                      isTiny({begin, static_cast<std::size_t>(end - begin)});
    if (!tiny) return std::nullopt;
    cursor_ = end;
    return 0;
  }

  /// Whether a word is one of Microsoft's for what is no number: "-1.#IND", "1.#QNAN".
  static bool isNanWord(std::string_view word) {
    if (word.starts_with('-')) word.remove_prefix(1);
    return word.starts_with("1.#IND") || word.starts_with("1.#QNAN") || word.starts_with("1.#SNAN");
  }

  /// A number with a decimal comma, as programs write it whose author forgot the locale.
  std::optional<double> tryCommaNumber(const char* begin, const char* comma) {
    const char* last = comma;
    while (!endsWord(last)) ++last;
    const auto value = parseNumber({begin, static_cast<std::size_t>(last - begin)});
    if (!value) return std::nullopt;
    cursor_ = last;
    return value;
  }

  /// Whether digits that are out of a double's range are so because they are too small.
  static bool isTiny(std::string_view digits) {
    const std::size_t exponent = digits.find_first_of("eE");
    const std::string_view mantissa = digits.substr(digits.starts_with('-') ? 1 : 0, exponent);
    return exponent != std::string_view::npos ? digits.substr(exponent + 1).starts_with('-')
                                              : mantissa.starts_with('0');
  }

  [[noreturn]] void failAtWord(const char* what, const char* wanted) {
    const std::string_view found = word();
    if (found.empty()) fail(std::string(what) + " is missing: the line ends before it");
    fail(std::string(what) + " should be " + wanted + ", not '" + shown(found) + "'");
  }

  std::string decoded_;  // the text where its bytes are not UTF-8
  std::string_view text_;
  const char* cursor_;
  const char* lineEnd_;
  const char* next_;
  const char* end_;
  const char* lineFeed_ = nullptr;  // the first one from `next_` on, as far as it is known
  const char* return_ = nullptr;    // the same for carriage returns
  bool returnsAlone_ = false;       // carriage returns end lines by themselves
  std::string name_;
  std::int64_t line_ = 0;
  TextScannerOptions options_;
};

}  // namespace exemplar
