// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/world_file.h"

#include <charconv>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "core/platform.h"
#include "engine/json.h"

namespace exemplar {
namespace {

Json toJson(const Settings& settings) {
  Json list = Json::array();
  for (const auto& [key, text] : settings.given()) list.push_back({key, text});
  return list;
}

/// What decides bytes.
Json essence(const WorldFile& file) {
  return {{"format", WorldFile::kFormat},
          {"program", file.program},
          {"engine", file.engine},
          {"seed", file.seed},
          {"tile", file.tile},
          {"window", file.window},
          {"height", file.height},
          {"settings", toJson(file.settings)},
          {"example", {{"file", file.example}, {"xxh3", hashText(file.exampleHash)}}},
          {"start", {{"xxh3", hashText(file.startHash)}}}};
}

std::uint64_t hashFrom(const Json& json) {
  const std::string text = json.get<std::string>();
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (text.size() != 16 || error != std::errc{} || end != text.data() + text.size())
    throw InputError("'" + text + "' is no hash");
  return hash;
}

}  // namespace

std::uint64_t WorldFile::id() const { return contentHash(jsonText(essence(*this), 0)); }

std::filesystem::path worldFilePath(const std::filesystem::path& world) {
  return world / "world.json";
}

WorldFile readWorldFile(const std::filesystem::path& world) {
  const std::filesystem::path path = worldFilePath(world);
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw InputError(world.string() + ": is no world; it has no world.json (exemplar world init)");
  WorldFile file;
  try {
    const Json json = Json::parse(readFile(path));
    if (json.at("format").get<int>() != WorldFile::kFormat)
      throw InputError("is of format " + std::to_string(json.at("format").get<int>()) +
                       ", and this program reads format " + std::to_string(WorldFile::kFormat));
    file.program = json.at("program");
    file.engine = json.at("engine");
    file.seed = json.at("seed");
    file.tile = json.at("tile");
    file.window = json.at("window");
    file.height = json.at("height");
    for (const Json& one : json.at("settings")) file.settings.add(one.at(0), one.at(1));
    file.example = json.at("example").at("file");
    file.exampleHash = hashFrom(json.at("example").at("xxh3"));
    file.startHash = hashFrom(json.at("start").at("xxh3"));
    file.fingerprint = json.at("fingerprint");
    file.canary = hashFrom(json.at("canary").at("xxh3"));
    const auto within = [](int n, int least, int most) { return n >= least && n <= most; };
    if (!within(file.tile, 8, 4096) || !within(file.window, 12, 1024) ||
        !within(file.height, 1, 32767))
      throw InputError("a size is out of range");
    if (std::filesystem::path(file.example).filename() != file.example || file.example.empty())
      throw InputError("the example's file is not in the world's folder");
  } catch (const Json::exception& e) {
    throw InputError(path.string() + ": is damaged: " + e.what());
  } catch (const InputError& e) {
    throw InputError(path.string() + ": " + e.what());
  }
  return file;
}

void writeWorldFile(const std::filesystem::path& world, const WorldFile& file) {
  Json json = essence(file);
  json["id"] = hashText(file.id());
  json["fingerprint"] = file.fingerprint;
  json["canary"] = {{"tile", {0, 0}}, {"xxh3", hashText(file.canary)}};
  writeFile(worldFilePath(world), jsonText(json, 2) + "\n");
}

std::string machineFingerprint() {
  return "exemplar " EXEMPLAR_VERSION ", " __VERSION__ ", " + platform::arithmetic();
}

}  // namespace exemplar
