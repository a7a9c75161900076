// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/setting.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "engine/words.h"

namespace exemplar {
namespace {

std::string named(const Setting& setting, const std::string& text) {
  return "`" + setting.key + "` " + text;
}

/// "3 to 15", "at least 1", "a number above 0".
std::string readableRange(const Setting& setting) {
  const bool least = std::isfinite(setting.least), most = std::isfinite(setting.most);
  const bool positive = setting.least == kAboveZero.least;
  const std::string unit = setting.unit.empty() ? "" : " " + setting.unit;
  if (least && most && !positive)
    return numberText(setting.least) + " to " + numberText(setting.most) + unit +
           (setting.type == SettingType::IntegerOrAuto ? ", or auto" : "");
  const bool whole =
      setting.type == SettingType::Integer || setting.type == SettingType::IntegerOrAuto;
  const std::string what = whole ? "a whole number" : "a number";
  if (positive)
    return what + " above 0" + (most ? ", at most " + numberText(setting.most) : "") + unit;
  if (least) return what + " from " + numberText(setting.least) + " on" + unit;
  if (most) return what + " of at most " + numberText(setting.most) + unit;
  return what + unit;
}

void requireRange(const Setting& setting, const std::string& text, double value) {
  if (!(value >= setting.least && value <= setting.most))
    throw InputError(named(setting, text) + ": expected " + readableRange(setting));
}

/// One number or three; throws unless each is above 0, or at least that where 0 is allowed.
Vec3d readTriple(const std::string& text, const std::string& what, bool zero = false) {
  const std::size_t count = split(text, ',').size();
  if (count != 1 && count != 3)
    throw InputError(what + ": expected one number or three, as in 2,2,1");
  const std::vector<double> numbers = parseNumbers(text, count, what);
  for (const double number : numbers)
    if (!(number > 0 || (zero && number == 0)))
      throw InputError(what + ": expected numbers " + (zero ? "from 0 on" : "above 0"));
  return count == 1 ? Vec3d{numbers[0], numbers[0], numbers[0]}
                    : Vec3d{numbers[0], numbers[1], numbers[2]};
}

}  // namespace

std::string_view typeName(SettingType type) {
  switch (type) {
    case SettingType::Flag:
      return "";
    case SettingType::Integer:
      return "N";
    case SettingType::IntegerOrAuto:
      return "N|auto";
    case SettingType::Number:
      return "NUMBER";
    case SettingType::Choice:
      return "NAME";
    case SettingType::Size:
    case SettingType::Lengths:
      return "X,Y,Z";
    case SettingType::Axes:
    case SettingType::AxesOrAuto:
      return "AXES";
    case SettingType::File:
      return "FILE";
    default:
      return "TEXT";
  }
}

void Settings::set(const std::string& key, std::string text) {
  remove(key);
  add(key, std::move(text));
}
void Settings::set(const std::string& key, double value) { set(key, numberText(value)); }

void Settings::remove(std::string_view key) {
  std::erase_if(given_, [&](const auto& entry) { return entry.first == key; });
}

bool Settings::has(std::string_view key) const {
  return std::ranges::any_of(given_, [&](const auto& entry) { return entry.first == key; });
}

std::string Settings::text(std::string_view key, std::string otherwise) const {
  for (auto entry = given_.rbegin(); entry != given_.rend(); ++entry)
    if (entry->first == key) return entry->second;
  return otherwise;
}

std::vector<std::string> Settings::texts(std::string_view key) const {
  std::vector<std::string> texts;
  for (const auto& [name, text] : given_)
    if (name == key) texts.push_back(text);
  return texts;
}

void checkSetting(const Setting& setting, const std::string& text) {
  switch (setting.type) {
    case SettingType::Flag:
      readFlag(setting, text);
      break;
    case SettingType::IntegerOrAuto:
      if (text == "auto") break;
      [[fallthrough]];
    case SettingType::Integer:
      readInteger(setting, text);
      break;
    case SettingType::Number:
      readNumber(setting, text);
      break;
    case SettingType::Choice:
      readChoice(setting, text);
      break;
    case SettingType::Size:
      readSize(setting, text);
      break;
    case SettingType::Lengths:
      readLengths(setting, text);
      break;
    case SettingType::Axes:
    case SettingType::AxesOrAuto:
      if (setting.type == SettingType::AxesOrAuto && text == "auto") break;
      parseAxes(text, named(setting, text));
      break;
    case SettingType::Text:
    case SettingType::File:
      if (text.empty()) throw InputError("`" + setting.key + "`: nothing is given");
      break;
  }
}

bool readFlag(const Setting& setting, const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  throw InputError(named(setting, text) + ": expected true or false");
}

std::int64_t readInteger(const Setting& setting, const std::string& text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    // Seeds may be any 64 bits.
    std::uint64_t bits = 0;
    const auto [last, wrong] = std::from_chars(text.data(), text.data() + text.size(), bits);
    if (wrong == std::errc{} && last == text.data() + text.size() && !std::isfinite(setting.most))
      return static_cast<std::int64_t>(bits);
    throw InputError(named(setting, text) + ": expected " + readableRange(setting));
  }
  requireRange(setting, text, static_cast<double>(value));
  return value;
}

