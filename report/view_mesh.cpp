// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/view_mesh.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/error.h"
#include "core/loop_progress.h"
#include "core/memory.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "mesh/color.h"
#include "preview/normals.h"
#include "preview/texture.h"
#include "report/encode.h"
#include "report/simplify.h"
#include "report/subdivide.h"
#include "sdf/example_surface.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 2048;
/// The longest edge of a surface with few triangles, as a share of its box's diagonal.
constexpr double kLongestEdge = 0.01;
/// Light is gathered at corners drawn in so far towards their triangles' middles: corners may be in
/// the ground or in each other.
constexpr double kDrawnIn = 0.2;
constexpr double kBytesPerTriangle = 900;  // of simplifying, and of looking up what was there

/// How a point of a surface looks, as a view keeps it.
struct Looks {
  std::array<std::uint8_t, 3> color{};
  std::uint8_t metallic = 0, roughness = 0, glow = 0;
};

std::uint8_t byteOf(double share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

/// What a mesh is made of; as `render` sees it.
class Palette {
 public:
  Palette(const TriangleMesh& mesh, Warnings* warnings)
      : mesh_(mesh), textures_(colorTextures(mesh, warnings)) {}

  /// Whether looks differ within one material.
  bool varies() const {
    return mesh_.hasColors() || std::any_of(textures_.begin(), textures_.end(),
                                            [](const auto& t) { return t != nullptr; });
  }

  Looks at(std::size_t triangle, const std::array<double, 3>& weights) const {
    Vec3f color{0.50f, 0.455f, 0.405f};  // clay, as in pictures
    Looks looks;
    looks.roughness = byteOf(0.65);
    if (mesh_.hasMaterials()) {
      const Material& m = mesh_.materials[mesh_.triangleMaterials[triangle]];
      color = {m.baseColor[0], m.baseColor[1], m.baseColor[2]};
      looks.metallic = byteOf(m.metallic);
      looks.roughness = byteOf(m.roughness);
      const float own = std::max({m.emission.x, m.emission.y, m.emission.z});
      if (own > 0) {
        // A view has one color a point: that of the light, where it has light.
        color = m.emission / own;
        looks.glow = byteOf(own);
      }
      if (m.baseColorTexture && mesh_.hasUvs() && textures_[*m.baseColorTexture]) {
        Vec2f at{};
        for (int c = 0; c < 3; ++c) {
          at.x += mesh_.uvs[triangle][c].x * static_cast<float>(weights[c]);
          at.y += mesh_.uvs[triangle][c].y * static_cast<float>(weights[c]);
        }
        color = scaled(color, textures_[*m.baseColorTexture]->at(m.baseColorTransform.apply(at)));
      }
    } else if (mesh_.hasColors()) {
      color = {1, 1, 1};
    }
    if (mesh_.hasColors()) {
      Vec3f own{};
      for (int c = 0; c < 3; ++c) {
        const auto& rgba = mesh_.colors[mesh_.triangles[triangle][c]];
        own += Vec3f{rgba[0], rgba[1], rgba[2]} * static_cast<float>(weights[c]);
      }
      color = scaled(color, own);
    }
    for (int c = 0; c < 3; ++c) looks.color[c] = linearToSrgb8(std::clamp(color[c], 0.0f, 1.0f));
    return looks;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<std::unique_ptr<ColorTexture>> textures_;
};

TriangleMesh bare(const TriangleMesh& mesh) {
  TriangleMesh shape;
  shape.positions = mesh.positions;
  shape.triangles = mesh.triangles;
  return shape;
}

/// What is drawn, and how it relates to the surface that it shows.
struct Shape {
  TriangleMesh mesh;
  bool another = false;  ///< simplified; else its triangles are parts of the surface's:
  std::vector<std::uint32_t> parents;
  std::vector<std::array<std::array<double, 3>, 3>> weights;
};

/// The shape alone, of about as many triangles as were asked for. Where there are few, large ones
/// are cut: light is kept at corners.
Shape shapeOf(const TriangleMesh& mesh, std::int64_t triangles) {
  Shape shape{bare(mesh)};
  const double diagonal = length(boundingBox(mesh).size());
  if (static_cast<std::int64_t>(mesh.triangles.size()) <= triangles) {
    // Too many parts: coarser ones; in the end the surface as it is.
    for (double longest = kLongestEdge * diagonal; longest < diagonal; longest *= 1.5) {
      if (auto parts = subdivide(mesh, longest, triangles)) {
        shape.mesh = std::move(parts->mesh);
        shape.parents = std::move(parts->parents);
        shape.weights = std::move(parts->weights);
        return shape;
      }
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      shape.parents.push_back(t);
      shape.weights.push_back({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    }
    return shape;
  }
  requireMemory(kBytesPerTriangle * static_cast<double>(mesh.triangles.size()),
                "simplifying a surface for the report", "leave the report out");
  shape.another = true;
  shape.mesh = simplified(mesh, triangles);
  return shape;
}

Vec3d centroid(const TriangleMesh& mesh, std::size_t t) {
  Vec3d sum{};
  for (const std::uint32_t v : mesh.triangles[t]) sum += mesh.positions[v];
  return sum / 3.0;
}

/// The looks of every triangle's corners.
std::vector<std::array<Looks, 3>> cornerLooks(const Shape& drawn, const TriangleMesh& full,
                                              Warnings* warnings, const Progress& progress) {
  const Palette palette(full, warnings);
  const TriangleMesh& shape = drawn.mesh;
  std::vector<std::array<Looks, 3>> looks(shape.triangles.size());
  if (!drawn.another) {
    for (std::size_t t = 0; t < looks.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c)
        looks[t][c] = palette.at(drawn.parents[t], drawn.weights[t][c]);
    return looks;
  }
  const ExampleSurface surface(full);
  const double facing = 0.02 * length(boundingBox(full).size());
  LoopProgress done(progress, "coloring the view", looks.size());
  parallelFor(0, looks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      done.check();
      ClosestOptions closest;
      closest.facing = normalized(areaNormal(shape, t));
      closest.facingCost = facing;
      const Vec3d middle = centroid(shape, t);
      const auto at = surface.closest(middle, closest);
      if (!at) continue;
      looks[t].fill(palette.at(at->triangle, at->weights));
      if (!palette.varies()) continue;
      // Colors vary from corner to corner, but stay within the triangle's one material.
      if (full.hasMaterials()) {
        closest.groups = full.triangleMaterials;
        closest.group = full.triangleMaterials[at->triangle];
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3d corner = shape.positions[shape.triangles[t][c]] * 0.98 + middle * 0.02;
        if (const auto near = surface.closest(corner, closest))
          looks[t][c] = palette.at(near->triangle, near->weights);
      }
    }
    done.advance(end - begin);
  });
  return looks;
}

/// Where points of a surface came from.
class Sources {
 public:
  explicit Sources(const ViewSource& view) : view_(view) {
    if (view.origins && (!view.field || !view.example))
      throw InputError("a view with origins needs the field and the example too");
    if (view.origins && view.origins->size() != view.field->size())
      throw InputError("a view's origins must be one for each of its field's samples");
    if (view.jumps && (!view.field || view.jumps->size() != view.field->size()))
      throw InputError("a view's seam jumps must be one for each of its field's samples");
    if (view.example) {
      box_ = view.example->box();
      const Vec3d size = box_.size();
      for (int axis = 0; axis < 3; ++axis) steps_[axis] = size[axis] > 0 ? 254 / size[axis] : 0;
    }
  }

  /// The motion that a triangle went with: that of the sample nearest to its middle.
  OriginMotion motionOf(const Vec3d& middle) const {
    if (!view_.origins) return {};
    const Vec3d index = view_.field->index(middle);
    const Vec3i cell = view_.field->values.clamped({static_cast<int>(std::lround(index.x)),
                                                    static_cast<int>(std::lround(index.y)),
                                                    static_cast<int>(std::lround(index.z))});
    return motionAt(*view_.origins, cell);
  }

  std::array<std::uint8_t, 3> at(const Vec3d& position, const OriginMotion& motion) const {
    if (!view_.example) return {};
    Vec3d source = position;
    if (view_.origins) {
      if (motion.example != view_.exampleIndex) return {};
      source = view_.example->position(motion.toExample(view_.field->index(position)));
    }
    std::array<std::uint8_t, 3> bytes{};
    for (int axis = 0; axis < 3; ++axis) {
      const double step = (source[axis] - box_.min[axis]) * steps_[axis];
      bytes[axis] = static_cast<std::uint8_t>(1 + std::lround(std::clamp(step, 0.0, 254.0)));
    }
    return bytes;
  }

  /// The largest jump among the samples around a point.
  std::uint8_t jumpAt(const Vec3d& position) const {
    if (!view_.jumps) return 0;
    const Vec3d index = view_.field->index(position);
    const Vec3i low{static_cast<int>(std::floor(index.x)), static_cast<int>(std::floor(index.y)),
                    static_cast<int>(std::floor(index.z))};
    float most = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3i cell = low + Vec3i{corner & 1, corner >> 1 & 1, corner >> 2};
      most = std::max(most, (*view_.jumps)[view_.jumps->clamped(cell)]);
    }
    return static_cast<std::uint8_t>(std::min(255.0, std::round(most * ViewVertex::kJumpSteps)));
  }

 private:
  const ViewSource& view_;
  Box3d box_;
  Vec3d steps_{};
};

/// Corners of one vertex that look alike are one in a view: same looks, same source, and normals
/// that differ by less than this (cosine; some 30 degrees), whose mean it then has.
constexpr float kAlike = 0.86f;

/// The corners at the vertices of a shape, as many at each as differ.
class ViewCorners {
 public:
  explicit ViewCorners(std::size_t vertices) : first_(vertices, kNone) {}

  /// The number of the corner at `vertex` that looks as `corner` does; a new one where there is
  /// none. `isNew` says which.
  std::uint32_t at(std::uint32_t vertex, const ViewVertex& corner, const Vec3f& normal,
                   const Vec3d& drawnIn, bool* isNew) {
    std::uint32_t* link = &first_[vertex];
    for (; *link != kNone; link = &next_[*link]) {
      Vec3f& sum = normals[*link];
      if (!(looks_[*link] == corner) || dot(normalized(sum), normal) < kAlike) continue;
      sum += normal;
      probes[*link].sum += drawnIn;
      probes[*link].count += 1;
      *isNew = false;
      return *link;
    }
    const auto number = static_cast<std::uint32_t>(looks_.size());
    *link = number;  // before the lists grow, and move
    looks_.push_back(corner);
    normals.push_back(normal);
    probes.push_back({drawnIn, 1});
    next_.push_back(kNone);
    *isNew = true;
    return number;
  }

  struct Sum {
    Vec3d sum;
    double count = 0;
  };
  std::vector<Vec3f> normals;  ///< of each corner; the sum of those that it represents
  std::vector<Sum> probes;     ///< the places that light is gathered at

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> first_, next_;
  std::vector<ViewVertex> looks_;
};

/// Writes planes of differences.
class Planes {
 public:
  template <class Value>
  void bytes(const std::vector<ViewVertex>& vertices, const Value& value) {
    std::uint8_t before = 0;
    for (const ViewVertex& v : vertices) {
      const auto now = static_cast<std::uint8_t>(value(v));
      out += static_cast<char>(static_cast<std::uint8_t>(now - before));
      before = now;
    }
  }

  template <class Value>
  void words(const std::vector<ViewVertex>& vertices, const Value& value) {
    std::string high;
    std::uint16_t before = 0;
    for (const ViewVertex& v : vertices) {
      const std::uint16_t now = value(v);
      const auto difference = static_cast<std::int16_t>(static_cast<std::uint16_t>(now - before));
      // Small differences of either sign become small numbers.
      const auto zigzag = static_cast<std::uint16_t>(static_cast<std::uint16_t>(difference) << 1 ^
                                                     (difference < 0 ? 0xFFFF : 0));
      out += static_cast<char>(zigzag & 255);
      high += static_cast<char>(zigzag >> 8);
      before = now;
    }
    out += high;
  }

  std::string out;
};

/// Points on the floor around the surface, as far as its shadow may fall.
ViewFloor floorBelow(const Box3d& box, std::vector<LightProbe>& probes) {
  ViewFloor floor;
  const Vec3d size = box.size();
  const double beyond = 1.3 * size.z + 0.1 * std::max(size.x, size.y);
  floor.box.min = {box.min.x - beyond, box.min.y - beyond, box.min.z};
  floor.box.max = {box.max.x + beyond, box.max.y + beyond, box.min.z};
  const double step = 1.0 / (ViewFloor::kSide - 1);
  for (int y = 0; y < ViewFloor::kSide; ++y)
    for (int x = 0; x < ViewFloor::kSide; ++x)
      probes.push_back(
          {floor.box.min + scaled(floor.box.max - floor.box.min, Vec3d{x * step, y * step, 0}),
           {0, 0, 1}});
  return floor;
}

/// Of the light on an open floor the key light brings this much.
constexpr double kKeyOfFloor = 0.66;

}  // namespace

