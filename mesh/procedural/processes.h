// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>

#include "core/progress.h"
#include "mesh/triangle_mesh.h"

namespace exemplar {

// The random processes behind the bundled scenes: each makes a window (`box`) of something that
// goes on beyond it. World units: one is one sample at the scene's own resolution of 64. `extent`
// multiplies the window's sides (>= 1), `seed` chooses the sample of the process. All are
// deterministic, every solid in them closed, manifold and oriented outwards. All report to
// `progress` and throw `Cancelled`.

/// A sample of a process: its solids and the window to look through.
struct ProcessSample {
  TriangleMesh mesh;
  Box3d box;
  std::optional<Vec3d> cell;  ///< of a sample made of model pieces
};

/// Identical tori woven 4-in-1: every ring passes through two rings of the row before and two of
/// the row after, none touches another, each a little out of place.
struct ChainmailProcess {
  int columns = 3, rows = 10;  ///< rings in the window; 1..64, rows even
  double ringRadius = 8.5;     ///< center to middle of the wire
  double wireRadius = 1.75;    ///< at most 0.21 ringRadius, beyond which rings would touch
  double tilt = 0.5236;        ///< of rings from the plane, rows alternating; radians, 0.4..0.65
  double jitter = 0.02;        ///< of positions, share of ringRadius, 0..0.02
};
ProcessSample makeChainmail(const ChainmailProcess& process, const Vec3d& extent,
                            std::uint64_t seed, const Progress& progress = {});

/// Equal balls dropped into a heap: a random loose packing, settled by gravity; every ball rests on
/// others and none overlap.
struct BallsProcess {
  double side = 64;     ///< of the window
  double radius = 6.5;  ///< of a ball, 1..side/2
  int colors = 5;       ///< materials among the balls, 1..5
};
ProcessSample makeBalls(const BallsProcess& process, const Vec3d& extent, std::uint64_t seed,
                        const Progress& progress = {});

/// Rods along the three axes through a lattice of balls, the lattice's points moved at random.
struct GridProcess {
  int cells = 4;            ///< lattice cells a side of the window, 1..32
  double cell = 16;         ///< side of a cell
  double rodRadius = 2.2;   ///< 0.5..cell/4
  double ballRadius = 4.2;  ///< rodRadius..cell/2
  double jitter = 1.2;      ///< deviation of a point along each axis, 0..cell/8
};
ProcessSample makeGrid(const GridProcess& process, const Vec3d& extent, std::uint64_t seed,
                       const Progress& progress = {});

/// Long fibers, roughly parallel to x, of different thickness, wavy, apart from one another.
struct FibersProcess {
  double side = 64;     ///< of the window
  double spacing = 11;  ///< least distance of neighbors' axes, > 2 (maxRadius + waviness)
  double minRadius = 2.2, maxRadius = 3.6;  ///< of a fiber
  double waviness = 1.6;                    ///< amplitude of its sideways motion, 0..spacing/4
};
ProcessSample makeFibers(const FibersProcess& process, const Vec3d& extent, std::uint64_t seed,
                         const Progress& progress = {});

/// Rough metal under the microscope: grains of different height and slope, pits between them.
struct MetalProcess {
  double side = 64;   ///< of the window
  double grain = 10;  ///< distance of neighboring grains, 2..side/2
  double relief = 9;  ///< from the lowest pit to the highest grain, about
  double depth = 5;   ///< solid below the lowest pit
};
ProcessSample makeMetal(const MetalProcess& process, const Vec3d& extent, std::uint64_t seed,
                        const Progress& progress = {});

/// Hills between winding valley floors, carved by running water: uplift against stream-power
/// erosion (Braun, Willett: "A very efficient O(n), implicit and parallel method to solve the
/// stream power equation", Geomorphology 180-181, 2013, doi:10.1016/j.geomorph.2012.10.008), flow
/// routed over filled pits (Barnes, Lehman, Mulla: "Priority-flood", Computers & Geosciences 62,
/// 2014, doi:10.1016/j.cageo.2013.04.024), and a limit on slopes.
struct TerrainProcess {
  double side = 64;    ///< of the window
  double relief = 15;  ///< of the highest ridges above the valley floors, about
  double valley = 34;  ///< distance of valley floors, about; 8..side
  double depth = 5;    ///< solid below the valley floors
  int steps = 60;      ///< of erosion, 1..1000
};
ProcessSample makeTerrain(const TerrainProcess& process, const Vec3d& extent, std::uint64_t seed,
                          const Progress& progress = {});

/// Curved, tapering blades on a thin sheet of soil.
struct GrassProcess {
  double side = 64;        ///< of the window
  double spacing = 8.5;    ///< least distance of roots, 2..side
  double width = 4.5;      ///< of a blade
  double thickness = 2.6;  ///< of a blade
  double length = 34;      ///< of a blade, on average
  double soil = 4;         ///< thickness of the soil
};
ProcessSample makeGrass(const GrassProcess& process, const Vec3d& extent, std::uint64_t seed,
                        const Progress& progress = {});

/// A wall on its back, in running bond: bricks with rounded edges, each a little out of place, in a
/// bed of mortar. y is up the wall, z toward whoever looks at it.
struct BricksProcess {
  int columns = 3, courses = 8;  ///< bricks in the window; 1..64, courses even
  double length = 20;            ///< from joint to joint along a course
  double height = 8;             ///< from joint to joint up the wall, at most `length`
  double joint = 1.8;            ///< width of the mortar between bricks, 0.1..0.5 height
  double relief = 3;             ///< of bricks above the mortar
  double jitter = 0.04;          ///< of places, sizes and turns, share of height, 0..0.1
};
ProcessSample makeBricks(const BricksProcess& process, const Vec3d& extent, std::uint64_t seed,
                         const Progress& progress = {});

/// Scales of a reptile: keeled shields in staggered rows, each on top of two of the row above it.
/// Their tips point along -y.
struct ScalesProcess {
  int columns = 5, rows = 6;  ///< scales in the window; 1..64, rows even
  double width = 12.8;        ///< distance of scales in a row
  double length = 10.4;       ///< distance of rows, 0.5..1.5 width
  double lift = 0.34;         ///< of tips from the skin, radians, 0.1..0.5
  double jitter = 0.05;       ///< of places, sizes and turns, share of width, 0..0.1
};
ProcessSample makeScales(const ScalesProcess& process, const Vec3d& extent, std::uint64_t seed,
                         const Progress& progress = {});

/// Bark of an old tree: plates, longer than wide, with furrows between them that run along y.
struct BarkProcess {
  double side = 64;    ///< of the window
  double plate = 9;    ///< distance of furrows across; 2..side/2
  double grain = 3.2;  ///< length of plates, of their width; 1..6
  double relief = 7;   ///< from the deepest furrow to the highest plate, about
  double depth = 4;    ///< of the wood below the furrows
};
ProcessSample makeBark(const BarkProcess& process, const Vec3d& extent, std::uint64_t seed,
                       const Progress& progress = {});

}  // namespace exemplar
