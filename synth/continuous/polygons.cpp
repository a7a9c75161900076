// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/polygons.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "core/disjoint_sets.h"
#include "synth/continuous/figures.h"

namespace exemplar::continuous {
namespace {

/// The rays of a central arrangement in one of its planes, and what is beside them. A sector of the
/// plane is known by the ray at its right end, seen from its tip, and a number of its own.
class PlaneRays {
 public:
  struct Side {
    std::uint32_t below = 0, above = 0;  // cells of the sector to a ray's left
  };

  PlaneRays(const Central& central, const std::vector<Vec3l>& normals) : central_(&central) {
    first_.push_back(0);
    for (const Central::Ray& ray : central.rays)
      first_.push_back(first_.back() + static_cast<std::uint32_t>(__builtin_popcount(ray.on)));
    left_.resize(first_.back());
    clockwise_.resize(first_.back());
    forEachFamily(central.families, [&](int i) { addPlane(i, normals[i]); });
  }

  /// How many sectors there are, over all planes.
  std::uint32_t sectors() const { return first_.back(); }
  std::uint32_t sector(std::uint32_t ray, int family) const {
    const Families below = central_->rays[ray].on & ((Families{1} << family) - 1);
    return first_[ray] + static_cast<std::uint32_t>(__builtin_popcount(below));
  }
  const Side& left(std::uint32_t sector) const { return left_[sector]; }
  /// The next ray of the plane to the right of a sector's ray.
  std::uint32_t clockwise(std::uint32_t sector) const { return clockwise_[sector]; }

 private:
  void addPlane(int i, const Vec3l& normal) {
    std::vector<std::uint32_t> around;
    for (std::uint32_t r = 0; r < central_->rays.size(); ++r)
      if (central_->rays[r].on >> i & 1) around.push_back(r);
    const Vec3l start = central_->rays[around[0]].direction;
    // Half a turn from `start` on, then the other half.
    const auto half = [&](const Vec3l& d) {
      const std::int64_t side = dot(normal, cross(start, d));
      return side > 0 || (side == 0 && dot(start, d) > 0) ? 0 : 1;
    };
    std::ranges::sort(around, [&](std::uint32_t a, std::uint32_t b) {
      const Vec3l &da = central_->rays[a].direction, &db = central_->rays[b].direction;
      if (half(da) != half(db)) return half(da) < half(db);
      return dot(normal, cross(da, db)) > 0;
    });
    const Families bit = Families{1} << i;
    for (std::size_t n = 0; n < around.size(); ++n) {
      const Central::Ray& ray = central_->rays[around[n]];
      const Central::Ray& next = central_->rays[around[(n + 1) % around.size()]];
      // Neighboring rays are less than half a turn apart: their sum is inside the sector.
      const Families above = ray.above | next.above;
      const std::uint32_t s = sector(around[n], i);
      left_[s] = {central_->cell(above & ~bit), central_->cell(above | bit)};
      clockwise_[s] = around[(n + around.size() - 1) % around.size()];
    }
  }

  const Central* central_;
  std::vector<std::uint32_t> first_;
  std::vector<Side> left_;
  std::vector<std::uint32_t> clockwise_;
};

class Outliner {
 public:
  Outliner(const Arrangement& arrangement, const Filling& filling)
      : a_(arrangement), filling_(filling) {
    for (const Central* central : a_.kinds()) rays_.emplace_back(*central, a_.planes().normals);
  }

