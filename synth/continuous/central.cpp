// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/central.h"

#include <algorithm>
#include <stdexcept>

namespace exemplar::continuous {
namespace {

/// The families of `among` whose positive side a direction is on.
Families aboveOf(const std::vector<Vec3l>& normals, Families among, const Vec3l& direction) {
  Families above = 0;
  forEachFamily(among, [&](int i) {
    if (dot(normals[i], direction) > 0) above |= Families{1} << i;
  });
  return above;
}

Families containing(const std::vector<Vec3l>& normals, Families among, const Vec3l& direction) {
  Families on = 0;
  forEachFamily(among, [&](int i) {
    if (dot(normals[i], direction) == 0) on |= Families{1} << i;
  });
  return on;
}

/// The sectors into which planes through a line cut its surroundings, each by the planes it is
/// above of. Neighboring borders of sectors are less than half a turn apart, so that the sum of two
/// is inside; other sums are inside some sector, too.
std::vector<Families> sectors(const std::vector<Vec3l>& normals, Families on, const Vec3l& line) {
  std::vector<Vec3l> borders;
  forEachFamily(on, [&](int i) {
    const Vec3l border = primitive(cross(normals[i], line));
    borders.push_back(border);
    borders.push_back(-border);
  });
  std::vector<Families> found;
  for (std::size_t a = 0; a < borders.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3l w = borders[a] + borders[b];
      if (containing(normals, on, w) == 0) found.push_back(aboveOf(normals, on, w));
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void findRays(const std::vector<Vec3l>& normals, const std::vector<int>& members, Central& made) {
  std::vector<Vec3l> directions;
  for (std::size_t a = 0; a < members.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3l d = primitive(cross(normals[members[a]], normals[members[b]]));
      directions.push_back(d);
      directions.push_back(-d);
    }
  }
  std::ranges::sort(directions, [](const Vec3l& a, const Vec3l& b) { return before(a, b); });
  directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
  for (const Vec3l& d : directions) {
    made.rays.push_back(
        {d, containing(normals, made.families, d), aboveOf(normals, made.families, d), 0, {}});
  }
  for (Central::Ray& ray : made.rays) ray.opposite = made.ray(-ray.direction);
}

std::unique_ptr<const Central> makeCentral(const std::vector<Vec3l>& normals, Families families) {
  auto made = std::make_unique<Central>();
  made->families = families;
  std::vector<int> members;
  forEachFamily(families, [&](int i) { members.push_back(i); });
  if (members.empty()) {
    made->cells = {0};
    return made;
  }
  if (members.size() == 1) {
    made->rank = 1;
    made->cells = {0, families};
    return made;
  }
  const Vec3l line = primitive(cross(normals[members[0]], normals[members[1]]));
  if (containing(normals, families, line) == families) {
    made->rank = 2;
    made->cells = sectors(normals, families, line);
    return made;
  }
  made->rank = 3;
  findRays(normals, members, *made);
  // Every cell is pointed and so has a ray.
  for (const Central::Ray& ray : made->rays)
    for (const Families sector : sectors(normals, ray.on, ray.direction))
      made->cells.push_back(ray.above | sector);
  std::ranges::sort(made->cells);
  made->cells.erase(std::unique(made->cells.begin(), made->cells.end()), made->cells.end());
  made->raysOfCell.resize(made->cells.size());
  for (std::uint32_t r = 0; r < made->rays.size(); ++r) {
    Central::Ray& ray = made->rays[r];
    for (std::uint32_t c = 0; c < made->cells.size(); ++c) {
      if ((made->cells[c] & ~ray.on) != ray.above) continue;
      made->raysOfCell[c].push_back(r);
      ray.around.push_back(c);
    }
    std::ranges::sort(ray.around, {}, [&](std::uint32_t c) { return made->cells[c] & ray.on; });
  }
  return made;
}

}  // namespace

std::uint32_t Central::cell(Families above) const {
  return static_cast<std::uint32_t>(std::ranges::lower_bound(cells, above) - cells.begin());
}

std::uint32_t Central::ray(const Vec3l& direction) const {
  const auto found =
      std::lower_bound(rays.begin(), rays.end(), direction,
                       [](const Ray& ray, const Vec3l& d) { return before(ray.direction, d); });
  if (found == rays.end() || found->direction != direction)
    throw std::logic_error("Central::ray: no such direction");
  return static_cast<std::uint32_t>(found - rays.begin());
}

const Central& Centrals::of(Families families) const {
  const std::scoped_lock lock(mutex_);
  std::unique_ptr<const Central>& made = made_[families];
  if (!made) made = makeCentral(normals_, families);
  return *made;
}

}  // namespace exemplar::continuous
