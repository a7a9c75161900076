// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <nlohmann/json.hpp>
#include <string>

#include "core/json_text.h"
#include "fuzz_reader.h"
#include "report/encode.h"

namespace {

using Json = nlohmann::ordered_json;

/// Whatever names and numbers the statistics hold, what is written can be read again, ends no
/// script element, and reads the same on a page.
void read(std::string_view bytes) {
  const std::string name(bytes.substr(0, bytes.size() / 2)), text(bytes.substr(bytes.size() / 2));
  double number = 0;
  bytes.copy(reinterpret_cast<char*>(&number), sizeof number);
  const Json stats = {
      {"warnings", Json::array({text, name})}, {"number", number}, {"names", {{name, text}}}};
  for (const int indent : {-1, 2}) {
    const std::string line = exemplar::jsonText(stats, indent);
    const Json again = Json::parse(line);
    if (again["warnings"].size() != 2 || exemplar::jsonText(again, indent) != line)
      __builtin_trap();
    const std::string safe = exemplar::escapedJson(line);
    if (safe.find("</") != std::string::npos || safe.find("<!--") != std::string::npos ||
        Json::parse(safe) != again)
      __builtin_trap();
  }
  const std::string html = exemplar::escapedHtml(text);
  if (html.find_first_of("<>\"'") != std::string::npos) __builtin_trap();
}

}  // namespace

EXEMPLAR_FUZZ_READER(read)
