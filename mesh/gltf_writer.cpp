// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "core/base64.h"
#include "core/error.h"
#include "core/json_text.h"
#include "mesh/gltf_material_writer.h"
#include "mesh/mesh_formats.h"
#include "mesh/split_vertices.h"
#include "mesh/tangents.h"

namespace exemplar {
namespace {

/// Keeps the order in which members are added.
using Json = nlohmann::ordered_json;

constexpr std::uint32_t kNone = 0xffffffff;
constexpr int kFloat = 5126, kUnsignedInt = 5125;
/// Share of a mesh's size that rounding may move its vertices by.
constexpr double kVisibleRounding = 1e-5;
constexpr int kVertices = 34962, kIndices = 34963;

void appendLittle(std::string& out, std::uint32_t value) {
  std::array<char, 4> bytes;
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i) & 255);
  out.append(bytes.data(), bytes.size());
}
void appendLittle(std::string& out, float value) {
  appendLittle(out, std::bit_cast<std::uint32_t>(value));
}

float unit(float value) { return std::min(std::max(value, 0.0f), 1.0f); }

class GlbWriter {
 public:
  /// Materials and textures are those of `mesh`, and so are the triangles where there are no parts.
  GlbWriter(const TriangleMesh& mesh, bool yUp, MeshNormals normals, bool plain,
            const Progress& progress, std::span<const Vec3f> given = {})
      : mesh_(mesh),
        part_(&mesh),
        yUp_(yUp),
        normals_(normals),
        given_(given),
        plain_(plain),
        progress_(progress),
        materials_(mesh, [this](const std::string& bytes) { return addPicture(bytes); }) {
    // Floats are finest near 0: a mesh far from there is moved to it, and its nodes move it back.
    if (floatRounding(mesh) > kVisibleRounding) offset_ = roundedCenter(boundingBox(mesh));
  }

  std::string write() {
    Json node{{"mesh", 0}};
    if (!mesh_.name.empty()) node["name"] = mesh_.name;
    const Vec3d shift = toFileAxes(offset_, yUp_);
    if (offset_ != Vec3d{}) node["translation"] = {shift.x, shift.y, shift.z};
    start(Json::array({std::move(node)}));
    json_["meshes"] = Json::array({addPrimitives()});
    const std::string& name = mesh_.dataName.empty() ? mesh_.name : mesh_.dataName;
    if (!name.empty()) json_["meshes"][0]["name"] = name;
    progress_.report("writing", 0.5);
    return finish();
  }

  std::string write(const MeshInstances& instances) {
    // Only parts that are placed are written.
    std::vector<std::uint32_t> meshOf(instances.first.size() - 1, kNone);
    Json nodes = Json::array(), meshes = Json::array();
    for (const MeshInstances::Placement& p : instances.placements) {
      if (instances.first[p.part] == instances.first[p.part + 1]) continue;
      if (meshOf[p.part] == kNone) {
        meshOf[p.part] = static_cast<std::uint32_t>(meshes_++);
      }
      const Vec3d shift = toFileAxes(p.translation + offset_, yUp_);
      nodes.push_back({{"mesh", meshOf[p.part]}, {"translation", {shift.x, shift.y, shift.z}}});
      if (!instances.names.empty()) nodes.back()["name"] = instances.names[p.part];
    }
    start(std::move(nodes));
    std::vector<std::uint32_t> partOf(meshes_);
    for (std::uint32_t part = 0; part < meshOf.size(); ++part) {
      if (meshOf[part] != kNone) partOf[meshOf[part]] = part;
    }
    for (const std::uint32_t part : partOf) {
      const TriangleMesh alone = partAlone(instances.first[part], instances.first[part + 1]);
      part_ = &alone;
      meshes.push_back(addPrimitives());
      meshes.back()["name"] =
          instances.names.empty()
              ? (mesh_.name.empty() ? "piece" : mesh_.name) + "_" + std::to_string(part)
              : instances.names[part];
    }
    part_ = &mesh_;
    json_["meshes"] = std::move(meshes);
    return finish();
  }

