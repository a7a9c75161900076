// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/version.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/built_with.h"
#include "apps/commit.h"
#include "apps/help.h"
#include "apps/terminal.h"
#include "core/json_text.h"
#include "core/platform.h"

namespace exemplar {
namespace {

/// Name and version of each library, as CMake has found them; those that say no version are left
/// out.
std::vector<std::pair<std::string, std::string>> libraries() {
  std::vector<std::pair<std::string, std::string>> all;
  for (std::string_view rest = EXEMPLAR_LIBRARY_VERSIONS; !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
    const std::size_t space = one.find(' ');
    if (space + 1 < one.size()) all.emplace_back(one.substr(0, space), one.substr(space + 1));
  }
  return all;
}

}  // namespace

std::string versionText() {
  std::string text = "exemplar " EXEMPLAR_VERSION "\n", names;
  if (!std::string_view(EXEMPLAR_COMMIT).empty()) text += "commit     " EXEMPLAR_COMMIT "\n";
  for (const auto& [name, version] : libraries())
    names += (names.empty() ? "" : ", ") + name + " " + version;
  text += "libraries  " + wrapped(names, 11).substr(11);
  text += "compiler   " __VERSION__ "\n";
  text += "machine    " + platform::arithmetic() + "\n";
  return text;
}

std::string versionJson() {
  nlohmann::ordered_json json{
      {"version", EXEMPLAR_VERSION},   {"commit", EXEMPLAR_COMMIT},
      {"protocol", kProgressProtocol}, {"libraries", nlohmann::ordered_json::object()},
      {"compiler", __VERSION__},       {"arithmetic", platform::arithmetic()},
      {"platform", platform::name()}};
  for (const auto& [name, version] : libraries()) json["libraries"][name] = version;
  return jsonText(json, 2) + "\n";
}

}  // namespace exemplar
