// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/mirror.h"

#include <algorithm>

#include "core/error.h"

namespace exemplar::continuous {
namespace {

Vec3l reflected(Vec3l direction, int axis) {
  direction[axis] = -direction[axis];
  return direction;
}

constexpr const char* kAxisNames[] = {"x", "y", "z"};

[[noreturn]] void refuse(int axis) {
  throw InputError("`mirror` " + std::string(kAxisNames[axis]) +
                   ": the planes of the result are not their own mirror images; use a `size` one "
                   "larger or smaller along " +
                   kAxisNames[axis] + ", or an example with faces that mirror each other");
}

}  // namespace

Mirror::Mirror(const Puzzle& puzzle, int axis) : puzzle_(puzzle), axis_(axis) {
  const Arrangement& a = puzzle.arrangement;
  const ExactBox& window = a.planes().window;
  twiceMiddle_ = window.low[axis] + window.high[axis];
  std::vector<std::uint32_t> imageKind(a.kinds().size(), EdgeEnd::kNone);
  image_.resize(a.vertices());
  for (std::uint32_t v = 0; v < a.vertices(); ++v) {
    ExactPoint p = a.point(v);
    p.n[axis] = twiceMiddle_ * p.d - p.n[axis];
    // Vertices are in order of position.
    std::uint32_t low = 0, high = static_cast<std::uint32_t>(a.vertices());
    while (low < high) {
      const std::uint32_t middle = (low + high) / 2;
      (before(a.point(middle), p) ? low = middle + 1 : high = middle);
    }
    if (low == a.vertices() || a.point(low) != p) refuse(axis);
    image_[v] = low;
    std::uint32_t& kind = imageKind[a.kind(v)];
    if (kind == EdgeEnd::kNone) kind = a.kind(low);
    if (kind != a.kind(low)) refuse(axis);
  }
  labels_.resize(a.kinds().size());
  for (std::uint32_t k = 0; k < imageKind.size(); ++k) {
    const Families families = a.kinds()[k]->families, image = a.kinds()[imageKind[k]]->families;
    const std::vector<Vec3l>& normals = a.planes().normals;
    forEachFamily(families, [&](int i) {
      const Vec3l normal = canonical(reflected(normals[static_cast<std::size_t>(i)], axis));
      const auto found = std::ranges::find(normals, normal) - normals.begin();
      if (found == std::ssize(normals) || !(image >> found & 1)) refuse(axis);
    });
    labels_[k] = imagesOf(k, imageKind[k]);
  }
}

std::vector<int> Mirror::imagesOf(std::uint32_t kind, std::uint32_t imageKind) const {
  const VertexClass &from = puzzle_.classes[kind], &to = puzzle_.classes[imageKind];
  std::vector<int> images;
  if (from.labels() == 0) return images;
  // A cell's image is among the images of its rays.
  std::vector<std::uint32_t> cellOf;
  const std::vector<Vec3l>& normals = puzzle_.arrangement.centrals().normals();
  for (const std::vector<std::uint32_t>& rays : from.central->raysOfCell) {
    Vec3l inward;
    for (const std::uint32_t r : rays) inward += from.central->rays[r].direction;
    Families above = 0;
    forEachFamily(to.central->families, [&](int i) {
      if (dot(normals[i], reflected(inward, axis_)) > 0) above |= Families{1} << i;
    });
    cellOf.push_back(to.central->cell(above));
  }
  std::vector<Substance> table(to.central->cells.size());
  for (std::size_t l = 0; l < from.labels(); ++l) {
    for (std::size_t c = 0; c < cellOf.size(); ++c) table[cellOf[c]] = from.cells(l)[c];
    const std::uint32_t figure =
        puzzle_.figures.find(reduced(puzzle_.arrangement.centrals(), to.central->families, table));
    images.push_back(figure == FigureSet::kNone ? -1 : to.labelOf(figure));
  }
  return images;
}

std::vector<std::uint32_t> Mirror::half(std::span<const std::uint32_t> vertices) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t v : vertices) {
    const ExactPoint& p = puzzle_.arrangement.point(v);
    if (2 * p.n[axis_] <= twiceMiddle_ * p.d) found.push_back(v);
  }
  return found;
}

void Mirror::restrict(std::span<const std::uint32_t> half, Domains& domains) const {
  const Arrangement& a = puzzle_.arrangement;
  for (const std::uint32_t v : half) {
    const VertexClass& c = puzzle_.classOf(v);
    const std::uint32_t image = image_[v];
    const VertexClass& other = puzzle_.classOf(image);
    for (std::size_t l = 0; l < c.labels(); ++l) {
      const int there = labels_[a.kind(v)][l];
      bool keeps = there >= 0 && contains(domains[image], static_cast<std::size_t>(there));
      if (image == v) keeps = keeps && there == static_cast<int>(l);
      const std::span<const EdgeEnd> ends = a.ends(v);
      for (std::size_t r = 0; r < ends.size() && keeps && image != v; ++r) {
        if (ends[r].vertex != image) continue;
        keeps =
            c.rays[r].edgeOf[l] == other.rays[ends[r].ray].edgeOf[static_cast<std::size_t>(there)];
      }
      if (!keeps) takeOut(domains[v], l);
    }
  }
}

void Mirror::complete(std::span<const std::uint32_t> half, Domains& domains) const {
  for (const std::uint32_t v : half) {
    if (image_[v] == v) continue;
    std::size_t label = 0;
    forEach(domains[v], [&](std::size_t l) { label = l; });
    std::ranges::fill(domains[image_[v]], 0);
    insert(domains[image_[v]],
           static_cast<std::size_t>(labels_[puzzle_.arrangement.kind(v)][label]));
  }
}

}  // namespace exemplar::continuous
