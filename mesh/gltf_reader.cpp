// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "core/error.h"
#include "core/memory.h"
#include "core/text_scanner.h"
#include "mesh/gltf_document.h"
#include "mesh/gltf_materials.h"
#include "mesh/gltf_scene.h"
#include "mesh/mesh_formats.h"
#include "mesh/object_names.h"

namespace exemplar {
namespace {

using Json = GltfDocument::Json;

constexpr std::uint32_t kNone = 0xffffffff;

/// Vertices that one or more primitives of a mesh index.
struct VertexSet {
  /// A joint of a skin, and its share in moving a vertex.
  struct Joint {
    std::uint32_t index;
    double weight;
  };
  std::vector<Vec3d> positions;
  std::vector<std::array<float, 4>> colors;  // as many, or none
  std::vector<std::vector<Joint>> joints;    // as many, or none
  /// Whether equal vertices are to be joined: they were split for normals or texture coordinates,
  /// which belong to corners here, or never shared. Without a reason to split they stay apart.
  bool join = false;
  /// Of a file of ours whose mesh has several vertices at one place: how many come before the first
  /// copy (0: any vertex may be a copy), and whose the copies are that equal several.
  std::size_t originals = 0;
  std::unordered_map<std::size_t, std::size_t> copies;
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

/// Gives each different pair of position and color one vertex of a mesh.
class Joiner {
 public:
  struct Key {
    Vec3d position;
    std::array<float, 4> color;
    bool operator==(const Key&) const = default;
  };

  /// Makes room for so many more pairs.
  void reserve(std::size_t more) {
    const std::size_t slots = std::bit_ceil(2 * (keys_.size() + more) + 1);
    if (slots <= slots_.size()) return;
    slots_.assign(slots, kNone);
    for (std::uint32_t i = 0; i < keys_.size(); ++i) slots_[slotOf(keys_[i].first)] = i;
  }

  /// The vertex of a pair, which becomes `next` where it has none yet.
  std::uint32_t add(const Key& key, std::uint32_t next) {
    if (2 * (keys_.size() + 1) > slots_.size()) reserve(keys_.size() + 1);
    std::uint32_t& slot = slots_[slotOf(key)];
    if (slot == kNone) {
      slot = static_cast<std::uint32_t>(keys_.size());
      keys_.push_back({key, next});
    }
    return keys_[slot].second;
  }

 private:
  /// Where a pair is in the table, or the free slot where it would be.
  std::size_t slotOf(const Key& key) const {
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != kNone && !(keys_[slots_[slot]].first == key))
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  static std::uint64_t hash(const Key& k) {
    std::uint64_t h = 0;
    const auto mix = [&](std::uint64_t bits) {
      h = (h ^ bits) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    };
    for (const double c : {k.position.x, k.position.y, k.position.z}) {
      mix(std::bit_cast<std::uint64_t>(c + 0.0));
    }
    for (const float c : k.color) mix(std::bit_cast<std::uint32_t>(c + 0.0f));
    return h ^ (h >> 32);
  }

  std::vector<std::pair<Key, std::uint32_t>> keys_;
  std::vector<std::uint32_t> slots_;  ///< indices of keys_, open addressing
};

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const MeshSource& source)
      : in_(bytes, source), source_(source), materials_(in_, source, mesh_), scene_(in_, source) {}

  TriangleMesh read() {
    decodeMeshes();
    const std::vector<GltfInstance>& instances = scene_.instances();
    for (std::size_t i = 0; i < instances.size(); ++i) {
      source_.progress.report("placing meshes", 0.5 + 0.5 * static_cast<double>(i) /
                                                          static_cast<double>(instances.size()));
      add(instances[i], *decoded_[i]);
    }
    materials_.finish();
    nameMesh();
    objects_.moveTo(mesh_);
    warnOfAttributes();
    return std::move(mesh_);
  }

