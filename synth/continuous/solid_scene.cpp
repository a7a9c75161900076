// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/solid_scene.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "core/error.h"
#include "mesh/color.h"
#include "mesh/toml_text.h"

namespace exemplar::continuous {
namespace {

/// Reads a scene's tables and says where something is wrong.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name)
      : name_(name), root_(parseToml(text, name)) {}

  SolidScene read() {
    requireKeys(root_, {"kind", "unit", "scale", "spacing", "flat", "ground", "settings",
                        "substances", "part", "object"});
    scene_.name = name_;
    scene_.solids.unit = real(root_, "unit", 1, 1e-9, 1e9);
    scene_.solids.substances = {"air"};
    scene_.looks.resize(1);
    scene_.looks[0].name = "air";
    if (const toml::node* scale = root_.get("scale")) {
      const std::vector<double> s = reals(*scale, 3, "scale");
      scene_.scale = {s[0], s[1], s[2]};
      if (!(s[0] > 0 && s[1] > 0 && s[2] > 0)) fail(*scale, "'scale' must be above 0");
    }
    if (const toml::node* spacing = root_.get("spacing")) {
      scene_.spacing = whole(*spacing, "spacing");
      if (*scene_.spacing < 1) fail(*spacing, "'spacing' must be at least 1");
    }
    if (const toml::node* flat = root_.get("flat")) {
      if (!flat->is_boolean()) fail(*flat, "'flat' must be true or false");
      scene_.solids.flat = *flat->value<bool>();
    }
    readSettings();
    readLooks();
    readGround();
    const toml::node* parts = root_.get("part");
    if ((!parts && !root_.get("object")) ||
        (parts && (!parts->as_array() || parts->as_array()->empty())))
      throw InputError(name_ + ": a scene of solids needs a [[part]]");
    for (std::size_t n = 0; parts && n < parts->as_array()->size(); ++n) {
      const toml::node& part = *parts->as_array()->get(n);
      if (!part.as_table()) fail(part, "'part' must be tables, each [[part]]");
      scene_.solids.flat ? readFlatPart(*part.as_table()) : readPart(*part.as_table());
    }
    if (const toml::node* objects = root_.get("object")) {
      if (scene_.solids.flat) fail(*objects, "a flat scene has no objects");
      if (!objects->as_array()) fail(*objects, "'object' must be tables, each [[object]]");
      for (const toml::node& object : *objects->as_array()) {
        if (!object.as_table()) fail(object, "'object' must be tables, each [[object]]");
        readObject(*object.as_table());
      }
    }
    if (scene_.solids.flat) raise();
    return std::move(scene_);
  }

