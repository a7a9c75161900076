// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/piece_shape.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace exemplar {
namespace {

constexpr float kAttributeTolerance = 1.0f / 500;
/// Shapes are made of parts that agree more closely than shapes need to: what is one plane or line
/// in a shape is then one in a shape that equals it.
constexpr double kWithin = 0.25;
/// A cell of more parts is compared part by part: looking for those in one plane would take longer
/// than is gained.
constexpr std::size_t kMostMerged = 4000;

double distanceToLine(const Vec3d& p, const Vec3d& on, const Vec3d& along) {
  return length(cross(p - on, along));
}

}  // namespace

/// Parts of one material in one plane with one map of attributes.
struct PieceShape::Plane {
  std::uint32_t material;
  Vec3d normal, on;
  Attributes base;  // at `on`
  std::array<Vec3d, 6> gradient;
  std::vector<const CutPolygon*> parts;

  Attributes at(const Vec3d& p) const {
    Attributes result;
    for (int i = 0; i < 6; ++i) {
      result[i] = base[i] + static_cast<float>(dot(gradient[i], p - on));
    }
    return result;
  }
};

PieceShape::PieceShape(const TriangleMesh& mesh, const CellCut& cut, std::size_t cell,
                       double tolerance) {
  const double within = kWithin * tolerance;
  const std::size_t nx = cut.size.x, ny = cut.size.y;
  const Vec3d corner =
      cast<double>(Vec3i{static_cast<int>(cell % nx), static_cast<int>(cell / nx % ny),
                         static_cast<int>(cell / (nx * ny))});
  const auto attributesOf = [&](std::uint32_t triangle, const Vec3d& weights) {
    Attributes result{};
    const std::uint32_t material = mesh.hasMaterials() ? mesh.triangleMaterials[triangle] : 0;
    const bool textured = mesh.hasUvs() && mesh.hasMaterials() &&
                          mesh.materials[material].hasTextures();
    for (int c = 0; c < 3; ++c) {
      const auto w = static_cast<float>(weights[c]);
      if (textured) {
        result[0] += w * mesh.uvs[triangle][c].x;
        result[1] += w * mesh.uvs[triangle][c].y;
      }
      if (mesh.hasColors()) {
        const auto& color = mesh.colors[mesh.triangles[triangle][c]];
        for (int i = 0; i < 4; ++i) result[2 + i] += w * color[i];
      }
    }
    return result;
  };
  const auto close = [](const Attributes& a, const Attributes& b) {
    for (int i = 0; i < 6; ++i) {
      if (std::abs(a[i] - b[i]) > kAttributeTolerance) return false;
    }
    return true;
  };

  // Parts by plane, the largest first: their planes are known best.
  std::vector<std::pair<double, const CutPolygon*>> parts;
  for (std::uint32_t n = cut.first[cell]; n < cut.first[cell + 1]; ++n) {
    parts.emplace_back(length(areaNormal(cut, cut.polygons[n])), &cut.polygons[n]);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Plane> planes;
  for (const auto& entry : parts) {
    const double area = entry.first;
    const CutPolygon* part = entry.second;
    const CutPoint* points = &cut.points[part->first];
    const Vec3d normal = areaNormal(cut, *part) / area;
    const std::uint32_t material = mesh.hasMaterials() ? mesh.triangleMaterials[part->triangle] : 0;
    const auto fits = [&](const Plane& plane) {
      if (plane.material != material || !(dot(plane.normal, normal) > 0.9)) return false;
      for (std::uint32_t i = 0; i < part->count; ++i) {
        const Vec3d p = points[i].p - corner;
        if (std::abs(dot(p - plane.on, plane.normal)) > within) return false;
        if (!close(plane.at(p), attributesOf(part->triangle, points[i].weights))) return false;
      }
      return true;
    };
    auto plane = parts.size() > kMostMerged ? planes.end()
                                            : std::find_if(planes.begin(), planes.end(), fits);
    if (plane == planes.end()) {
      plane = planes.insert(planes.end(), Plane{});
      plane->material = material;
      plane->normal = normal;
      plane->on = points[0].p - corner;
      plane->base = attributesOf(part->triangle, points[0].weights);
      // Of the three points that span most area, the attributes' slopes.
      std::uint32_t second = 1, third = 2;
      double most = -1;
      for (std::uint32_t i = 1; i < part->count; ++i) {
        for (std::uint32_t k = i + 1; k < part->count; ++k) {
          const double spanned =
              length(cross(points[i].p - points[0].p, points[k].p - points[0].p));
          if (spanned > most) {
            most = spanned;
            second = i;
            third = k;
          }
        }
      }
      const Vec3d e = points[second].p - points[0].p, f = points[third].p - points[0].p;
      const Vec3d n = cross(e, f);
      const Attributes atE = attributesOf(part->triangle, points[second].weights);
      const Attributes atF = attributesOf(part->triangle, points[third].weights);
      for (int i = 0; i < 6; ++i) {
        plane->gradient[i] = (cross(f, n) * double{atE[i] - plane->base[i]} +
                              cross(n, e) * double{atF[i] - plane->base[i]}) /
                             dot(n, n);
      }
    }
    plane->parts.push_back(part);
  }

  // The rim of each plane: edges line by line, those that run both ways cancelled.
  struct Side {
    Vec3d a, b;
    double length;
  };
  struct Line {
    Vec3d on, along;
    std::vector<std::pair<double, int>> changes;
  };
  for (const Plane& plane : planes) {
    std::vector<Side> sides;
    for (const CutPolygon* part : plane.parts) {
      for (std::uint32_t i = 0; i < part->count; ++i) {
        const Vec3d a = cut.points[part->first + i].p - corner;
        const Vec3d b = cut.points[part->first + (i + 1) % part->count].p - corner;
        sides.push_back({a, b, exemplar::length(b - a)});
      }
    }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& a, const Side& b) { return a.length > b.length; });
    std::vector<Line> lines;
    for (const Side& side : sides) {
      auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& l) {
        return distanceToLine(side.a, l.on, l.along) <= within &&
               distanceToLine(side.b, l.on, l.along) <= within;
      });
      if (line == lines.end()) {
        line = lines.insert(lines.end(), {side.a, (side.b - side.a) / side.length, {}});
      }
      const double from = dot(side.a - line->on, line->along);
      const double to = dot(side.b - line->on, line->along);
      // One more sheet from here to there; one less where the side is run through backwards.
      line->changes.emplace_back(from, 1);
      line->changes.emplace_back(to, -1);
    }
    for (Line& line : lines) {
      std::sort(line.changes.begin(), line.changes.end());
      int covered = 0;
      double begin = 0;
      for (std::size_t n = 0; n < line.changes.size();) {
        // Changes within the tolerance happen at once.
        const double at = line.changes[n].first;
        int change = 0;
        for (; n < line.changes.size() && line.changes[n].first <= at + 2 * within; ++n) {
          change += line.changes[n].second;
        }
        if (change == 0) continue;
        if (covered != 0) {
          Edge edge;
          edge.material = plane.material;
          edge.normal = plane.normal;
          edge.a = line.on + line.along * begin;
          edge.b = line.on + line.along * at;
          if (covered < 0) std::swap(edge.a, edge.b);
          edge.multiplicity = std::abs(covered);
          edge.atA = plane.at(edge.a);
          edge.atB = plane.at(edge.b);
          rim_.push_back(edge);
        }
        covered += change;
        begin = at;
      }
    }
  }
  finish();
}

