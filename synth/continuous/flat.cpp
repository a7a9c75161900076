// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/flat.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/error.h"
#include "mesh/color.h"
#include "mesh/polygon.h"

namespace exemplar::continuous {
namespace {

constexpr std::int64_t kMostUnits = 4096;  // on the longest side, of a grid that is found
/// How well coordinates are known, in lengths of the longest side: files have six digits.
constexpr double kPrecision = 2e-6;

using Point = std::array<double, 2>;

/// Twice the area in a loop, negative where it runs clockwise.
std::int64_t area2(const std::vector<Vec3l>& loop) {
  std::int64_t sum = 0;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Vec3l &a = loop[n], &b = loop[(n + 1) % loop.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

/// The loops of a shape, each with what is filled to its left: outer ones counterclockwise.
std::vector<std::vector<Vec3l>> orientedLoops(const std::vector<std::vector<Vec3l>>& loops) {
  // Whether a point slightly beside a loop's first side is in another loop, by the even-odd rule.
  const auto inside = [](const std::vector<Vec3l>& loop, double x, double y) {
    bool in = false;
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const Vec3d a = cast<double>(loop[n]), b = cast<double>(loop[(n + 1) % loop.size()]);
      if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)) in = !in;
    }
    return in;
  };
  std::vector<std::vector<Vec3l>> oriented;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (area2(loops[l]) == 0) continue;
    const Vec3d a = cast<double>(loops[l][0]), b = cast<double>(loops[l][1]);
    int depth = 0;
    for (std::size_t m = 0; m < loops.size(); ++m)
      depth += m != l && inside(loops[m], a.x + 0.437 * (b.x - a.x), a.y + 0.437 * (b.y - a.y));
    oriented.push_back(loops[l]);
    if ((area2(loops[l]) > 0) != (depth % 2 == 0)) std::ranges::reverse(oriented.back());
  }
  return oriented;
}

class Converter {
 public:
  Converter(const Drawing& drawing, const std::string& name, Warnings* warnings)
      : drawing_(drawing), name_(name), warnings_(warnings) {
    for (const DrawnShape& shape : drawing.shapes) {
      for (const auto& loop : shape.loops)
        for (const Point& p : loop) box_.add({p[0], p[1], 0});
    }
    longest_ = std::max(box_.size().x, box_.size().y);
    if (!(longest_ > 0)) fail("the drawing has no area");
  }

