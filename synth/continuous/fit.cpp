// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "synth/continuous/convex_cells.h"
#include "synth/continuous/mesh_parts.h"
#include "synth/continuous/planes.h"
#include "synth/continuous/surface_distance.h"
#include "synth/continuous/synthesize.h"

namespace exemplar::continuous {
namespace {

/// How far faces may be moved in the plans that are made, in shares of the tolerance; the first
/// that is coarse enough to be of use and whose surface is near enough counts.
constexpr std::array kPlans{0.015, 0.035, 0.07, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0};
constexpr double kUsualTolerance = 0.07;  // lengths of the longest side
/// Vertices of all planes within the example's own box, above which a fit is too fine to be of use:
/// a result twice as long and wide has four times as many and more.
constexpr double kMostOwnVertices = 500'000;
/// Triangles of one part that differ less in direction are one face, radians.
constexpr double kFlat = 0.5 * std::numbers::pi / 180;
/// Faces narrower than this times the room are left out: the faces beside a bevel of 45 degrees
/// meet at half its width from it.
constexpr double kNarrow = 1.6;
/// What of a face is less far than this share of the tolerance beyond a plane does not count there:
/// less, and displaced faces leave slivers; more, and shallow corners of arches are lost.
constexpr double kBeside = 0.25;
/// The farthest that any face may be turned.
constexpr double kMostTurn = 0.4;
constexpr int kFinestGrid = 1024;  // units on the longest side

/// Triangles of a part that lie in one plane, and what they become.
struct Patch {
  std::uint32_t number = 0;  // in the order of being found
  Vec3d areaNormal, middle;
  double area = 0, radius = 0;
  double level = 0;  // of its corners along `normal`, on average, from the origin on
  bool dropped = false;
  Vec3l normal;
};

double angleBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
  return text;
}

class Fitting {
 public:
  Fitting(const TriangleMesh& mesh, const FitOptions& options) : mesh_(mesh), options_(options) {
    const Box3d box = boundingBox(mesh);
    const Vec3d size = box.size();
    longest_ = std::max({size.x, size.y, size.z});
    if (!(longest_ > 0)) throw InputError("the mesh has no volume");
    origin_ = box.min;
    parts_ = partsOf(mesh, 1e-5 * longest_);
    for (std::uint32_t p = 0; p < parts_.parts.size(); ++p) findPatches(p);
    std::ranges::stable_sort(patches_, std::greater{}, &Patch::area);
    for (std::uint32_t n = 0; n < patches_.size(); ++n) placeOf_[patches_[n].number] = n;
  }

  Solids run(FitReport* report, const Progress& progress) {
    if (parts_.parts.empty()) {
      throw InputError("the mesh has no volume (" + counted(parts_.sheets, "open sheet") +
                       "); thicken it, or use the engine geometry");
    }
    tolerance_ = options_.tolerance.value_or(kUsualTolerance) * longest_;
    std::string first, last;  // why it does not do when faces are moved least, and most
    for (std::size_t n = 0; n < kPlans.size(); ++n) {
      progress.report("fitting planes", static_cast<double>(n) / kPlans.size());
      last = attempt(kPlans[n] * tolerance_, progress);
      if (n == 0) first = last;
      if (!last.empty()) continue;
      if (report) {
        *report = {moved_, parts_.parts.size(), parts_.openings, parts_.sheets,
                   static_cast<std::size_t>(std::ranges::count(patches_, true, &Patch::dropped))};
      }
      return std::move(made_);
    }
    const auto moved = [&](double plan, const std::string& why) {
      return "moved by up to " + percent(plan * tolerance_ / longest_) + " of its longest side, " +
             why;
    };
    throw InputError("the mesh is too fine to be read as solids between planes: " +
                     moved(kPlans.front(), first) + "; " + moved(kPlans.back(), last) +
                     (options_.tolerance ? "; a larger `snap`, or the engine geometry, may do"
                                         : "; simplify it, or use the engine geometry"));
  }

