// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/snap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/text.h"
#include "mesh/shading_normals.h"

namespace exemplar::continuous {
namespace {

/// Faces whose normals differ by less have one direction, radians.
constexpr double kSameDirection = 0.05 * std::numbers::pi / 180;
/// The finest grid that is found by itself, in lengths of the mesh's longest side.
constexpr double kFinestUnit = 1.0 / 4096;
/// How well coordinates are known, in lengths of the longest side: files have six digits or floats.
constexpr double kPrecision = 4e-6;

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// A set of coplanar triangles that hang together.
struct Patch {
  Vec3d areaNormal;  // the sum of its triangles'
  Vec3l normal;      // outward
  double level = 0;  // normal . (x - origin) of its corners, on average
  std::int64_t offset = 0;
};

double angleBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Euclid's algorithm on lengths that are known to within `precision`.
double commonMeasure(double a, double b, double precision) {
  while (b > precision) {
    const double rest = std::abs(a - b * std::round(a / b));
    a = b;
    b = rest;
  }
  return a;
}

class Snapping {
 public:
  Snapping(const TriangleMesh& mesh, const SnapOptions& options)
      : mesh_(mesh), options_(options), vertex_(firstOfEqual(mesh.positions)) {
    const Vec3d size = boundingBox(mesh).size();
    longest_ = std::max({size.x, size.y, size.z});
  }

  Solids run(SnapReport* report, const Progress& progress) {
    progress.report("snapping to a grid", 0);
    takeTriangles();
    requireClosed();
    findPatches();
    progress.report("snapping to a grid", 0.3);
    findDirections();
    findUnit();
    progress.report("snapping to a grid", 0.6);
    placeVertices();
    makeSolids();
    if (report) *report = {moved_, shells_};
    return std::move(made_);
  }

 private:
  std::uint32_t corner(std::uint32_t t, int c) const { return vertex_[mesh_.triangles[t][c % 3]]; }

