// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/marks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include "core/cells.h"
#include "core/disjoint_sets.h"
#include "core/error.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "measure/novelty.h"

namespace exemplar {
namespace {

constexpr int kSeamCell = 6, kRepeatCell = 8;  // samples
constexpr std::size_t kLeastSurface = 12;      // samples of a cell of the example, to count at all
constexpr double kLeastShare = 0.25;           // of such a cell, to be there again
constexpr std::size_t kPlacesLooked = 64;      // of a repeated part
constexpr std::size_t kLooked = 400;           // samples of a place that are looked at

/// The solid samples with an empty one at a face, by rising index.
std::vector<std::size_t> surfaceSamples(const DistanceField& field, const Progress& progress) {
  std::vector<std::vector<std::size_t>> layers(static_cast<std::size_t>(field.size().z));
  const Array3D<float>& values = field.values;
  parallelFor(0, layers.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t layer = begin; layer < end; ++layer) {
      progress.check();
      const int k = static_cast<int>(layer);
      const CellBox box{{0, 0, k}, {field.size().x, field.size().y, k + 1}};
      forEachCell(box, [&](const Vec3i& p) {
        if (!(values[p] < 0)) return;
        for (const Vec3i& step : kFaceSteps) {
          const Vec3i q = p + step;
          if (!values.contains(q) || values[q] < 0) continue;
          layers[layer].push_back(values.index(p));
          return;
        }
      });
    }
  });
  std::vector<std::size_t> surface;
  for (const auto& layer : layers) surface.insert(surface.end(), layer.begin(), layer.end());
  return surface;
}

/// What a camera sees of a field's surface.
class Eye {
 public:
  Eye(const DistanceField& field, const Camera& camera) : field_(field), camera_(camera) {}

  /// Where the picture shows a sample of the surface, unless something hides it.
  std::optional<std::array<double, 2>> sees(const Vec3i& sample) const {
    const Vec3d from = field_.position(cast<double>(sample));
    const auto at = pictureOf(camera_, from);
    if (!at) return std::nullopt;
    // Toward the camera in steps of half a voxel; the first few leave the surface's own skin.
    const Vec3d step = normalized(camera_.position - from) * 0.5;
    Vec3d index = cast<double>(sample) + step * 4.0;
    const double steps = length(camera_.position - from) / field_.voxelSize * 2 - 4;
    for (double n = 0; n < steps; ++n) {
      index += step;
      const Vec3i cell{static_cast<int>(std::lround(index.x)),
                       static_cast<int>(std::lround(index.y)),
                       static_cast<int>(std::lround(index.z))};
      if (!field_.values.contains(cell)) return at;
      if (field_.values[cell] < 0) return std::nullopt;
    }
    return at;
  }

  /// Fills in where the picture shows the samples of one place. `position` becomes the sample that
  /// is nearest to their middle, of those that are seen if any is.
  void look(const Array3D<float>& grid, const std::vector<std::size_t>& samples, Mark& mark) const {
    std::vector<Vec3i> all, seen;
    const std::size_t stride = samples.size() / kLooked + 1;
    for (std::size_t n = 0; n < samples.size(); n += stride) {
      const Vec3i cell = grid.ijk(samples[n]);
      all.push_back(cell);
      if (const auto at = sees(cell)) {
        seen.push_back(cell);
        mark.outline.push_back(*at);
      }
    }
    mark.outline = convexHull(std::move(mark.outline));
    const std::vector<Vec3i>& shown = seen.empty() ? all : seen;
    Vec3d middle{};
    for (const Vec3i& cell : shown) middle += cast<double>(cell);
    middle *= 1 / static_cast<double>(shown.size());
    const Vec3i nearest =
        *std::min_element(shown.begin(), shown.end(), [&](const Vec3i& a, const Vec3i& b) {
          return length(cast<double>(a) - middle) < length(cast<double>(b) - middle);
        });
    put(nearest, mark);
  }

  void put(const Vec3i& sample, Mark& mark) const {
    mark.position = field_.position(cast<double>(sample));
    mark.at = sees(sample);
  }

 private:
  const DistanceField& field_;
  const Camera& camera_;
};

Vec3i cellOf(const Vec3i& sample, int side) {
  return {sample.x / side, sample.y / side, sample.z / side};
}

