// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/svg_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace exemplar {
namespace {

using Point = std::array<double, 2>;
using Color = std::array<std::uint8_t, 3>;
using Attributes = std::map<std::string, std::string>;

const std::map<std::string, Color>& colorNames() {
  static const std::map<std::string, Color> names{
      {"black", {0, 0, 0}},        {"white", {255, 255, 255}}, {"gray", {128, 128, 128}},
      {"silver", {192, 192, 192}}, {"red", {255, 0, 0}},       {"maroon", {128, 0, 0}},
      {"orange", {255, 165, 0}},   {"yellow", {255, 255, 0}},  {"olive", {128, 128, 0}},
      {"green", {0, 128, 0}},      {"lime", {0, 255, 0}},      {"teal", {0, 128, 128}},
      {"cyan", {0, 255, 255}},     {"blue", {0, 0, 255}},      {"navy", {0, 0, 128}},
      {"purple", {128, 0, 128}},   {"magenta", {255, 0, 255}}, {"brown", {165, 42, 42}},
      {"tan", {210, 180, 140}}};
  return names;
}

std::optional<Color> colorOf(const std::string& text) {
  if (const auto found = colorNames().find(lowerCase(text)); found != colorNames().end())
    return found->second;
  unsigned r = 0, g = 0, b = 0;
  int used = 0;
  const auto whole = [&] { return used == static_cast<int>(text.size()); };
  const auto byte = [](unsigned v) { return static_cast<std::uint8_t>(v); };
  if (text.size() == 7 && std::sscanf(text.c_str(), "#%2x%2x%2x%n", &r, &g, &b, &used) == 3 &&
      whole())
    return Color{byte(r), byte(g), byte(b)};
  if (text.size() == 4 && std::sscanf(text.c_str(), "#%1x%1x%1x%n", &r, &g, &b, &used) == 3 &&
      whole())
    return Color{byte(r * 17), byte(g * 17), byte(b * 17)};
  if (std::sscanf(text.c_str(), "rgb(%3u , %3u , %3u )%n", &r, &g, &b, &used) == 3 && whole() &&
      std::max({r, g, b}) < 256)
    return Color{byte(r), byte(g), byte(b)};
  return std::nullopt;
}

std::string hexOf(const Color& c) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", c[0], c[1], c[2]);
  return text;
}

