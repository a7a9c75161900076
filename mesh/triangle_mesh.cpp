// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <limits>
#include <set>
#include <unordered_map>

#include "core/error.h"

namespace exemplar {
namespace {

/// Where the sum of three squares and a cross product of differences still stay far from overflow.
constexpr double kLargestCoordinate = 1e15;
constexpr std::uint32_t kUnknown = std::numeric_limits<std::uint32_t>::max();

bool allFinite(const std::array<float, 4>& c) {
  return std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]) && std::isfinite(c[3]);
}

void checkCount(std::size_t count, std::size_t wanted, const char* what, const char* ofWhat,
                const std::string& name) {
  if (count != 0 && count != wanted) {
    throw InputError(name + ": the mesh has " + std::to_string(count) + " " + what + " for " +
                     std::to_string(wanted) + " " + ofWhat);
  }
}

/// The index in `textures` of one with the same content as `texture`; added where there is none.
std::uint32_t addTexture(std::vector<Texture>& textures, const Texture& texture) {
  for (std::size_t i = 0; i < textures.size(); ++i) {
    if (textures[i].mimeType == texture.mimeType && textures[i].bytes == texture.bytes) {
      return static_cast<std::uint32_t>(i);
    }
  }
  std::set<std::string> names;
  for (const Texture& t : textures) names.insert(t.name);
  Texture added = texture;
  for (int n = 2; names.count(added.name) != 0; ++n) {
    const std::size_t dot = std::min(texture.name.rfind('.'), texture.name.size());
    added.name = texture.name.substr(0, dot) + "_" + std::to_string(n) + texture.name.substr(dot);
  }
  textures.push_back(std::move(added));
  return static_cast<std::uint32_t>(textures.size() - 1);
}

/// Adds materials to a mesh, equal ones once.
class MaterialMerger {
 public:
  explicit MaterialMerger(std::vector<Material>& materials) : materials_(materials) {
    for (std::uint32_t m = 0; m < materials.size(); ++m) byName_.emplace(keyOf(materials[m]), m);
  }

  std::uint32_t add(const Material& material) {
    const auto [begin, end] = byName_.equal_range(keyOf(material));
    std::uint32_t first = kUnknown;
    for (auto it = begin; it != end; ++it)
      if (materials_[it->second] == material) first = std::min(first, it->second);
    if (first != kUnknown) return first;
    const auto added = static_cast<std::uint32_t>(materials_.size());
    materials_.push_back(material);
    byName_.emplace(keyOf(material), added);
    return added;
  }

 private:
  static std::size_t keyOf(const Material& m) {
    std::size_t key = std::hash<std::string>{}(m.name);
    for (const float c : m.baseColor) key = key * 31 + std::hash<float>{}(c);
    return key;
  }

  std::vector<Material>& materials_;
  std::unordered_multimap<std::size_t, std::uint32_t> byName_;
};

/// Appends `from`, which covers `fromCount` elements, to `to`, which covers `toCount`;
/// where only one of the two is there, the other's elements become `missing`.
template <class T>
void appendAttribute(std::vector<T>& to, std::size_t toCount, const std::vector<T>& from,
                     std::size_t fromCount, const T& missing) {
  if (to.empty() && from.empty()) return;
  to.resize(toCount, missing);
  to.insert(to.end(), from.begin(), from.end());
  to.resize(toCount + fromCount, missing);
}

/// Adds which objects the triangles of `other` belong to; `triangles` are in the mesh before them.
void appendObjects(TriangleMesh& mesh, std::size_t triangles, const TriangleMesh& other) {
  if (mesh.objects.empty() && other.objects.empty()) return;
  const auto numberOf = [&](const std::string& name) {
    const auto found = std::ranges::find(mesh.objects, name);
    const auto number = static_cast<std::uint32_t>(found - mesh.objects.begin());
    if (found == mesh.objects.end()) mesh.objects.push_back(name);
    return number;
  };
  if (mesh.triangleObjects.empty() && triangles > 0)
    mesh.triangleObjects.assign(triangles, numberOf(mesh.name));
  if (other.triangleObjects.empty()) {
    mesh.triangleObjects.insert(mesh.triangleObjects.end(), other.triangles.size(),
                                numberOf(other.name));
    return;
  }
  std::vector<std::uint32_t> objectOf;
  for (const std::string& name : other.objects) objectOf.push_back(numberOf(name));
  for (const std::uint32_t object : other.triangleObjects)
    mesh.triangleObjects.push_back(objectOf[object]);
}

}  // namespace

