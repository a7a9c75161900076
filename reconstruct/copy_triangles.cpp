// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/copy_triangles.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/manifold.h"
#include "reconstruct/pull.h"
#include "reconstruct/smooth.h"
#include "reconstruct/stitch.h"
#include "core/loop_progress.h"

namespace exemplar {
namespace {

/// Corners that agree to this many voxels are one: they are the same corner of the example, reached
/// by another sum.
constexpr double kSame = 1e-5;

/// Relaxing moves no vertex farther than this, voxels.
constexpr double kFarthest = 0.5;

constexpr const char* kStage = "copying triangles";

/// A corner of a piece of an example triangle: where, in the example's index space, and its
/// barycentric weights.
struct PieceCorner {
  Vec3d at;
  std::array<double, 3> weights;
};
using Piece = std::vector<PieceCorner>;

/// The part of a convex polygon on one side of a plane across `axis`.
Piece clipped(const Piece& piece, int axis, double plane, bool below) {
  Piece result;
  const auto off = [&](const PieceCorner& c) {
    return below ? plane - c.at[axis] : c.at[axis] - plane;
  };
  for (std::size_t n = 0; n < piece.size(); ++n) {
    const PieceCorner &a = piece[n], &b = piece[(n + 1) % piece.size()];
    const double offA = off(a), offB = off(b);
    if (offA >= 0) result.push_back(a);
    if ((offA > 0 && offB < 0) || (offA < 0 && offB > 0)) {
      // Always from the lower to the higher end, so that both sides get the same corner.
      const bool forward = a.at[axis] < b.at[axis];
      const PieceCorner &from = forward ? a : b, &to = forward ? b : a;
      const double t = (plane - from.at[axis]) / (to.at[axis] - from.at[axis]);
      PieceCorner cut;
      cut.at = from.at + (to.at - from.at) * t;
      cut.at[axis] = plane;
      for (int k = 0; k < 3; ++k) {
        cut.weights[k] = from.weights[k] + (to.weights[k] - from.weights[k]) * t;
      }
      result.push_back(cut);
    }
  }
  return result;
}

double area(const Piece& piece) {
  Vec3d sum{};
  for (std::size_t n = 2; n < piece.size(); ++n) {
    sum += cross(piece[n - 1].at - piece[0].at, piece[n].at - piece[0].at);
  }
  return length(sum) / 2;
}

/// The cell that a place is in; the one above on a border, unless that is outside.
int cellAlong(double x, int size) {
  return std::clamp(static_cast<int>(std::floor(x + 0.5)), 0, size - 1);
}

/// The cells a triangle's bounding box touches.
CellBox cellsOf(const Piece& piece, const Vec3i& size) {
  CellBox box;
  for (int a = 0; a < 3; ++a) {
    double low = piece[0].at[a], high = low;
    for (const PieceCorner& c : piece) {
      low = std::min(low, c.at[a]);
      high = std::max(high, c.at[a]);
    }
    box.begin[a] = cellAlong(low, size[a]);
    // A corner that only touches the next cell from below does not reach into it.
    box.end[a] = std::max(box.begin[a], cellAlong(std::nextafter(high, low), size[a])) + 1;
  }
  return box;
}

/// Cuts a piece along cell borders until each part lies in cells that `inside` accepts, or in none.
/// Returns whether all of it is accepted: then nothing was added to `out` and the caller has the
/// whole.
template <class Inside>
bool takeInside(const Piece& piece, const CellBox& box, const Inside& inside,
                std::vector<Piece>& out) {
  const Vec3i extent = box.size();
  if (extent == Vec3i{1, 1, 1}) return inside(box.begin);
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const int middle = box.begin[axis] + (extent[axis] - 1) / 2;
  const double plane = middle + 0.5;
  CellBox lower = box, upper = box;
  lower.end[axis] = upper.begin[axis] = middle + 1;
  Piece below = clipped(piece, axis, plane, true), above = clipped(piece, axis, plane, false);
  // What lies in the border belongs above, as in `cellAlong`.
  const bool hasBelow = below.size() >= 3 && area(below) > 0;
  const bool hasAbove = above.size() >= 3 && area(above) > 0;
  if (hasBelow && hasAbove && area(below) == area(piece) && area(above) == area(piece)) {
    return takeInside(piece, upper, inside, out);
  }
  std::vector<Piece> fromBelow, fromAbove;
  const bool allBelow = !hasBelow || takeInside(below, lower, inside, fromBelow);
  const bool allAbove = !hasAbove || takeInside(above, upper, inside, fromAbove);
  if (allBelow && allAbove) return true;
  if (allBelow && hasBelow) fromBelow.push_back(std::move(below));
  if (allAbove && hasAbove) fromAbove.push_back(std::move(above));
  for (auto* list : {&fromBelow, &fromAbove}) {
    for (Piece& p : *list) out.push_back(std::move(p));
  }
  return false;
}

/// A triangle in the example's index space, as far as it lies in the field's box: what is beyond is
/// not part of the example. Empty where nothing is left.
Piece examplePiece(const TriangleMesh& mesh, const DistanceField& field, std::size_t t) {
  constexpr double kSlack = 1e-6;  // voxels; the box is often made to touch the mesh
  Piece piece(3);
  for (int c = 0; c < 3; ++c) {
    piece[c].at = field.index(mesh.positions[mesh.triangles[t][c]]);
    piece[c].weights[c] = 1;
  }
  for (int a = 0; a < 3; ++a) {
    for (const bool below : {false, true}) {
      const double plane = below ? field.size()[a] - 0.5 + kSlack : -0.5 - kSlack;
      const bool all = std::all_of(piece.begin(), piece.end(), [&](const PieceCorner& c) {
        return below ? c.at[a] <= plane : c.at[a] >= plane;
      });
      if (!all) piece = clipped(piece, a, plane, below);
      if (piece.size() < 3) return {};
    }
  }
  return piece;
}

/// Which triangles of an example run through each of its cells.
struct CellTriangles {
  std::vector<std::uint32_t> begin, triangles;
};

CellTriangles binTriangles(const ExampleView& example, const Progress& progress) {
  const Vec3i size = example.field.size();
  const std::size_t count = example.mesh.triangles.size();
  // A triangle passes a cell by where its plane does.
  std::vector<std::vector<std::uint32_t>> cells(count);
  parallelFor(0, count, 64, [&](std::size_t t0, std::size_t t1) {
    for (std::size_t t = t0; t < t1; ++t) {
      progress.check();
      const Piece piece = examplePiece(example.mesh, example.field, t);
      if (piece.empty()) continue;
      const CellBox box = cellsOf(piece, size);
      const Vec3d normal = areaNormal(example.mesh, t);
      const double reach =
          (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) * (0.5 + 1e-5);
      forEachCell(box, [&](const Vec3i& cell) {
        if (std::abs(dot(normal, cast<double>(cell) - piece[0].at)) <= reach) {
          cells[t].push_back(static_cast<std::uint32_t>(example.field.values.index(cell)));
        }
      });
    }
  });
  CellTriangles bins;
  bins.begin.assign(example.field.values.count() + 1, 0);
  for (const auto& list : cells) {
    for (const std::uint32_t c : list) ++bins.begin[c + 1];
  }
  std::partial_sum(bins.begin.begin(), bins.begin.end(), bins.begin.begin());
  bins.triangles.resize(bins.begin.back());
  std::vector<std::uint32_t> fill(bins.begin.begin(), bins.begin.end() - 1);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (const std::uint32_t c : cells[t]) bins.triangles[fill[c]++] = t;
  }
  return bins;
}

/// One triangle to be copied with one motion.
struct Copy {
  std::uint32_t motion, triangle;
  bool operator<(const Copy& b) const {
    return std::tie(motion, triangle) < std::tie(b.motion, b.triangle);
  }
  bool operator==(const Copy& b) const = default;
};

/// Everything to be copied: the distinct motions of cells through which the surface runs, and for
/// each the triangles in such cells.
struct Copies {
  std::vector<OriginMotion> motions;
  std::vector<Copy> copies;
};

Copies collectCopies(const Origins& origins, std::span<const ExampleView> examples,
                     const Progress& progress) {
  std::vector<CellTriangles> bins;
  for (const ExampleView& example : examples) bins.push_back(binTriangles(example, progress));
  progress.report(kStage, 0.3);
  const auto cellBin = [&](const Origin& o) {
    const Vec3i cell = examples[o.example].field.values.clamped(o.cell());
    return examples[o.example].field.values.index(cell);
  };
  struct Use {
    OriginMotion motion;
    std::uint32_t cell;
    bool operator<(const Use& b) const {
      return motion == b.motion ? cell < b.cell : motion < b.motion;
    }
  };
  std::vector<Use> uses;
  for (std::size_t c = 0; c < origins.count(); ++c) {
    const Origin& o = origins.values()[c];
    const auto& bin = bins[o.example];
    const std::size_t cell = cellBin(o);
    if (bin.begin[cell] == bin.begin[cell + 1]) continue;
    uses.push_back({OriginMotion(o, origins.ijk(c)), static_cast<std::uint32_t>(cell)});
  }
  tbb::parallel_sort(uses.begin(), uses.end());
  progress.report(kStage, 0.6);

  Copies result;
  for (std::size_t n = 0; n < uses.size(); ++n) {
    if (n == 0 || !(uses[n].motion == uses[n - 1].motion)) result.motions.push_back(uses[n].motion);
    const auto& bin = bins[uses[n].motion.example];
    for (std::uint32_t t = bin.begin[uses[n].cell]; t < bin.begin[uses[n].cell + 1]; ++t) {
      result.copies.push_back(
          {static_cast<std::uint32_t>(result.motions.size() - 1), bin.triangles[t]});
    }
  }
  progress.report(kStage, 0.8);
  tbb::parallel_sort(result.copies.begin(), result.copies.end());
  result.copies.erase(std::unique(result.copies.begin(), result.copies.end()), result.copies.end());
  return result;
}

/// Adds the triangles of a convex piece to `mesh`: a fan from the corner that keeps them widest.
void addPiece(const Piece& piece, const OriginMotion& motion, const DistanceField& field,
              const TriangleMesh& example, std::uint32_t triangle, TriangleMesh& mesh) {
  const std::size_t n = piece.size();
  std::size_t hub = 0;
  double widest = -1;
  for (std::size_t h = 0; n > 3 && h < n; ++h) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const Vec3d& o = piece[h].at;
      least =
          std::min(least, length(cross(piece[(h + k) % n].at - o, piece[(h + k + 1) % n].at - o)));
    }
    if (least > widest) {
      widest = least;
      hub = h;
    }
  }
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const PieceCorner& c : piece) {
    mesh.positions.push_back(field.position(motion.toResult(c.at)));
    if (!example.hasColors()) continue;
    std::array<float, 4> color;
    for (int k = 0; k < 4; ++k) {
      double sum = 0;
      for (int v = 0; v < 3; ++v) {
        sum += c.weights[v] * example.colors[example.triangles[triangle][v]][k];
      }
      color[k] = static_cast<float>(sum);
    }
    mesh.colors.push_back(color);
  }
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const std::array<std::size_t, 3> corner{hub, (hub + k) % n, (hub + k + 1) % n};
    mesh.triangles.push_back({static_cast<std::uint32_t>(first + corner[0]),
                              static_cast<std::uint32_t>(first + corner[1]),
                              static_cast<std::uint32_t>(first + corner[2])});
    if (example.hasMaterials()) {
      mesh.triangleMaterials.push_back(example.triangleMaterials[triangle]);
    }
    if (!example.hasUvs()) continue;
    std::array<Vec2f, 3> uvs;
    for (int c = 0; c < 3; ++c) {
      double x = 0, y = 0;
      for (int v = 0; v < 3; ++v) {
        x += piece[corner[c]].weights[v] * example.uvs[triangle][v].x;
        y += piece[corner[c]].weights[v] * example.uvs[triangle][v].y;
      }
      uvs[c] = {static_cast<float>(x), static_cast<float>(y)};
    }
    mesh.uvs.push_back(uvs);
  }
}

