// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <charconv>

#include "core/memory.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

constexpr int kFreeLines = 3;
constexpr int kLongestSide = 32767;

int readSide(TextScanner& scan, const char* what) {
  const std::int64_t side = scan.integer(what);
  if (side < 1 || side > kLongestSide) {
    scan.fail(std::string(what) + " should be 1 to " + std::to_string(kLongestSide) + ", not " +
              std::to_string(side));
  }
  return static_cast<int>(side);
}

Vec3i readSize(TextScanner& scan) {
  for (int line = 0; line < kFreeLines; ++line) {
    if (!scan.nextLine()) scan.fail("the file ends within its first three lines of text");
  }
  if (!scan.nextLine()) scan.fail("the file ends before the grid's size, three numbers on line 4");
  const Vec3i size{readSide(scan, "the size along x"), readSide(scan, "the size along y"),
                   readSide(scan, "the size along z")};
  if (!scan.atLineEnd()) scan.fail("expected three numbers alone, the grid's size X Y Z");
  return size;
}

Label readLabel(TextScanner& scan) {
  const std::int64_t label = scan.integer("a label");
  if (label < 0 || label >= kMostLabels) {
    scan.fail("a label should be 0 to " + std::to_string(kMostLabels - 1) + ", not " +
              std::to_string(label));
  }
  return static_cast<Label>(label);
}

void readCells(TextScanner& scan, Array3D<Label>& cells, const Progress& progress) {
  const Vec3i size = cells.size();
  for (int z = 0; z < size.z; ++z) {
    progress.report("reading labels", static_cast<double>(z) / size.z);
    for (int x = 0; x < size.x; ++x) {
      progress.check();
      for (int y = 0; y < size.y; ++y) {
        while (scan.atLineEnd()) {
          if (scan.nextLine()) continue;
          const std::int64_t found = (std::int64_t{z} * size.x + x) * size.y + y;
          scan.fail("the file ends after " + std::to_string(found) + " of " +
                    std::to_string(volume(size)) + " labels");
        }
        cells(x, y, z) = readLabel(scan);
      }
    }
  }
  if (!scan.atLineEnd()) {
    scan.fail("'" + TextScanner::shown(scan.word()) + "' follows the last of " +
              std::to_string(volume(size)) + " labels; the size on line 4 may be wrong");
  }
}

/// The section `<Objects>`, whose first line has been read.
void readObjects(TextScanner& scan, LabelGrid& grid) {
  if (!scan.nextLine()) return;
  grid.name = std::string(scan.rest());
  std::size_t label = 1;
  for (; scan.nextLine(); ++label) {
    std::string header(scan.rest());
    if (header.empty()) {
      --label;
      continue;
    }
    if (header.starts_with("</")) return;
    if (label >= static_cast<std::size_t>(kMostLabels)) {
      scan.fail("there are more than " + std::to_string(kMostLabels - 1) + " groups of objects");
    }
    if (label >= grid.labels.size()) grid.labels.resize(label + 1);
    LabelLook& look = grid.labels[label];
    look.name = std::move(header);
    for (;;) {
      if (!scan.nextLine()) scan.fail("the file ends within a group of objects, before its '#'");
      const std::string_view line = scan.rest();
      if (line.starts_with('#')) break;
      if (line.empty()) continue;
      if (!line.starts_with('$')) {
        scan.fail("expected a line that begins with '$', or '#', not '" + TextScanner::shown(line) +
                  "'");
      }
      look.objects.emplace_back(line);
    }
  }
}

void appendInt(std::string& text, int value) {
  char digits[16];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

}  // namespace

LabelGrid parseLabelText(std::string_view bytes, const std::string& name,
                         const Progress& progress) {
  TextScanner scan(bytes, name);
  const Vec3i size = readSize(scan);
  // Each label takes a digit and a blank, but for the last.
  if (volume(size) > static_cast<std::int64_t>(scan.afterLine().size() / 2 + 1)) {
    scan.fail("the size says " + std::to_string(volume(size)) +
              " labels, more than the file has room for");
  }
  requireMemory(2.0 * static_cast<double>(volume(size)), name + ": its labels",
                "use a smaller grid");
  LabelGrid grid;
  grid.cells = Array3D<Label>(size);
  readCells(scan, grid.cells, progress);
  const auto cells = grid.cells.values();
  grid.labels.resize(std::size_t{1} + *std::max_element(cells.begin(), cells.end()));
  while (scan.nextLine()) {
    if (scan.atLineEnd()) continue;
    const std::string_view line = scan.rest();
    if (line != "<Objects>") {
      scan.fail("expected <Objects> or the end of the file after the last of " +
                std::to_string(volume(size)) + " labels, not '" + TextScanner::shown(line) + "'");
    }
    readObjects(scan, grid);
  }
  for (int label = 0; label < grid.labelCount(); ++label) {
    LabelLook& look = grid.labels[label];
    if (label == 0)
      look = emptyLook();
    else
      look.color = distinctColor(label);
  }
  return grid;
}

std::string formatLabelText(const LabelGrid& grid, const Progress& progress) {
  const Vec3i size = grid.size();
  std::string text = "grid of labels, written by exemplar\n";
  text += "layers from the bottom, each of X lines with Y labels; 0 is empty\n";
  text += "X Y Z:\n";
  text += std::to_string(size.x) + " " + std::to_string(size.y) + " " + std::to_string(size.z);
  text += "\n\n";
  for (int z = 0; z < size.z; ++z) {
    progress.report("writing labels", static_cast<double>(z) / size.z);
    for (int x = 0; x < size.x; ++x) {
      progress.check();
      for (int y = 0; y < size.y; ++y) {
        appendInt(text, grid.cells(x, y, z));
        text += y + 1 < size.y ? ' ' : '\n';
      }
    }
    if (z + 1 < size.z) text += '\n';
  }
  const bool described = std::any_of(
      grid.labels.begin() + std::min<std::size_t>(1, grid.labels.size()), grid.labels.end(),
      [](const LabelLook& look) { return !look.name.empty() || !look.objects.empty(); });
  if (!described && grid.name.empty()) return text;
  text += "\n<Objects>\n" + oneLine(grid.name) + "\n";
  for (std::size_t label = 1; label < grid.labels.size(); ++label) {
    const LabelLook& look = grid.labels[label];
    const std::string header = oneLine(look.name);
    const bool blank = header.find_first_not_of(" \t") == std::string::npos;
    text += (blank || header.starts_with("</") ? "label " + std::to_string(label) : header) + "\n";
    for (const std::string& object : look.objects) {
      text += (object.starts_with('$') ? "" : "$") + oneLine(object) + "\n";
    }
    text += "#\n";
  }
  return text;
}

}  // namespace exemplar
