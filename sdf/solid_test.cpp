// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/solid_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/stoppable.h"
#include "sdf/row_crossing.h"
#include "sdf/sample_distances.h"
#include "sdf/triangle_tree.h"

namespace exemplar {
namespace {

// One open component, outwards.
struct Part {
  std::vector<Corners> triangles;
  Box3d box;
};

// Six times the volume between the triangles and the middle of their box: negative where they are
// turned inside out.
double enclosedVolume(const Part& part) {
  const Vec3d middle = part.box.center();
  double sum = 0;
  for (const auto& [a, b, c] : part.triangles)
    sum += dot(a - middle, cross(b - middle, c - middle));
  return sum;
}

// Whether all triangles lie in one plane, to within rounding.
bool isFlat(const Part& part) {
  Vec3d normal{};
  double longest = 0;
  for (const auto& [a, b, c] : part.triangles) {
    const Vec3d n = cross(b - a, c - a);
    if (dot(n, n) > longest) {
      longest = dot(n, n);
      normal = normalized(n);
    }
  }
  const double allowed = 1e-9 * length(part.box.size());
  const Vec3d at = part.triangles[0][0];
  for (const Corners& t : part.triangles)
    for (const Vec3d& corner : t)
      if (std::abs(dot(corner - at, normal)) > allowed) return false;
  return true;
}

// How many of the triangles a line along each axis through their box crosses on average.
Vec3d meanCrossings(const std::vector<Corners>& triangles) {
  Vec3d shadows{};
  Box3d box;
  for (const Corners& t : triangles) {
    const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
    shadows += Vec3d{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)} / 2;
    for (const Vec3d& corner : t) box.add(corner);
  }
  const Vec3d side = box.size();
  return {shadows.x / (side.y * side.z), shadows.y / (side.z * side.x),
          shadows.z / (side.x * side.y)};
}

// Closed components, asked along the axis along which a line crosses the fewest of them: from the
// middle of a town upwards, and not through all of its walls.
class Rows {
 public:
  Rows() = default;
  explicit Rows(std::shared_ptr<const TriangleTree> tree, const Progress& progress)
      : tree_(std::move(tree)) {
    constexpr double kFew = 8;  // another tree would cost more than it saves
    constexpr double kGain = 2;
    const Vec3d crossings = meanCrossings(tree_->triangles());
    for (int axis = 1; axis < 3; ++axis)
      if (crossings[axis] < crossings[axis_]) axis_ = axis;
    if (!(crossings[0] > kFew && crossings[0] > kGain * crossings[axis_])) axis_ = 0;
    if (axis_ == 0) return;
    std::vector<Corners> turned = tree_->triangles();
    for (Corners& t : turned)
      for (Vec3d& corner : t) corner = turn(corner);
    tree_ =
        std::make_shared<TriangleTree>(std::move(turned), progress, TriangleTree::For::Distances);
  }

  bool inside(const Vec3d& p) const { return tree_ && windingAlongRow(*tree_, turn(p)) != 0; }

 private:
  // Quarter turns, which leave outsides out.
  Vec3d turn(const Vec3d& p) const { return {p[axis_], p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]}; }

  std::shared_ptr<const TriangleTree> tree_;
  int axis_ = 0;
};

}  // namespace

struct SolidTest::Parts {
  std::shared_ptr<const TriangleTree> closed;  // all closed components; null: none
  Rows rows;                                   // the same for single points
  TriangleTree flat{{}};                       // all flat ones
  std::vector<TriangleTree> open;              // the others
  TriangleTree boxes{{}};  // their boxes, each as a triangle between two of its corners
};