  void takeTriangles() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (length(areaNormal(mesh_, t)) > 1e-12 * longest_ * longest_) triangles_.push_back(t);
    }
    if (triangles_.empty()) throw InputError("the mesh has no faces");
    if (triangles_.size() < mesh_.triangles.size()) {
      warn(options_.warnings, counted(mesh_.triangles.size() - triangles_.size(), "triangle") +
                                  " without area left out");
    }
    for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
      for (int c = 0; c < 3; ++c) {
        const auto [low, high] =
            std::minmax({corner(triangles_[n], c), corner(triangles_[n], c + 1)});
        edges_[{low, high}].push_back(n);
      }
    }
  }

  void requireClosed() const {
    std::size_t open = 0;
    for (const auto& [ends, users] : edges_) {
      int forward = 0;
      for (const std::uint32_t n : users) {
        for (int c = 0; c < 3; ++c) {
          const std::uint32_t a = corner(triangles_[n], c), b = corner(triangles_[n], c + 1);
          if (a == ends.first && b == ends.second) ++forward;
          if (b == ends.first && a == ends.second) --forward;
        }
      }
      open += forward != 0;
    }
    if (open > 0) {
      throw InputError("the mesh is not closed, or its faces are not oriented alike (at " +
                       counted(open, "edge") + "); every solid needs a closed surface");
    }
  }

  void findPatches() {
    DisjointSets patches(triangles_.size());
    std::vector<Vec3d> normals;
    for (const std::uint32_t t : triangles_) normals.push_back(areaNormal(mesh_, t));
    for (const auto& [ends, users] : edges_) {
      for (std::size_t i = 1; i < users.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          if (angleBetween(normals[users[i]], normals[users[j]]) < kSameDirection)
            patches.join(users[i], users[j]);
        }
      }
    }
    std::uint32_t count = 0;
    patchOf_ = patches.numbered(&count);
    patches_.resize(count);
    for (std::uint32_t n = 0; n < triangles_.size(); ++n)
      patches_[patchOf_[n]].areaNormal += normals[n];
  }

  void findDirections() {
    std::vector<std::uint32_t> order(patches_.size());
    for (std::uint32_t p = 0; p < order.size(); ++p) order[p] = p;
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::uint32_t p) { return length(patches_[p].areaNormal); });
    std::vector<Vec3d> clusters;
    std::vector<int> clusterOf(patches_.size());
    for (const std::uint32_t p : order) {
      Vec3d n = patches_[p].areaNormal;
      int found = -1;
      for (std::size_t c = 0; c < clusters.size() && found < 0; ++c) {
        if (std::abs(dot(n, clusters[c])) <
            std::cos(2 * kSameDirection) * length(n) * length(clusters[c]))
          continue;
        found = static_cast<int>(c);
      }
      if (found < 0) {
        found = static_cast<int>(clusters.size());
        clusters.push_back({});
      }
      const bool turned = dot(n, clusters[found]) < 0;
      clusters[found] += turned ? -n : n;
      clusterOf[p] = turned ? -found - 1 : found;
      if (clusters.size() > 4 * kMostFamilies) refuseDirections(clusters.size(), "more than ");
    }
    std::vector<Vec3l> integer;
    std::set<std::array<std::int64_t, 3>> distinct;
    for (const Vec3d& c : clusters) {
      integer.push_back(integerDirection(c, kSameDirection));
      const Vec3l v = canonical(integer.back());
      distinct.insert({v.x, v.y, v.z});
    }
    if (distinct.size() > kMostFamilies) refuseDirections(distinct.size(), "");
    for (std::uint32_t p = 0; p < patches_.size(); ++p) {
      const int c = clusterOf[p];
      patches_[p].normal = c < 0 ? -integer[-c - 1] : integer[c];
    }
  }
  [[noreturn]] static void refuseDirections(std::size_t count, const std::string& atLeast) {
    throw InputError("the mesh has faces of " + atLeast + std::to_string(count) +
                     " directions, and at most " + std::to_string(kMostFamilies) +
                     " can be handled; replace what is curved or noisy by few planes (bounding "
                     "boxes, say)");
  }

  /// A vertex at which three directions meet becomes the grid's origin, so that all planes through
  /// it have whole offsets.
  void findUnit() {
    std::map<std::uint32_t, std::set<std::uint32_t>> at;
    for (std::uint32_t n = 0; n < triangles_.size(); ++n)
      for (int c = 0; c < 3; ++c) at[corner(triangles_[n], c)].insert(patchOf_[n]);
    for (const auto& [v, patches] : at) {
      facesAt_.emplace_back(v, std::vector<std::uint32_t>(patches.begin(), patches.end()));
    }
    const std::uint32_t* first = nullptr;
    for (const auto& [v, patches] : facesAt_) {
      if (rank(patches) < 3) continue;
      const Vec3d &p = mesh_.positions[v], *best = first ? &mesh_.positions[*first] : nullptr;
      if (!best || std::tie(p.x, p.y, p.z) < std::tie(best->x, best->y, best->z)) first = &v;
    }
    if (!first) throw InputError("the mesh has no corner at which three faces meet");
    made_.origin = mesh_.positions[*first];

    std::vector<double> corners(patches_.size());
    for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
      Patch& patch = patches_[patchOf_[n]];
      for (int c = 0; c < 3; ++c) {
        patch.level += dot(cast<double>(patch.normal),
                           mesh_.positions[corner(triangles_[n], c)] - made_.origin);
        corners[patchOf_[n]] += 1;
      }
    }
    for (std::size_t p = 0; p < patches_.size(); ++p) patches_[p].level /= corners[p];
    made_.unit = options_.unit.value_or(0);
    if (!options_.unit) made_.unit = measure();
    for (Patch& patch : patches_) {
      const double offset = patch.level / made_.unit;
      if (std::abs(offset) > 3.0 * kMostNormal * kMostCoordinate)
        throw InputError("the mesh is too large for a grid of this `unit`; choose a larger one");
      patch.offset = std::llround(offset);
    }
  }

  double measure() const {
    double unit = 0;
    for (const Patch& patch : patches_) {
      const double level = std::abs(patch.level);
      const double precision = kPrecision * longest_ * length(cast<double>(patch.normal));
      if (level <= precision) continue;
      unit = unit == 0 ? level
                       : commonMeasure(std::max(unit, level), std::min(unit, level), 4 * precision);
    }
    if (unit == 0) unit = longest_;
    if (unit < kFinestUnit * longest_) {
      throw InputError(
          "the mesh's faces do not fit a grid: the distances between parallel ones have no common "
          "measure above " +
          shortNumber(kFinestUnit * longest_) + "; give a `unit`");
    }
    double above = 0, below = 0;
    for (const Patch& patch : patches_) {
      const double k = std::round(patch.level / unit);
      above += patch.level * k;
      below += k * k;
    }
    return below > 0 ? above / below : unit;
  }

  int rank(const std::vector<std::uint32_t>& patches) const {
    Vec3l line;
    for (const std::uint32_t a : patches) {
      if (line == Vec3l{}) {
        line = cross(patches_[patches[0]].normal, patches_[a].normal);
      } else if (dot(line, patches_[a].normal) != 0) {
        return 3;
      }
    }
    return line == Vec3l{} ? 1 : 2;
  }

  ExactPlane planeOf(std::uint32_t patch) const {
    return {patches_[patch].normal, patches_[patch].offset};
  }

  void placeVertices() {
    nearIndex_.assign(mesh_.positions.size(), 0);
    for (const auto& [v, patches] : facesAt_) {
      const Vec3d before = (mesh_.positions[v] - made_.origin) / made_.unit;
      Vec3d after;
      ExactPoint point;
      if (sharpest(patches, point)) {
        for (const std::uint32_t p : patches) {
          if (planeOf(p).side(point) == 0) continue;
          throw InputError("faces that meet at " + at(v) +
                           " no longer do on the grid; give a `unit` that fits the mesh");
        }
        made_.points.push_back(point);
        after = point.approximately();
      } else {
        if (rank(patches) == 3)
          throw InputError("the mesh is too large for a grid of this `unit`; choose a larger one");
        after = projected(before, patches);
      }
      const double moved = length(after - before) * made_.unit;
      if (moved > moved_) {
        moved_ = moved;
        movedMost_ = v;
      }
      nearIndex_[v] = static_cast<std::uint32_t>(made_.nearPoints.size());
      made_.nearPoints.push_back(after);
    }
    if (moved_ > options_.tolerance * longest_) {
      throw InputError("snapping to a grid of " + shortNumber(made_.unit) + " would move " +
                       at(movedMost_) + " by " + shortNumber(moved_) + ", more than the `snap` " +
                       "tolerance of " + shortNumber(options_.tolerance * longest_) +
                       "; give a `unit` that fits, or straighten the mesh");
    }
  }
  std::string at(std::uint32_t v) const {
    const Vec3d& p = mesh_.positions[v];
    return "(" + shortNumber(p.x) + ", " + shortNumber(p.y) + ", " + shortNumber(p.z) + ")";
  }

  /// Where the three of the planes meet that are farthest from dependent.
  bool sharpest(const std::vector<std::uint32_t>& patches, ExactPoint& point) const {
    double most = 0;
    std::array<std::uint32_t, 3> best{};
    for (std::size_t a = 0; a < patches.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        for (std::size_t c = 0; c < b; ++c) {
          const Vec3l &na = patches_[patches[a]].normal, &nb = patches_[patches[b]].normal,
                      &nc = patches_[patches[c]].normal;
          const double volume =
              std::abs(dot(normalized(cast<double>(na)),
                           cross(normalized(cast<double>(nb)), normalized(cast<double>(nc)))));
          if (determinant(na, nb, nc) == 0 || volume <= most) continue;
          most = volume;
          best = {patches[a], patches[b], patches[c]};
        }
      }
    }
    return most > 0 && meet(planeOf(best[0]), planeOf(best[1]), planeOf(best[2]), point);
  }

  /// A point in the middle of a face or of a straight edge, moved onto it by the shortest way.
  Vec3d projected(const Vec3d& p, const std::vector<std::uint32_t>& patches) const {
    const auto excess = [&](std::uint32_t patch) {
      return static_cast<double>(patches_[patch].offset) -
             dot(cast<double>(patches_[patch].normal), p);
    };
    const Vec3d a = cast<double>(patches_[patches[0]].normal);
    Vec3d b;
    std::uint32_t second = patches[0];
    for (const std::uint32_t patch : patches) {
      const Vec3d n = cast<double>(patches_[patch].normal);
      if (length(cross(a, n)) / length(n) <= length(cross(a, b)) / std::max(length(b), 1.0))
        continue;
      b = n;
      second = patch;
    }
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ea = excess(patches[0]);
    if (second == patches[0]) return p + a * (ea / aa);
    const double eb = excess(second), whole = aa * bb - ab * ab;
    return p + a * ((ea * bb - eb * ab) / whole) + b * ((eb * aa - ea * ab) / whole);
  }

  void makeSolids() {
    // Where solids touch along an edge, each goes on with its own material.
    const auto materialOf = [&](std::uint32_t n) {
      return mesh_.hasMaterials() ? mesh_.triangleMaterials[triangles_[n]] : 0;
    };
    DisjointSets parts(triangles_.size());
    for (const auto& [ends, users] : edges_) {
      for (const std::uint32_t a : users) {
        for (const std::uint32_t b : users)
          if (users.size() == 2 || materialOf(a) == materialOf(b)) parts.join(a, b);
      }
    }
    std::uint32_t count = 0;
    const std::vector<std::uint32_t> partOf = parts.numbered(&count);
    shells_ = static_cast<int>(count);
    std::vector<std::map<std::uint32_t, double>> area(count);
    for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
      const std::uint32_t t = triangles_[n];
      area[partOf[n]][mesh_.hasMaterials() ? mesh_.triangleMaterials[t] : 0] +=
          length(areaNormal(mesh_, t));
    }
    std::map<std::uint32_t, std::size_t> solidOfMaterial;
    std::vector<std::size_t> solidOf(count);
    made_.substances = {"air"};
    for (std::uint32_t part = 0; part < count; ++part) {
      std::uint32_t material = 0;
      double most = -1;
      for (const auto& [m, share] : area[part]) {
        if (share <= most) continue;
        most = share;
        material = m;
      }
      const auto [entry, isNew] = solidOfMaterial.emplace(material, made_.solids.size());
      solidOf[part] = entry->second;
      if (!isNew) continue;
      if (made_.substances.size() > 200)
        throw InputError("the mesh has solids of more than 200 materials");
      made_.solids.push_back({static_cast<Substance>(made_.substances.size()), {}, {}});
      made_.substances.push_back(material < mesh_.materials.size() ? mesh_.materials[material].name
                                                                   : std::string("solid"));
    }
    std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> sideOf;
    std::vector<double> volume(made_.solids.size());
    for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
      const std::size_t s = solidOf[partOf[n]];
      Solid& solid = made_.solids[s];
      const auto [side, isNew] =
          sideOf.emplace(std::pair(s, patchOf_[n]), static_cast<std::uint32_t>(solid.sides.size()));
      if (isNew) solid.sides.push_back(planeOf(patchOf_[n]));
      const std::uint32_t t = triangles_[n];
      ShellTriangle triangle{{}, side->second};
      for (int c = 0; c < 3; ++c) triangle.corners[c] = nearIndex_[corner(t, c)];
      volume[s] +=
          dot(made_.nearPoints[triangle.corners[0]],
              cross(made_.nearPoints[triangle.corners[1]], made_.nearPoints[triangle.corners[2]]));
      solid.triangles.push_back(triangle);
      made_.origins.push_back({solid.substance, solid.sides[side->second].normal, t});
    }
    for (std::size_t s = 0; s < made_.solids.size(); ++s)
      if (volume[s] < 0) turnOutside(made_.solids[s]);
    if (options_.ground) addGround();
  }

  void turnOutside(Solid& solid) {
    warn(options_.warnings,
         "faces of " + made_.substances[solid.substance] + " point inward; turned around");
    for (ExactPlane& side : solid.sides) side = {-side.normal, -side.offset};
    for (FaceOrigin& origin : made_.origins)
      if (origin.substance == solid.substance) origin.normal = -origin.normal;
    for (ShellTriangle& triangle : solid.triangles)
      std::swap(triangle.corners[1], triangle.corners[2]);
  }

  void addGround() {
    const double height = (*options_.ground - made_.origin.z) / made_.unit;
    const std::int64_t whole = std::llround(height);
    if (std::abs(height) > kMostCoordinate ||
        std::abs(height - static_cast<double>(whole)) * made_.unit >
            options_.tolerance * longest_) {
      throw InputError("`ground` " + shortNumber(*options_.ground) +
                       " is not a height of the mesh's grid, which has steps of " +
                       shortNumber(made_.unit));
    }
    made_.ground = {whole, static_cast<Substance>(made_.substances.size())};
    made_.substances.push_back("ground");
  }

  const TriangleMesh& mesh_;
  const SnapOptions& options_;
  std::vector<std::uint32_t> vertex_;     // the first of equal positions
  std::vector<std::uint32_t> triangles_;  // with area; all else is indexed by place in this list
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges_;
  std::vector<std::uint32_t> patchOf_;
  std::vector<Patch> patches_;
  std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> facesAt_;
  std::vector<std::uint32_t> nearIndex_;
  Solids made_;
  double longest_ = 0, moved_ = 0;
  std::uint32_t movedMost_ = 0;
  int shells_ = 0;
};

}  // namespace

Vec3l integerDirection(const Vec3d& direction, double within) {
  const Vec3d size{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
  const double most = std::max({size.x, size.y, size.z});
  Vec3l best;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= kMostNormal; ++k) {
    const Vec3d s = direction * (k / most);
    const Vec3l v{std::llround(s.x), std::llround(s.y), std::llround(s.z)};
    const double angle = angleBetween(cast<double>(v), direction);
    if (angle < nearest) {
      nearest = angle;
      best = primitive(v);
    }
    if (angle < within) break;
  }
  return best;
}

Solids snapMesh(const TriangleMesh& mesh, const SnapOptions& options, SnapReport* report,
                const Progress& progress) {
  return Snapping(mesh, options).run(report, progress);
}

}  // namespace exemplar::continuous
