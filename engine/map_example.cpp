// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Examples as maps.

#include <algorithm>
#include <cctype>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "engine/example_forms.h"
#include "engine/words.h"

namespace exemplar {
namespace {

MapLayer readLayer(const Source& source, const std::string& name, Warnings& warnings) {
  if (const std::string* bytes = source.inMemory<std::string>())
    return decodeMapLayer(*bytes, source.name(), name, &warnings);
  return readMapLayer(source.path(), name, &warnings);
}

bool isPicture(const Source& source) {
  const std::string ending = lowerExtension(source.path());
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

}  // namespace

void readAsMap(Example& example, const Progress& progress) {
  if (!isPicture(example.source)) {
    throw InputError(example.name() +
                     ": the engine layered takes pictures (.png .jpg); try the engine geometry");
  }
  Map map;
  map.layers.push_back(readLayer(example.source, "color", example.warnings));
  std::set<std::string> names{"color"};
  for (const auto& [name, file] : example.reading.channels) {
    progress.check();
    const auto isPlain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (!std::ranges::all_of(name, isPlain))
      throw InputError("`channel` " + name + ": a name is of letters, digits, _ and -");
    if (!names.insert(name).second)
      throw InputError("`channel` " + name + ": given twice, or the name of the first picture");
    map.layers.push_back(readLayer(Source(file), name, example.warnings));
    const Grid<float>& plane = map.layers.back().planes.front();
    if (!plane.sameSize(map.layers.front().planes.front())) {
      throw InputError(file + ": " + std::to_string(plane.width()) + " x " +
                       std::to_string(plane.height()) + " pixels, and " + example.name() + " has " +
                       std::to_string(map.width()) + " x " + std::to_string(map.height()) +
                       "; the pictures of one surface are of one size");
    }
  }
  example.description = "picture of " + std::to_string(map.width()) + " x " +
                        std::to_string(map.height()) + " pixels of " +
                        std::to_string(map.layers.front().bits) + " bits";
  if (map.layers.size() > 1)
    example.description += " with " + counted(map.layers.size() - 1, "channel");
  example.data = std::move(map);
}

}  // namespace exemplar