  PolygonModel run(const Progress& progress) {
    number();
    progress.report("outlining faces", 0.2);
    join();
    progress.report("outlining faces", 0.5);
    walk();
    progress.report("outlining faces", 0.9);
    return std::move(model_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  bool constant(std::uint32_t v) const {
    const Substance* cells = filling_.cells(v);
    const std::size_t n = a_.central(v).cells.size();
    return std::all_of(cells + 1, cells + n, [&](Substance s) { return s == cells[0]; });
  }

  void number() {
    base_.assign(a_.vertices(), kNone);
    std::uint32_t sectors = 0;
    for (std::uint32_t v = 0; v < a_.vertices(); ++v) {
      if (constant(v)) continue;
      base_[v] = sectors;
      faceVertices_.push_back(v);
      sectors += rays_[a_.kind(v)].sectors();
    }
    regions_.reset(sectors);
    walked_.assign(sectors, 0);
  }

  /// What is below and above a sector, as one number; 0 where it is on no face.
  std::uint32_t face(std::uint32_t v, std::uint32_t sector) const {
    const PlaneRays::Side& side = rays_[a_.kind(v)].left(sector);
    const Substance* cells = filling_.cells(v);
    const std::uint32_t below = cells[side.below], above = cells[side.above];
    return below == above ? 0 : (below << 8 | above) + 1;
  }

  template <class Body>
  void forEachFaceSector(std::uint32_t v, Body&& body) const {
    const Central& central = a_.central(v);
    const PlaneRays& rays = rays_[a_.kind(v)];
    for (std::uint32_t r = 0; r < central.rays.size(); ++r) {
      if (a_.ends(v)[r].vertex == EdgeEnd::kNone) continue;
      std::uint32_t sector = rays.sector(r, __builtin_ctz(central.rays[r].on));
      forEachFamily(central.rays[r].on, [&](int i) {
        if (face(v, sector) != 0) body(r, i, sector);
        ++sector;
      });
    }
  }

  /// Joins sectors of one facet of the arrangement, and facets of one face across edges.
  void join() {
    for (const std::uint32_t v : faceVertices_) {
      const PlaneRays& rays = rays_[a_.kind(v)];
      forEachFaceSector(v, [&](std::uint32_t r, int i, std::uint32_t sector) {
        const EdgeEnd& end = a_.ends(v)[r];
        const PlaneRays& there = rays_[a_.kind(end.vertex)];
        const std::uint32_t same = there.sector(there.clockwise(there.sector(end.ray, i)), i);
        if (base_[end.vertex] == kNone || face(end.vertex, same) != face(v, sector))
          throw std::logic_error("outline: the ends of an edge do not agree");
        regions_.join(base_[v] + sector, base_[end.vertex] + same);
        const std::uint32_t right = rays.sector(rays.clockwise(sector), i);
        if (face(v, right) == face(v, sector)) regions_.join(base_[v] + sector, base_[v] + right);
      });
    }
  }

  /// Walks along each border with its face to the left.
  void walk() {
    corner_.assign(a_.vertices(), 0);
    point_.assign(a_.vertices(), kNone);
    for (const std::uint32_t v : faceVertices_) {
      forEachFaceSector(v, [&](std::uint32_t r, int i, std::uint32_t sector) {
        if (walked_[base_[v] + sector] || !border(v, i, sector)) return;
        std::vector<std::uint32_t> loop;
        const std::uint32_t state = face(v, sector);
        std::uint32_t at = v, ray = r, here = sector;
        do {
          walked_[base_[at] + here] = 1;
          if (isCorner(at)) loop.push_back(at);
          const EdgeEnd& end = a_.ends(at)[ray];
          at = end.vertex;
          ray = end.ray;
          const PlaneRays& rays = rays_[a_.kind(at)];
          // Clockwise from where it came, through the face, to the face's other border.
          do {
            ray = rays.clockwise(rays.sector(ray, i));
            here = rays.sector(ray, i);
          } while (face(at, rays.sector(rays.clockwise(here), i)) == state);
        } while (base_[at] + here != base_[v] + sector);
        addLoop(v, i, sector, state, std::move(loop));
      });
    }
    for (auto& [region, polygon] : polygons_) model_.polygons.push_back(std::move(polygon));
  }

  bool border(std::uint32_t v, int i, std::uint32_t sector) const {
    const PlaneRays& rays = rays_[a_.kind(v)];
    return face(v, rays.sector(rays.clockwise(sector), i)) != face(v, sector);
  }

  /// Whether faces of three directions meet at a vertex.
  bool isCorner(std::uint32_t v) {
    if (corner_[v] == 0) {
      const Substance* cells = filling_.cells(v);
      const auto [entry, isNew] = cornerOf_.emplace(cells, false);
      if (isNew) {
        const Central& central = a_.central(v);
        const Figure figure =
            reduced(a_.centrals(), central.families, {cells, central.cells.size()});
        entry->second = a_.centrals().of(figure.support).rank == 3;
      }
      corner_[v] = entry->second ? 2 : 1;
    }
    return corner_[v] == 2;
  }

  void addLoop(std::uint32_t v, int i, std::uint32_t sector, std::uint32_t state,
               std::vector<std::uint32_t> loop) {
    const std::uint32_t region = regions_.find(base_[v] + sector);
    Polygon& polygon = polygons_[region];
    if (polygon.loops.empty()) {
      const Vec3l& normal = a_.planes().normals[i];
      const ExactPoint& p = a_.point(v);
      polygon.plane = {normal, dot(normal, p.n) / p.d};
      polygon.below = static_cast<Substance>((state - 1) >> 8);
      polygon.above = static_cast<Substance>((state - 1) & 0xFF);
    }
    for (std::uint32_t& corner : loop) {
      if (point_[corner] == kNone) {
        point_[corner] = static_cast<std::uint32_t>(model_.points.size());
        model_.points.push_back(a_.point(corner));
      }
      corner = point_[corner];
    }
    polygon.loops.push_back(std::move(loop));
    // A region has one outer border: the loop that runs counterclockwise.
    if (polygon.loops.size() > 1 && area(polygon, polygon.loops.back()) > 0)
      std::swap(polygon.loops.front(), polygon.loops.back());
  }

  double area(const Polygon& polygon, const std::vector<std::uint32_t>& loop) const {
    const Vec3d start = model_.points[loop[0]].approximately();
    Vec3d sum;
    for (std::size_t n = 2; n < loop.size(); ++n) {
      sum += cross(model_.points[loop[n - 1]].approximately() - start,
                   model_.points[loop[n]].approximately() - start);
    }
    return dot(sum, cast<double>(polygon.plane.normal));
  }

  const Arrangement& a_;
  const Filling& filling_;
  std::vector<PlaneRays> rays_;      // by kind
  std::vector<std::uint32_t> base_;  // the first sector of a vertex on a face
  std::vector<std::uint32_t> faceVertices_;
  DisjointSets regions_;              // of sectors
  std::vector<std::uint8_t> walked_;  // along the ray of a sector
  std::vector<std::uint8_t> corner_;  // 0 not known, 1 no, 2 yes
  std::unordered_map<const Substance*, bool> cornerOf_;
  std::vector<std::uint32_t> point_;           // of the model
  std::map<std::uint32_t, Polygon> polygons_;  // by region
  PolygonModel model_;
};

}  // namespace

PolygonModel outline(const Arrangement& arrangement, const Filling& filling,
                     const Progress& progress) {
  return Outliner(arrangement, filling).run(progress);
}

}  // namespace exemplar::continuous
