// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mesh/image.h"
#include "report/marks.h"
#include "report/view_mesh.h"

namespace exemplar {

/// A page that shows an example and what was made of it: one file that opens from disk, asks no
/// network for anything, and holds surfaces to turn, pictures, figures, and scripts.
///
/// What it says is JSON, as `compare.json` holds it: `title`, `description`, `example`, `runs`
/// (each with `engine`, `seed`, `status`, and where complete `figures`, `seconds`, `marks`),
/// `figures` (group, key and meaning of each) and `notes`; docs/report.md describes all of it.
/// Where it names a view or picture, that is the name of one that was added.
class ReportPage {
 public:
  /// A surface, as `viewPart` gives it.
  void addView(const std::string& name, std::string part);
  /// A picture, kept as JPEG.
  void addPicture(const std::string& name, const Image8& image);

  /// How long the page will be at least, in bytes.
  std::size_t bytes() const;

  /// The page. Text in `report` is shown, never run, whatever it holds. The same bytes for the same
  /// input.
  std::string html(const nlohmann::ordered_json& report) const;

 private:
  struct Part {
    std::string name, text;
  };
  std::vector<Part> views_, pictures_;
};

/// A view as text that a page holds and a file can keep: JSON of one object.
std::string viewPart(const ViewMesh& view);

/// Marks as `runs[].marks` has them.
nlohmann::ordered_json toJson(const std::vector<Mark>& marks);

/// Whether pages hold what shows surfaces that turn; else they show pictures (built without npm).
bool reportsTurn();

/// The most bytes of surfaces and pictures that a page should hold; the rest is left out, and said.
inline constexpr std::size_t kReportBytes = 13'000'000;

}  // namespace exemplar
