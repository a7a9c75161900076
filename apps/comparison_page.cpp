// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string_view>

#include "apps/comparison.h"
#include "apps/json.h"
#include "core/file.h"

namespace exemplar {
namespace {

std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (i + b < bytes.size() ? static_cast<unsigned char>(bytes[i + b]) : 0u);
    for (std::size_t d = 0; d < 4; ++d)
      text += i + d > bytes.size() ? '=' : kDigits[group >> (18 - 6 * d) & 63];
  }
  return text;
}

/// Text for HTML, inside of elements and attributes alike.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string figure(const std::filesystem::path& folder, const std::string& picture,
                   const std::string& caption) {
  std::string html = "<figure>";
  if (!picture.empty()) {
    html += "<img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
            base64(readFile(folder / picture)) + "\">";
  }
  return html + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; font: 16px/1.5 system-ui, sans-serif; }
body { max-width: 76rem; margin: 0 auto; padding: 1rem; }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(17rem, 1fr)); gap: 1rem; }
figure { margin: 0; } img { width: 100%; height: auto; border-radius: 4px; }
figcaption { font-size: .9rem; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .7rem; text-align: right; border-bottom: 1px solid #8886; }
th:first-child, td:first-child { text-align: left; font-family: ui-monospace, monospace; }
)";

/// Mean and spread of every figure over the complete runs of each engine.
struct Column {
  int runs = 0, complete = 0;
  double seconds = 0;
  std::map<std::string, std::vector<double>> values;
};

std::string meanOf(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (double v : values) sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (double v : values) squares += (v - mean) * (v - mean);
  if (values.size() < 2) return number(mean);
  return number(mean) + " ± " + number(std::sqrt(squares / static_cast<double>(values.size() - 1)));
}

}  // namespace

std::string comparisonPage(const Json& comparison, const std::filesystem::path& folder) {
  std::vector<std::string> engines, keys;
  std::map<std::string, Column> columns;
  for (const Json& run : comparison.at("runs")) {
    const std::string engine = run.at("engine");
    if (!columns.contains(engine)) engines.push_back(engine);
    Column& column = columns[engine];
    ++column.runs;
    if (run.at("status") != "complete") continue;
    ++column.complete;
    column.seconds += run.at("seconds").get<double>();
    for (const auto& [group, figures] : run.at("figures").items())
      for (const auto& [key, value] : figures.items()) {
        if (!value.is_number()) continue;
        const std::string name = group + "." + key;
        if (std::ranges::find(keys, name) == keys.end()) keys.push_back(name);
        column.values[name].push_back(value.get<double>());
      }
  }

  const std::string title = "exemplar compare: " + comparison.at("example").get<std::string>();
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>" +
      escaped(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" +
      escaped(title) + "</h1>\n<p>" + escaped(comparison.at("description").get<std::string>()) +
      "</p>\n";
  html += "<h2>Pictures</h2>\n<div class=\"row\">\n" +
          figure(folder, comparison.at("picture"), "the example");
  for (const Json& run : comparison.at("runs")) {
    std::string caption = run.at("engine").get<std::string>() + ", seed " +
                          std::to_string(run.at("seed").get<std::uint64_t>());
    const bool complete = run.at("status") == "complete";
    if (!complete)
      caption +=
          ": " + run.at("status").get<std::string>() + ": " + run.at("why").get<std::string>();
    html += figure(folder, complete ? run.at("picture").get<std::string>() : "", caption);
  }
  html +=
      "</div>\n<h2>Figures</h2>\n<p>Means over seeds, ± their standard deviation.</p>\n"
      "<div class=\"wide\"><table>\n<tr><th>figure</th>";
  for (const std::string& engine : engines) html += "<th>" + escaped(engine) + "</th>";
  const auto row = [&](const std::string& name, const auto& cell) {
    html += "</tr>\n<tr><td>" + escaped(name) + "</td>";
    for (const std::string& engine : engines) html += "<td>" + cell(columns[engine]) + "</td>";
  };
  row("complete",
      [](const Column& c) { return std::to_string(c.complete) + " of " + std::to_string(c.runs); });
  row("seconds", [](const Column& c) {
    return c.complete == 0 ? std::string("–") : number(c.seconds / c.complete);
  });
  for (const std::string& key : keys)
    row(key, [&](const Column& c) {
      const auto values = c.values.find(key);
      return values == c.values.end() ? std::string("–") : meanOf(values->second);
    });
  html += "</tr>\n</table></div>\n<h2>What is not comparable</h2>\n<ul>\n";
  for (const Json& note : comparison.at("notes"))
    html += "<li>" + escaped(note.get<std::string>()) + "</li>\n";
  return html + "</ul>\n</body>\n</html>\n";
}

}  // namespace exemplar