 private:
  void start(Json nodes) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "exemplar"}};
    json_["scene"] = 0;
    Json roots = Json::array();
    for (std::size_t n = 0; n < nodes.size(); ++n) roots.push_back(n);
    json_["scenes"] = Json::array({{{"nodes", std::move(roots)}}});
    json_["nodes"] = std::move(nodes);
    numberMaterials();
  }

  std::string finish() {
    addMaterials();
    json_["accessors"] = std::move(accessors_);
    json_["bufferViews"] = std::move(views_);
    json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    return plain_ ? plainJson() : container();
  }

  /// Some of the triangles with the vertices that they use.
  TriangleMesh partAlone(std::uint32_t firstTriangle, std::uint32_t endTriangle) const {
    TriangleMesh part;
    part.materials = mesh_.materials;
    std::unordered_map<std::uint32_t, std::uint32_t> vertexOf;
    for (std::uint32_t t = firstTriangle; t < endTriangle; ++t) {
      auto& triangle = part.triangles.emplace_back();
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t v = mesh_.triangles[t][c];
        const auto [found, isNew] =
            vertexOf.try_emplace(v, static_cast<std::uint32_t>(part.positions.size()));
        if (isNew) {
          part.positions.push_back(mesh_.positions[v]);
          if (mesh_.hasColors()) part.colors.push_back(mesh_.colors[v]);
        }
        triangle[c] = found->second;
      }
      if (mesh_.hasUvs()) part.uvs.push_back(mesh_.uvs[t]);
      if (mesh_.hasMaterials()) part.triangleMaterials.push_back(mesh_.triangleMaterials[t]);
    }
    return part;
  }

  /// A mesh's middle, with few digits: a multiple of a power of two near its size.
  static Vec3d roundedCenter(const Box3d& box) {
    const Vec3d size = box.size();
    const double step = std::exp2(std::round(std::log2(std::max({size.x, size.y, size.z}))));
    Vec3d center = box.center();
    for (int axis = 0; axis < 3; ++axis) center[axis] = std::round(center[axis] / step) * step;
    return center;
  }

  int endView(std::size_t begin, int target) {
    Json view{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", binary_.size() - begin}};
    if (target != 0) view["target"] = target;
    views_.push_back(std::move(view));
    while (binary_.size() % 4 != 0) binary_ += '\0';
    return static_cast<int>(views_.size() - 1);
  }

  int addAccessor(int view, int componentType, std::size_t count, const char* type,
                  std::size_t offset = 0) {
    Json accessor{{"bufferView", view}};
    if (offset != 0) accessor["byteOffset"] = offset;
    accessor["componentType"] = componentType;
    accessor["count"] = count;
    accessor["type"] = type;
    accessors_.push_back(std::move(accessor));
    return static_cast<int>(accessors_.size() - 1);
  }

  int addPositions(const std::vector<std::uint32_t>& source) {
    const std::size_t begin = binary_.size();
    Vec3f low{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
              std::numeric_limits<float>::max()};
    Vec3f high = -low;
    for (const std::uint32_t v : source) {
      const Vec3f p = cast<float>(toFileAxes(part_->positions[v] - offset_, yUp_));
      low = min(low, p);
      high = max(high, p);
      for (const float c : {p.x, p.y, p.z}) appendLittle(binary_, c);
    }
    const int accessor = addAccessor(endView(begin, kVertices), kFloat, source.size(), "VEC3");
    accessors_.back()["min"] = {low.x, low.y, low.z};
    accessors_.back()["max"] = {high.x, high.y, high.z};
    return accessor;
  }

  int addNormals(const std::vector<Vec3f>& normals) {
    const std::size_t begin = binary_.size();
    for (const Vec3f& normal : normals) {
      const Vec3d n = toFileAxes(cast<double>(normal), yUp_);
      for (const double c : {n.x, n.y, n.z}) appendLittle(binary_, static_cast<float>(c));
    }
    return addAccessor(endView(begin, kVertices), kFloat, normals.size(), "VEC3");
  }

  /// Readers join equal vertices again. Where the mesh itself has several vertices at one place, as
  /// where parts touch, `extras` says how many vertices are no copies, and of which vertices those
  /// copies are that equal several.
  void addCopies(Json& json, const SplitVertices& vertices) const {
    if (vertices.normals.empty() && vertices.uvs.empty() && vertices.points.empty())
      return;  // nothing is joined
    std::vector<Vec3d> places;
    places.reserve(vertices.originals);
    for (std::size_t i = 0; i < vertices.originals; ++i)
      places.push_back(cast<double>(cast<float>(part_->positions[vertices.source[i]] - offset_)));
    progress_.check();
    const std::vector<std::uint32_t> first = firstOfEqual(places);
    std::vector<bool> ambiguous(vertices.originals, false);
    bool any = false;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      if (first[i] == i) continue;
      ambiguous[i] = ambiguous[first[i]] = any = true;
    }
    if (!any) return;
    std::vector<std::uint32_t> originalOf(part_->positions.size(), 0);
    for (std::uint32_t i = 0; i < vertices.originals; ++i) originalOf[vertices.source[i]] = i;
    Json copies = Json::array();
    for (std::size_t i = vertices.originals; i < vertices.source.size(); ++i) {
      const std::uint32_t original = originalOf[vertices.source[i]];
      if (!ambiguous[original]) continue;
      copies.push_back(i);
      copies.push_back(original);
    }
    json["extras"] = {{"exemplarVertices", vertices.originals}};
    if (!copies.empty()) json["extras"]["exemplarCopies"] = std::move(copies);
  }

  int addColors(const std::vector<std::uint32_t>& source) {
    const std::size_t begin = binary_.size();
    const int channels = hasAlpha() ? 4 : 3;
    for (const std::uint32_t v : source) {
      for (int c = 0; c < channels; ++c) appendLittle(binary_, unit(part_->colors[v][c]));
    }
    return addAccessor(endView(begin, kVertices), kFloat, source.size(),
                       channels == 4 ? "VEC4" : "VEC3");
  }

  bool hasAlpha() const {
    return std::any_of(mesh_.colors.begin(), mesh_.colors.end(),
                       [](const auto& c) { return c[3] < 1; });
  }

  int addTangents(const std::vector<Tangent>& tangents) {
    const std::size_t begin = binary_.size();
    for (const auto& [x, y, z, side] : tangents) {
      const Vec3d t = toFileAxes({x, y, z}, yUp_);
      for (const double c : {t.x, t.y, t.z}) appendLittle(binary_, static_cast<float>(c));
      appendLittle(binary_, side);
    }
    return addAccessor(endView(begin, kVertices), kFloat, tangents.size(), "VEC4");
  }

  /// Where vertices came from, as attributes of an application, whose numbers are floats: those of
  /// triangles are exact to 2^24.
  void addSources(Json& attributes, const std::vector<SourcePoint>& points) {
    const auto add = [&](const char* name, const char* type, const auto& append) {
      const std::size_t begin = binary_.size();
      for (const SourcePoint& point : points) append(point);
      attributes[name] = addAccessor(endView(begin, kVertices), kFloat, points.size(), type);
    };
    add("_SOURCE_FACE", "SCALAR", [&](const SourcePoint& point) {
      appendLittle(binary_, static_cast<float>(point.triangle));
    });
    add("_SOURCE_WEIGHTS", "VEC2", [&](const SourcePoint& point) {
      for (const float w : point.weights) appendLittle(binary_, w);
    });
    add("_SOURCE_EXAMPLE", "SCALAR", [&](const SourcePoint& point) {
      appendLittle(binary_, static_cast<float>(point.example));
    });
  }

  /// The tangents of a part where a material has a normal map.
  CornerTangents tangentsOf(const ShadingNormals& normals) {
    if (!part_->hasUvs() || !part_->hasMaterials() || normals.corners.empty()) return {};
    if (std::ranges::none_of(part_->triangleMaterials,
                             [&](std::uint32_t m) { return lookups_[m].has_value(); }))
      return {};
    return cornerTangents(*part_, normals, lookups_, progress_);
  }

  /// The file has the materials that triangles use, in their order.
  void numberMaterials() {
    const std::size_t materials = mesh_.hasMaterials() ? mesh_.materials.size() : 1;
    std::vector<bool> used(materials, !mesh_.hasMaterials());
    for (const std::uint32_t m : mesh_.triangleMaterials) used[m] = true;
    std::uint32_t next = 0;
    for (std::size_t m = 0; m < materials; ++m) {
      materialOf_.push_back(used[m] ? next++ : kNone);
      if (mesh_.hasMaterials())
        lookups_.push_back(used[m] ? normalMapLookup(mesh_.materials[m]) : std::nullopt);
    }
  }

  /// A mesh of the file: one primitive for each material, all with the same vertices.
  Json addPrimitives() {
    const Progress computing = part_ == &mesh_ ? progress_.part(0, 0.4) : Progress{};
    const ShadingNormals normals =
        given_.empty() ? shadingNormals(*part_, normals_, computing)
                       : ShadingNormals{{given_.begin(), given_.end()}, part_->triangles};
    const CornerTangents tangents = tangentsOf(normals);
    const SplitVertices vertices =
        splitVertices(*part_, normals, tangents, {.sources = true}, progress_);
    progress_.check();
    binary_.reserve(binary_.size() + vertices.source.size() * (part_->hasColors() ? 28 : 12) +
                    vertices.normals.size() * 12 + vertices.uvs.size() * 8 +
                    vertices.triangles.size() * 12);
    Json attributes{{"POSITION", addPositions(vertices.source)}};
    if (!vertices.normals.empty()) attributes["NORMAL"] = addNormals(vertices.normals);
    if (part_->hasColors()) attributes["COLOR_0"] = addColors(vertices.source);
    if (part_->hasUvs()) {
      const std::size_t begin = binary_.size();
      for (const Vec2f& uv : vertices.uvs) {
        appendLittle(binary_, uv.x);
        appendLittle(binary_, 1 - uv.y);  // v points down in glTF
      }
      attributes["TEXCOORD_0"] =
          addAccessor(endView(begin, kVertices), kFloat, vertices.uvs.size(), "VEC2");
    }
    const int tangent = vertices.tangents.empty() ? -1 : addTangents(vertices.tangents);
    if (!vertices.points.empty()) addSources(attributes, vertices.points);
    // The triangles of each material, one behind the other in one view.
    const std::size_t materials = part_->hasMaterials() ? part_->materials.size() : 1;
    std::vector<std::vector<std::uint32_t>> trianglesOf(materials);
    for (std::size_t t = 0; t < part_->triangles.size(); ++t) {
      if (t % 16384 == 0) progress_.check();
      trianglesOf[part_->hasMaterials() ? part_->triangleMaterials[t] : 0].push_back(
          static_cast<std::uint32_t>(t));
    }
    const std::size_t begin = binary_.size();
    for (const auto& triangles : trianglesOf) {
      progress_.check();
      for (const std::uint32_t t : triangles) {
        for (const std::uint32_t v : vertices.triangles[t]) appendLittle(binary_, v);
      }
    }
    const int view = endView(begin, kIndices);
    Json primitives = Json::array();
    std::size_t offset = 0;
    for (std::size_t m = 0; m < materials; ++m) {
      const auto& triangles = trianglesOf[m];
      if (triangles.empty()) continue;
      const int indices = addAccessor(view, kUnsignedInt, 3 * triangles.size(), "SCALAR", offset);
      primitives.push_back(
          {{"attributes", attributes}, {"indices", indices}, {"material", materialOf_[m]}});
      if (tangent >= 0 && lookups_[m]) primitives.back()["attributes"]["TANGENT"] = tangent;
      offset += 12 * triangles.size();
    }
    Json json{{"primitives", std::move(primitives)}};
    addCopies(json, vertices);
    return json;
  }

  void addMaterials() {
    if (!mesh_.hasMaterials()) {
      // The standard's default material is metal, which is black in most viewers. The mark lets our
      // reader leave it out again.
      Material plain;
      if (mesh_.hasColors()) plain.baseColor = {1, 1, 1, 1};
      materials_.add(plain, hasAlpha());
      materials_.markPlaceholder();
    }
    std::vector<bool> translucent(mesh_.materials.size(), false);
    if (mesh_.hasColors() && mesh_.hasMaterials()) {
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
        for (const std::uint32_t v : mesh_.triangles[t])
          if (mesh_.colors[v][3] < 1) translucent[mesh_.triangleMaterials[t]] = true;
    }
    for (std::size_t m = 0; m < mesh_.materials.size() && mesh_.hasMaterials(); ++m)
      if (materialOf_[m] != kNone) materials_.add(mesh_.materials[m], translucent[m]);
    materials_.finish(json_);
  }

  int addPicture(const std::string& bytes) {
    const std::size_t begin = binary_.size();
    binary_ += bytes;
    return endView(begin, 0);
  }

  /// The JSON alone, its buffer embedded as base64.
  std::string plainJson() {
    json_["buffers"][0]["uri"] = "data:application/octet-stream;base64," + encodeBase64(binary_);
    return text();
  }

  /// Names may hold bytes that are not UTF-8; they are replaced rather than refused.
  std::string text() const { return jsonText(json_); }

  std::string container() const {
    std::string json = text();
    while (json.size() % 4 != 0) json += ' ';
    const std::size_t length = 12 + 8 + json.size() + 8 + binary_.size();
    if (length > std::numeric_limits<std::uint32_t>::max()) {
      throw InputError("the mesh needs a .glb of " + std::to_string(length) +
                       " bytes, and its format ends at 4294967295; write a .ply");
    }
    std::string out;
    out.reserve(length);
    out += "glTF";
    appendLittle(out, std::uint32_t{2});
    appendLittle(out, static_cast<std::uint32_t>(length));
    appendLittle(out, static_cast<std::uint32_t>(json.size()));
    out += "JSON" + json;
    appendLittle(out, static_cast<std::uint32_t>(binary_.size()));
    out.append("BIN\0", 4);
    return out += binary_;
  }

  const TriangleMesh& mesh_;
  const TriangleMesh* part_;  // what is being written: the mesh, or a part of it
  Vec3d offset_{};            // world space: what is taken off positions and given to nodes
  bool yUp_;
  MeshNormals normals_;
  std::span<const Vec3f> given_;  // of the vertices; may be empty
  bool plain_;                    // JSON alone rather than a binary container
  Progress progress_;
  std::size_t meshes_ = 0;  // meshes of the file so far
  Json json_;
  Json accessors_ = Json::array(), views_ = Json::array();
  std::string binary_;
  std::vector<std::uint32_t> materialOf_;
  std::vector<std::optional<UvTransform>> lookups_;  // of the normal maps of materials
  GltfMaterialWriter materials_;
};

}  // namespace

std::string formatGlb(const TriangleMesh& mesh, bool yUp, MeshNormals normals,
                      const Progress& progress, std::span<const Vec3f> given) {
  return GlbWriter(mesh, yUp, normals, false, progress, given).write();
}

std::string formatGltf(const TriangleMesh& mesh, bool yUp, MeshNormals normals,
                       const Progress& progress, std::span<const Vec3f> given) {
  return GlbWriter(mesh, yUp, normals, true, progress, given).write();
}

std::string formatGlb(const TriangleMesh& mesh, const MeshInstances& instances, bool yUp,
                      MeshNormals normals, const Progress& progress) {
  return GlbWriter(mesh, yUp, normals, false, progress).write(instances);
}

}  // namespace exemplar