void validate(const TriangleMesh& mesh, const std::string& name) {
  const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
  if (triangles == 0) throw InputError(name + ": the mesh has no triangles");
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3d& p = mesh.positions[v];
    if (!isFinite(p)) {
      throw InputError(name + ": vertex " + std::to_string(v) +
                       " has a NaN or infinite coordinate");
    }
    if (!(std::abs(p.x) < kLargestCoordinate && std::abs(p.y) < kLargestCoordinate &&
          std::abs(p.z) < kLargestCoordinate)) {
      throw InputError(name + ": vertex " + std::to_string(v) +
                       " has a coordinate of 1e15 or more; scale the mesh down");
    }
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= vertices) {
        throw InputError(name + ": triangle " + std::to_string(t) + " names vertex " +
                         std::to_string(v) + " of " + std::to_string(vertices));
      }
    }
  }
  checkCount(mesh.colors.size(), vertices, "colors", "vertices", name);
  checkCount(mesh.uvs.size(), triangles, "texture coordinates", "triangles", name);
  checkCount(mesh.triangleMaterials.size(), triangles, "material indices", "triangles", name);
  checkCount(mesh.triangleObjects.size(), triangles, "object indices", "triangles", name);
  checkCount(mesh.sources.size(), triangles, "sources", "triangles", name);
  for (const auto& color : mesh.colors) {
    if (!allFinite(color)) throw InputError(name + ": a vertex color is NaN or infinite");
  }
  for (const auto& corners : mesh.uvs) {
    for (const Vec2f& uv : corners) {
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
        throw InputError(name + ": a texture coordinate is NaN or infinite");
      }
    }
  }
  for (std::size_t t = 0; t < mesh.triangleMaterials.size(); ++t) {
    if (mesh.triangleMaterials[t] >= mesh.materials.size()) {
      throw InputError(name + ": triangle " + std::to_string(t) + " names material " +
                       std::to_string(mesh.triangleMaterials[t]) + " of " +
                       std::to_string(mesh.materials.size()));
    }
  }
  for (std::size_t t = 0; t < mesh.triangleObjects.size(); ++t) {
    if (mesh.triangleObjects[t] >= mesh.objects.size()) {
      throw InputError(name + ": triangle " + std::to_string(t) + " names object " +
                       std::to_string(mesh.triangleObjects[t]) + " of " +
                       std::to_string(mesh.objects.size()));
    }
  }
  for (const Material& m : mesh.materials) {
    if (!allFinite(m.baseColor) || !std::isfinite(m.metallic) || !std::isfinite(m.roughness) ||
        !isFinite(m.emission)) {
      throw InputError(name + ": material '" + m.name + "' has a NaN or infinite number");
    }
    if (m.baseColorTexture && *m.baseColorTexture >= mesh.textures.size()) {
      throw InputError(name + ": material '" + m.name + "' names texture " +
                       std::to_string(*m.baseColorTexture) + " of " +
                       std::to_string(mesh.textures.size()));
    }
    for (const std::uint32_t picture : m.pictures) {
      if (picture >= mesh.textures.size()) {
        throw InputError(name + ": material '" + m.name + "' names picture " +
                         std::to_string(picture) + " of " + std::to_string(mesh.textures.size()));
      }
    }
  }
}

Box3d boundingBox(const TriangleMesh& mesh) {
  Box3d box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) box.add(mesh.positions[v]);
  }
  return box;
}

Vec3d areaNormal(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3d& origin = mesh.positions[a];
  return cross(mesh.positions[b] - origin, mesh.positions[c] - origin);
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  if (&mesh == &other) {
    append(mesh, TriangleMesh(other));
    return;
  }
  const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
  if (vertices + other.positions.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("the joined mesh would have more than 4294967295 vertices; use less of it");
  }
  if (triangles == 0) {
    mesh.name = other.name;
    mesh.dataName = other.dataName;
  }
  std::vector<std::uint32_t> materialOf, textureOf(other.textures.size(), kUnknown);
  const auto addOnce = [&](std::uint32_t t) {
    if (textureOf[t] == kUnknown) textureOf[t] = addTexture(mesh.textures, other.textures[t]);
    return textureOf[t];
  };
  MaterialMerger materials(mesh.materials);
  for (Material material : other.materials) {
    if (material.baseColorTexture) material.baseColorTexture = addOnce(*material.baseColorTexture);
    for (std::uint32_t& picture : material.pictures) picture = addOnce(picture);
    materialOf.push_back(materials.add(material));
  }
  for (std::uint32_t t = 0; t < other.textures.size(); ++t) addOnce(t);

  std::vector<std::uint32_t> otherMaterials(other.triangleMaterials);
  for (std::uint32_t& m : otherMaterials) m = materialOf[m];
  const bool fillMaterials =
      (mesh.hasMaterials() && !other.hasMaterials() && !other.triangles.empty()) ||
      (!mesh.hasMaterials() && other.hasMaterials() && triangles != 0);
  const std::uint32_t defaultMaterial = fillMaterials ? materials.add(Material{}) : 0;
  appendAttribute(mesh.triangleMaterials, triangles, otherMaterials, other.triangles.size(),
                  defaultMaterial);
  appendAttribute(mesh.colors, vertices, other.colors, other.positions.size(), {1, 1, 1, 1});
  appendAttribute(mesh.uvs, triangles, other.uvs, other.triangles.size(), {});
  appendObjects(mesh, triangles, other);
  // A corner that came from nowhere cannot be said.
  if (triangles != 0 && !other.triangles.empty() && mesh.sources.empty() != other.sources.empty()) {
    mesh.sources.clear();
  } else {
    mesh.sources.insert(mesh.sources.end(), other.sources.begin(), other.sources.end());
  }

  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.triangles.reserve(triangles + other.triangles.size());
  const std::uint32_t shift = static_cast<std::uint32_t>(vertices);
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + shift, b + shift, c + shift});
  }
}

}  // namespace exemplar
