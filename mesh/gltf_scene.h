// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/gltf_document.h"

namespace exemplar {

/// An affine map: three columns and a translation.
struct GltfTransform {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, move{};

  Vec3d turned(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d operator()(const Vec3d& p) const { return turned(p) + move; }
  /// First `other`, then this.
  GltfTransform operator*(const GltfTransform& other) const {
    return {turned(other.x), turned(other.y), turned(other.z), (*this)(other.move)};
  }
  bool mirrors() const { return dot(cross(x, y), z) < 0; }
};

/// A mesh where the scene shows it.
struct GltfInstance {
  std::uint64_t mesh = 0;
  GltfTransform transform;
  std::optional<std::uint64_t> skin;
  std::vector<double> weights;  ///< of morph targets
  std::string name;             ///< of its node
};

/// What a glTF document shows, and where: its default scene's tree of nodes, with instances
/// (EXT_mesh_gpu_instancing) and without what is hidden (KHR_node_visibility).
class GltfScene {
 public:
  using Json = GltfDocument::Json;

  /// Walks the tree. All must outlive this. Throws `InputError` for what is malformed.
  GltfScene(GltfDocument& document, const MeshSource& source);

  const std::vector<GltfInstance>& instances() const { return instances_; }
  /// What a skin's joints do to vertices: where a joint is now, after undoing where it was when the
  /// skin was bound to it.
  std::vector<GltfTransform> jointTransforms(std::uint64_t skin);

 private:
  GltfTransform transformOf(const Json& node, const std::string& place) const;
  /// A scale, then a rotation by a quaternion (x, y, z, w), then a move.
  GltfTransform fromParts(const double* move, const double* q, const double* scale,
                          const std::string& place) const;
  /// The nodes where the scene begins: the default scene's, the first one's, or, where there is no
  /// scene, all nodes that are no other node's child.
  std::vector<std::uint64_t> rootNodes() const;
  void appendNodes(const Json& object, const char* key, const std::string& place,
                   std::vector<std::uint64_t>& to) const;
  void findInstances();
  bool isVisible(const Json& node, const std::string& place) const;
  void addInstances(const Json& node, const GltfTransform& transform, const std::string& place);
  std::vector<double> weightsOf(const Json& object, const std::string& place) const;
  /// The places that EXT_mesh_gpu_instancing gives a node's mesh.
  std::vector<GltfTransform> instanceTransforms(const Json& instancing, const std::string& node);
  /// A node's transform in world space, whether or not the scene shows it.
  GltfTransform placeOf(std::uint64_t node);

  GltfDocument& in_;
  const MeshSource& source_;
  std::vector<GltfInstance> instances_;
  std::vector<std::optional<GltfTransform>> placed_;   // the nodes of the scene in world space
  std::vector<std::optional<std::uint64_t>> parents_;  // of all nodes; empty until asked for
};

}  // namespace exemplar
