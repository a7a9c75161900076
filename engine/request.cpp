// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/request.h"

#include <cmath>

#include "core/error.h"
#include "engine/words.h"

namespace exemplar {
namespace {

using O = Request;

/// Those with a value that is read into a member.
const SettingTable<O>& valueTable() {
  static const SettingTable<O> table{
      settingRow<O>(
          "scale", [](O & o) -> auto& { return o.extent.scale; },
          "the result's size as a multiple of the example's", kAboveZero, "",
          "the example's own choice, mostly 2,2,1"),
      settingRow<O>("size", [](O & o) -> auto& { return o.extent.size; },
                    "the result's size in samples, or cells of labels, in place of `scale`",
                    {1, 32767}),
      settingRow<O>("seed", &O::seed, "another seed, another result", kFromZero),
      settingRow<O>(
          "periodic", &O::periodic,
          "axes along which copies of the result tile; its surface is left open there, so "
          "that they join")};
  return table;
}

}  // namespace

std::span<const Setting> requestSettings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> settings(valueTable().settings().begin(), valueTable().settings().end());
    settings.push_back({.key = "keep",
                        .type = SettingType::File,
                        .meaning = "a solid (mesh or .vdb) in the example's coordinates: what is "
                                   "inside stays as it is, an end at its end, and all else is made "
                                   "of it, or in a longer result also of the end that is not "
                                   "kept; of a height map a gray picture: what is white stays"});
    settings.push_back({.key = "guide",
                        .type = SettingType::File,
                        .meaning = "a volume, mesh or height map, stretched to the result's box, "
                                   "that says coarsely where solid should be; of terrain rough "
                                   "heights, or lines of ridges and valleys (.csv); of solids a "
                                   "picture seen from above, or cells (.vox, .txt): nothing is "
                                   "where it is black or empty, most where it is white"});
    settings.push_back({.key = "mix-map",
                        .type = SettingType::File,
                        .meaning = "where each of several examples is wanted: a gray picture seen "
                                   "from above, black for the first and white for the last, or "
                                   "a volume (.vdb), inside whose solid the last is; both are "
                                   "stretched to the result's box"});
    settings.push_back({.key = "on",
                        .type = SettingType::File,
                        .meaning = "a surface (mesh) that the example, which lies flat, is laid "
                                   "on"});
    settings.push_back({.key = "pin",
                        .type = SettingType::Text,
                        .meaning = "a cell that must have one of some labels: X,Y,Z=LABEL,...",
                        .repeats = true});
    return settings;
  }();
  return all;
}

Request requestOf(const Settings& settings, const ReadOptions& reading) {
  Request request;
  request.reading = reading;
  valueTable().apply(settings, request);
  if (request.extent.size && request.extent.scale)
    throw InputError("`size` and `scale` say the same thing; give one of the two");
  if (settings.has("keep")) request.decided.keep = Source(settings.text("keep"));
  if (settings.has("guide")) request.guide = Source(settings.text("guide"));
  if (settings.has("mix-map")) request.mixMap = Source(settings.text("mix-map"));
  if (settings.has("on")) request.on = Source(settings.text("on"));
  for (const std::string& text : settings.texts("pin")) {
    const auto [cell, labels] = keyAndValue(text, "`pin`", "X,Y,Z=LABEL,...");
    request.decided.pins.push_back({parseCell(cell, "`pin` " + text), labels});
  }
  for (const auto& [key, text] : settings.given()) {
    bool common = false;
    for (const Setting& setting : requestSettings()) common = common || setting.key == key;
    if (!common) request.settings.add(key, text);
  }
  return request;
}

Vec3i resultSize(const Request& request, const Vec3i& example, const Vec3d& usualScale,
                 const std::string& unit) {
  if (request.extent.size) return *request.extent.size;
  return scaledSize(example, request.extent.scale.value_or(usualScale), unit);
}

Vec3i scaledSize(const Vec3i& size, const Vec3d& scale, const std::string& unit) {
  Vec3i scaled;
  for (int axis = 0; axis < 3; ++axis) {
    const double n = std::round(size[axis] * scale[axis]);
    if (!(n >= 1 && n <= 32767)) {
      throw InputError("`scale`: the result would be " + numberText(n) + " " + unit +
                       " long; expected 1 to 32767");
    }
    scaled[axis] = static_cast<int>(n);
  }
  return scaled;
}

}  // namespace exemplar