SolidTest::SolidTest(const TriangleSoup& soup, std::shared_ptr<const TriangleTree> tree,
                     const Progress& progress)
    : parts_(std::make_unique<Parts>()) {
  if (soup.closed) {
    parts_->closed = std::move(tree);
    parts_->rows = Rows(parts_->closed, progress);
    return;
  }
  std::vector<Corners> closed;
  std::vector<Part> open(soup.componentClosed.size());
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    if (looksUp(t)) progress.check();
    const Corners corners = cornersOf(soup, t);
    const std::uint32_t component = soup.component[t];
    if (soup.componentClosed[component]) {
      closed.push_back(corners);
      continue;
    }
    open[component].triangles.push_back(corners);
    for (const Vec3d& p : corners) open[component].box.add(p);
  }
  if (!closed.empty()) {
    parts_->closed = std::make_shared<TriangleTree>(std::move(closed), progress);
    parts_->rows = Rows(parts_->closed, progress);
  }
  std::erase_if(open, [](const Part& part) { return part.triangles.empty(); });

  std::vector<Corners> flat, boxes;
  for (std::size_t n = 0; n < open.size(); ++n) {
    if (looksUp(n)) progress.check();
    Part& part = open[n];
    if (isFlat(part)) {
      flat.insert(flat.end(), part.triangles.begin(), part.triangles.end());
      continue;
    }
    if (enclosedVolume(part) < 0)
      for (Corners& t : part.triangles) std::swap(t[1], t[2]);
    boxes.push_back({part.box.min, part.box.max, part.box.min});
    parts_->open.emplace_back(std::move(part.triangles), progress);
  }
  parts_->flat = TriangleTree(std::move(flat), progress);
  parts_->boxes = TriangleTree(std::move(boxes), progress);
}

SolidTest::~SolidTest() = default;

void SolidTest::mark(const Vec3i& low, Array3D<std::uint8_t>& inside,
                     const Progress& progress) const {
  std::ranges::fill(inside.values(), std::uint8_t{0});
  const bool openings = parts_->flat.count() > 0 || !parts_->open.empty();
  if (parts_->closed)
    markInside(*parts_->closed, low, inside, progress.part(0, openings ? 0.1 : 1));
  if (!openings) return;
  forBlocks(inside.size(), 4, progress.part(parts_->closed ? 0.1 : 0, 1), "finding signs",
            [&](const Vec3i& first, const Vec3i& end) {
              std::array<Vec3d, kTogether> points;
              std::array<std::uint8_t, kTogether> in{};
              std::size_t count = 0;
              serpentine(first, end,
                         [&](const Vec3i& ijk) { points[count++] = cast<double>(low + ijk); });
              askOpen({points.data(), count}, in.data());
              count = 0;
              serpentine(first, end, [&](const Vec3i& ijk) { inside[ijk] |= in[count++]; });
            });
}

void SolidTest::inside(std::span<const Vec3d> points, std::span<std::uint8_t> result) const {
  for (std::size_t p = 0; p < points.size(); ++p) result[p] = parts_->rows.inside(points[p]);
  for (std::size_t begin = 0; begin < points.size(); begin += kTogether) {
    const auto some = points.subspan(begin, std::min(kTogether, points.size() - begin));
    askOpen(some, result.data() + begin);
  }
}

void SolidTest::askOpen(std::span<const Vec3d> points, std::uint8_t* in) const {
  std::array<double, kTogether> winding;
  const auto ask = [&](const TriangleTree& tree, bool eitherWay) {
    tree.windingNumbers(points, {winding.data(), points.size()});
    for (std::size_t p = 0; p < points.size(); ++p)
      in[p] |= (eitherWay ? std::abs(winding[p]) : winding[p]) > 0.5;
  };
  if (parts_->flat.count() > 0) ask(parts_->flat, true);
  if (parts_->open.empty()) return;
  // Outside its convex hull no component winds around a point by more than 1/2.
  Box3d box;
  for (const Vec3d& p : points) box.add(p);
  parts_->boxes.visitBox(box.min, box.max,
                         [&](std::uint32_t part) { ask(parts_->open[part], false); });
}

}  // namespace exemplar