 private:
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(node.source().begin.line) + ": " + what);
  }
  void requireKeys(const toml::table& table, const std::set<std::string>& known) const {
    for (const auto& [key, node] : table) {
      if (known.contains(std::string(key.str()))) continue;
      std::string names;
      for (const std::string& k : known) names += (names.empty() ? "" : ", ") + k;
      fail(node, "unknown key '" + std::string(key.str()) + "'; known are " + names);
    }
  }
  double real(const toml::table& table, const char* key, double usual, double low, double high) {
    const toml::node* node = table.get(key);
    if (!node) return usual;
    const auto value = node->value<double>();
    if (!value || !(*value >= low && *value <= high))
      fail(*node, "'" + std::string(key) + "' must be a number in range");
    return *value;
  }
  std::int64_t whole(const toml::node& node, const std::string& key) const {
    const auto value = node.value<double>();
    if (!value || *value != std::floor(*value) || std::abs(*value) > kMostCoordinate) {
      fail(node, "'" + key + "' must be whole numbers below " + std::to_string(kMostCoordinate) +
                     "; choose a smaller 'unit'");
    }
    return static_cast<std::int64_t>(*value);
  }
  std::vector<std::int64_t> wholes(const toml::node& node, std::size_t count,
                                   const std::string& key) const {
    const toml::array* array = node.as_array();
    if (!array || array->size() != count)
      fail(node, "'" + key + "' must have " + std::to_string(count) + " whole numbers");
    std::vector<std::int64_t> values;
    for (const toml::node& value : *array) values.push_back(whole(value, key));
    return values;
  }
  std::vector<double> reals(const toml::node& node, std::size_t count, const std::string& key) {
    const toml::array* array = node.as_array();
    std::vector<double> values;
    for (std::size_t n = 0; array && n < array->size(); ++n)
      values.push_back(array->get(n)->value<double>().value_or(0));
    if (values.size() != count)
      fail(node, "'" + key + "' must have " + std::to_string(count) + " numbers");
    return values;
  }
  std::vector<Vec3l> points(const toml::node& node, const std::string& key, bool flat) const {
    const toml::array* array = node.as_array();
    if (!array || array->empty()) fail(node, "'" + key + "' must be a list of points");
    std::vector<Vec3l> list;
    for (const toml::node& point : *array) {
      const std::vector<std::int64_t> p = wholes(point, flat ? 2 : 3, key);
      list.push_back({p[0], p[1], flat ? 0 : p[2]});
    }
    return list;
  }

  Substance substance(const toml::node& node) {
    const auto name = node.value<std::string>();
    if (!name || name->empty()) fail(node, "'substance' must be a name");
    auto& names = scene_.solids.substances;
    const auto found = std::ranges::find(names, *name);
    if (found != names.end()) return static_cast<Substance>(found - names.begin());
    if (names.size() > 200) fail(node, "there are more than 200 substances");
    names.push_back(*name);
    Material look;
    look.name = *name;
    scene_.looks.push_back(look);
    return static_cast<Substance>(names.size() - 1);
  }
  /// Texts, numbers, true or false, or lists of texts.
  void readSettings() {
    const toml::node* node = root_.get("settings");
    if (!node) return;
    if (!node->as_table()) fail(*node, "'settings' must be a table");
    const auto add = [&](const std::string& key, const toml::node& value) {
      if (value.is_boolean()) {
        scene_.settings.emplace_back(key, *value.value<bool>() ? "true" : "false");
      } else if (value.is_string()) {
        scene_.settings.emplace_back(key, *value.value<std::string>());
      } else if (const auto number = value.value<double>()) {
        char text[32];
        const auto end = std::to_chars(text, text + sizeof text, *number).ptr;
        scene_.settings.emplace_back(key, std::string(text, end));
      } else {
        fail(value, "'" + key + "' must be a text, a number, true or false, or a list of these");
      }
    };
    for (const auto& [name, value] : *node->as_table()) {
      const std::string key(name.str());
      if (!value.as_array()) {
        add(key, value);
        continue;
      }
      for (const toml::node& one : *value.as_array()) add(key, one);
    }
  }
  void readLooks() {
    const toml::node* node = root_.get("substances");
    if (!node) return;
    if (!node->as_table()) fail(*node, "'substances' must be a table");
    for (const auto& [key, value] : *node->as_table()) {
      if (!value.as_table()) fail(value, "a substance must be { color = \"#rrggbb\" }");
      const toml::table& table = *value.as_table();
      requireKeys(table, {"color", "roughness", "metallic"});
      const Substance s = substance(*toml::array{std::string(key.str())}.get(0));
      Material& look = scene_.looks[s];
      look.roughness = static_cast<float>(real(table, "roughness", 0.8, 0, 1));
      look.metallic = static_cast<float>(real(table, "metallic", 0, 0, 1));
      if (const toml::node* color = table.get("color")) {
        const std::string text = color->value<std::string>().value_or("");
        std::uint32_t rgb = 0;
        const char* end = text.data() + text.size();
        if (text.size() != 7 || text[0] != '#' ||
            std::from_chars(text.data() + 1, end, rgb, 16).ptr != end)
          fail(*color, "'color' must be \"#rrggbb\"");
        for (int c = 0; c < 3; ++c)
          look.baseColor[c] = srgb8ToLinear(static_cast<std::uint8_t>(rgb >> (16 - 8 * c)));
      }
    }
  }
  void readGround() {
    const toml::node* node = root_.get("ground");
    if (!node) return;
    if (!node->as_table()) fail(*node, "'ground' must be { height = 0, substance = \"...\" }");
    if (scene_.solids.flat) fail(*node, "a flat scene has no ground; use a part");
    const toml::table& table = *node->as_table();
    requireKeys(table, {"height", "substance"});
    const toml::node* name = table.get("substance");
    if (!name) fail(*node, "'ground' needs a 'substance'");
    const toml::node* height = table.get("height");
    scene_.solids.ground = {height ? whole(*height, "height") : 0, substance(*name)};
    if (scene_.solids.ground->substance == kAir) fail(*name, "the ground cannot be air");
  }

  void readPart(const toml::table& table) {
    requireKeys(table, {"substance", "box", "points", "outline", "heights", "planes", "move"});
    const toml::node* name = table.get("substance");
    if (!name) fail(table, "a part needs a 'substance'");
    Solid part;
    part.substance = substance(*name);
    int forms = 0;
    try {
      if (const toml::node* box = table.get("box")) {
        ++forms;
        const std::vector<std::int64_t> b = wholes(*box, 6, "box");
        if (b[0] >= b[3] || b[1] >= b[4] || b[2] >= b[5])
          fail(*box, "'box' must be its low corner, then its high one");
        for (int axis = 0; axis < 3; ++axis) {
          Vec3l n;
          n[axis] = 1;
          part.sides.push_back({n, b[axis + 3]});
          part.sides.push_back({-n, -b[axis]});
        }
      }
      if (const toml::node* list = table.get("points")) {
        ++forms;
        part.sides = hullOf(points(*list, "points", false));
      }
      if (const toml::node* list = table.get("outline")) {
        ++forms;
        const toml::node* heights = table.get("heights");
        if (!heights) fail(*list, "'outline' needs 'heights'");
        const std::vector<std::int64_t> h = wholes(*heights, 2, "heights");
        if (h[0] >= h[1]) fail(*heights, "'heights' must rise");
        std::vector<Vec3l> both;
        for (Vec3l p : points(*list, "outline", true)) {
          for (const std::int64_t z : h) both.push_back({p.x, p.y, z});
        }
        part.sides = hullOf(both);
      }
      if (const toml::node* list = table.get("planes")) {
        ++forms;
        if (!list->as_array()) fail(*list, "'planes' must be a list");
        for (const toml::node& plane : *list->as_array()) {
          const std::vector<std::int64_t> p = wholes(plane, 4, "planes");
          part.sides.push_back(planeOf({p[0], p[1], p[2]}, p[3], plane));
        }
      }
    } catch (const InputError& error) {
      const std::string what = error.what();
      if (what.starts_with(name_)) throw;
      fail(table, what);
    }
    if (forms != 1) fail(table, "a part needs one of 'box', 'points', 'outline' and 'planes'");
    if (const toml::node* move = table.get("move")) {
      const std::vector<std::int64_t> m = wholes(*move, 3, "move");
      for (ExactPlane& side : part.sides) side.offset += dot(side.normal, Vec3l{m[0], m[1], m[2]});
    }
    scene_.solids.solids.push_back(std::move(part));
  }
  /// A mesh's box in two halves, between which a plane keeps its proportions.
  void readObject(const toml::table& table) {
    requireKeys(table, {"file", "box", "keep"});
    const toml::node *file = table.get("file"), *box = table.get("box");
    if (!file || !box) fail(table, "an object needs a 'file' and a 'box'");
    StandIn object;
    object.file = file->value<std::string>().value_or("");
    if (object.file.empty()) fail(*file, "'file' must be the name of a mesh");
    object.name = object.file.substr(object.file.find_last_of('/') + 1);
    const std::vector<std::int64_t> b = wholes(*box, 6, "box");
    object.box = {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
    const Vec3l low = object.box.low, size = object.box.size();
    if (size.x <= 0 || size.y <= 0 || size.z <= 0)
      fail(*box, "'box' must be its low corner, then its high one");
    const toml::node* keep = table.get("keep");
    const std::string kept = keep ? keep->value<std::string>().value_or("") : "xyz";
    ExactPlane cut;
    if (kept == "xy") {
      cut.normal = primitive({size.y, -size.x, 0});
    } else if (kept == "xz") {
      cut.normal = primitive({size.z, 0, -size.x});
    } else if (kept == "yz") {
      cut.normal = primitive({0, size.z, -size.y});
    } else if (kept == "xyz") {
      cut.normal = primitive({size.y * size.z, size.x * size.z, size.x * size.y});
    } else {
      fail(keep ? *keep : table, "'keep' must be \"xy\", \"xz\", \"yz\" or \"xyz\"");
    }
    cut.offset = dot(cut.normal, kept == "xyz" ? low + Vec3l{size.x, 0, 0} : low);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(cut.normal[axis]) > kMostNormal)
        fail(*box, "the sides of 'box' are no fractions of numbers up to 64; choose simpler ones");
    }
    const auto known = std::ranges::find(scene_.standIns, object.file, &StandIn::file);
    if (known != scene_.standIns.end()) {
      object.halves = known->halves;
    } else {
      const std::string names[] = {object.name, object.name + " (other half)"};
      for (int half = 0; half < 2; ++half)
        object.halves[half] = substance(*toml::array{names[half]}.get(0));
      scene_.standIns.push_back(object);
    }
    for (int half = 0; half < 2; ++half) {
      Solid part{object.halves[half], {}, {}};
      for (int axis = 0; axis < 3; ++axis) {
        Vec3l n;
        n[axis] = 1;
        part.sides.push_back({n, object.box.high[axis]});
        part.sides.push_back({-n, -low[axis]});
      }
      part.sides.push_back(half == 0 ? cut : ExactPlane{-cut.normal, -cut.offset});
      scene_.solids.solids.push_back(std::move(part));
    }
  }

  /// A part of a scene of the plane: its upright sides.
  void readFlatPart(const toml::table& table) {
    requireKeys(table, {"substance", "box", "outline", "planes", "move"});
    const toml::node* name = table.get("substance");
    if (!name) fail(table, "a part needs a 'substance'");
    Solid part;
    part.substance = substance(*name);
    std::vector<Vec3l> corners;
    int forms = 0;
    if (const toml::node* box = table.get("box")) {
      ++forms;
      const std::vector<std::int64_t> b = wholes(*box, 4, "box");
      if (b[0] >= b[2] || b[1] >= b[3])
        fail(*box, "'box' must be its low corner, then its high one");
      corners = {{b[0], b[1], 0}, {b[2], b[1], 0}, {b[2], b[3], 0}, {b[0], b[3], 0}};
    }
    if (const toml::node* list = table.get("outline")) {
      ++forms;
      corners = points(*list, "outline", true);
    }
    if (const toml::node* list = table.get("planes")) {
      ++forms;
      if (!list->as_array()) fail(*list, "'planes' must be a list");
      for (const toml::node& line : *list->as_array()) {
        const std::vector<std::int64_t> p = wholes(line, 3, "planes");
        part.sides.push_back(planeOf({p[0], p[1], 0}, p[2], line));
      }
    }
    if (forms != 1) fail(table, "a part needs one of 'box', 'outline' and 'planes'");
    if (!corners.empty()) {
      std::vector<Vec3l> both = corners;
      for (const Vec3l& p : corners) both.push_back(p + Vec3l{0, 0, 1});
      try {
        part.sides = hullOf(both);
      } catch (const InputError& error) {
        fail(table, error.what());
      }
      std::erase_if(part.sides, [](const ExactPlane& side) { return side.normal.z != 0; });
    }
    if (const toml::node* move = table.get("move")) {
      const std::vector<std::int64_t> m = wholes(*move, 2, "move");
      for (ExactPlane& side : part.sides) side.offset += dot(side.normal, Vec3l{m[0], m[1], 0});
      for (Vec3l& p : corners) p += Vec3l{m[0], m[1], 0};
    }
    flatCorners_.insert(flatCorners_.end(), corners.begin(), corners.end());
    scene_.solids.solids.push_back(std::move(part));
  }
  /// Gives the parts of a scene of the plane their height.
  void raise() {
    std::vector<ExactPlane> sides;
    for (const Solid& part : scene_.solids.solids)
      sides.insert(sides.end(), part.sides.begin(), part.sides.end());
    const std::int64_t height = scene_.spacing.value_or(prismHeight(sides, flatCorners_));
    for (Solid& part : scene_.solids.solids) {
      part.sides.push_back({{0, 0, 1}, height});
      part.sides.push_back({{0, 0, -1}, 0});
    }
  }
  ExactPlane planeOf(const Vec3l& normal, std::int64_t offset, const toml::node& node) const {
    if (normal == Vec3l{}) fail(node, "a plane's normal is 0");
    const std::int64_t g = gcd(normal);
    const Vec3l n = normal / g;
    if (offset % g != 0)
      fail(node, "a plane's numbers have no whole offset; choose a smaller unit");
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(n[axis]) > kMostNormal) fail(node, "a plane's normal is above 64");
    return {n, offset / g};
  }

  std::string name_;
  toml::table root_;
  SolidScene scene_;
  std::vector<Vec3l> flatCorners_;
};

}  // namespace