Vec3i cellCount(const Vec3i& size, int side) {
  return {(size.x + side - 1) / side, (size.y + side - 1) / side, (size.z + side - 1) / side};
}

void markSeams(const std::vector<std::size_t>& surface, const Array3D<float>& jumps, const Eye& eye,
               const MarkOptions& options, std::vector<Mark>& marks) {
  struct Cell {
    double sum = 0;
    float most = 0;
    std::size_t sample = 0;
    bool seen = false;
  };
  Array3D<Cell> cells(cellCount(jumps.size(), kSeamCell));
  for (const std::size_t n : surface) {
    const float jump = jumps.values()[n];
    if (!(jump >= options.leastJump)) continue;
    Cell& cell = cells[cellOf(jumps.ijk(n), kSeamCell)];
    cell.sum += jump;
    if (jump > cell.most) cell.most = jump, cell.sample = n;
  }
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < cells.count(); ++c) {
    Cell& cell = cells.values()[c];
    if (!(cell.most > 0)) continue;
    cell.seen = eye.sees(jumps.ijk(cell.sample)).has_value();
    order.push_back(c);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Cell &x = cells.values()[a], &y = cells.values()[b];
    if (x.seen != y.seen) return x.seen;
    return x.sum != y.sum ? x.sum > y.sum : a < b;
  });
  std::vector<Vec3i> taken;
  for (const std::size_t c : order) {
    if (static_cast<int>(taken.size()) == options.seams) break;
    const Vec3i at = cells.ijk(c);
    const bool beside = std::any_of(taken.begin(), taken.end(), [&](const Vec3i& t) {
      return std::max({std::abs(t.x - at.x), std::abs(t.y - at.y), std::abs(t.z - at.z)}) < 2;
    });
    if (beside) continue;
    taken.push_back(at);
    Mark mark{Mark::Kind::Seam, static_cast<int>(taken.size()) - 1};
    mark.value = cells.values()[c].most;
    eye.put(jumps.ijk(cells.values()[c].sample), mark);
    marks.push_back(std::move(mark));
  }
}

void markRepeats(const DistanceField& example, const std::vector<std::size_t>& exampleSurface,
                 const std::vector<std::size_t>& surface, const Origins& origins, int exampleIndex,
                 const Eye& eye, const Array3D<float>& grid, const MarkOptions& options,
                 std::vector<Mark>& marks, const Progress& progress) {
  const Vec3i count = cellCount(example.size(), kRepeatCell);
  Array3D<std::uint32_t> own(count), used(count);
  Array3D<std::uint8_t> isSurface(example.size());
  for (const std::size_t n : exampleSurface) {
    isSurface.values()[n] = 1;
    ++own[cellOf(isSurface.ijk(n), kRepeatCell)];
  }
  double uses = 0;
  for (const std::size_t n : surface) {
    const Origin& o = origins.values()[n];
    if (o.example != exampleIndex || !isSurface[o.cell()]) continue;
    ++used[cellOf(o.cell(), kRepeatCell)];
    ++uses;
  }
  if (uses == 0) return;
  const double average = uses / static_cast<double>(exampleSurface.size());
  const auto use = [&](std::size_t c) {
    return own.values()[c] < kLeastSurface ? 0.0 : 1.0 * used.values()[c] / own.values()[c];
  };
  std::vector<std::size_t> order(own.count());
  for (std::size_t c = 0; c < order.size(); ++c) order[c] = c;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return use(a) != use(b) ? use(a) > use(b) : a < b;
  });

  std::vector<Vec3i> taken;
  for (const std::size_t c : order) {
    if (static_cast<int>(taken.size()) == options.repeats) break;
    if (use(c) < options.leastRepeat * average) break;
    const Vec3i cell = own.ijk(c);
    const bool beside = std::any_of(taken.begin(), taken.end(), [&](const Vec3i& t) {
      return std::max({std::abs(t.x - cell.x), std::abs(t.y - cell.y), std::abs(t.z - cell.z)}) < 2;
    });
    if (beside) continue;
    progress.check();
    std::map<OriginMotion, std::vector<std::size_t>> places;
    for (const std::size_t n : surface) {
      const Origin& o = origins.values()[n];
      if (o.example == exampleIndex && isSurface[o.cell()] && cellOf(o.cell(), kRepeatCell) == cell)
        places[OriginMotion(o, origins.ijk(n))].push_back(n);
    }
    std::vector<const std::vector<std::size_t>*> whole;
    for (const auto& [motion, samples] : places)
      if (static_cast<double>(samples.size()) >= kLeastShare * own.values()[c])
        whole.push_back(&samples);
    if (whole.size() < 2) continue;
    std::stable_sort(whole.begin(), whole.end(),
                     [](const auto* a, const auto* b) { return a->size() > b->size(); });
    const int group = static_cast<int>(taken.size());
    taken.push_back(cell);
    std::vector<Mark> found;
    for (std::size_t w = 0; w < std::min(whole.size(), kPlacesLooked); ++w) {
      Mark& mark = found.emplace_back(Mark{Mark::Kind::Repeat, group});
      mark.value = use(c) / average;
      eye.look(grid, *whole[w], mark);
    }
    std::stable_partition(found.begin(), found.end(),
                          [](const Mark& m) { return m.at.has_value(); });
    if (static_cast<int>(found.size()) > options.places)
      found.resize(static_cast<std::size_t>(options.places));
    std::move(found.begin(), found.end(), std::back_inserter(marks));
  }
}