void check(const DistanceField& field, const Origins& origins,
           std::span<const ExampleView> examples, const CopyTrianglesOptions& options) {
  if (!(options.weld >= 0 && options.weld <= 1)) {
    throw InputError("`weld` is " + std::to_string(options.weld) + "; it must be 0..1 voxels");
  }
  if (examples.empty()) throw InputError("no example is given to copy triangles from");
  for (const ExampleView& example : examples) validate(example.mesh, "example");
  checkOrigins(field, origins, examples);
}

}  // namespace

CopiedTriangles copyTriangles(const DistanceField& field, const Origins& origins,
                              std::span<const ExampleView> examples,
                              const CopyTrianglesOptions& options, const Progress& progress) {
  check(field, origins, examples, options);
  progress.report(kStage, 0);
  const Copies copies = collectCopies(origins, examples, progress.part(0, 0.2));

  // Pieces of about this many copies make one mesh each; these are joined in order.
  constexpr std::size_t kChunk = 512;
  struct Chunk {
    std::vector<TriangleMesh> meshes;              // one an example
    std::vector<std::vector<std::uint32_t>> part;  // of each vertex: its motion
    std::int64_t whole = 0, cut = 0;
  };
  std::vector<Chunk> chunks((copies.copies.size() + kChunk - 1) / kChunk);
  LoopProgress done(progress.part(0.2, 0.5), kStage, chunks.size());
  parallelFor(0, chunks.size(), 1, [&](std::size_t c0, std::size_t c1) {
    for (std::size_t c = c0; c < c1; ++c) {
      Chunk& chunk = chunks[c];
      chunk.meshes.resize(examples.size());
      chunk.part.resize(examples.size());
      const std::size_t end = std::min((c + 1) * kChunk, copies.copies.size());
      for (std::size_t n = c * kChunk; n < end; ++n) {
        progress.check();
        const auto& [motionId, triangle] = copies.copies[n];
        const OriginMotion& motion = copies.motions[motionId];
        const ExampleView& example = examples[motion.example];
        const auto inside = [&](const Vec3i& cell) {
          const Vec3d at = motion.toResult(cast<double>(cell));
          const Vec3i there{static_cast<int>(std::lround(at.x)),
                            static_cast<int>(std::lround(at.y)),
                            static_cast<int>(std::lround(at.z))};
          return origins.contains(there) && motionAt(origins, there) == motion;
        };
        Piece piece = examplePiece(example.mesh, example.field, triangle);
        std::vector<Piece> pieces;
        if (takeInside(piece, cellsOf(piece, example.field.size()), inside, pieces)) {
          pieces.push_back(std::move(piece));
          ++chunk.whole;
        } else {
          chunk.cut += !pieces.empty();
        }
        TriangleMesh& mesh = chunk.meshes[motion.example];
        for (const Piece& p : pieces) addPiece(p, motion, field, example.mesh, triangle, mesh);
        chunk.part[motion.example].resize(mesh.positions.size(), motionId);
      }
      done.advance();
    }
  });

  CopiedTriangles result;
  result.motions = static_cast<std::int64_t>(copies.motions.size());
  std::vector<std::uint32_t> part;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    TriangleMesh fromExample;
    fromExample.materials = examples[e].mesh.materials;
    fromExample.textures = examples[e].mesh.textures;
    for (Chunk& chunk : chunks) {
      const TriangleMesh& m = chunk.meshes[e];
      const auto shift = static_cast<std::uint32_t>(fromExample.positions.size());
      const auto add = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      add(fromExample.positions, m.positions);
      add(fromExample.colors, m.colors);
      add(fromExample.uvs, m.uvs);
      add(fromExample.triangleMaterials, m.triangleMaterials);
      for (const auto& [a, b, c] : m.triangles) {
        fromExample.triangles.push_back({a + shift, b + shift, c + shift});
      }
      add(part, chunk.part[e]);
      if (e == 0) {
        result.wholeTriangles += chunk.whole;
        result.cutTriangles += chunk.cut;
      }
    }
    if (e == 0) {
      result.mesh = std::move(fromExample);
    } else {
      append(result.mesh, fromExample);
    }
  }
  if (result.mesh.triangles.empty()) {
    throw InputError(
        "no triangle was copied: the origins name only cells that the example's surface does not "
        "run through; use a higher `resolution` or another `seed`");
  }
  chunks.clear();

  progress.report("joining the copied parts", 0.5);
  weldVertices(result.mesh, kSame * field.voxelSize, part, progress);
  progress.report("joining the copied parts", 0.6);
  if (options.weld > 0) stitchRims(result.mesh, options.weld * field.voxelSize, part, progress);
  // Where several parts overlap, rims meet in edges of three and more triangles; nothing moves.
  makeManifold(result.mesh, {.separation = 0, .repairDegenerate = false}, progress.part(0.7, 0.8));
  if (options.relax > 0) {
    progress.report("relaxing the seams", 0.8);
    SmoothOptions relax;
    relax.iterations = options.relax;
    relax.weights = seamWeights(result.mesh, field, origins, 2, progress);
    relax.box = field.box();
    relax.most = kFarthest * field.voxelSize;
    smooth(result.mesh, relax, progress.part(0.85, 0.95));
  }
  result.health = meshHealth(result.mesh);
  progress.report("triangles copied", 1);
  return result;
}

CopiedTriangles copyTriangles(const DistanceField& field, const Origins& origins,
                              const TriangleMesh& example, const DistanceField& exampleField,
                              const CopyTrianglesOptions& options, const Progress& progress) {
  const ExampleView view{example, exampleField};
  return copyTriangles(field, origins, std::span(&view, 1), options, progress);
}

}  // namespace exemplar