std::int64_t prismHeight(std::span<const ExactPlane> sides, std::span<const Vec3l> corners) {
  std::vector<ExactPlane> planes;
  for (const ExactPlane& side : sides) planes.push_back(canonical(side));
  makeDistinct(planes);
  std::int64_t alongAxes = 0, other = 0, ofCorners = 0;
  for (std::size_t p = 1; p < planes.size(); ++p) {
    if (planes[p].normal != planes[p - 1].normal) continue;
    const Vec3l& n = planes[p].normal;
    std::int64_t& step = n.x == 0 || n.y == 0 ? alongAxes : other;
    step = std::gcd(step, planes[p].offset - planes[p - 1].offset);
  }
  for (const Vec3l& c : corners) ofCorners = std::gcd(ofCorners, gcd(c - corners[0]));
  for (const std::int64_t step : {alongAxes, other, ofCorners})
    if (step > 0) return step;
  return 1;
}

std::vector<ExactPlane> hullOf(const std::vector<Vec3l>& points) {
  std::vector<ExactPlane> sides;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t c = 0; c < b; ++c) {
        const Vec3l across = cross(points[a] - points[b], points[a] - points[c]);
        if (across == Vec3l{}) continue;
        const Vec3l n = primitive(across);
        const std::int64_t offset = dot(n, points[a]);
        bool above = false, below = false;
        for (const Vec3l& p : points) {
          above = above || dot(n, p) > offset;
          below = below || dot(n, p) < offset;
        }
        if (above == below) continue;
        for (int axis = 0; axis < 3; ++axis) {
          if (std::abs(n[axis]) > kMostNormal)
            throw InputError("a side's normal has components above 64; move points a little");
        }
        sides.push_back(below ? ExactPlane{n, offset} : ExactPlane{-n, -offset});
      }
    }
  }
  makeDistinct(sides);
  if (sides.size() < 4) throw InputError("the points of a part lie in one plane");
  return sides;
}

bool isSolidScene(std::string_view text) {
  try {
    return parseToml(text, {})["kind"].value<std::string>() == "solids";
  } catch (const InputError&) {
    return false;
  }
}

SolidScene readSolidScene(std::string_view text, const std::string& name) {
  return Reader(text, name).read();
}

}  // namespace exemplar::continuous