void markCopies(std::size_t exampleSurface, const std::vector<std::size_t>& surface,
                const Origins& origins, const Eye& eye, const Array3D<float>& grid,
                const MarkOptions& options, std::vector<Mark>& marks, const Progress& progress) {
  DisjointSets regions(origins.count());
  const Vec3i n = origins.size();
  for (int k = 0; k < n.z; ++k) {
    progress.report("marking what shows", static_cast<double>(k) / n.z);
    forEachCell(CellBox{{0, 0, k}, {n.x, n.y, k + 1}}, [&](const Vec3i& a) {
      for (const Vec3i& step : {Vec3i{1, 0, 0}, Vec3i{0, 1, 0}, Vec3i{0, 0, 1}})
        if (origins.contains(a + step) && continues(origins[a], origins[a + step], step))
          regions.join(static_cast<std::uint32_t>(origins.index(a)),
                       static_cast<std::uint32_t>(origins.index(a + step)));
    });
  }
  std::map<std::uint32_t, std::vector<std::size_t>> parts;
  for (const std::size_t s : surface)
    parts[regions.find(static_cast<std::uint32_t>(s))].push_back(s);
  std::vector<const std::vector<std::size_t>*> order;
  for (const auto& [region, samples] : parts) order.push_back(&samples);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->size() > b->size(); });
  for (std::size_t r = 0; r < order.size() && static_cast<int>(r) < options.copies; ++r) {
    Mark mark{Mark::Kind::Copy, static_cast<int>(r)};
    mark.value = static_cast<double>(order[r]->size()) / static_cast<double>(exampleSurface);
    if (mark.value < options.leastCopy) break;
    eye.look(grid, *order[r], mark);
    marks.push_back(std::move(mark));
  }
}

}  // namespace

std::vector<Mark> findMarks(const DistanceField& example, const DistanceField& result,
                            const Origins& origins, const Array3D<float>& jumps,
                            const Camera& camera, const MarkOptions& options, int exampleIndex,
                            const Progress& progress) {
  progress.report("marking what shows", 0);
  requireOriginsFit(origins, example, result, exampleIndex);
  if (jumps.size() != result.size())
    throw InputError("seam jumps must be one for each of the result's samples");
  std::vector<Mark> marks;
  const std::vector<std::size_t> surface = surfaceSamples(result, progress);
  const std::vector<std::size_t> exampleSurface = surfaceSamples(example, progress);
  if (surface.empty() || exampleSurface.empty()) return marks;
  const Eye eye(result, camera);
  progress.report("marking what shows", 0.2);
  markSeams(surface, jumps, eye, options, marks);
  progress.report("marking what shows", 0.3);
  markRepeats(example, exampleSurface, surface, origins, exampleIndex, eye, result.values, options,
              marks, progress);
  markCopies(exampleSurface.size(), surface, origins, eye, result.values, options, marks,
             progress.part(0.5, 1));
  return marks;
}

std::vector<std::array<double, 2>> convexHull(std::vector<std::array<double, 2>> points) {
  // A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto turn = [](const auto& a, const auto& b, const auto& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  std::vector<std::array<double, 2>> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // the next chain begins there
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace exemplar
