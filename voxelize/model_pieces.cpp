// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/model_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "core/cells.h"
#include "core/error.h"
#include "core/parallel.h"
#include "voxelize/cell_cut.h"
#include "voxelize/material_color.h"
#include "voxelize/mesh_to_labels.h"
#include "voxelize/piece_shape.h"

namespace exemplar {
namespace {

/// An object's name without the number that modelers give to its copies: "tower.003" is a "tower".
std::string objectKind(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  if (last == std::string::npos || last + 1 == name.size()) return name;
  const std::size_t end = name.find_last_not_of("._ ", last);
  return end == std::string::npos ? name : name.substr(0, end + 1);
}

/// The looks of labels, gathered from the materials of what they show.
class LookMixer {
 public:
  void add(const TriangleMesh& mesh, const std::vector<std::array<float, 4>>& colors,
           std::uint32_t triangle, const Vec3d& weights, double area) {
    const std::size_t number = mesh.hasMaterials() ? mesh.triangleMaterials[triangle] : 0;
    std::array<double, 4> color;
    for (int c = 0; c < 4; ++c) color[c] = colors[number][c];
    if (mesh.hasColors()) {
      for (int c = 0; c < 4; ++c) {
        double mixed = 0;
        for (int k = 0; k < 3; ++k) {
          mixed += weights[k] * mesh.colors[mesh.triangles[triangle][k]][c];
        }
        color[c] *= mixed;
      }
    }
    for (int c = 0; c < 4; ++c) sum_[c] += color[c] * area;
    area_ += area;
    materials_[mesh.hasMaterials() ? mesh.materials[number].name : ""] += area;
    if (!mesh.triangleObjects.empty())
      objects_[objectKind(mesh.objects[mesh.triangleObjects[triangle]])] += area;
  }

  /// Named "piece NUMBER, OBJECT, MATERIAL": of what most of its surface is.
  LabelLook look(std::size_t number) const {
    LabelLook look;
    for (int c = 0; c < 4; ++c) {
      const double mean = area_ > 0 ? sum_[c] / area_ : 0.8;
      look.color[c] = std::clamp(static_cast<float>(mean), c < 3 ? 0.0f : 1.0f / 255, 1.0f);
    }
    look.name = "piece " + std::to_string(number);
    for (const auto* areas : {&objects_, &materials_}) {
      const auto most =
          std::ranges::max_element(*areas, {}, [](const auto& entry) { return entry.second; });
      if (most != areas->end() && !most->first.empty()) look.name += ", " + most->first;
    }
    return look;
  }

 private:
  std::array<double, 4> sum_{};
  double area_ = 0;
  std::map<std::string, double> objects_, materials_;  // their areas
};

class PieceFinder {
 public:
  PieceFinder(const TriangleMesh& mesh, const ModelPiecesOptions& options)
      : mesh_(mesh), options_(options) {}

  ModelPieces find(const Progress& progress) {
    validate(mesh_, "the mesh");
    if (!(options_.tolerance >= 1e-7 && options_.tolerance <= 0.1)) {
      throw InputError("`tolerance`: must be 1e-7 to 0.1 cells");
    }
    if (options_.air < 0 || options_.air > 1024) {
      throw InputError("`air` " + std::to_string(options_.air) + ": must be 0 to 1024 cells");
    }
    result_.tolerance = options_.tolerance;
    result_.grid = gridOver(options_.box.value_or(boundingBox(mesh_)), options_.cellSize,
                            options_.air, options_.tolerance);
    cut_ = cutAlongCells(mesh_, result_.grid.origin, result_.grid.cellSize, result_.grid.size(),
                         options_.tolerance, progress.part(0, 0.2));
    constexpr const char* kStage = "finding equal pieces";
    progress.report(kStage, 0.2);
    // The shapes of cells are independent; which are equal is found in the cells' order.
    const std::size_t cells = result_.grid.cells.count();
    std::vector<std::uint32_t> filled;
    for (std::size_t c = 0; c < cells; ++c) {
      if (cut_.first[c] != cut_.first[c + 1]) filled.push_back(static_cast<std::uint32_t>(c));
    }
    std::vector<PieceShape> shapes(filled.size());
    parallelFor(0, filled.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        progress.check();
        shapes[n] = PieceShape(mesh_, cut_, filled[n], options_.tolerance);
      }
    });
    shapes_.resize(1);
    cellOf_.resize(1);
    for (std::size_t n = 0; n < filled.size(); ++n) {
      if (n % 1024 == 0) {
        progress.report(kStage, 0.5 + 0.2 * static_cast<double>(n) / double(filled.size()));
      }
      if (shapes[n].empty()) continue;
      result_.grid.cells.values()[filled[n]] = labelOf(std::move(shapes[n]), filled[n]);
    }
    progress.report("copying pieces", 0.7);
    copyPieces(progress);
    labelInside(progress.part(0.75, 0.9));
    namePieces();
    progress.report("finding mirrored and turned pieces", 0.9);
    findImages(progress);
    return std::move(result_);
  }