 private:
  void findPatches(std::uint32_t p) {
    const std::vector<PartTriangle>& triangles = parts_.parts[p].triangles;
    const auto normalOf = [&](std::uint32_t n) {
      const auto& c = triangles[n].corners;
      return cross(c[1] - c[0], c[2] - c[0]);
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first;
    DisjointSets flat(triangles.size());
    for (std::uint32_t n = 0; n < triangles.size(); ++n) {
      for (int c = 0; c < 3; ++c) {
        const auto& ids = triangles[n].ids;
        const auto [other, isNew] = first.emplace(std::minmax(ids[c], ids[(c + 1) % 3]), n);
        if (!isNew && angleBetween(normalOf(other->second), normalOf(n)) < kFlat)
          flat.join(n, other->second);
      }
    }
    std::uint32_t count = 0;
    const std::vector<std::uint32_t> patchOf = flat.numbered(&count);
    const auto base = static_cast<std::uint32_t>(patches_.size());
    for (std::uint32_t n = 0; n < count; ++n) patches_.push_back({.number = base + n});
    std::vector<std::vector<Vec3d>> corners(count);
    for (std::uint32_t n = 0; n < triangles.size(); ++n) {
      Patch& patch = patches_[base + patchOf[n]];
      const double area = length(normalOf(n)) / 2;
      patch.areaNormal += normalOf(n);
      patch.area += area;
      for (const Vec3d& c : triangles[n].corners) {
        patch.middle += c * (area / 3);
        corners[patchOf[n]].push_back(c);
      }
      patchOfTriangle_.push_back(base + patchOf[n]);
    }
    for (std::uint32_t n = 0; n < count; ++n) {
      Patch& patch = patches_[base + n];
      patch.middle = patch.area > 0 ? patch.middle / patch.area : corners[n][0];
      for (const Vec3d& c : corners[n])
        patch.radius = std::max(patch.radius, length(c - patch.middle));
    }
    placeOf_.resize(patches_.size());
  }

  const Patch& patchOf(std::size_t triangle) const {
    return patches_[placeOf_[patchOfTriangle_[triangle]]];
  }

  /// Fits with faces moved by up to `plan`, half of that by turning them and half along the grid;
  /// returns why that does not do, or nothing.
  std::string attempt(double plan, const Progress& progress) {
    const std::size_t directions = findDirections(plan / 2);
    if (directions + 3 > kMostFamilies)
      return "its faces have " + std::to_string(directions) + " directions (at most " +
             std::to_string(kMostFamilies - 3) + " can be handled)";
    const std::optional<double> unit = options_.unit ? options_.unit : findUnit(plan / 2);
    if (!unit) return "its faces fit no grid";
    unit_ = *unit;
    if (longest_ / unit_ > kMostCoordinate / 4.0) return "the grid is too fine";
    cutIntoCells(plan, progress);
    if (made_.solids.empty()) return "nothing of it is left";
    if (const double own = ownVertices(); own > kMostOwnVertices)
      return "its planes meet in some " + counted(static_cast<std::size_t>(own), "point") +
             " (at most " + std::to_string(static_cast<int>(kMostOwnVertices)) + " are of use)";
    moved_ = measure(plan, progress);
    if (moved_ > tolerance_) return "its surface is still " + percent(moved_ / longest_) + " away";
    return "";
  }

  std::size_t findDirections(double room) {
    struct Choice {
      Vec3l normal;
      Vec3d unit;
    };
    std::vector<Choice> chosen;
    std::set<std::array<std::int64_t, 3>> distinct;
    for (Patch& patch : patches_) {
      patch.dropped =
          patch.area / (2 * patch.radius) < kNarrow * room || length(patch.areaNormal) == 0;
      if (patch.dropped) continue;
      const double slack = std::min(kMostTurn, std::asin(std::min(1.0, room / patch.radius)));
      // Angles as squares of chords: there are as many as patches times directions.
      const Vec3d unit = normalized(patch.areaNormal);
      const double chord = 2 * std::sin(std::max(slack, 1e-6) / 2);
      double nearest = chord * chord;
      const Vec3l* found = nullptr;
      for (const Choice& choice : chosen) {
        const Vec3d off = choice.unit - unit;
        const double square = dot(off, off);
        if (square > nearest) continue;
        nearest = square;
        found = &choice.normal;
      }
      if (found) {
        patch.normal = *found;
        continue;
      }
      patch.normal = integerDirection(patch.areaNormal, slack);
      const Vec3d own = normalized(cast<double>(patch.normal));
      chosen.push_back({patch.normal, own});
      chosen.push_back({-patch.normal, -own});
      const Vec3l n = canonical(patch.normal);
      distinct.insert({n.x, n.y, n.z});
    }
    std::vector<double> corners(patches_.size());
    for (Patch& patch : patches_) patch.level = 0;
    std::size_t triangle = 0;
    for (const MeshPart& part : parts_.parts) {
      for (const PartTriangle& t : part.triangles) {
        const std::uint32_t place = placeOf_[patchOfTriangle_[triangle++]];
        for (const Vec3d& c : t.corners) {
          patches_[place].level += dot(cast<double>(patches_[place].normal), c - origin_);
          corners[place] += 1;
        }
      }
    }
    for (std::size_t n = 0; n < patches_.size(); ++n) patches_[n].level /= corners[n];
    return distinct.size();
  }

  /// The longest unit with which no face moves farther than `room`.
  std::optional<double> findUnit(double room) const {
    for (int k = 1; k <= kFinestGrid; ++k) {
      const double unit = longest_ / k;
      const bool fits = std::ranges::all_of(patches_, [&](const Patch& patch) {
        if (patch.dropped) return true;
        const double at = patch.level / unit;
        return std::abs(at - std::round(at)) * unit <=
               std::max(room, 1e-6 * longest_) * length(cast<double>(patch.normal));
      });
      if (fits) return unit;
    }
    return std::nullopt;
  }

  ExactPlane planeOf(const Patch& patch) const {
    return {patch.normal, std::llround(patch.level / unit_)};
  }
  Vec3d onGrid(const Vec3d& p) const { return (p - origin_) / unit_; }

  ExactBox boxOf(const MeshPart& part) const {
    Box3d box;
    for (const PartTriangle& t : part.triangles)
      for (const Vec3d& c : t.corners) box.add(onGrid(c));
    ExactBox whole;
    for (int axis = 0; axis < 3; ++axis) {
      whole.low[axis] = std::llround(box.min[axis]);
      whole.high[axis] = std::llround(box.max[axis]);
    }
    return whole;
  }

  void cutIntoCells(double plan, const Progress& progress) {
    made_ = {};
    made_.unit = unit_;
    made_.origin = origin_;
    made_.substances = {"air"};
    std::map<std::uint32_t, Substance> substanceOf;
    std::size_t triangle = 0;
    for (const MeshPart& part : parts_.parts) {
      const std::size_t first = triangle;
      triangle += part.triangles.size();
      const ExactBox box = boxOf(part);
      if (box.low.x >= box.high.x || box.low.y >= box.high.y || box.low.z >= box.high.z) continue;
      std::vector<ExactPlane> planes;
      std::vector<SurfacePolygon> polygons;
      std::map<std::uint32_t, std::uint32_t> planeOfPatch;
      for (std::size_t n = 0; n < part.triangles.size(); ++n) {
        const std::uint32_t place = placeOf_[patchOfTriangle_[first + n]];
        if (patches_[place].dropped) continue;
        const auto [entry, isNew] =
            planeOfPatch.emplace(place, static_cast<std::uint32_t>(planes.size()));
        if (isNew) planes.push_back(planeOf(patches_[place]));
        SurfacePolygon polygon{{}, entry->second};
        for (const Vec3d& c : part.triangles[n].corners) polygon.corners.push_back(onGrid(c));
        polygons.push_back(std::move(polygon));
      }
      const auto inside = [&](const ConvexCell& cell) { return isInside(part, cell); };
      const std::vector<ConvexCell> cells =
          convexCells(box, planes, std::move(polygons), kBeside * plan / unit_, inside, progress);
      if (cells.empty()) continue;
      const Substance substance = substanceFor(part.material, substanceOf);
      for (const ConvexCell& cell : cells) {
        Solid solid{substance, {}, {}};
        for (const ConvexCell::Side& side : cell.sides) solid.sides.push_back(side.plane);
        made_.solids.push_back(std::move(solid));
      }
      for (std::size_t n = 0; n < part.triangles.size(); ++n) {
        if (part.triangles[n].origin != PartTriangle::kCap && !patchOf(first + n).dropped)
          made_.origins.push_back({substance, patchOf(first + n).normal, part.triangles[n].origin});
      }
    }
    if (options_.ground) {
      const double height = (*options_.ground - origin_.z) / unit_;
      made_.ground = {std::llround(height), static_cast<Substance>(made_.substances.size())};
      made_.substances.push_back("ground");
    }
  }

  Substance substanceFor(std::uint32_t material, std::map<std::uint32_t, Substance>& known) {
    const auto [entry, isNew] =
        known.emplace(material, static_cast<Substance>(made_.substances.size()));
    if (isNew) {
      if (known.size() > 200) throw InputError("the mesh has solids of more than 200 materials");
      made_.substances.push_back(mesh_.hasMaterials() ? mesh_.materials[material].name
                                                      : std::string("solid"));
    }
    return entry->second;
  }

  /// By most of a few points, since the surface is near the cell's sides only.
  bool isInside(const MeshPart& part, const ConvexCell& cell) const {
    const std::vector<Vec3d> corners = cell.corners();
    Vec3d middle;
    for (const Vec3d& c : corners) middle += c / static_cast<double>(corners.size());
    int in = 0, asked = 0;
    const auto ask = [&](const Vec3d& p) {
      ++asked;
      in += std::abs(windingNumber(part, origin_ + p * unit_)) > 0.5;
    };
    ask(middle);
    for (const ConvexCell::Side& side : cell.sides) ask((middle + side.corners[0]) * 0.5);
    return 2 * in > asked;
  }

  double ownVertices() const {
    const PlaneLattice lattice = latticeOf(made_);
    const Vec3l size = continuous::boxOf(made_).size();
    const double volume =
        static_cast<double>(size.x) * static_cast<double>(size.y) * static_cast<double>(size.z);
    double density = 0;
    const std::size_t m = lattice.normals.size();
    for (std::size_t i = 0; i < m; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          density +=
              std::abs(static_cast<double>(
                  determinant(lattice.normals[i], lattice.normals[j], lattice.normals[k]))) /
              (static_cast<double>(lattice.steps[i]) * static_cast<double>(lattice.steps[j]) *
               static_cast<double>(lattice.steps[k]));
        }
      }
    }
    return density * volume;
  }

  /// The largest distance between the surface of the union of the parts and that of the solids.
  double measure(double spacing, const Progress& progress) const {
    Solids solids = made_;
    solids.ground.reset();
    const TriangleMesh fitted =
        triangulate(polygonsOf(solids, std::vector<Material>(made_.substances.size())));
    return surfaceDistance(parts_.parts, fitted, spacing, progress);
  }

  const TriangleMesh& mesh_;
  const FitOptions& options_;
  double longest_ = 0, tolerance_ = 0, unit_ = 1, moved_ = 0;
  Vec3d origin_;
  MeshParts parts_;
  std::vector<Patch> patches_;                  // by area
  std::vector<std::uint32_t> patchOfTriangle_;  // of all parts, one after the other
  std::vector<std::uint32_t> placeOf_;          // in patches_, by number
  Solids made_;
};

}  // namespace

Solids fitParts(const TriangleMesh& mesh, const FitOptions& options, FitReport* report,
                const Progress& progress) {
  return Fitting(mesh, options).run(report, progress);
}

}  // namespace exemplar::continuous
