// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/settings_page.h"

#include <cmath>
#include <map>

#include "engine/engine.h"
#include "engine/json.h"
#include "engine/realize.h"
#include "engine/words.h"

namespace exemplar {
namespace {

std::string_view typeWord(SettingType type) {
  switch (type) {
    case SettingType::Flag:
      return "flag";
    case SettingType::IntegerOrAuto:
    case SettingType::Integer:
      return "integer";
    case SettingType::Number:
      return "number";
    case SettingType::Choice:
      return "choice";
    case SettingType::Size:
      return "size";
    case SettingType::Lengths:
      return "lengths";
    case SettingType::Axes:
    case SettingType::AxesOrAuto:
      return "axes";
    case SettingType::File:
      return "file";
    default:
      return "text";
  }
}

/// "3 to 15 samples", "quilt, vote", "X,Y,Z in cells".
std::string valuesOf(const Setting& setting) {
  if (setting.type == SettingType::Flag) return "";
  if (setting.type == SettingType::Choice) return joined(setting.choices, "or");
  std::string text(typeName(setting.type));
  const bool least = std::isfinite(setting.least) && setting.least > -1e15;
  if (least && setting.least == kAboveZero.least) {
    text += " above 0";
  } else if (least && std::isfinite(setting.most)) {
    text += ", " + numberText(setting.least) + " to " + numberText(setting.most);
  } else if (least) {
    text += " from " + numberText(setting.least) + " on";
  }
  return setting.unit.empty() ? text : text + ", " + setting.unit;
}

std::string table(std::span<const Setting> settings) {
  std::string text = "| setting | value | default | meaning |\n|---|---|---|---|\n";
  for (const Setting& setting : settings) {
    text += "| `" + setting.key + "` | " + valuesOf(setting) + " | " +
            (setting.type == SettingType::Flag ? "" : setting.byDefault) + " | " + setting.meaning +
            (setting.repeats ? " (may be repeated)" : "") + " |\n";
  }
  return text;
}

Json toJson(const Setting& setting) {
  Json json{{"key", setting.key},   {"type", typeWord(setting.type)}, {"meaning", setting.meaning},
            {"unit", setting.unit}, {"default", setting.byDefault},   {"repeats", setting.repeats}};
  if (std::isfinite(setting.least)) json["least"] = setting.least;
  if (std::isfinite(setting.most)) json["most"] = setting.most;
  if (!setting.choices.empty()) json["choices"] = setting.choices;
  return json;
}

/// "distances", "labels", ...
std::string_view formName(Form form) {
  constexpr std::string_view kNames[] = {"distances", "labels", "polygons", "maps", "height maps"};
  return kNames[static_cast<std::size_t>(form)];
}

}  // namespace

std::string settingsPage() {
  std::string text =
      "# Settings\n\n"
      "Every setting, as the library declares it (`engine/`); `exemplar engines --markdown` writes "
      "this page.\nOn the command line `field-block` is `--field-block`; in `compare --engines` it "
      "is `NAME:field-block=8`. An engine that does not have\na setting refuses it, naming those "
      "that do.\n\n"
      "## Requests\n\nEvery engine honors `scale`, `size` and `seed`; the others are refused by "
      "engines that cannot.\n\n" +
      table(requestSettings()) + "\n## Engines\n";
  for (const Engine* engine : engines()) {
    std::vector<std::string> honored{"`scale`", "`size`", "`seed`"};
    for (const std::string_view key : engine->honors())
      honored.push_back("`" + std::string(key) + "`");
    text += "\n### " + std::string(engine->name()) + "\n\n" + std::string(engine->meaning()) +
            ". Works on " + std::string(formName(engine->form())) + "; honors " +
            joined(honored, "and") + (engine->mixes() ? "; takes several examples" : "") + ".\n\n" +
            table(engine->settings());
  }
  text +=
      "\n## Reading an example as distances\n\n" + table(readingSettings(Form::Field).settings());
  text += "\n## Reading an example as labels\n\n" + table(readingSettings(Form::Labels).settings());
  text +=
      "\n## Reading an example as polygons\n\n" + table(readingSettings(Form::Polygons).settings());
  text += "\n## Reading an example as a map\n\n" + table(readingSettings(Form::Map).settings());
  text += "\n## Reading a height map for terrain\n\n" +
          table(readingSettings(Form::Heights).settings());
  text += "\n## The surface of a result\n\nOf distances:\n\n" +
          table(surfaceSettings(Form::Field).settings()) + "\nOf labels:\n\n" +
          table(surfaceSettings(Form::Labels).settings()) + "\nOf polygons:\n\n" +
          table(surfaceSettings(Form::Polygons).settings());
  return text;
}

Json settingsJson() {
  Json all = Json::array();
  for (const Engine* engine : engines()) {
    Json settings = Json::array();
    for (const Setting& setting : settingsOf(*engine)) settings.push_back(toJson(setting));
    all.push_back({{"name", engine->name()},
                   {"meaning", engine->meaning()},
                   {"form", formName(engine->form())},
                   {"mixes", engine->mixes()},
                   {"settings", std::move(settings)}});
  }
  return all;
}

}  // namespace exemplar