 private:
  Label known(const PieceShape& shape) const {
    const auto bucket = bySize_.find(shape.count());
    if (bucket == bySize_.end()) return ModelPieces::kNone;
    for (const Label label : bucket->second) {
      if (shapes_[label].equals(shape, options_.tolerance)) return label;
    }
    return ModelPieces::kNone;
  }

  Label labelOf(PieceShape shape, std::uint32_t cell) {
    const Label found = known(shape);
    if (found != ModelPieces::kNone) return found;
    if (shapes_.size() + 1 >= ModelPieces::kNone) {
      throw InputError("the mesh has more than 65,533 different pieces; use a larger `cell`");
    }
    const auto label = static_cast<Label>(shapes_.size());
    bySize_[shape.count()].push_back(label);
    shapes_.push_back(std::move(shape));
    cellOf_.push_back(cell);
    return label;
  }

  /// The triangles of each label's first cell.
  void copyPieces(const Progress& progress) {
    TriangleMesh& out = result_.mesh;
    out.materials = mesh_.materials;
    out.textures = mesh_.textures;
    out.name = mesh_.name;
    const std::vector<std::array<float, 4>> colors = materialColors(mesh_);
    result_.first = {0, 0};
    for (std::size_t label = 1; label < shapes_.size(); ++label) {
      progress.check();
      const std::size_t cell = cellOf_[label];
      const Vec3d corner = cast<double>(result_.grid.cells.ijk(cell));
      LookMixer mixer;
      std::map<std::array<double, 3>, std::uint32_t> points;
      for (std::uint32_t n = cut_.first[cell]; n < cut_.first[cell + 1]; ++n) {
        const CutPolygon& part = cut_.polygons[n];
        mixer.add(mesh_, colors, part.triangle, cut_.points[part.first].weights,
                  length(areaNormal(cut_, part)));
        std::vector<std::uint32_t> vertices;
        for (std::uint32_t i = 0; i < part.count; ++i) {
          const CutPoint& point = cut_.points[part.first + i];
          const Vec3d p = point.p - corner;
          const auto [found, isNew] =
              points.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(out.positions.size()));
          if (isNew) {
            out.positions.push_back(scaled(p, options_.cellSize));
            if (mesh_.hasColors()) out.colors.push_back(colorAt(part.triangle, point.weights));
          }
          vertices.push_back(found->second);
        }
        addFan(part, vertices);
      }
      result_.first.push_back(static_cast<std::uint32_t>(out.triangles.size()));
      result_.grid.labels.push_back(mixer.look(label));
    }
  }

  std::array<float, 4> colorAt(std::uint32_t triangle, const Vec3d& weights) const {
    std::array<float, 4> color{};
    for (int k = 0; k < 3; ++k) {
      const auto& c = mesh_.colors[mesh_.triangles[triangle][k]];
      for (int i = 0; i < 4; ++i) color[i] += static_cast<float>(weights[k]) * c[i];
    }
    return color;
  }

  Vec2f uvAt(std::uint32_t triangle, const Vec3d& weights) const {
    Vec2f uv;
    for (int k = 0; k < 3; ++k) {
      uv.x += static_cast<float>(weights[k]) * mesh_.uvs[triangle][k].x;
      uv.y += static_cast<float>(weights[k]) * mesh_.uvs[triangle][k].y;
    }
    return uv;
  }

  void addFan(const CutPolygon& part, const std::vector<std::uint32_t>& vertices) {
    TriangleMesh& out = result_.mesh;
    // Points may lie on a straight line: the fan begins where its thinnest triangle is widest.
    const auto pointAt = [&](std::uint32_t i) {
      return cut_.points[part.first + i % part.count].p;
    };
    std::uint32_t best = 0;
    double widest = -1;
    for (std::uint32_t from = 0; from < part.count; ++from) {
      double thinnest = 1e300;
      for (std::uint32_t i = 2; i < part.count; ++i) {
        thinnest = std::min(thinnest, length(cross(pointAt(from + i - 1) - pointAt(from),
                                                   pointAt(from + i) - pointAt(from))));
      }
      if (thinnest > widest) {
        widest = thinnest;
        best = from;
      }
    }
    for (std::uint32_t i = 2; i < part.count; ++i) {
      const std::array<std::uint32_t, 3> corners{best, (best + i - 1) % part.count,
                                                 (best + i) % part.count};
      auto& triangle = out.triangles.emplace_back();
      for (int c = 0; c < 3; ++c) triangle[c] = vertices[corners[c]];
      if (mesh_.hasMaterials()) {
        out.triangleMaterials.push_back(mesh_.triangleMaterials[part.triangle]);
      }
      if (mesh_.hasUvs()) {
        auto& uvs = out.uvs.emplace_back();
        for (int c = 0; c < 3; ++c) {
          uvs[c] = uvAt(part.triangle, cut_.points[part.first + corners[c]].weights);
        }
      }
    }
  }

  /// Cells without triangles that are inside get a label of their own.
  void labelInside(const Progress& progress) {
    const Array3D<std::uint8_t> inside = cellsInside(mesh_, result_.grid, progress);
    const auto label = static_cast<Label>(result_.grid.labels.size());
    LabelLook look;
    bool any = false;
    for (std::size_t c = 0; c < inside.count(); ++c) {
      if (!inside.values()[c] || result_.grid.cells.values()[c] != 0) continue;
      // In the color of the piece below or beside it that comes first.
      if (!any && c > 0) look = result_.grid.labels[result_.grid.cells.values()[c - 1]];
      result_.grid.cells.values()[c] = label;
      any = true;
    }
    if (!any) return;
    look.name = "inside";
    look.color[3] = 1;
    result_.grid.labels.push_back(look);
    result_.first.push_back(result_.first.back());
  }

  /// Names pieces by where most of their cells lie. So far they are "piece 12, MATERIAL".
  void namePieces() {
    enum Place { Ground, Low, Roof, Wall, Inside, Span, kPlaces };
    constexpr std::array<const char*, kPlaces> kNames{"ground", "low",    "roof",
                                                      "wall",   "inside", "span"};
    const Array3D<Label>& cells = result_.grid.cells;
    const auto filled = [&](const Vec3i& p) { return cells.contains(p) && cells[p] != 0; };
    std::vector<std::array<int, kPlaces>> counts(shapes_.size());
    forEachCell(cells.size(), [&](const Vec3i& p) {
      if (!filled(p) || cells[p] >= shapes_.size()) return;
      const bool above = filled(p + Vec3i{0, 0, 1}), below = filled(p - Vec3i{0, 0, 1});
      bool open = false;
      for (const Vec3i& side : {Vec3i{1, 0, 0}, Vec3i{0, 1, 0}})
        open = open || !filled(p + side) || !filled(p - side);
      Place place = Span;
      if (p.z == 0) {
        place = Ground;
      } else if (below && !above) {
        place = p.z == 1 ? Low : Roof;
      } else if (below) {
        place = open ? Wall : Inside;
      }
      ++counts[cells[p]][place];
    });
    for (std::size_t label = 1; label < shapes_.size(); ++label) {
      const auto most = std::max_element(counts[label].begin(), counts[label].end());
      std::string& name = result_.grid.labels[label].name;
      name.replace(0, std::string_view("piece").size(), kNames[most - counts[label].begin()]);
    }
  }

  void findImages(const Progress& progress) {
    const std::size_t labels = result_.grid.labels.size();
    const bool square =
        std::abs(options_.cellSize.x - options_.cellSize.y) <= 1e-9 * options_.cellSize.x;
    for (auto* image : {&result_.mirroredX, &result_.mirroredY, &result_.turned}) {
      image->assign(labels, ModelPieces::kNone);
      // What holds no triangles is its own image.
      image->front() = 0;
      if (labels > shapes_.size()) image->back() = static_cast<Label>(labels - 1);
    }
    parallelFor(1, shapes_.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t label = begin; label < end; ++label) {
        progress.check();
        result_.mirroredX[label] = known(shapes_[label].mirrored(0));
        result_.mirroredY[label] = known(shapes_[label].mirrored(1));
        if (square) result_.turned[label] = known(shapes_[label].turned());
      }
    });
  }

  const TriangleMesh& mesh_;
  const ModelPiecesOptions& options_;
  CellCut cut_;
  std::vector<PieceShape> shapes_;     // of each label; the first is empty
  std::vector<std::uint32_t> cellOf_;  // where each was found first
  std::map<std::size_t, std::vector<Label>> bySize_;
  ModelPieces result_;
};

}  // namespace

ModelPieces cutIntoPieces(const TriangleMesh& mesh, const ModelPiecesOptions& options,
                          const Progress& progress) {
  return PieceFinder(mesh, options).find(progress);
}

}  // namespace exemplar
