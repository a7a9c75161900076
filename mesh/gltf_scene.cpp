// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gltf_scene.h"

#include <cmath>
#include <utility>

#include "core/text_scanner.h"

namespace exemplar {

GltfScene::GltfScene(GltfDocument& document, const MeshSource& source)
    : in_(document), source_(source) {
  findInstances();
}

GltfTransform GltfScene::transformOf(const Json& node, const std::string& place) const {
  double m[16];
  if (in_.numbers(node, "matrix", 16, m, place)) {
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  }
  double move[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
  in_.numbers(node, "translation", 3, move, place);
  in_.numbers(node, "rotation", 4, q, place);
  in_.numbers(node, "scale", 3, scale, place);
  return fromParts(move, q, scale, place);
}

GltfTransform GltfScene::fromParts(const double* move, const double* q, const double* scale,
                                   const std::string& place) const {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0) || !std::isfinite(length)) in_.fail(place + ".rotation should have length 1");
  const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
  GltfTransform t;
  t.x = Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)} * scale[0];
  t.y = Vec3d{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)} * scale[1];
  t.z = Vec3d{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)} * scale[2];
  t.move = {move[0], move[1], move[2]};
  return t;
}

std::vector<std::uint64_t> GltfScene::rootNodes() const {
  std::vector<std::uint64_t> roots;
  if (in_.count("scenes") > 0) {
    const std::uint64_t scene = in_.index(in_.root(), "scene", "the file").value_or(0);
    if (in_.count("scenes") > 1) {
      source_.warn("of its " + std::to_string(in_.count("scenes")) + " scenes only scenes[" +
                   std::to_string(scene) + "] is read");
    }
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

void GltfScene::appendNodes(const Json& object, const char* key, const std::string& place,
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
void GltfScene::findInstances() {
  struct Step {
    std::uint64_t node;
    GltfTransform parent;
    bool visible;
  };
  std::vector<Step> stack;
  const auto push = [&](std::vector<std::uint64_t> nodes, const GltfTransform& parent,
                        bool visible) {
    // The stack gives back the last one first; the order of the file is what we want.
    for (std::size_t i = nodes.size(); i-- > 0;) stack.push_back({nodes[i], parent, visible});
  };
  placed_.resize(in_.count("nodes"));
  push(rootNodes(), {}, true);
  while (!stack.empty()) {
    const Step step = stack.back();
    stack.pop_back();
    const std::string place = "nodes[" + std::to_string(step.node) + "]";
    if (placed_[step.node]) in_.fail(place + " is reached twice: nodes should form a tree");
    const Json& node = in_.element("nodes", step.node, "the scene");
    const GltfTransform transform = step.parent * transformOf(node, place);
    placed_[step.node] = transform;
    const bool visible = step.visible && isVisible(node, place);
    if (visible) addInstances(node, transform, place);
    std::vector<std::uint64_t> children;
    appendNodes(node, "children", place, children);
    push(std::move(children), transform, visible);
  }
}

/// KHR_node_visibility hides a node with all below it.
bool GltfScene::isVisible(const Json& node, const std::string& place) const {
  const Json* visibility = in_.extension(node, "KHR_node_visibility", place);
  if (!visibility) return true;
  const auto visible = visibility->find("visible");
  return visible == visibility->end() || !visible->is_boolean() || visible->get<bool>();
}

void GltfScene::addInstances(const Json& node, const GltfTransform& transform,
                             const std::string& place) {
  const auto mesh = in_.index(node, "mesh", place);
  if (!mesh) return;
  const Json& json = in_.element("meshes", *mesh, place);
  GltfInstance instance{.mesh = *mesh, .transform = transform};
  instance.name = in_.text(node, "name", place);
  instance.skin = in_.index(node, "skin", place);
  // The weights of a node come before those of its mesh.
  instance.weights = weightsOf(node, place);
  if (instance.weights.empty()) {
    instance.weights = weightsOf(json, "meshes[" + std::to_string(*mesh) + "]");
  }
  const Json* instancing = in_.extension(node, "EXT_mesh_gpu_instancing", place);
  if (!instancing) {
    instances_.push_back(std::move(instance));
    return;
  }
  for (const GltfTransform& copy : instanceTransforms(*instancing, place)) {
    instance.transform = transform * copy;
    instances_.push_back(instance);
  }
}

std::vector<double> GltfScene::weightsOf(const Json& object, const std::string& place) const {
  const Json* array = in_.array(object, "weights", place);
  if (!array) return {};
  std::vector<double> weights(array->size());
  in_.numbers(object, "weights", weights.size(), weights.data(), place);
  return weights;
}

std::vector<GltfTransform> GltfScene::instanceTransforms(const Json& instancing,
                                                         const std::string& node) {
  const std::string place = node + ".EXT_mesh_gpu_instancing";
  const Json* attributes = in_.object(instancing, "attributes", place);
  if (!attributes) in_.fail(place + ".attributes is missing");
  std::optional<std::uint64_t> count;
  const auto read = [&](const char* key, int components) {
    std::vector<double> numbers;
    const auto index = in_.index(*attributes, key, place);
    if (!index) return numbers;
    GltfAccessor accessor = in_.accessor(*index, place);
    accessor.normalized = true;  // integers are allowed for rotations only, as shares of 1
    if (accessor.components != components || (count && *count != accessor.count))
      in_.fail(accessor.place + " does not fit its use as " + key + " of instances");
    count = accessor.count;
    numbers = in_.readNumbers(accessor);
    for (const double n : numbers) {
      if (!std::isfinite(n)) in_.fail(accessor.place + " has a NaN or infinite number");
    }
    return numbers;
  };
  const std::vector<double> moves = read("TRANSLATION", 3), rotations = read("ROTATION", 4),
                            scales = read("SCALE", 3);
  for (const auto& item : attributes->items()) {
    const std::string& key = item.key();
    if (key != "TRANSLATION" && key != "ROTATION" && key != "SCALE")
      source_.warn("attributes of instances that are not read: " + TextScanner::shown(key));
  }
  std::vector<GltfTransform> transforms;
  constexpr double kNoMove[] = {0, 0, 0}, kNoTurn[] = {0, 0, 0, 1}, kNoScale[] = {1, 1, 1};
  for (std::uint64_t i = 0; i < count.value_or(1); ++i) {
    transforms.push_back(fromParts(moves.empty() ? kNoMove : &moves[3 * i],
                                   rotations.empty() ? kNoTurn : &rotations[4 * i],
                                   scales.empty() ? kNoScale : &scales[3 * i], place));
  }
  return transforms;
}

GltfTransform GltfScene::placeOf(std::uint64_t node) {
  if (parents_.empty()) {
    parents_.resize(in_.count("nodes"));
    for (std::uint64_t n = 0; n < parents_.size(); ++n) {
      std::vector<std::uint64_t> children;
      const std::string place = "nodes[" + std::to_string(n) + "]";
      appendNodes(in_.element("nodes", n, place), "children", place, children);
      for (const std::uint64_t child : children) parents_[child] = n;
    }
  }
  GltfTransform transform;
  std::optional<std::uint64_t> at = node;
  for (std::size_t steps = 0; at && !placed_[*at]; at = parents_[*at]) {
    const std::string place = "nodes[" + std::to_string(*at) + "]";
    if (++steps > parents_.size()) in_.fail(place + " is its own parent");
    transform = transformOf(in_.element("nodes", *at, place), place) * transform;
  }
  return at ? *placed_[*at] * transform : transform;
}

std::vector<GltfTransform> GltfScene::jointTransforms(std::uint64_t skin) {
  const std::string place = "skins[" + std::to_string(skin) + "]";
  const Json& json = in_.element("skins", skin, "a node");
  std::vector<std::uint64_t> joints;
  appendNodes(json, "joints", place, joints);
  if (joints.empty()) in_.fail(place + " has no joints");
  std::vector<double> inverse;
  if (const auto index = in_.index(json, "inverseBindMatrices", place)) {
    const GltfAccessor accessor = in_.accessor(*index, place);
    if (accessor.components != 16 || accessor.count < joints.size())
      in_.fail(accessor.place + " should be a MAT4 for each joint");
    inverse = in_.readNumbers(accessor);
  }
  std::vector<GltfTransform> transforms;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    transforms.push_back(placeOf(joints[i]));
    if (inverse.empty()) continue;
    const double* m = &inverse[16 * i];
    transforms.back() = transforms.back() * GltfTransform{{m[0], m[1], m[2]},
                                                          {m[4], m[5], m[6]},
                                                          {m[8], m[9], m[10]},
                                                          {m[12], m[13], m[14]}};
  }
  return transforms;
}

}  // namespace exemplar
