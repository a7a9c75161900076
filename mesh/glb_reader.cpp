// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/error.h"
#include "core/memory.h"
#include "core/text_scanner.h"
#include "mesh/gltf_document.h"
#include "mesh/mesh_formats.h"

namespace exemplar {
namespace {

using Json = GltfDocument::Json;

constexpr std::uint32_t kNone = 0xffffffff;

/// An affine map: three columns and a translation.
struct Transform {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, move{};

  Vec3d turned(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d operator()(const Vec3d& p) const { return turned(p) + move; }
  /// First `other`, then this.
  Transform operator*(const Transform& other) const {
    return {turned(other.x), turned(other.y), turned(other.z), (*this)(other.move)};
  }
  bool mirrors() const { return dot(cross(x, y), z) < 0; }
};

/// Vertices that one or more primitives of a mesh index.
struct VertexSet {
  std::vector<Vec3d> positions;
  std::vector<std::array<float, 4>> colors;  // as many, or none
  /// Whether equal vertices are to be joined: they were split for normals or texture coordinates,
  /// which belong to corners here, or never shared. Without a reason to split they stay apart.
  bool join = false;
};

struct Primitive {
  std::size_t set = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<Vec2f, 3>> uvs;  // as many, or none
  std::uint32_t material = kNone;
};

struct DecodedMesh {
  std::vector<VertexSet> sets;
  std::vector<Primitive> primitives;
};

struct Instance {
  std::uint64_t mesh = 0;
  Transform transform;
};

/// How a material's base-color texture is looked up.
struct TextureUse {
  std::uint64_t texCoord = 0;
  std::array<double, 2> offset{0, 0}, scale{1, 1};
  double rotation = 0;

  /// The texture coordinate, v up, for one in the file, v down (KHR_texture_transform turns
  /// counterclockwise as seen on the picture).
  Vec2f apply(double u, double v) const {
    const double c = std::cos(rotation), s = std::sin(rotation);
    const double scaledU = u * scale[0], scaledV = v * scale[1];
    return {static_cast<float>(offset[0] + c * scaledU + s * scaledV),
            static_cast<float>(1 - (offset[1] - s * scaledU + c * scaledV))};
  }
};

/// Gives each different pair of position and color one vertex of a mesh.
class Joiner {
 public:
  struct Key {
    Vec3d position;
    std::array<float, 4> color;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = 0;
      const auto mix = [&](std::uint64_t bits) {
        h = (h ^ bits) * 0x9e3779b97f4a7c15u;
        h ^= h >> 29;
      };
      for (const double c : {k.position.x, k.position.y, k.position.z}) {
        mix(std::bit_cast<std::uint64_t>(c + 0.0));
      }
      for (const float c : k.color) mix(std::bit_cast<std::uint32_t>(c + 0.0f));
      return h;
    }
  };

  std::unordered_map<Key, std::uint32_t, Hash> indexOf;
};

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const MeshSource& source)
      : in_(bytes, source), source_(source) {
    materialUsed_.resize(in_.count("materials"), false);
    textureUses_.resize(in_.count("materials"));
  }

  TriangleMesh read() {
    findInstances();
    decodeMeshes();
    for (std::size_t i = 0; i < instances_.size(); ++i) {
      source_.progress.report("placing meshes", 0.5 + 0.5 * static_cast<double>(i) /
                                                          static_cast<double>(instances_.size()));
      add(instances_[i]);
    }
    finishMaterials();
    return std::move(mesh_);
  }

