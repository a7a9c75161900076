// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What is beside a file of heights whose format cannot say it: FILE.json.

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "maps/height_formats.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kKind = "exemplar height map";

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what + "; correct or remove the file");
}

/// Whether there is a file of ours, whatever it holds; `found` is its content.
bool isOurs(const fs::path& place, Json& found) {
  std::error_code error;
  if (!fs::is_regular_file(place, error) || fs::file_size(place, error) > 1 << 16) return false;
  if (fs::file_size(place, error) == 0 || error) return false;
  found = Json::parse(readFile(place), nullptr, false);
  return found.is_object() && found.contains("kind") && found["kind"] == kKind;
}

std::optional<double> number(const fs::path& place, const Json& json, const char* key, double least,
                             double most) {
  if (!json.contains(key)) return std::nullopt;
  const Json& value = json[key];
  const double number =
      value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!(number >= least && number <= most)) {
    fail(place, std::string("\"") + key + "\" must be a number from " + exactNumber(least) +
                    " to " + exactNumber(most));
  }
  return number;
}

}  // namespace

fs::path heightSidecarPath(const fs::path& path) { return fs::path(path) += ".json"; }

std::optional<HeightSidecar> readSidecar(const fs::path& path) {
  const fs::path place = heightSidecarPath(path);
  Json json;
  if (!isOurs(place, json)) return std::nullopt;
  constexpr double kMost = 1e15, kLeast = 1e-15;
  HeightSidecar sidecar;
  sidecar.width = static_cast<int>(number(place, json, "width", 1, 1 << 24).value_or(0));
  sidecar.height = static_cast<int>(number(place, json, "height", 1, 1 << 24).value_or(0));
  sidecar.cellSize = number(place, json, "cell_size", kLeast, kMost);
  const auto west = number(place, json, "west", -kMost, kMost);
  const auto south = number(place, json, "south", -kMost, kMost);
  if (west && south) sidecar.corner = {*west, *south};
  sidecar.step = number(place, json, "height_step", kLeast, kMost).value_or(1);
  sidecar.offset = number(place, json, "height_offset", -kMost, kMost).value_or(0);
  if (const auto noData = number(place, json, "no_data", 0, 65535))
    sidecar.noData = static_cast<int>(*noData);
  if (json.contains("type")) {
    sidecar.floats = json["type"] == "float32";
    if (!sidecar.floats && json["type"] != "uint16")
      fail(place, "\"type\" must be \"uint16\" or \"float32\"");
  }
  return sidecar;
}

void requireSidecarPlace(const fs::path& path) {
  const fs::path place = heightSidecarPath(path);
  std::error_code error;
  Json json;
  if (fs::exists(place, error) && !isOurs(place, json)) {
    throw InputError(place.string() + ": is there and is something else; what " +
                     path.filename().string() + " cannot say would be written to it");
  }
}

void writeSidecar(const fs::path& path, const HeightSidecar& sidecar, Warnings* warnings) {
  const fs::path place = heightSidecarPath(path);
  const bool usual = sidecar.step == 1 && sidecar.offset == 0;
  const std::string ending = lowerExtension(path);
  const bool saysSize = (ending != ".r16" && ending != ".raw") || sidecar.width == sidecar.height;
  if (usual && saysSize && !sidecar.cellSize && !sidecar.noData) {
    Json json;
    std::error_code error;
    if (isOurs(place, json)) fs::remove(place, error);
    return;
  }
  Json json = {{"kind", kKind}, {"width", sidecar.width}, {"height", sidecar.height}};
  if (sidecar.cellSize) json["cell_size"] = *sidecar.cellSize;
  if (sidecar.corner) {
    json["west"] = sidecar.corner->west;
    json["south"] = sidecar.corner->south;
  }
  json["height_step"] = sidecar.step;
  json["height_offset"] = sidecar.offset;
  if (sidecar.noData) json["no_data"] = *sidecar.noData;
  writeFile(place, json.dump(2) + "\n");
  std::string line = path.string() + ": ";
  if (!saysSize) {
    line += "it holds " + std::to_string(sidecar.width) + " x " + std::to_string(sidecar.height) +
            " points; ";
  }
  if (!usual) {
    line += "its integers count steps of " + exactNumber(sidecar.step) + " from a height of " +
            exactNumber(sidecar.offset) + "; ";
  }
  if (sidecar.noData) line += std::to_string(*sidecar.noData) + " is no data; ";
  if (sidecar.cellSize) line += "cells are " + exactNumber(*sidecar.cellSize) + " long; ";
  warn(warnings, line + "so says " + place.filename().string() + ", which is read with it");
}

}  // namespace exemplar