std::array<double, 2> octahedral(const Vec3d& direction) {
  const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  if (!(sum > 0)) return {0, 0};
  const double x = direction.x / sum, y = direction.y / sum;
  if (direction.z >= 0) return {x, y};
  return {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1)};
}

ViewMesh makeViewMesh(const ViewSource& source, const ViewOptions& options,
                      const Progress& progress) {
  if (options.triangles < 1000)
    throw InputError("a view of " + std::to_string(options.triangles) +
                     " triangles shows nothing; 1000 or more is right");
  validate(source.mesh, "view");
  const Sources sources(source);
  progress.report("simplifying the view", 0);
  const Shape drawn = shapeOf(source.mesh, options.triangles);
  const TriangleMesh& shape = drawn.mesh;
  const std::vector<std::array<Looks, 3>> looks =
      cornerLooks(drawn, source.mesh, options.picture.warnings, progress.part(0.3, 0.5));
  const std::vector<std::array<Vec3f, 3>> normals =
      cornerNormals(shape, options.picture.creaseAngle);
  progress.report("placing the view's corners", 0.55);

  ViewMesh view;
  view.box = boundingBox(shape);
  view.ofTriangles = drawn.another ? static_cast<std::int64_t>(source.mesh.triangles.size())
                                   : static_cast<std::int64_t>(shape.triangles.size());
  const Vec3d size = view.box.size();
  ViewCorners corners(shape.positions.size());
  std::vector<LightProbe> probes;
  for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
    if (length(areaNormal(shape, t)) == 0) continue;
    const OriginMotion motion = sources.motionOf(centroid(shape, t));
    std::array<std::uint32_t, 3>& triangle = view.triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t v = shape.triangles[t][c];
      const Vec3d& p = shape.positions[v];
      ViewVertex vertex;
      for (int axis = 0; axis < 3; ++axis) {
        const double share = size[axis] > 0 ? (p[axis] - view.box.min[axis]) / size[axis] : 0;
        vertex.position[axis] = static_cast<std::uint16_t>(std::lround(65535 * share));
      }
      vertex.color = looks[t][c].color;
      vertex.metallic = looks[t][c].metallic;
      vertex.roughness = looks[t][c].roughness;
      vertex.glow = looks[t][c].glow;
      vertex.source = sources.at(p, motion);
      bool isNew = false;
      triangle[c] = corners.at(v, vertex, normals[t][c],
                               p * (1 - kDrawnIn) + centroid(shape, t) * kDrawnIn, &isNew);
      if (!isNew) continue;
      vertex.jump = sources.jumpAt(p);
      view.vertices.push_back(vertex);
    }
  }
  for (std::size_t v = 0; v < view.vertices.size(); ++v) {
    probes.push_back(
        {corners.probes[v].sum * (1 / corners.probes[v].count), normalized(corners.normals[v])});
    const std::array<double, 2> normal = octahedral(cast<double>(probes[v].normal));
    for (std::size_t i = 0; i < 2; ++i)
      view.vertices[v].normal[i] = static_cast<std::int8_t>(std::lround(127 * normal[i]));
  }
  if (view.triangles.empty()) throw InputError("a view needs a triangle with an area");
  BakeOptions bake;
  bake.rays = options.rays;
  bake.picture = options.picture;
  view.floor = floorBelow(view.box, probes);
  const std::vector<BakedLight> light = bakeLight(shape, probes, bake, progress.part(0.6, 1));
  for (std::size_t v = 0; v < view.vertices.size(); ++v) view.vertices[v].light = light[v];
  for (std::size_t p = view.vertices.size(); p < light.size(); ++p)
    view.floor.light.push_back(static_cast<std::uint8_t>(
        std::lround(kKeyOfFloor * light[p].key + (1 - kKeyOfFloor) * light[p].sky)));
  return view;
}

