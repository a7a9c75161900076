// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "synth/continuous/solids.h"

/// Solids as text: convex parts with whole coordinates, exact.
namespace exemplar::continuous {

/// A scene of solids, as a .toml file holds it:
///
///     kind = "solids"
///     unit = 0.5                  # of all coordinates, world units; 1
///     scale = [4, 4, 1]           # a good size of a result, in boxes of the example; [3, 3, 1]
///     spacing = 2                 # distance of planes along the axes, units; found
///     ground = { height = 0, substance = "grass" }
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
struct SolidScene {
  std::string name;
  Solids solids;
  std::vector<Material> looks;  ///< of each substance, air's first
  Vec3d scale{3, 3, 1};
  std::optional<std::int64_t> spacing;
};

/// Whether a .toml file, by its text, is a scene of solids.
bool isSolidScene(std::string_view text);

/// Reads a scene; throws `InputError` naming the file and line.
SolidScene readSolidScene(std::string_view text, const std::string& name);

/// The convex hull of points as planes that point outward; throws `InputError` where they lie in
/// one plane, or a plane is steeper than normals of `kMostNormal` allow.
std::vector<ExactPlane> hullOf(const std::vector<Vec3l>& points);

}  // namespace exemplar::continuous
