// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/progress.h"
#include "core/text_scanner.h"

/// What a `.ply` file is made of, whatever it describes: a header, and rows of numbers.
namespace exemplar::ply {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

constexpr int kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct Property {
  std::string name;
  Type type = Type::Float;
  bool isList = false;
  Type countType = Type::Uint8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  /// The property with one of these names, or -1.
  int find(std::initializer_list<std::string_view> names, bool list = false) const {
    for (const std::string_view wanted : names) {
      for (std::size_t i = 0; i < properties.size(); ++i) {
        if (properties[i].name == wanted && properties[i].isList == list)
          return static_cast<int>(i);
      }
    }
    return -1;
  }
};

enum class Encoding { Ascii, Little, Big };

struct Header {
  Encoding encoding = Encoding::Ascii;
  std::vector<Element> elements;
  std::map<std::size_t, std::string> materialNames;
  std::vector<std::string> textureFiles;  ///< as MeshLab and scanners name them
};

/// Reads all up to the first row; unknown keys and comments are skipped.
Header readHeader(TextScanner& in);

/// Reads the body's elements one after another; each element as one number for each property, and
/// lists on the side.
class Body {
 public:
  Body(TextScanner& in, Encoding encoding, const Progress& progress)
      : in_(in), encoding_(encoding), bytes_(in.afterLine()), progress_(progress) {
    const bool nativeIsBig = std::endian::native == std::endian::big;
    swap_ = (encoding == Encoding::Big) != nativeIsBig;
  }

  /// Prepares for an element's rows; refuses a count that the rest of the file cannot hold.
  void begin(const Element& element) {
    element_ = &element;
    scalars_.assign(element.properties.size(), 0);
    words_.assign(element.properties.size(), {});
    hasWords_ = false;
    lists_.resize(element.properties.size());
    std::uint64_t least = 0;
    for (const Property& p : element.properties) {
      least += encoding_ == Encoding::Ascii
                   ? 2
                   : kBytes[static_cast<int>(p.isList ? p.countType : p.type)];
    }
    const std::uint64_t left =
        encoding_ == Encoding::Ascii ? in_.bytesLeft() + 1 : bytes_.size() - position_;
    if (element.count > 0 && least > 0 && element.count > left / least) {
      fail("the file is truncated: its header promises " + std::to_string(element.count) + " of '" +
           TextScanner::shown(element.name) + "' and " + std::to_string(left) + " bytes are left");
    }
  }

  void readRow() {
    if (rows_++ % 16384 == 0) report();
    if (encoding_ == Encoding::Ascii) {
      readTextRow();
    } else {
      readBinaryRow();
    }
  }

  double scalar(int property) const {
    if (hasWords_) checkNumber(property);
    return scalars_[property];
  }
  const std::vector<double>& list(int property) const { return lists_[property]; }

  [[noreturn]] void fail(const std::string& message) const {
    if (encoding_ == Encoding::Ascii) in_.fail(message);
    throw InputError(in_.name() + ": " + message);
  }

 private:
  [[gnu::noinline]] void checkNumber(int property) const {
    if (words_[property].empty()) return;
    fail(element_->properties[property].name + " should be a number, not '" +
         TextScanner::shown(words_[property]) + "'");
  }

  [[gnu::noinline]] void report() const { progress_.report("reading", fraction()); }

  double fraction() const {
    if (encoding_ == Encoding::Ascii) return in_.fraction();
    return static_cast<double>(position_) / static_cast<double>(bytes_.size() + 1);
  }

  void readTextRow() {
    do {
      if (!in_.nextLine())
        fail("the file is truncated: a '" + TextScanner::shown(element_->name) + "' is missing");
    } while (in_.atLineEnd());
    if (hasWords_) std::fill(words_.begin(), words_.end(), std::string_view());
    hasWords_ = false;
    for (std::size_t i = 0; i < element_->properties.size(); ++i) {
      const Property& p = element_->properties[i];
      if (!p.isList) {
        if (const auto value = in_.tryNumber()) {
          scalars_[i] = *value;
        } else if (in_.atLineEnd()) {
          in_.number(p.name.c_str());
        } else {
          // Not-a-numbers have many spellings ("-1.#IND"); they matter only where they are used.
          words_[i] = in_.word();
          hasWords_ = true;
        }
        continue;
      }
      const std::int64_t count = in_.integer("a list's count");
      if (count < 0 || static_cast<std::uint64_t>(count) > in_.bytesLeft())
        fail("a list's count is wrong");
      lists_[i].clear();
      for (std::int64_t k = 0; k < count; ++k) lists_[i].push_back(in_.number(p.name.c_str()));
    }
  }

  void readBinaryRow() {
    for (std::size_t i = 0; i < element_->properties.size(); ++i) {
      const Property& p = element_->properties[i];
      if (!p.isList) {
        require(kBytes[static_cast<int>(p.type)]);
        scalars_[i] = take(p.type);
        continue;
      }
      require(kBytes[static_cast<int>(p.countType)]);
      const double count = take(p.countType);
      if (count < 0) fail("a list's count is negative");
      require(count * kBytes[static_cast<int>(p.type)]);
      lists_[i].resize(static_cast<std::size_t>(count));
      for (double& value : lists_[i]) value = take(p.type);
    }
  }

  void require(double bytes) const {
    if (bytes > static_cast<double>(bytes_.size() - position_)) {
      fail("the file is truncated: it ends in the middle of a '" +
           TextScanner::shown(element_->name) + "'");
    }
  }

  template <class T>
  double takeAs() {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    if (swap_) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
  }

  double take(Type type) {
    switch (type) {
      case Type::Int8:
        return takeAs<std::int8_t>();
      case Type::Uint8:
        return takeAs<std::uint8_t>();
      case Type::Int16:
        return takeAs<std::int16_t>();
      case Type::Uint16:
        return takeAs<std::uint16_t>();
      case Type::Int32:
        return takeAs<std::int32_t>();
      case Type::Uint32:
        return takeAs<std::uint32_t>();
      case Type::Float:
        return takeAs<float>();
      case Type::Double:
        return takeAs<double>();
    }
    return 0;
  }

  TextScanner& in_;
  Encoding encoding_;
  std::string_view bytes_;
  const Progress& progress_;
  std::size_t position_ = 0, rows_ = 0;
  bool swap_ = false;
  const Element* element_ = nullptr;
  std::vector<double> scalars_;
  std::vector<std::string_view> words_;  ///< of the row: what is no number, where `hasWords_`
  bool hasWords_ = false;
  std::vector<std::vector<double>> lists_;
};

}  // namespace exemplar::ply