void PieceShape::finish() {
  std::stable_sort(rim_.begin(), rim_.end(),
                   [](const Edge& e, const Edge& f) { return e.key() < f.key(); });
  length_ = 0;
  middle_ = {};
  for (const Edge& edge : rim_) {
    const double l = exemplar::length(edge.b - edge.a);
    length_ += l;
    middle_ += (edge.a + edge.b) * (l / 2);
  }
  if (length_ > 0) middle_ = middle_ / length_;
}

bool PieceShape::alike(const Edge& e, const Edge& f, double tolerance) {
  if (e.material != f.material || e.multiplicity != f.multiplicity) return false;
  if (length(e.a - f.a) > tolerance || length(e.b - f.b) > tolerance) return false;
  if (!(dot(e.normal, f.normal) > 0.99)) return false;
  for (int i = 0; i < 6; ++i) {
    if (std::abs(e.atA[i] - f.atA[i]) > kAttributeTolerance) return false;
    if (std::abs(e.atB[i] - f.atB[i]) > kAttributeTolerance) return false;
  }
  return true;
}

bool PieceShape::equals(const PieceShape& other, double tolerance) const {
  if (rim_.size() != other.rim_.size()) return false;
  const double slack = 2 * tolerance * static_cast<double>(rim_.size());
  if (std::abs(length_ - other.length_) > slack) return false;
  // Each edge finds its equal among those whose keys are as near as equal edges' are.
  const double window = 15 * tolerance;
  std::vector<bool> taken(rim_.size(), false);
  std::size_t begin = 0;
  for (const Edge& edge : rim_) {
    const double key = edge.key();
    while (begin < other.rim_.size() && other.rim_[begin].key() < key - window) ++begin;
    bool found = false;
    for (std::size_t n = begin; n < other.rim_.size() && !found; ++n) {
      if (other.rim_[n].key() > key + window) break;
      if (taken[n] || !alike(edge, other.rim_[n], tolerance)) continue;
      taken[n] = found = true;
    }
    if (!found) return false;
  }
  return true;
}

PieceShape PieceShape::mirrored(int axis) const {
  PieceShape result = *this;
  for (Edge& edge : result.rim_) {
    edge.a[axis] = 1 - edge.a[axis];
    edge.b[axis] = 1 - edge.b[axis];
    edge.normal[axis] = -edge.normal[axis];
    // What lay to the left lies to the right now: run the other way.
    std::swap(edge.a, edge.b);
    std::swap(edge.atA, edge.atB);
  }
  result.finish();
  return result;
}

PieceShape PieceShape::turned() const {
  const auto turn = [](const Vec3d& p) { return Vec3d{1 - p.y, p.x, p.z}; };
  PieceShape result = *this;
  for (Edge& edge : result.rim_) {
    edge.a = turn(edge.a);
    edge.b = turn(edge.b);
    edge.normal = {-edge.normal.y, edge.normal.x, edge.normal.z};
  }
  result.finish();
  return result;
}

}  // namespace exemplar