/// Reads the elements one after the other.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name, Warnings* warnings)
      : text_(text), name_(name), warnings_(warnings) {}

  Drawing read() {
    if (text_.find("<svg") == std::string_view::npos) fail("not an .svg: it has no <svg>");
    while (at_ < text_.size()) {
      const std::size_t open = text_.find('<', at_);
      if (open == std::string_view::npos) break;
      count(open);
      if (skip(open, "<!--", "-->") || skip(open, "<![CDATA[", "]]>")) continue;
      const std::size_t close = endOfTag(open);
      readTag(text_.substr(open + 1, close - open - 1));
      count(close + 1);
    }
    if (drawing_.shapes.empty()) fail("no filled polygon in it");
    if (leftOut_ > 0) {
      warn(warnings_, name_ + ": " + counted(leftOut_, "element") +
                          " other than filled shapes left out (texts, lines)");
    }
    return std::move(drawing_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(line_) + ": " + what);
  }
  void count(std::size_t to) {
    line_ += std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                        text_.begin() + static_cast<std::ptrdiff_t>(to), '\n');
    at_ = to;
  }
  bool skip(std::size_t open, std::string_view start, std::string_view end) {
    if (text_.substr(open, start.size()) != start) return false;
    const std::size_t close = text_.find(end, open);
    count(close == std::string_view::npos ? text_.size() : close + end.size());
    return true;
  }
  std::size_t endOfTag(std::size_t open) const {
    char quote = 0;
    for (std::size_t n = open; n < text_.size(); ++n) {
      const char c = text_[n];
      if (quote) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        return n;
      }
    }
    fail("an element does not end");
  }

  void readTag(std::string_view tag) {
    if (tag.empty() || tag[0] == '?' || tag[0] == '!') return;
    if (tag[0] == '/') {
      if (tag.substr(1).starts_with("g") && fills_.size() > 1) fills_.pop_back();
      if (tag.starts_with("/defs") || tag.starts_with("/symbol")) --hidden_;
      return;
    }
    const bool empty = tag.back() == '/';
    if (empty) tag.remove_suffix(1);
    std::size_t n = 0;
    while (n < tag.size() && !std::isspace(static_cast<unsigned char>(tag[n]))) ++n;
    const std::string element(tag.substr(0, n));
    const Attributes attributes = attributesOf(tag.substr(n));
    if (element == "defs" || element == "symbol") {
      hidden_ += !empty;
      return;
    }
    if (hidden_ > 0) return;
    if (attributes.contains("transform"))
      fail("transformations are not read; apply them to the coordinates (\"flatten\")");
    if (element == "g") {
      if (!empty) fills_.push_back(fillOf(attributes));
      return;
    }
    static const char* kShapes[] = {"polygon", "rect", "path", "polyline", "circle", "ellipse"};
    if (std::ranges::find(kShapes, element) == std::end(kShapes)) {
      leftOut_ += element == "text" || element == "line" || element == "image" || element == "use";
      return;
    }
    const std::string fill = fillOf(attributes);
    if (fill == "none" || fill == "transparent") {
      ++leftOut_;
      return;
    }
    if (element == "circle" || element == "ellipse")
      fail("a <" + element + "> has no straight sides; use a <polygon>");
    DrawnShape shape;
    const std::optional<Color> color = colorOf(fill);
    if (!color) fail("fill \"" + fill + "\" is no color; use \"#rrggbb\"");
    shape.color = *color;
    const auto material = attributes.find("data-material");
    shape.material = material == attributes.end() ? hexOf(shape.color) : material->second;
    if (element == "rect") {
      const double x = number(attributes, "x", 0), y = number(attributes, "y", 0);
      const double w = number(attributes, "width", 0), h = number(attributes, "height", 0);
      if (!(w > 0 && h > 0)) fail("a <rect> needs a width and a height above 0");
      if (attributes.contains("rx") || attributes.contains("ry"))
        fail("a <rect> with round corners has no straight sides");
      shape.loops = {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}};
    } else if (element == "path") {
      readPath(attributes, shape);
    } else {
      readPoints(attributes, shape);
    }
    for (auto& loop : shape.loops) {
      while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
      for (Point& p : loop) p[1] = -p[1];
    }
    std::erase_if(shape.loops, [](const auto& loop) { return loop.size() < 3; });
    if (!shape.loops.empty()) drawing_.shapes.push_back(std::move(shape));
  }

  Attributes attributesOf(std::string_view text) const {
    Attributes attributes;
    std::size_t n = 0;
    const auto space = [&] {
      while (n < text.size() && std::isspace(static_cast<unsigned char>(text[n]))) ++n;
    };
    while (true) {
      space();
      const std::size_t key = n;
      while (n < text.size() && text[n] != '=' &&
             !std::isspace(static_cast<unsigned char>(text[n])))
        ++n;
      if (n == key) return attributes;
      const std::string name(text.substr(key, n - key));
      space();
      if (n >= text.size() || text[n] != '=') fail("attribute '" + name + "' has no value");
      ++n;
      space();
      if (n >= text.size() || (text[n] != '"' && text[n] != '\''))
        fail("attribute '" + name + "' is not in quotes");
      const std::size_t end = text.find(text[n], n + 1);
      attributes[name] = text.substr(n + 1, end - n - 1);
      n = end + 1;
    }
  }

  std::string fillOf(const Attributes& attributes) const {
    if (const auto style = attributes.find("style"); style != attributes.end()) {
      std::size_t n = style->second.find("fill:");
      while (n != std::string::npos && n > 0 && style->second[n - 1] != ';' &&
             !std::isspace(static_cast<unsigned char>(style->second[n - 1])))
        n = style->second.find("fill:", n + 1);
      if (n != std::string::npos) {
        std::string value = style->second.substr(n + 5);
        value = value.substr(0, value.find(';'));
        value.erase(0, value.find_first_not_of(" \t"));
        return value.substr(0, value.find_last_not_of(" \t") + 1);
      }
    }
    const auto fill = attributes.find("fill");
    return fill == attributes.end() ? fills_.back() : fill->second;
  }

  double number(const Attributes& attributes, const char* key, double usual) const {
    const auto found = attributes.find(key);
    if (found == attributes.end()) return usual;
    const std::optional<double> value = parseNumber(found->second);
    if (!value || !(std::abs(*value) < 1e9))
      fail("'" + std::string(key) + "' is not a number: " + found->second);
    return *value;
  }

  /// The next number of a list; nothing where another kind of character comes.
  std::optional<double> nextNumber(const std::string& text, std::size_t& n) const {
    while (n < text.size() && (std::isspace(static_cast<unsigned char>(text[n])) || text[n] == ','))
      ++n;
    const std::size_t start = n;
    bool dot = false;
    while (n < text.size()) {
      const char c = text[n];
      const bool afterExponent = n > start && (text[n - 1] == 'e' || text[n - 1] == 'E');
      const bool sign = (c == '-' || c == '+') && (n == start || afterExponent);
      const bool exponent = (c == 'e' || c == 'E') && n > start && !afterExponent;
      if (c == '.' && !dot) {
        dot = true;
      } else if (!std::isdigit(static_cast<unsigned char>(c)) && !sign && !exponent) {
        break;
      }
      ++n;
    }
    if (n == start) return std::nullopt;
    const std::optional<double> value = parseNumber(text.substr(start, n - start));
    if (!value || !(std::abs(*value) < 1e9))
      fail("not a coordinate: " + text.substr(start, n - start));
    return value;
  }

  void readPoints(const Attributes& attributes, DrawnShape& shape) const {
    const auto points = attributes.find("points");
    if (points == attributes.end()) fail("a polygon without points");
    std::vector<double> numbers;
    std::size_t n = 0;
    while (const std::optional<double> value = nextNumber(points->second, n))
      numbers.push_back(*value);
    if (n < points->second.size() || numbers.size() % 2 != 0)
      fail("'points' must be pairs of numbers");
    auto& loop = shape.loops.emplace_back();
    for (std::size_t p = 0; p < numbers.size(); p += 2)
      loop.push_back({numbers[p], numbers[p + 1]});
  }

  void readPath(const Attributes& attributes, DrawnShape& shape) const {
    const auto found = attributes.find("d");
    if (found == attributes.end()) fail("a path without 'd'");
    const std::string& d = found->second;
    Point at{}, start{};
    char command = 0;
    std::size_t n = 0;
    while (true) {
      while (n < d.size() && (std::isspace(static_cast<unsigned char>(d[n])) || d[n] == ',')) ++n;
      if (n == d.size()) return;
      if (std::isalpha(static_cast<unsigned char>(d[n]))) {
        command = d[n++];
        if (command == 'Z' || command == 'z') at = start;
        if (std::string_view("MmLlHhVvZz").find(command) == std::string_view::npos) {
          fail(std::string("the path has a curve ('") + command +
               "'); use straight lines, or flatten it");
        }
        if (command == 'Z' || command == 'z') continue;
      } else if (command == 0 || command == 'Z' || command == 'z') {
        fail("a path's numbers need a command");
      }
      const bool relative = std::islower(static_cast<unsigned char>(command));
      const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
      const auto coordinate = [&](int axis) {
        const std::optional<double> value = nextNumber(d, n);
        if (!value) fail("a path's command lacks a number");
        return *value + (relative ? at[axis] : 0);
      };
      Point to = at;
      if (kind != 'V') to[0] = coordinate(0);
      if (kind != 'H') to[1] = coordinate(1);
      at = to;
      if (kind == 'M') {
        start = at;
        shape.loops.emplace_back();
        command = relative ? 'l' : 'L';
      }
      if (shape.loops.empty()) fail("a path must begin with 'M'");
      shape.loops.back().push_back(at);
    }
  }

  std::string_view text_;
  std::string name_;
  Warnings* warnings_;
  std::size_t at_ = 0, leftOut_ = 0;
  std::ptrdiff_t line_ = 1;
  int hidden_ = 0;  // levels of definitions
  std::vector<std::string> fills_{"#000000"};
  Drawing drawing_;
};

