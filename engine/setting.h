// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/axes.h"
#include "core/vec.h"

/// Settings are declared once: what a key means, its type, range, unit and default. The command's
/// options and help, what an engine accepts, `compare`, and the docs' tables come from that list.
namespace exemplar {

/// What a setting's text is read as.
enum class SettingType {
  Flag,           ///< "true" or "false"
  Integer,        ///< "12"
  Number,         ///< "0.5"
  Choice,         ///< one of `Setting::choices`
  Size,           ///< "16", or "16,16,8": whole numbers along x, y, z
  Lengths,        ///< "2", or "1,1,2": numbers above 0 along x, y, z
  Axes,           ///< "x,y", "xy" or "none"
  AxesOrAuto,     ///< the same, or "auto"
  IntegerOrAuto,  ///< "12" or "auto"
  Text,           ///< anything
  File,           ///< a path
};
/// "number", "X,Y,Z", ...: what stands for a value in help and tables.
std::string_view typeName(SettingType type);

/// One thing that can be set.
struct Setting {
  std::string key;  ///< "field-block": lower case, words joined by hyphens
  SettingType type = SettingType::Text;
  std::string meaning;    ///< one sentence without a full stop
  std::string unit = {};  ///< "samples", "cells", "voxels", ...; of numbers
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};
  std::string byDefault = {};  ///< as it would be written, or in words: "found from the example"
  bool repeats = false;        ///< may be given several times
};

/// Settings as they were given: keys and texts, in order. What they may be is checked where they
/// are applied.
class Settings {
 public:
  Settings() = default;
  Settings(std::initializer_list<std::pair<std::string, std::string>> given) {
    for (const auto& [key, text] : given) add(key, text);
  }

  /// Replaces what was given for the key.
  void set(const std::string& key, std::string text);
  void set(const std::string& key, const char* text) { set(key, std::string(text)); }
  void set(const std::string& key, bool on) { set(key, std::string(on ? "true" : "false")); }
  void set(const std::string& key, double value);
  void set(const std::string& key, int value) { set(key, std::to_string(value)); }
  /// Adds to what was given for a key that repeats.
  void add(const std::string& key, std::string text) { given_.emplace_back(key, std::move(text)); }
  void remove(std::string_view key);

  bool has(std::string_view key) const;
  /// The last text that was given for the key; `otherwise` where there is none.
  std::string text(std::string_view key, std::string otherwise = {}) const;
  /// All texts that were given for the key.
  std::vector<std::string> texts(std::string_view key) const;
  const std::vector<std::pair<std::string, std::string>>& given() const { return given_; }

 private:
  std::vector<std::pair<std::string, std::string>> given_;
};

/// Throws `InputError` naming the setting unless its text can be read and is in range.
void checkSetting(const Setting& setting, const std::string& text);

/// Reads the value of a setting; each throws `InputError` naming it, the text, and what would be
/// right.
bool readFlag(const Setting& setting, const std::string& text);
std::int64_t readInteger(const Setting& setting, const std::string& text);
double readNumber(const Setting& setting, const std::string& text);
std::size_t readChoice(const Setting& setting, const std::string& text);
Vec3i readSize(const Setting& setting, const std::string& text);
Vec3d readLengths(const Setting& setting, const std::string& text);

/// Replaces each `` `key` `` in a message of the library by how its reader spells settings:
/// "--key".
std::string spelled(std::string_view message,
                    const std::function<std::string(std::string_view)>& spell);

/// The settings that fill a plain options struct: each row declares a setting and writes its value
/// into a member. Types and defaults come from the member.
template <class Options>
class SettingTable {
 public:
  struct Row {
    Setting setting;
    std::function<void(const Setting&, const std::string& text, Options&)> write;
  };

  SettingTable(std::initializer_list<Row> rows) {
    for (const Row& row : rows) {
      settings_.push_back(row.setting);
      write_.push_back(row.write);
    }
  }
  std::span<const Setting> settings() const { return settings_; }

  /// Writes what was given of these settings into `options`; others are passed over. Throws
  /// `InputError` as `readNumber` and its like do.
  void apply(const Settings& given, Options& options) const {
    for (std::size_t n = 0; n < settings_.size(); ++n) {
      for (const std::string& text : given.texts(settings_[n].key))
        write_[n](settings_[n], text, options);
    }
  }

 private:
  std::vector<Setting> settings_;
  std::vector<std::function<void(const Setting&, const std::string&, Options&)>> write_;
};