std::string packViewMesh(const ViewMesh& view) {
  const std::vector<ViewVertex>& v = view.vertices;
  Planes planes;
  for (std::size_t a = 0; a < 3; ++a)
    planes.words(v, [a](const ViewVertex& x) { return x.position[a]; });
  for (std::size_t a = 0; a < 2; ++a)
    planes.bytes(v, [a](const ViewVertex& x) { return x.normal[a]; });
  for (std::size_t a = 0; a < 3; ++a)
    planes.bytes(v, [a](const ViewVertex& x) { return x.color[a]; });
  planes.bytes(v, [](const ViewVertex& x) { return x.metallic; });
  planes.bytes(v, [](const ViewVertex& x) { return x.roughness; });
  planes.bytes(v, [](const ViewVertex& x) { return x.glow; });
  planes.bytes(v, [](const ViewVertex& x) { return x.light.sky; });
  planes.bytes(v, [](const ViewVertex& x) { return x.light.key; });
  for (std::size_t a = 0; a < 3; ++a)
    planes.bytes(v, [a](const ViewVertex& x) { return x.source[a]; });
  planes.bytes(v, [](const ViewVertex& x) { return x.jump; });
  std::uint32_t next = 0;  // the lowest index not named yet
  for (const auto& triangle : view.triangles)
    for (const std::uint32_t corner : triangle) {
      std::uint32_t below = next - corner;
      next = std::max(next, corner + 1);
      for (; below >= 128; below >>= 7) planes.out += static_cast<char>((below & 127) | 128);
      planes.out += static_cast<char>(below);
    }
  std::uint8_t before = 0;
  for (const std::uint8_t now : view.floor.light) {
    planes.out += static_cast<char>(static_cast<std::uint8_t>(now - before));
    before = now;
  }
  return deflated(planes.out);
}

}  // namespace exemplar