  SolidScene run(std::optional<double> unit) {
    Solids& solids = scene_.solids;
    scene_.name = name_;
    solids.flat = true;
    solids.unit = unit ? *unit : findUnit();
    if (longest_ / solids.unit > kMostCoordinate / 4.0)
      fail("the drawing is too large for a grid of this `unit`; choose a larger one");
    solids.origin = box_.min;
    solids.substances = {"air"};
    scene_.looks.resize(1);
    scene_.looks[0].name = "air";
    scene_.scale = {3, 3, 1};
    for (const DrawnShape& shape : drawing_.shapes) addSides(shape);
    std::vector<ExactPlane> sides;
    for (const Solid& solid : solids.solids)
      sides.insert(sides.end(), solid.sides.begin(), solid.sides.end());
    height_ = prismHeight(sides, corners_);
    for (std::size_t s = 0; s < solids.solids.size(); ++s) raise(s);
    if (solids.solids.empty()) fail("the drawing has no area");
    if (moved_ > 1e-4 * longest_) {
      char text[64];
      std::snprintf(text, sizeof text, "%.3g", moved_);
      warn(warnings_, name_ + ": corners were moved by up to " + text + " to the grid");
    }
    return std::move(scene_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  double findUnit() const {
    std::vector<double> distances;
    for (const DrawnShape& shape : drawing_.shapes) {
      for (const auto& loop : shape.loops) {
        for (const Point& p : loop) {
          distances.push_back(p[0] - box_.min.x);
          distances.push_back(p[1] - box_.min.y);
        }
      }
    }
    const double room = kPrecision * longest_;
    for (std::int64_t k = 1; k <= kMostUnits; ++k) {
      const double unit = longest_ / static_cast<double>(k);
      const bool fits = std::ranges::all_of(
          distances, [&](double d) { return std::abs(d - unit * std::round(d / unit)) <= room; });
      if (fits) return unit;
    }
    fail("coordinates have no common measure of at least 1 / " + std::to_string(kMostUnits) +
         " of its size; draw on a grid, or give a `unit`");
  }

  Substance substanceOf(const DrawnShape& shape) {
    if (shape.color == std::array<std::uint8_t, 3>{255, 255, 255}) return kAir;
    auto& names = scene_.solids.substances;
    const auto found = std::ranges::find(names, shape.material);
    if (found != names.end()) return static_cast<Substance>(found - names.begin());
    if (names.size() > 200) fail("the drawing has more than 200 materials");
    names.push_back(shape.material);
    Material look;
    look.name = shape.material;
    for (int c = 0; c < 3; ++c) look.baseColor[c] = srgb8ToLinear(shape.color[c]);
    scene_.looks.push_back(std::move(look));
    return static_cast<Substance>(names.size() - 1);
  }

  void addSides(const DrawnShape& shape) {
    std::vector<std::vector<Vec3l>> loops;
    for (const auto& loop : shape.loops) {
      std::vector<Vec3l>& whole = loops.emplace_back();
      for (const Point& p : loop) {
        const Vec3d q = (Vec3d{p[0], p[1], 0} - scene_.solids.origin) / scene_.solids.unit;
        const Vec3l at{std::llround(q.x), std::llround(q.y), 0};
        moved_ = std::max(moved_, length(q - cast<double>(at)) * scene_.solids.unit);
        if (whole.empty() || whole.back() != at) whole.push_back(at);
      }
      while (whole.size() > 1 && whole.front() == whole.back()) whole.pop_back();
    }
    std::erase_if(loops, [](const auto& loop) { return loop.size() < 3; });
    loops = orientedLoops(loops);
    if (loops.empty()) return;
    Solid solid{substanceOf(shape), {}, {}};
    for (const auto& loop : loops) {
      for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec3l along = loop[(n + 1) % loop.size()] - loop[n];
        const Vec3l normal = primitive({along.y, -along.x, 0});
        if (std::max(std::abs(normal.x), std::abs(normal.y)) > kMostNormal) {
          fail("a side of " + shape.material +
               " has a slope that is no fraction of numbers up to " + std::to_string(kMostNormal) +
               "; draw on a coarser grid, or give a larger `unit`");
        }
        solid.sides.push_back({normal, dot(normal, loop[n])});
      }
      corners_.insert(corners_.end(), loop.begin(), loop.end());
    }
    scene_.solids.solids.push_back(std::move(solid));
    loops_.push_back(std::move(loops));
  }

  /// Makes a closed shell of a solid's sides.
  void raise(std::size_t s) {
    Solid& solid = scene_.solids.solids[s];
    const auto top = static_cast<std::uint32_t>(solid.sides.size());
    std::uint32_t side = 0;
    for (const std::vector<Vec3l>& loop : loops_[s]) {
      const auto low = static_cast<std::uint32_t>(scene_.solids.nearPoints.size());
      const auto n = static_cast<std::uint32_t>(loop.size()), high = low + n;
      std::vector<Vec3d> corners;
      for (const std::int64_t z : {std::int64_t{0}, height_}) {
        for (const Vec3l& p : loop) {
          scene_.solids.points.push_back({{p.x, p.y, z}, 1});
          scene_.solids.nearPoints.push_back(cast<double>(Vec3l{p.x, p.y, z}));
          if (z == 0) corners.push_back(cast<double>(p));
        }
      }
      for (std::uint32_t c = 0; c < n; ++c, ++side) {
        const std::uint32_t next = (c + 1) % n;
        solid.triangles.push_back({{low + c, low + next, high + next}, side});
        solid.triangles.push_back({{low + c, high + next, high + c}, side});
      }
      // A hole's ends face the other way and take away from those of the loop around it.
      const std::uint32_t ends = area2(loop) > 0 ? top : top + 2;
      std::vector<std::array<std::uint32_t, 3>> cut;
      if (!triangulate(corners, cut)) fail("a shape has too many corners");
      for (const auto& t : cut) {
        solid.triangles.push_back({{high + t[0], high + t[1], high + t[2]}, ends});
        solid.triangles.push_back({{low + t[0], low + t[2], low + t[1]}, ends + 1});
      }
    }
    solid.sides.push_back({{0, 0, 1}, height_});
    solid.sides.push_back({{0, 0, -1}, 0});
    solid.sides.push_back({{0, 0, -1}, -height_});
    solid.sides.push_back({{0, 0, 1}, 0});
  }

  const Drawing& drawing_;
  std::string name_;
  Warnings* warnings_;
  Box3d box_;
  double longest_ = 0, moved_ = 0;
  std::int64_t height_ = 1;
  std::vector<Vec3l> corners_;
  std::vector<std::vector<std::vector<Vec3l>>> loops_;  // of each solid
  SolidScene scene_;
};

}  // namespace

SolidScene solidsOfDrawing(const Drawing& drawing, const std::string& name,
                           std::optional<double> unit, Warnings* warnings) {
  return Converter(drawing, name, warnings).run(unit);
}

Drawing drawingOf(const PolygonModel& model) {
  if (!model.flat)
    throw InputError(
        "only results of the plane are drawings; write a mesh, or begin with an .svg "
        "or a scene with `flat = true`");
  Drawing drawing;
  for (const Polygon& polygon : model.polygons) {
    if (polygon.plane.normal != Vec3l{0, 0, 1} || polygon.above != kAir) continue;
    DrawnShape shape;
    shape.material = model.substances[polygon.below];
    for (int c = 0; c < 3; ++c)
      shape.color[c] = linearToSrgb8(model.looks[polygon.below].baseColor[c]);
    for (const std::vector<std::uint32_t>& loop : polygon.loops) {
      auto& drawn = shape.loops.emplace_back();
      for (const std::uint32_t corner : loop) {
        const Vec3d p = model.toWorld(model.points[corner]);
        drawn.push_back({p.x, p.y});
      }
    }
    drawing.shapes.push_back(std::move(shape));
  }
  return drawing;
}

}  // namespace exemplar::continuous