 private:
  Transform transformOf(const Json& node, const std::string& place) const {
    double m[16];
    if (in_.numbers(node, "matrix", 16, m, place)) {
      return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    double move[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    in_.numbers(node, "translation", 3, move, place);
    in_.numbers(node, "rotation", 4, q, place);
    in_.numbers(node, "scale", 3, scale, place);
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0) || !std::isfinite(length)) in_.fail(place + ".rotation should have length 1");
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    Transform t;
    t.x = Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)} * scale[0];
    t.y = Vec3d{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)} * scale[1];
    t.z = Vec3d{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)} * scale[2];
    t.move = {move[0], move[1], move[2]};
    return t;
  }

  /// The nodes where the scene begins: the default scene's, the first one's, or, where there is no
  /// scene, all nodes that are no other node's child.
  std::vector<std::uint64_t> rootNodes() const {
    std::vector<std::uint64_t> roots;
    if (in_.count("scenes") > 0) {
      const std::uint64_t scene = in_.index(in_.root(), "scene", "the file").value_or(0);
      const std::string place = "scenes[" + std::to_string(scene) + "]";
      appendNodes(in_.element("scenes", scene, "the file"), "nodes", place, roots);
      return roots;
    }
    std::vector<bool> isChild(in_.count("nodes"), false);
    for (std::uint64_t n = 0; n < isChild.size(); ++n) {
      std::vector<std::uint64_t> children;
      const std::string place = "nodes[" + std::to_string(n) + "]";
      appendNodes(in_.element("nodes", n, place), "children", place, children);
      for (const std::uint64_t child : children) isChild[child] = true;
    }
    for (std::uint64_t n = 0; n < isChild.size(); ++n) {
      if (!isChild[n]) roots.push_back(n);
    }
    return roots;
  }

  void appendNodes(const Json& object, const char* key, const std::string& place,
                   std::vector<std::uint64_t>& to) const {
    const Json* nodes = in_.array(object, key, place);
    if (!nodes) return;
    for (const Json& n : *nodes) {
      if (!n.is_number_unsigned() || n.get<std::uint64_t>() >= in_.count("nodes")) {
        in_.fail(place + "." + key + " names a node that does not exist: there are " +
                 std::to_string(in_.count("nodes")));
      }
      to.push_back(n.get<std::uint64_t>());
    }
  }

  /// Walks the tree of nodes without recursion: it may be as deep as the file is long.
  void findInstances() {
    struct Step {
      std::uint64_t node;
      Transform parent;
    };
    std::vector<Step> stack;
    const auto push = [&](std::vector<std::uint64_t> nodes, const Transform& parent) {
      // The stack gives back the last one first; the order of the file is what we want.
      for (std::size_t i = nodes.size(); i-- > 0;) stack.push_back({nodes[i], parent});
    };
    push(rootNodes(), {});
    std::vector<bool> seen(in_.count("nodes"), false);
    while (!stack.empty()) {
      const Step step = stack.back();
      stack.pop_back();
      const std::string place = "nodes[" + std::to_string(step.node) + "]";
      if (seen[step.node]) in_.fail(place + " is reached twice: nodes should form a tree");
      seen[step.node] = true;
      const Json& node = in_.element("nodes", step.node, "the scene");
      const Transform transform = step.parent * transformOf(node, place);
      if (const auto mesh = in_.index(node, "mesh", place)) {
        in_.element("meshes", *mesh, place);
        instances_.push_back({*mesh, transform});
      }
      std::vector<std::uint64_t> children;
      appendNodes(node, "children", place, children);
      push(std::move(children), transform);
    }
  }

  void decodeMeshes() {
    double bytes = 0, vertices = 0;
    for (const Instance& instance : instances_) {
      const auto [found, added] = meshes_.try_emplace(instance.mesh);
      if (added) found->second = decodeMesh(instance.mesh);
      for (const VertexSet& s : found->second.sets) {
        vertices += static_cast<double>(s.positions.size());
        bytes += static_cast<double>(s.positions.size() * 40);
      }
      for (const Primitive& p : found->second.primitives) {
        bytes += static_cast<double>(p.triangles.size() * 40);
      }
    }
    requireMemory(bytes, source_.name + ": this scene with its copies of meshes",
                  "use a smaller one");
    if (vertices >= kNone) in_.fail("the scene has more than 4294967294 vertices");
  }

  DecodedMesh decodeMesh(std::uint64_t index) {
    source_.progress.report("decoding meshes", 0.5 * static_cast<double>(meshes_.size()) /
                                                   static_cast<double>(in_.count("meshes") + 1));
    DecodedMesh mesh;
    const std::string place = "meshes[" + std::to_string(index) + "]";
    const Json* primitives = in_.array(in_.element("meshes", index, place), "primitives", place);
    if (!primitives) in_.fail(place + ".primitives is missing");
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> setOf;
    std::map<std::uint64_t, std::vector<double>> uvsOf;
    for (std::size_t i = 0; i < primitives->size(); ++i) {
      const std::string at = place + ".primitives[" + std::to_string(i) + "]";
      const Json& json = (*primitives)[i];
      if (!json.is_object()) in_.fail(at + " should be an object");
      const std::uint64_t mode = in_.index(json, "mode", at).value_or(4);
      if (mode > 6) in_.fail(at + ".mode should be 0 to 6");
      if (mode < 4) continue;  // points and lines
      const Json* attributes = in_.object(json, "attributes", at);
      if (!attributes) in_.fail(at + ".attributes is missing");
      const auto position = in_.index(*attributes, "POSITION", at + ".attributes");
      if (!position) in_.fail(at + " has no POSITION");
      const auto color = in_.index(*attributes, "COLOR_0", at + ".attributes");
      const auto [set, added] =
          setOf.try_emplace({*position, color.value_or(~std::uint64_t{0})}, mesh.sets.size());
      if (added) mesh.sets.push_back(decodeSet(*position, color, at));
      VertexSet& vertices = mesh.sets[set->second];
      const bool hasIndices = json.contains("indices");
      vertices.join = vertices.join || !hasIndices || attributes->size() > (color ? 2u : 1u);

      Primitive primitive;
      primitive.set = set->second;
      const std::vector<std::uint32_t> corners = decodeIndices(json, vertices.positions.size(), at);
      primitive.triangles = trianglesOf(corners, mode, at);
      if (const auto material = in_.index(json, "material", at)) {
        useMaterial(*material, at);
        primitive.material = static_cast<std::uint32_t>(*material);
      }
      decodeUvs(primitive, *attributes, vertices.positions.size(), uvsOf, at);
      mesh.primitives.push_back(std::move(primitive));
    }
    return mesh;
  }

  VertexSet decodeSet(std::uint64_t position, std::optional<std::uint64_t> color,
                      const std::string& at) {
    VertexSet set;
    const GltfAccessor positions = in_.accessor(position, at);
    if (positions.components != 3)
      in_.fail(positions.place + " should be VEC3: it is used as POSITION");
    const std::vector<double> p = in_.readNumbers(positions);
    set.positions.reserve(positions.count);
    for (std::size_t i = 0; i < p.size(); i += 3) {
      set.positions.push_back({p[i], p[i + 1], p[i + 2]});
      if (const char* problem = coordinateProblem(set.positions.back())) {
        in_.fail(positions.place + ": vertex " + std::to_string(i / 3) + " " + problem);
      }
    }
    if (!color) return set;
    GltfAccessor colors = in_.accessor(*color, at);
    if (colors.components < 3 || colors.count != positions.count) {
      in_.fail(colors.place + " should be " + std::to_string(positions.count) +
               " of VEC3 or VEC4: it is used as COLOR_0");
    }
    colors.normalized = true;  // the standard asks for it; some writers forget to say so
    const std::vector<double> c = in_.readNumbers(colors);
    for (std::size_t i = 0; i < c.size(); i += colors.components) {
      set.colors.push_back({static_cast<float>(c[i]), static_cast<float>(c[i + 1]),
                            static_cast<float>(c[i + 2]),
                            colors.components == 4 ? static_cast<float>(c[i + 3]) : 1.0f});
      for (const float sample : set.colors.back()) {
        if (!(std::abs(sample) < 1e6f)) in_.fail(colors.place + " has a color that is not in 0..1");
      }
    }
    return set;
  }

  std::vector<std::uint32_t> decodeIndices(const Json& primitive, std::size_t vertices,
                                           const std::string& at) {
    std::vector<std::uint32_t> indices;
    if (const auto accessor = in_.index(primitive, "indices", at)) {
      indices = in_.readIndices(in_.accessor(*accessor, at));
      for (const std::uint32_t i : indices) {
        if (i >= vertices) {
          in_.fail(at + " names vertex " + std::to_string(i) + " of " + std::to_string(vertices));
        }
      }
    } else {
      if (vertices >= kNone) in_.fail(at + " has more than 4294967294 vertices");
      indices.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) indices[i] = static_cast<std::uint32_t>(i);
    }
    return indices;
  }

  std::vector<std::array<std::uint32_t, 3>> trianglesOf(const std::vector<std::uint32_t>& v,
                                                        std::uint64_t mode,
                                                        const std::string& at) const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    if (mode == 4) {
      if (v.size() % 3 != 0) {
        in_.fail(at + " has " + std::to_string(v.size()) +
                 " corners, which is not a multiple of three");
      }
      triangles.reserve(v.size() / 3);
      for (std::size_t i = 0; i < v.size(); i += 3) triangles.push_back({v[i], v[i + 1], v[i + 2]});
      return triangles;
    }
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
      const std::array<std::uint32_t, 3> t =
          mode == 6 ? std::array{v[i + 1], v[i + 2], v[0]}
                    : std::array{v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]};
      // Equal corners are how strips are joined.
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    return triangles;
  }

  void decodeUvs(Primitive& primitive, const Json& attributes, std::size_t vertices,
                 std::map<std::uint64_t, std::vector<double>>& uvsOf, const std::string& at) {
    TextureUse use;
    if (primitive.material != kNone) use = textureUses_[primitive.material];
    const std::string key = "TEXCOORD_" + std::to_string(use.texCoord);
    const auto index = in_.index(attributes, key.c_str(), at + ".attributes");
    if (!index) return;
    const auto [found, added] = uvsOf.try_emplace(*index);
    if (added) {
      const GltfAccessor accessor = in_.accessor(*index, at);
      if (accessor.components != 2)
        in_.fail(accessor.place + " should be VEC2: it is used as " + key);
      found->second = in_.readNumbers(accessor);
      for (const double c : found->second) {
        if (!(std::abs(c) < 1e15))
          in_.fail(accessor.place + " has a NaN or too large texture coordinate");
      }
    }
    const std::vector<double>& uvs = found->second;
    if (uvs.size() != 2 * vertices) {
      in_.fail(at + " has " + std::to_string(uvs.size() / 2) + " texture coordinates for " +
               std::to_string(vertices) + " vertices");
    }
    primitive.uvs.reserve(primitive.triangles.size());
    for (const auto& triangle : primitive.triangles) {
      auto& corners = primitive.uvs.emplace_back();
      for (int c = 0; c < 3; ++c) {
        corners[c] = use.apply(uvs[2 * triangle[c]], uvs[2 * triangle[c] + 1]);
        if (!std::isfinite(corners[c].x) || !std::isfinite(corners[c].y)) {
          in_.fail(at + " has a texture coordinate that its transform makes infinite");
        }
      }
    }
  }

  /// Marks a material as used and finds out how its texture is looked up.
  void useMaterial(std::uint64_t index, const std::string& at) {
    const Json& json = in_.element("materials", index, at);
    if (materialUsed_[index]) return;
    materialUsed_[index] = true;
    const std::string place = "materials[" + std::to_string(index) + "]";
    const Json* texture = baseColorTexture(json, place);
    if (!texture) return;
    TextureUse& use = textureUses_[index];
    use.texCoord = in_.index(*texture, "texCoord", place).value_or(0);
    const Json* extensions = in_.object(*texture, "extensions", place);
    if (!extensions) return;
    if (const Json* transform = in_.object(*extensions, "KHR_texture_transform", place)) {
      const std::string within = place + ".KHR_texture_transform";
      in_.numbers(*transform, "offset", 2, use.offset.data(), within);
      in_.numbers(*transform, "scale", 2, use.scale.data(), within);
      use.rotation = in_.number(*transform, "rotation", 0, within);
      use.texCoord = in_.index(*transform, "texCoord", within).value_or(use.texCoord);
    }
  }

  const Json* baseColorTexture(const Json& material, const std::string& place) const {
    const Json* pbr = in_.object(material, "pbrMetallicRoughness", place);
    return pbr ? in_.object(*pbr, "baseColorTexture", place) : nullptr;
  }

  void add(const Instance& instance) {
    const DecodedMesh& source = meshes_.at(instance.mesh);
    const bool mirrors = instance.transform.mirrors();
    Joiner joiner;
    std::vector<std::vector<std::uint32_t>> vertexOf;
    for (const VertexSet& set : source.sets) vertexOf.push_back(addVertices(set, instance, joiner));
    for (const Primitive& p : source.primitives) {
      const std::vector<std::uint32_t>& vertex = vertexOf[p.set];
      if (!p.uvs.empty()) mesh_.uvs.resize(mesh_.triangles.size());
      for (std::size_t t = 0; t < p.triangles.size(); ++t) {
        if (t % 16384 == 0) source_.progress.check();
        auto [a, b, c] = p.triangles[t];
        // A mirrored node turns triangles inside out.
        if (mirrors) std::swap(b, c);
        mesh_.triangles.push_back({vertex[a], vertex[b], vertex[c]});
        mesh_.triangleMaterials.push_back(p.material);
        if (p.uvs.empty()) continue;
        const auto& uv = p.uvs[t];
        mesh_.uvs.push_back(mirrors ? std::array{uv[0], uv[2], uv[1]} : uv);
      }
    }
    if (mesh_.hasUvs()) mesh_.uvs.resize(mesh_.triangles.size());
  }

  /// Adds a set's vertices, turned and moved; returns the index in the result of each.
  std::vector<std::uint32_t> addVertices(const VertexSet& set, const Instance& instance,
                                         Joiner& joiner) {
    std::vector<std::uint32_t> vertexOf;
    vertexOf.reserve(set.positions.size());
    if (!set.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), {1, 1, 1, 1});
    for (std::size_t v = 0; v < set.positions.size(); ++v) {
      if (v % 16384 == 0) source_.progress.check();
      const Vec3d p = instance.transform(set.positions[v]);
      if (const char* problem = coordinateProblem(p)) {
        in_.fail(std::string("a vertex, as its node places it, ") + problem);
      }
      const std::array<float, 4> color =
          set.colors.empty() ? std::array<float, 4>{1, 1, 1, 1} : set.colors[v];
      const std::uint32_t next = static_cast<std::uint32_t>(mesh_.positions.size());
      if (set.join) {
        const auto [found, added] = joiner.indexOf.try_emplace({p, color}, next);
        vertexOf.push_back(found->second);
        if (!added) continue;
      } else {
        vertexOf.push_back(next);
      }
      mesh_.positions.push_back(p);
      if (!set.colors.empty()) mesh_.colors.push_back(color);
    }
    if (mesh_.hasColors()) mesh_.colors.resize(mesh_.positions.size(), {1, 1, 1, 1});
    return vertexOf;
  }

  /// Keeps the materials that triangles use, in the order of the file; the standard's default one
  /// comes last, for triangles without any.
  void finishMaterials() {
    std::vector<std::uint32_t> materialOf(materialUsed_.size() + 1, kNone);
    const auto slotOf = [&](std::uint32_t m) { return m == kNone ? materialUsed_.size() : m; };
    std::vector<bool> isUsed(materialUsed_.size() + 1, false);
    for (const std::uint32_t m : mesh_.triangleMaterials) isUsed[slotOf(m)] = true;
    const bool onlyDefault = std::find(isUsed.begin(), isUsed.end() - 1, true) == isUsed.end() - 1;
    if (onlyDefault || isPlaceholder(isUsed)) {
      mesh_.triangleMaterials.clear();
      return;
    }
    for (std::size_t m = 0; m < isUsed.size(); ++m) {
      if (!isUsed[m]) continue;
      materialOf[m] = static_cast<std::uint32_t>(mesh_.materials.size());
      mesh_.materials.push_back(
          m < materialUsed_.size()
              ? readMaterial(m)
              : Material{.baseColor = {1, 1, 1, 1}, .metallic = 1, .roughness = 1});
    }
    for (std::uint32_t& m : mesh_.triangleMaterials) m = materialOf[slotOf(m)];
  }

  /// Whether the only material is the one that `formatGlb` gives a mesh without materials.
  bool isPlaceholder(const std::vector<bool>& isUsed) const {
    if (std::count(isUsed.begin(), isUsed.end(), true) != 1 || isUsed.back()) return false;
    const std::size_t m =
        static_cast<std::size_t>(std::find(isUsed.begin(), isUsed.end(), true) - isUsed.begin());
    const Json& json = in_.element("materials", m, "a primitive");
    const auto extras = json.find("extras");
    return extras != json.end() && extras->is_object() && extras->contains("exemplarPlaceholder");
  }

  Material readMaterial(std::uint64_t index) {
    const std::string place = "materials[" + std::to_string(index) + "]";
    const Json& json = in_.element("materials", index, place);
    Material m{.name = in_.text(json, "name", place),
               .baseColor = {1, 1, 1, 1},
               .metallic = 1,
               .roughness = 1};
    if (const Json* pbr = in_.object(json, "pbrMetallicRoughness", place)) {
      double color[4];
      if (in_.numbers(*pbr, "baseColorFactor", 4, color, place)) {
        for (int c = 0; c < 4; ++c) m.baseColor[c] = bounded(color[c], 1, place);
      }
      m.metallic = bounded(in_.number(*pbr, "metallicFactor", 1, place), 1, place);
      m.roughness = bounded(in_.number(*pbr, "roughnessFactor", 1, place), 1, place);
    }
    const std::string alphaMode = in_.text(json, "alphaMode", place);
    if (alphaMode.empty() || alphaMode == "OPAQUE") m.baseColor[3] = 1;  // so the standard says
    double emission[3];
    if (in_.numbers(json, "emissiveFactor", 3, emission, place)) {
      double strength = 1;
      if (const Json* extensions = in_.object(json, "extensions", place)) {
        if (const Json* e = in_.object(*extensions, "KHR_materials_emissive_strength", place)) {
          strength = in_.number(*e, "emissiveStrength", 1, place);
        }
      }
      for (int c = 0; c < 3; ++c) m.emission[c] = bounded(emission[c] * strength, 1e30, place);
    }
    if (const Json* texture = baseColorTexture(json, place))
      m.baseColorTexture = readTexture(*texture, place);
    return m;
  }

  float bounded(double value, double most, const std::string& place) const {
    if (!(value >= 0 && value <= most))
      in_.fail(place + " has a factor that is negative or too large");
    return static_cast<float>(value);
  }

  /// The texture that a material refers to; none where its picture is missing or no PNG or JPEG.
  std::optional<std::uint32_t> readTexture(const Json& info, const std::string& place) {
    const auto texture = in_.index(info, "index", place + ".baseColorTexture");
    if (!texture) in_.fail(place + ".baseColorTexture.index is missing");
    const std::string at = "textures[" + std::to_string(*texture) + "]";
    const auto image = in_.index(in_.element("textures", *texture, place), "source", at);
    if (!image) return std::nullopt;
    const auto [found, added] = textureOf_.try_emplace(*image);
    if (!added) return found->second;
    std::optional<std::string> bytes = in_.image(*image, at);
    const std::string mimeType = bytes ? imageMimeType(*bytes) : "";
    if (mimeType.empty()) return std::nullopt;
    found->second = static_cast<std::uint32_t>(mesh_.textures.size());
    mesh_.textures.push_back({textureName(*image, mimeType), mimeType, std::move(*bytes)});
    return found->second;
  }

  std::string textureName(std::uint64_t image, const std::string& mimeType) const {
    const Json& json = in_.element("images", image, "a texture");
    const std::string place = "images[" + std::to_string(image) + "]";
    std::string base = in_.text(json, "name", place);
    const std::string uri = in_.text(json, "uri", place);
    if (base.empty() && !uri.starts_with("data:")) base = uri.substr(uri.find_last_of('/') + 1);
    if (base.empty()) base = "texture" + std::to_string(image);
    const std::string ending = mimeType == "image/png" ? ".png" : ".jpg";
    if (!base.ends_with(ending) && !base.ends_with(".jpeg")) base += ending;
    std::string unique = base;
    const auto isTaken = [&] {
      return std::any_of(mesh_.textures.begin(), mesh_.textures.end(),
                         [&](const Texture& t) { return t.name == unique; });
    };
    for (int n = 2; isTaken(); ++n) unique = std::to_string(n) + "_" + base;
    return unique;
  }

  GltfDocument in_;
  const MeshSource& source_;
  TriangleMesh mesh_;
  std::vector<Instance> instances_;
  std::map<std::uint64_t, DecodedMesh> meshes_;
  std::vector<bool> materialUsed_;
  std::vector<TextureUse> textureUses_;
  std::map<std::uint64_t, std::optional<std::uint32_t>> textureOf_;
};

}  // namespace

TriangleMesh parseGltf(std::string_view bytes, const MeshSource& source) {
  return GltfReader(bytes, source).read();
}

}  // namespace exemplar
