// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "synth/continuous/solids.h"

/// Solids as text: convex parts with whole coordinates, exact.
namespace exemplar::continuous {

/// A mesh for which a box stands (thesis, section 4.6.4): it is too complex to be synthesized, and
/// its box is cut in two, of different substances, so that results have boxes of its proportions
/// only, in which it is put back, scaled.
struct StandIn {
  std::string name;
  std::string file;                   ///< of the mesh, as the scene says
  std::array<Substance, 2> halves{};  ///< used for nothing else
  ExactBox box;                       ///< the first one's
  std::optional<TriangleMesh> mesh;   ///< where it was read
};

/// A scene of solids, as a .toml file holds it:
///
///     kind = "solids"
///     unit = 0.5                  # of all coordinates, world units; 1
///     scale = [4, 4, 1]           # a good size of a result, in boxes of the example; [3, 3, 1]
///     spacing = 2                 # distance of planes along the axes, units; found
///     ground = { height = 0, substance = "grass" }
///
///     [settings]                  # of the engine continuous, where a request says nothing else
///     thin = ["street=y"]
///     groups = 1
///
///     [substances]                # looks; sRGB colors
///     brick = { color = "#a05040", roughness = 0.9 }
///
///     [[part]]                    # later parts replace earlier ones where they overlap
///     substance = "brick"         # "air" cuts away
///     box = [0, 0, 0, 4, 4, 3]    # low and high corner, or
///     points = [[0, 0, 3], ...]   # the hull of points, or
///     outline = [[0, 0], ...]     # a convex prism between two
///     heights = [0, 3]            # heights, or
///     planes = [[1, 0, 1, 5]]     # a x + b y + c z <= d
///     move = [8, 0, 0]            # may be given with each
///
///     [[object]]                  # a mesh for which its box stands
///     file = "tree.glb"           # beside the scene
///     box = [0, 0, 0, 2, 2, 4]    # where it is
///     keep = "xyz"                # which sides keep their proportions: "xy", "xz", "yz" or "xyz"
///
/// With `flat = true` it is a scene of the plane: `box` is [x0, y0, x1, y1], `outline` needs no
/// heights, `planes` are lines [a, b, c] with a x + b y <= c, `move` is [x, y], and there is no
/// ground. Its parts become prisms of one height, that of one spacing.
struct SolidScene {
  std::string name;
  Solids solids;
  std::vector<Material> looks;    ///< of each substance, air's first
  std::vector<StandIn> standIns;  ///< boxes that become meshes again in results
  Vec3d scale{3, 3, 1};
  /// Good settings for it, as keys and texts.
  std::vector<std::pair<std::string, std::string>> settings;
  std::optional<std::int64_t> spacing;
};

/// Whether a .toml file, by its text, is a scene of solids.
bool isSolidScene(std::string_view text);

/// Reads a scene; throws `InputError` naming the file and line.
SolidScene readSolidScene(std::string_view text, const std::string& name);

/// The height of prisms that stand for shapes of the plane: the common measure of the distances
/// between their parallel sides along the axes, else along others, else of `corners`.
std::int64_t prismHeight(std::span<const ExactPlane> sides, std::span<const Vec3l> corners);

/// The convex hull of points as planes that point outward; throws `InputError` where they lie in
/// one plane, or a plane is steeper than normals of `kMostNormal` allow.
std::vector<ExactPlane> hullOf(const std::vector<Vec3l>& points);

}  // namespace exemplar::continuous