std::string coordinate(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value == 0 ? 0 : value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace

bool isDrawingFile(const std::filesystem::path& path) { return lowerExtension(path) == ".svg"; }

Drawing readDrawing(std::string_view text, const std::string& name, Warnings* warnings) {
  return Reader(text, name, warnings).read();
}

std::string drawingText(const Drawing& drawing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  std::vector<std::pair<std::string, Color>> legend;
  for (const DrawnShape& shape : drawing.shapes) {
    for (const auto& loop : shape.loops) {
      for (const Point& p : loop) {
        for (int axis = 0; axis < 2; ++axis) {
          low[axis] = std::min(low[axis], p[axis]);
          high[axis] = std::max(high[axis], p[axis]);
        }
      }
    }
    if (std::ranges::find(legend, std::pair(shape.material, shape.color)) == legend.end())
      legend.emplace_back(shape.material, shape.color);
  }
  if (drawing.shapes.empty()) low = high = {0, 0};
  const double side = std::max({high[0] - low[0], high[1] - low[1], 1e-9});
  const double margin = 0.03 * side, row = 0.05 * side;
  const double width = high[0] - low[0] + 2 * margin;
  const double height = high[1] - low[1] + 2 * margin + (legend.empty() ? 0 : row + 0.5 * margin);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" +
                    coordinate(low[0] - margin) + " " + coordinate(-high[1] - margin) + " " +
                    coordinate(width) + " " + coordinate(height) + "\" width=\"640\">\n";
  out += "<g stroke=\"#202020\" stroke-width=\"" + coordinate(0.002 * side) +
         "\" stroke-linejoin=\"round\" fill-rule=\"evenodd\">\n";
  for (const DrawnShape& shape : drawing.shapes) {
    out += "<path data-material=\"" + escaped(shape.material) + "\" fill=\"" + hexOf(shape.color) +
           "\" d=\"";
    for (const auto& loop : shape.loops) {
      for (std::size_t n = 0; n < loop.size(); ++n)
        out += (n == 0 ? "M" : " ") + coordinate(loop[n][0]) + "," + coordinate(-loop[n][1]);
      out += "Z";
    }
    out += "\"><title>" + escaped(shape.material) + "</title></path>\n";
  }
  out += "</g>\n";
  double x = low[0];
  const double y = -low[1] + 1.5 * margin;
  for (const auto& [material, color] : legend) {
    // A swatch is a stroked line, so that it is no shape when the file is read again.
    out += "<line stroke=\"" + hexOf(color) + "\" stroke-width=\"" + coordinate(0.6 * row) +
           "\" x1=\"" + coordinate(x) + "\" x2=\"" + coordinate(x + 0.6 * row) + "\" y1=\"" +
           coordinate(y + 0.3 * row) + "\" y2=\"" + coordinate(y + 0.3 * row) + "\"/>";
    out += "<text font-family=\"sans-serif\" font-size=\"" + coordinate(0.7 * row) + "\" x=\"" +
           coordinate(x + 0.8 * row) + "\" y=\"" + coordinate(y + 0.55 * row) + "\">" +
           escaped(material) + "</text>\n";
    x += row * (1.8 + 0.42 * static_cast<double>(material.size()));
  }
  return out + "</svg>\n";
}

}  // namespace exemplar
