// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/page.h"

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "core/base64.h"
#include "core/error.h"
#include "core/json_text.h"
#include "mesh/jpeg.h"
#include "report/encode.h"
#include "report/resources.h"

namespace exemplar {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kQuality = 86;  // of pictures

/// Nothing from elsewhere, whatever a name or a text in the page says.
constexpr const char* kPolicy =
    "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src "
    "'unsafe-inline'; base-uri 'none'; form-action 'none'";

std::string textOf(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

}  // namespace

void ReportPage::addView(const std::string& name, std::string part) {
  views_.push_back({name, std::move(part)});
}

void ReportPage::addPicture(const std::string& name, const Image8& image) {
  pictures_.push_back({name, encodeBase64(encodeJpeg(image, kQuality))});
}

std::size_t ReportPage::bytes() const {
  std::size_t sum = resources::style().size() + resources::script().size() +
                    resources::viewer().size() + resources::license().size();
  for (const Part& part : views_) sum += part.text.size();
  for (const Part& part : pictures_) sum += part.text.size();
  return sum;
}

std::string ReportPage::html(const Json& report) const {
  const std::string title = textOf(report, "title");
  std::string html;
  html.reserve(bytes() + 65536);
  html += "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  html +=
      std::string("<meta http-equiv=\"Content-Security-Policy\" content=\"") + kPolicy + "\">\n";
  html +=
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      escapedHtml(title) + " – exemplar</title>\n<style>\n";
  html += resources::style();
  html += "</style>\n</head>\n<body>\n<main id=\"page\">\n<h1>" + escapedHtml(title) +
          "</h1>\n<p>" + escapedHtml(textOf(report, "description")) + "</p>\n";
  // What is seen where scripts do not run; the page's script takes the pictures from here.
  html += "<div class=\"plain\">\n";
  for (const Part& picture : pictures_) {
    html += "<figure><img data-picture=\"" + escapedHtml(picture.name) + "\" alt=\"" +
            escapedHtml(picture.name) + "\" src=\"data:image/jpeg;base64," + picture.text +
            "\"><figcaption>" + escapedHtml(picture.name) + "</figcaption></figure>\n";
  }
  html += "</div>\n<ul>\n";
  if (const auto notes = report.find("notes"); notes != report.end())
    for (const Json& note : *notes)
      if (note.is_string()) html += "<li>" + escapedHtml(note.get<std::string>()) + "</li>\n";
  html += "</ul>\n</main>\n<script type=\"application/json\" id=\"report\">" +
          escapedJson(jsonText(report)) + "</script>\n";
  for (const Part& view : views_) {
    html += "<script type=\"application/json\" data-view=\"" + escapedHtml(view.name) + "\">" +
            escapedJson(view.text) + "</script>\n";
  }
  if (!resources::license().empty()) {
    html += "<template id=\"license\">";
    html += escapedHtml(resources::license());
    html += "</template>\n";
  }
  if (!resources::viewer().empty()) {
    html += "<script>";
    html += resources::viewer();
    html += "</script>\n";
  }
  html += "<script>\n";
  html += resources::script();
  return html + "</script>\n</body>\n</html>\n";
}

std::string viewPart(const ViewMesh& view) {
  const auto corner = [](const Vec3d& p) { return Json{p.x, p.y, p.z}; };
  return jsonText(Json{{"vertices", view.vertices.size()},
                       {"triangles", view.triangles.size()},
                       {"of_triangles", view.ofTriangles},
                       {"box", {corner(view.box.min), corner(view.box.max)}},
                       {"floor",
                        {{"side", ViewFloor::kSide},
                         {"box", {corner(view.floor.box.min), corner(view.floor.box.max)}}}},
                       {"jump_steps", ViewVertex::kJumpSteps},
                       {"data", encodeBase64(packViewMesh(view))}});
}

Json toJson(const std::vector<Mark>& marks) {
  constexpr const char* kKinds[] = {"seam", "repeat", "copy"};
  const auto rounded = [](double v) { return std::round(v * 1e4) / 1e4; };
  Json list = Json::array();
  for (const Mark& mark : marks) {
    Json& json =
        list.emplace_back(Json{{"kind", kKinds[static_cast<int>(mark.kind)]},
                               {"group", mark.group},
                               {"value", rounded(mark.value)},
                               {"position", {mark.position.x, mark.position.y, mark.position.z}}});
    json["at"] = nullptr;
    if (mark.at) json["at"] = {rounded((*mark.at)[0]), rounded((*mark.at)[1])};
    if (mark.outline.size() > 2) {
      for (const auto& p : mark.outline) json["outline"].push_back({rounded(p[0]), rounded(p[1])});
    }
  }
  return list;
}

bool reportsTurn() { return !resources::viewer().empty(); }

}  // namespace exemplar
