// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "report/subdivide.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace exemplar {
namespace {

struct Part {
  std::array<std::uint32_t, 3> corners;
  std::array<std::array<double, 3>, 3> weights;
};

}  // namespace

std::optional<Subdivided> subdivide(const TriangleMesh& mesh, double longest, std::int64_t most) {
  Subdivided result;
  std::vector<Vec3d>& positions = result.mesh.positions;
  positions = mesh.positions;
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, isNew] = middles.try_emplace(std::uint64_t{a} << 32 | b,
                                                 static_cast<std::uint32_t>(positions.size()));
    if (isNew) positions.push_back((positions[a] + positions[b]) * 0.5);
    return at->second;
  };
  std::vector<Part> work;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    work.push_back({mesh.triangles[t], {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}});
    while (!work.empty()) {
      const Part part = work.back();
      work.pop_back();
      const auto edge = [&](std::size_t c) {
        return length(positions[part.corners[c]] - positions[part.corners[(c + 1) % 3]]);
      };
      // An edge is cut in its middle or not at all, and in the end none is too long: triangles that
      // share one agree, in whichever order they cut theirs.
      std::size_t cut = 0;
      for (std::size_t c = 1; c < 3; ++c)
        if (edge(c) > edge(cut)) cut = c;
      if (!(edge(cut) > longest)) {
        result.mesh.triangles.push_back(part.corners);
        result.parents.push_back(t);
        result.weights.push_back(part.weights);
        if (static_cast<std::int64_t>(result.parents.size()) > most) return std::nullopt;
        continue;
      }
      if (static_cast<std::int64_t>(result.parents.size() + work.size()) > most)
        return std::nullopt;
      const std::size_t next = (cut + 1) % 3;
      const std::uint32_t m = middle(part.corners[cut], part.corners[next]);
      std::array<double, 3> weights{};
      for (std::size_t w = 0; w < 3; ++w)
        weights[w] = (part.weights[cut][w] + part.weights[next][w]) / 2;
      Part first = part, second = part;
      first.corners[next] = m;
      first.weights[next] = weights;
      second.corners[cut] = m;
      second.weights[cut] = weights;
      work.push_back(second);
      work.push_back(first);
    }
  }
  return result;
}

}  // namespace exemplar