/// The range of a setting's numbers.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};
/// Numbers above 0, and from 0 on.
inline constexpr Range kAboveZero{std::numeric_limits<double>::denorm_min()}, kFromZero{0};

/// How a number is written: "0.2", "7", "inf".
std::string numberText(double value);

namespace setting_detail {

template <class T>
struct Unwrapped {
  using Type = T;
  static constexpr bool optional = false;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using Type = T;
  static constexpr bool optional = true;
};

template <class T>
constexpr SettingType typeOf() {
  if constexpr (std::is_same_v<T, bool>) return SettingType::Flag;
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) return SettingType::Integer;
  if constexpr (std::is_floating_point_v<T>) return SettingType::Number;
  if constexpr (std::is_same_v<T, Vec3i>) return SettingType::Size;
  if constexpr (std::is_same_v<T, Vec3d>) return SettingType::Lengths;
  if constexpr (std::is_same_v<T, Axes>) return SettingType::Axes;
  return SettingType::Text;
}

template <class T>
std::string textOf(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return numberText(static_cast<double>(value));
  } else if constexpr (std::is_same_v<T, Vec3i> || std::is_same_v<T, Vec3d>) {
    return numberText(value.x) + "," + numberText(value.y) + "," + numberText(value.z);
  } else if constexpr (std::is_same_v<T, Axes>) {
    return readableAxes(value);
  } else {
    return {};
  }
}

template <class T>
T read(const Setting& setting, const std::string& text) {
  if constexpr (std::is_same_v<T, bool>) {
    return readFlag(setting, text);
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(readInteger(setting, text));
  } else if constexpr (std::is_floating_point_v<T>) {
    return readNumber(setting, text);
  } else if constexpr (std::is_same_v<T, Vec3i>) {
    return readSize(setting, text);
  } else if constexpr (std::is_same_v<T, Vec3d>) {
    return readLengths(setting, text);
  } else if constexpr (std::is_same_v<T, Axes>) {
    return parseAxes(text, "`" + setting.key + "` " + text);
  } else {
    return text;
  }
}

}  // namespace setting_detail

/// A row for a member, which `member` (a pointer to it, or a function that returns it by reference)
/// names. An optional member has no value by default, and `byDefault` says so in words; optional
/// axes may be set to "auto", which is none.
template <class Options, class Member>
typename SettingTable<Options>::Row settingRow(std::string key, Member member, std::string meaning,
                                               Range range = {}, std::string unit = {},
                                               std::string byDefault = {}) {
  using Held = std::remove_cvref_t<std::invoke_result_t<Member, Options&>>;
  using Wrapped = setting_detail::Unwrapped<Held>;
  using Value = typename Wrapped::Type;
  Setting setting{.key = std::move(key),
                  .type = setting_detail::typeOf<Value>(),
                  .meaning = std::move(meaning),
                  .unit = std::move(unit),
                  .least = range.least,
                  .most = range.most,
                  .byDefault = std::move(byDefault)};
  if constexpr (!Wrapped::optional) {
    Options usual{};
    if (setting.byDefault.empty())
      setting.byDefault = setting_detail::textOf<Value>(std::invoke(member, usual));
  }
  if constexpr (Wrapped::optional && std::is_same_v<Value, Axes>)
    setting.type = SettingType::AxesOrAuto;
  return {std::move(setting), [member](const Setting& s, const std::string& text, Options& o) {
            if (s.type == SettingType::AxesOrAuto && text == "auto") {
              std::invoke(member, o) = Held{};
            } else {
              std::invoke(member, o) = setting_detail::read<Value>(s, text);
            }
          }};
}

/// A row for a member that is one of a few named values.
template <class Options, class Value, class Member>
typename SettingTable<Options>::Row choiceRow(std::string key, Member member, std::string meaning,
                                              std::vector<std::pair<std::string, Value>> names,
                                              std::string byDefault = {}) {
  Setting setting{.key = std::move(key),
                  .type = SettingType::Choice,
                  .meaning = std::move(meaning),
                  .byDefault = std::move(byDefault)};
  Options usual{};
  for (const auto& [name, value] : names) {
    setting.choices.push_back(name);
    if (setting.byDefault.empty() && Value(std::invoke(member, usual)) == value)
      setting.byDefault = name;
  }
  return {std::move(setting),
          [member, names](const Setting& s, const std::string& text, Options& o) {
            std::invoke(member, o) = names[readChoice(s, text)].second;
          }};
}

}  // namespace exemplar