double readNumber(const Setting& setting, const std::string& text) {
  if (text == "inf" && setting.most == std::numeric_limits<double>::infinity())
    return std::numeric_limits<double>::infinity();
  const double value = parseNumber(text, named(setting, text));
  requireRange(setting, text, value);
  return value;
}

std::size_t readChoice(const Setting& setting, const std::string& text) {
  const auto found = std::ranges::find(setting.choices, text);
  if (found == setting.choices.end()) {
    throw InputError(named(setting, text) + ": expected " + joined(setting.choices, "or"));
  }
  return static_cast<std::size_t>(found - setting.choices.begin());
}

Vec3i readSize(const Setting& setting, const std::string& text) {
  const bool zero = setting.least == 0;
  const Vec3d triple = readTriple(text, named(setting, text), zero);
  Vec3i size;
  const double most = std::min(setting.most, 32767.0);
  const double least = zero ? 0 : std::max(setting.least, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    if (triple[axis] != std::floor(triple[axis]) || triple[axis] > most || triple[axis] < least) {
      throw InputError(named(setting, text) + ": expected whole numbers" +
                       (setting.unit.empty() ? "" : " of " + setting.unit) + ", " +
                       numberText(least) + " to " + numberText(most));
    }
    size[axis] = static_cast<int>(triple[axis]);
  }
  return size;
}

Vec3d readLengths(const Setting& setting, const std::string& text) {
  const Vec3d lengths = readTriple(text, named(setting, text));
  for (int axis = 0; axis < 3; ++axis) requireRange(setting, text, lengths[axis]);
  return lengths;
}

std::string spelled(std::string_view message,
                    const std::function<std::string(std::string_view)>& spell) {
  const auto isKey = [](std::string_view word) {
    return !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == word.npos;
  };
  std::string text;
  while (!message.empty()) {
    const std::size_t open = message.find('`');
    const std::size_t close = open == message.npos ? open : message.find('`', open + 1);
    if (close == message.npos) break;
    const std::string_view word = message.substr(open + 1, close - open - 1);
    text += message.substr(0, open);
    if (isKey(word)) {
      text += spell(word);
      message.remove_prefix(close + 1);
    } else {
      // The second backtick may begin a name.
      text += message.substr(open, close - open);
      message.remove_prefix(close);
    }
  }
  text += message;
  return text;
}

std::string numberText(double value) {
  // Without an exponent where that is readable.
  const double size = std::abs(value);
  const bool fixed = value == 0 || (size >= 1e-6 && size < 1e15);
  char text[64];
  const auto [end, error] =
      fixed ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed)
            : std::to_chars(text, text + sizeof text, value);
  return error == std::errc{} ? std::string(text, end) : std::string();
}

}  // namespace exemplar
