// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/origins.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/parallel.h"

namespace exemplar {
namespace {

/// A cell's label, then its neighbors' at -x, +x, -y, +y, -z, +z; `kOutside` beyond the grid.
using Surroundings = std::array<std::uint32_t, 7>;
constexpr std::uint32_t kOutside = 0x10000;

struct SurroundingsHash {
  std::size_t operator()(const Surroundings& s) const {
    std::uint64_t h = 0x9E3779B97F4A7C15u;
    for (const std::uint32_t v : s) h = (h ^ v) * 0xD6E8FEB86659FD93u, h ^= h >> 32;
    return h;
  }
};

Surroundings surroundings(const LabelGrid& grid, const Vec3i& p) {
  Surroundings s;
  s[0] = grid.cells[p];
  for (int side = 0; side < 6; ++side) {
    const Vec3i q = p + kFaceSteps[side];
    s[side + 1] = grid.cells.contains(q) ? grid.cells[q] : kOutside;
  }
  return s;
}

int agreement(const Surroundings& a, const Surroundings& b) {
  int count = 0;
  for (int i = 1; i < 7; ++i) count += a[i] == b[i];
  return count;
}

}  // namespace

Origins findOrigins(const LabelGrid& grid, std::span<const LabelGrid> examples,
                    const Progress& progress) {
  if (examples.size() > 255)
    throw InputError("there are " + std::to_string(examples.size()) +
                     " examples, and origins can name 255; use fewer");
  progress.report("finding origins", 0);
  struct Place {
    Surroundings around;
    Origin first;
  };
  std::unordered_map<Surroundings, Origin, SurroundingsHash> known;
  std::vector<std::vector<Place>> places;  // of a label: each surroundings that it has
  for (std::size_t e = 0; e < examples.size(); ++e) {
    const Vec3i n = examples[e].size();
    if (std::max({n.x, n.y, n.z}) > 32767) {
      throw InputError(
          "an example is longer than the 32,767 cells that origins can name; use a "
          "smaller one");
    }
    places.resize(std::max<std::size_t>(places.size(), examples[e].labels.size()));
    forEachCell(n, [&](const Vec3i& p) {
      if (p.x == 0 && p.y == 0) progress.check();
      const Surroundings s = surroundings(examples[e], p);
      const Origin origin(p, static_cast<int>(e));
      if (known.try_emplace(s, origin).second) places[s[0]].push_back({s, origin});
    });
  }

  // The example's cell with the same label whose surroundings agree most.
  const auto mostAlike = [&](const Surroundings& here) {
    Origin best;
    int most = -1;
    for (const Place& place : places[here[0]]) {
      const int agree = agreement(here, place.around);
      if (agree <= most) continue;
      most = agree;
      best = place.first;
    }
    return best;
  };
  for (const Label b : grid.cells.values()) {
    if (b >= places.size() || places[b].empty()) {
      throw InputError("label " + std::to_string(b) + " is in the grid and in no example");
    }
  }

  Origins origins(grid.size());
  const Vec3i n = grid.size();
  constexpr int kRows = 16;  // what goes on from a neighbor does so within these
  parallelFor(0, static_cast<std::size_t>((n.y + kRows - 1) / kRows), 1,
              [&](std::size_t begin, std::size_t end) {
                for (std::size_t part = begin; part < end; ++part) {
                  const int y0 = static_cast<int>(part) * kRows, y1 = std::min(n.y, y0 + kRows);
                  std::unordered_map<Surroundings, Origin, SurroundingsHash> unknown;
                  for (int k = 0; k < n.z; ++k) {
                    progress.check();
                    for (int j = y0; j < y1; ++j) {
                      for (int i = 0; i < n.x; ++i) {
                        const Vec3i p{i, j, k};
                        const Surroundings here = surroundings(grid, p);
                        Origin best;
                        if (const auto exact = known.find(here); exact != known.end()) {
                          best = exact->second;
                        } else {
                          const auto [entry, fresh] = unknown.try_emplace(here, Origin{});
                          if (fresh) entry->second = mostAlike(here);
                          best = entry->second;
                        }
                        const int most =
                            agreement(here, surroundings(examples[best.example], best.cell()));
                        for (int side = 0; side < 6; side += 2) {
                          const Vec3i q = p + kFaceSteps[side];
                          if (q.x < 0 || q.y < y0 || q.z < 0) continue;
                          const Origin& near = origins[q];
                          const LabelGrid& example = examples[near.example];
                          const Vec3i there = near.cell() - kFaceSteps[side];
                          if (!example.cells.contains(there) || example.cells[there] != here[0])
                            continue;
                          if (agreement(here, surroundings(example, there)) < most) continue;
                          best = Origin(there, near.example);
                          break;
                        }
                        origins[p] = best;
                      }
                    }
                  }
                }
              });
  return origins;
}

}  // namespace exemplar