 private:
  void decodeMeshes() {
    double bytes = 0, vertices = 0;
    for (const GltfInstance& instance : scene_.instances()) {
      // Meshes that are bent differently are decoded apart.
      const auto [found, added] =
          meshes_.try_emplace({instance.mesh, instance.skin.has_value(), instance.weights});
      if (added) found->second = decodeMesh(instance);
      decoded_.push_back(&found->second);
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

  DecodedMesh decodeMesh(const GltfInstance& instance) {
    const std::uint64_t index = instance.mesh;
    source_.progress.report("decoding meshes", 0.5 * static_cast<double>(meshes_.size()) /
                                                   static_cast<double>(in_.count("meshes") + 1));
    DecodedMesh mesh;
    const std::string place = "meshes[" + std::to_string(index) + "]";
    const Json* primitives = in_.array(in_.element("meshes", index, place), "primitives", place);
    if (!primitives) in_.fail(place + ".primitives is missing");
    std::map<std::vector<std::uint64_t>, std::size_t> setOf;
    std::map<std::uint64_t, std::vector<double>> uvsOf;
    for (std::size_t i = 0; i < primitives->size(); ++i) {
      const std::string at = place + ".primitives[" + std::to_string(i) + "]";
      const Json& json = (*primitives)[i];
      if (!json.is_object()) in_.fail(at + " should be an object");
      const std::uint64_t mode = in_.index(json, "mode", at).value_or(4);
      if (mode > 6) in_.fail(at + ".mode should be 0 to 6");
      if (mode < 4) {
        source_.warn("points and lines are left out");
        continue;
      }
      const Json* attributes = in_.object(json, "attributes", at);
      if (!attributes) in_.fail(at + ".attributes is missing");
      const auto position = in_.index(*attributes, "POSITION", at + ".attributes");
      if (!position) in_.fail(at + " has no POSITION");
      const auto color = in_.index(*attributes, "COLOR_0", at + ".attributes");
      if (in_.extension(json, "KHR_draco_mesh_compression", at) &&
          !in_.element("accessors", *position, at).contains("bufferView")) {
        in_.fail(at +
                 " is compressed (KHR_draco_mesh_compression), which is not supported; save "
                 "it without");
      }
      std::vector<std::uint64_t> sources{*position, color.value_or(~std::uint64_t{0})};
      const std::vector<WeightedTarget> targets = morphTargets(json, instance.weights, at);
      for (const WeightedTarget& target : targets) sources.push_back(target.accessor);
      std::vector<std::array<std::uint64_t, 2>> joints;
      if (instance.skin) joints = jointAccessors(*attributes, at);
      for (const auto& [joint, weight] : joints) sources.insert(sources.end(), {joint, weight});
      const auto [set, added] = setOf.try_emplace(sources, mesh.sets.size());
      if (added) {
        mesh.sets.push_back(decodeSet(*position, color, at));
        morph(mesh.sets.back(), targets);
        for (const auto& [joint, weight] : joints)
          decodeJoints(mesh.sets.back(), joint, weight, at);
      }
      VertexSet& vertices = mesh.sets[set->second];
      const bool hasIndices = json.contains("indices");
      vertices.join = vertices.join || !hasIndices || attributes->size() > (color ? 2u : 1u);

      Primitive primitive;
      primitive.set = set->second;
      const std::vector<std::uint32_t> corners = decodeIndices(json, vertices.positions.size(), at);
      primitive.triangles = trianglesOf(corners, mode, at);
      if (const auto material = in_.index(json, "material", at)) {
        materials_.use(*material, at);
        primitive.material = static_cast<std::uint32_t>(*material);
      }
      decodeUvs(primitive, *attributes, vertices.positions.size(), uvsOf, at);
      mesh.primitives.push_back(std::move(primitive));
    }
    if (mesh.sets.size() == 1) readCopies(in_.element("meshes", index, place), mesh.sets[0]);
    return mesh;
  }

  /// Reads what `formatGlb` says of vertices that are no copies; nothing where it does not hold, as
  /// after another program has changed the vertices.
  static void readCopies(const Json& mesh, VertexSet& set) {
    const auto extras = mesh.find("extras");
    if (extras == mesh.end() || !extras->is_object()) return;
    const auto count = extras->find("exemplarVertices"), copies = extras->find("exemplarCopies");
    if (count == extras->end() || !count->is_number_unsigned()) return;
    const std::uint64_t originals = count->get<std::uint64_t>();
    if (originals > set.positions.size()) return;
    std::unordered_map<std::size_t, std::size_t> copyOf;
    if (copies != extras->end()) {
      if (!copies->is_array() || copies->size() % 2 != 0) return;
      for (std::size_t i = 0; i < copies->size(); i += 2) {
        const Json &copy = (*copies)[i], &original = (*copies)[i + 1];
        if (!copy.is_number_unsigned() || !original.is_number_unsigned()) return;
        const auto c = copy.get<std::uint64_t>(), o = original.get<std::uint64_t>();
        if (c < originals || c >= set.positions.size() || o >= originals) return;
        if (set.positions[c] != set.positions[o]) return;
        copyOf[c] = o;
      }
    }
    set.originals = originals;
    set.copies = std::move(copyOf);
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
      if (std::ranges::any_of(set.colors.back(), [](float s) { return std::isnan(s); })) {
        set.colors.back().fill(1);
        source_.warn(kNanColors);
      }
      for (const float sample : set.colors.back()) {
        if (!(std::abs(sample) < 1e6f)) in_.fail(colors.place + " has a color that is not in 0..1");
      }
    }
    return set;
  }

  /// A morph target's positions, and how much of them is added.
  struct WeightedTarget {
    std::uint64_t accessor;
    double weight;
  };

  /// The targets of a primitive that its weights move.
  std::vector<WeightedTarget> morphTargets(const Json& primitive,
                                           const std::vector<double>& weights,
                                           const std::string& at) const {
    std::vector<WeightedTarget> result;
    const Json* targets = in_.array(primitive, "targets", at);
    if (!targets) return result;
    for (std::size_t i = 0; i < std::min(targets->size(), weights.size()); ++i) {
      const std::string place = at + ".targets[" + std::to_string(i) + "]";
      if (!(*targets)[i].is_object()) in_.fail(place + " should be an object");
      const auto position = in_.index((*targets)[i], "POSITION", place);
      if (position && weights[i] != 0) result.push_back({*position, weights[i]});
    }
    return result;
  }

  void morph(VertexSet& set, const std::vector<WeightedTarget>& targets) {
    for (const WeightedTarget& target : targets) {
      const GltfAccessor moves = in_.accessor(target.accessor, "a morph target");
      if (moves.components != 3 || moves.count != set.positions.size()) {
        in_.fail(moves.place + " should be " + std::to_string(set.positions.size()) +
                 " of VEC3: it is used as a morph target");
      }
      const std::vector<double> m = in_.readNumbers(moves);
      for (std::size_t v = 0; v < set.positions.size(); ++v) {
        set.positions[v] += Vec3d{m[3 * v], m[3 * v + 1], m[3 * v + 2]} * target.weight;
        if (const char* problem = coordinateProblem(set.positions[v])) {
          in_.fail(moves.place + ": vertex " + std::to_string(v) + ", as it is morphed, " +
                   problem);
        }
      }
    }
  }

  /// The accessors of a primitive's JOINTS_n and WEIGHTS_n.
  std::vector<std::array<std::uint64_t, 2>> jointAccessors(const Json& attributes,
                                                           const std::string& at) const {
    std::vector<std::array<std::uint64_t, 2>> result;
    for (int n = 0;; ++n) {
      const std::string suffix = "_" + std::to_string(n);
      const auto joints = in_.index(attributes, ("JOINTS" + suffix).c_str(), at);
      const auto weights = in_.index(attributes, ("WEIGHTS" + suffix).c_str(), at);
      if (!joints || !weights) return result;
      result.push_back({*joints, *weights});
    }
  }

  /// Adds up to four joints to each vertex.
  void decodeJoints(VertexSet& set, std::uint64_t jointAccessor, std::uint64_t weightAccessor,
                    const std::string& at) {
    GltfAccessor joints = in_.accessor(jointAccessor, at);
    GltfAccessor weights = in_.accessor(weightAccessor, at);
    joints.normalized = false;
    weights.normalized = true;
    for (const GltfAccessor* a : {&joints, &weights}) {
      if (a->components != 4 || a->count != set.positions.size()) {
        in_.fail(a->place + " should be " + std::to_string(set.positions.size()) +
                 " of VEC4: it is used for a skin");
      }
    }
    const std::vector<double> j = in_.readNumbers(joints), w = in_.readNumbers(weights);
    set.joints.resize(set.positions.size());
    for (std::size_t i = 0; i < j.size(); ++i) {
      if (!(w[i] > 0) || !std::isfinite(w[i])) continue;
      if (!(j[i] >= 0 && j[i] < kNone)) in_.fail(joints.place + " has an index that is none");
      set.joints[i / 4].push_back({static_cast<std::uint32_t>(j[i]), w[i]});
    }
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
    const std::uint64_t set =
        primitive.material == kNone ? 0 : materials_.texCoord(primitive.material);
    const std::string key = "TEXCOORD_" + std::to_string(set);
    noteUnread(attributes, key);
    const auto index = in_.index(attributes, key.c_str(), at + ".attributes");
    if (!index) return;
    const auto [found, added] = uvsOf.try_emplace(*index);
    if (added) {
      const GltfAccessor accessor = in_.accessor(*index, at);
      if (accessor.components != 2)
        in_.fail(accessor.place + " should be VEC2: it is used as " + key);
      found->second = in_.readNumbers(accessor);
      for (double& c : found->second) {
        if (std::abs(c) < 1e15) continue;
        source_.warn("texture coordinates that are NaN or too large are taken as 0");
        c = 0;
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
        // v runs down in the file.
        corners[c] = {static_cast<float>(uvs[2 * triangle[c]]),
                      static_cast<float>(1 - uvs[2 * triangle[c] + 1])};
      }
    }
  }

  /// Remembers the attributes of a primitive that nothing here has a place for.
  void noteUnread(const Json& attributes, const std::string& texCoord) {
    for (const auto& item : attributes.items()) {
      const std::string& key = item.key();
      const bool derived = key == "POSITION" || key == "NORMAL" || key == "TANGENT" ||
                           key == "COLOR_0" || key == texCoord || key.starts_with("JOINTS_") ||
                           key.starts_with("WEIGHTS_");
      if (!derived) unread_.insert(TextScanner::shown(key));
    }
  }

  void warnOfAttributes() const {
    if (unread_.empty()) return;
    std::string names;
    for (const std::string& name : unread_) names += (names.empty() ? "" : ", ") + name;
    source_.warn("attributes of vertices that are not read: " + names);
  }

  std::string dataName(const GltfInstance& instance) {
    const std::string place = "meshes[" + std::to_string(instance.mesh) + "]";
    return in_.text(in_.element("meshes", instance.mesh, place), "name", place);
  }

  /// The names of the only object.
  void nameMesh() {
    if (scene_.instances().size() != 1) return;
    const GltfInstance& only = scene_.instances().front();
    mesh_.name = only.name;
    mesh_.dataName = dataName(only);
    if (mesh_.name.empty()) mesh_.name = mesh_.dataName;
    if (mesh_.name == mesh_.dataName) mesh_.dataName.clear();
  }

  void add(const GltfInstance& instance, const DecodedMesh& source) {
    std::vector<GltfTransform> joints;
    if (instance.skin) joints = scene_.jointTransforms(*instance.skin);
    const bool mirrors = joints.empty() ? instance.transform.mirrors() : joints.front().mirrors();
    const std::uint32_t object =
        objects_.numberOf(instance.name.empty() ? dataName(instance) : instance.name);
    Joiner joiner;
    std::vector<std::vector<std::uint32_t>> vertexOf;
    for (const VertexSet& set : source.sets)
      vertexOf.push_back(addVertices(set, instance.transform, joints, joiner));
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
        mesh_.triangleObjects.push_back(object);
        if (p.uvs.empty()) continue;
        const auto& uv = p.uvs[t];
        mesh_.uvs.push_back(mirrors ? std::array{uv[0], uv[2], uv[1]} : uv);
      }
    }
    if (mesh_.hasUvs()) mesh_.uvs.resize(mesh_.triangles.size());
  }

  /// Adds a set's vertices, turned and moved; returns the index in the result of each.
  std::vector<std::uint32_t> addVertices(const VertexSet& set, const GltfTransform& transform,
                                         const std::vector<GltfTransform>& joints, Joiner& joiner) {
    std::vector<std::uint32_t> vertexOf;
    vertexOf.reserve(set.positions.size());
    if (set.join) joiner.reserve(set.positions.size());
    if (!set.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), {1, 1, 1, 1});
    for (std::size_t v = 0; v < set.positions.size(); ++v) {
      if (v % 16384 == 0) source_.progress.check();
      const Vec3d p = set.joints.empty() ? transform(set.positions[v]) : skinned(set, v, joints);
      if (const char* problem = coordinateProblem(p)) {
        in_.fail(std::string("a vertex, as its node places it, ") + problem);
      }
      const std::array<float, 4> color =
          set.colors.empty() ? std::array<float, 4>{1, 1, 1, 1} : set.colors[v];
      const std::uint32_t next = static_cast<std::uint32_t>(mesh_.positions.size());
      if (const auto copy = set.copies.find(v); copy != set.copies.end()) {
        vertexOf.push_back(vertexOf[copy->second]);
        continue;
      }
      if (v < set.originals) {
        joiner.add({p, color}, next);
        vertexOf.push_back(next);
      } else if (set.join) {
        vertexOf.push_back(joiner.add({p, color}, next));
        if (vertexOf.back() != next) continue;
      } else {
        vertexOf.push_back(next);
      }
      mesh_.positions.push_back(p);
      if (!set.colors.empty()) mesh_.colors.push_back(color);
    }
    if (mesh_.hasColors()) mesh_.colors.resize(mesh_.positions.size(), {1, 1, 1, 1});
    return vertexOf;
  }

  /// Where a skin puts a vertex; its node's own transform has no effect (glTF 2.0, 3.7.3.2).
  Vec3d skinned(const VertexSet& set, std::size_t v,
                const std::vector<GltfTransform>& joints) const {
    Vec3d sum{};
    double weights = 0;
    for (const VertexSet::Joint& joint : set.joints[v]) {
      if (joint.index >= joints.size()) {
        in_.fail("a vertex names joint " + std::to_string(joint.index) + " of " +
                 std::to_string(joints.size()));
      }
      sum += joints[joint.index](set.positions[v]) * joint.weight;
      weights += joint.weight;
    }
    return weights > 0 ? sum / weights : joints.front()(set.positions[v]);
  }

  GltfDocument in_;
  const MeshSource& source_;
  TriangleMesh mesh_;
  GltfMaterials materials_;
  GltfScene scene_;
  std::vector<const DecodedMesh*> decoded_;  // of each instance
  std::set<std::string> unread_;
  ObjectNames objects_;
  /// By mesh, whether a skin moves it, and its weights.
  std::map<std::tuple<std::uint64_t, bool, std::vector<double>>, DecodedMesh> meshes_;
};

}  // namespace

TriangleMesh parseGltf(std::string_view bytes, const MeshSource& source) {
  return GltfReader(bytes, source).read();
}

}  // namespace exemplar
