// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/pyramid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sdf/resample.h"

namespace exemplar {
namespace {

/// A guide speaks of more than single samples: both sides are means this far around, samples.
constexpr int kGuideBlur = 1;
/// Patches do not become smaller than this to fit between holes, samples a side.
constexpr int kSmallestPatch = 3;

/// Which of the six sides are air all over, in all parts: bit 2 * axis for the low side, + 1 for
/// the high.
int airSides(std::span<const SourcePart> parts) {
  int sides = 0b111111;
  for (const SourcePart& part : parts) {
    const Array3D<float>& values = part.field.values;
    const Vec3i last = values.size() - Vec3i{1, 1, 1};
    for (std::size_t s = 0; s < values.count(); ++s) {
      if (values.values()[s] > 0) continue;
      const Vec3i p = values.ijk(s);
      for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] == 0) sides &= ~(1 << (2 * axis));
        if (p[axis] == last[axis]) sides &= ~(2 << (2 * axis));
      }
    }
  }
  return sides;
}

/// A cell of a coarser grid counts where all of its samples do.
Array3D<std::uint8_t> shrunkMask(const Array3D<std::uint8_t>& mask, int shrink) {
  const Vec3i n = mask.size();
  Array3D<std::uint8_t> coarse(
      {(n.x + shrink - 1) / shrink, (n.y + shrink - 1) / shrink, (n.z + shrink - 1) / shrink}, 1);
  for (std::size_t s = 0; s < mask.count(); ++s) {
    if (mask.values()[s]) continue;
    const Vec3i p = mask.ijk(s);
    coarse(p.x / shrink, p.y / shrink, p.z / shrink) = 0;
  }
  return coarse;
}

/// The mean over boxes of 2 `reach` + 1 samples a side, cut off at the grid's faces.
Array3D<float> blurred(Array3D<float> grid, int reach) {
  const Vec3i n = grid.size();
  for (int axis = 0; axis < 3; ++axis) {
    Array3D<float> next(n);
    for (std::size_t s = 0; s < grid.count(); ++s) {
      Vec3i p = grid.ijk(s);
      const int from = std::max(0, p[axis] - reach), to = std::min(n[axis] - 1, p[axis] + reach);
      float sum = 0;
      for (int i = from; i <= to; ++i) {
        p[axis] = i;
        sum += grid[p];
      }
      next.values()[s] = sum / static_cast<float>(to - from + 1);
    }
    grid = std::move(next);
  }
  return grid;
}

/// A sample of a target brought inside along periodic axes.
Vec3i wrapped(const PyramidLevel& level, Vec3i p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!level.periodic[axis]) continue;
    const int n = level.targetSize[axis];
    const int inner = (p[axis] - level.before[axis]) % n;
    p[axis] = level.before[axis] + (inner < 0 ? inner + n : inner);
  }
  return p;
}

/// Where patches may be matched: wholly inside one part's frame and on usable samples only.
Array3D<std::uint8_t> findAllowed(const PyramidLevel& level) {
  const Vec3i n = level.source.size();
  Array3D<std::uint8_t> free(n);
  for (std::size_t part = 0; part < level.first.size(); ++part) {
    const Vec3i low = level.first[part] - level.low;
    const Vec3i end = level.first[part] + level.partSize[part] + level.high;
    for (int k = low.z; k < end.z; ++k) {
      for (int j = low.y; j < end.y; ++j) {
        for (int i = low.x; i < end.x; ++i) free(i, j, k) = level.usable(i, j, k);
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    Array3D<std::uint8_t> next(n);
    for (std::size_t s = 0; s < free.count(); ++s) {
      Vec3i p = free.ijk(s);
      if (p[axis] + level.patch[axis] > n[axis]) continue;
      std::uint8_t all = 1;
      for (int i = 0; i < level.patch[axis] && all; ++i, ++p[axis]) all = free[p];
      next.values()[s] = all;
    }
    free = std::move(next);
  }
  return free;
}

bool anySet(const Array3D<std::uint8_t>& mask) {
  return std::any_of(mask.values().begin(), mask.values().end(), [](auto m) { return m != 0; });
}

}  // namespace

Vec3i SourcePart::unturned(const Vec3i& cell) const {
  const Vec3i n = field.size();
  switch (turns) {
    case 1:
      return {cell.y, n.x - 1 - cell.x, cell.z};
    case 2:
      return {n.x - 1 - cell.x, n.y - 1 - cell.y, cell.z};
    case 3:
      return {n.y - 1 - cell.y, cell.x, cell.z};
    default:
      return cell;
  }
}

DistanceField turnedField(const DistanceField& field, int turns) {
  SourcePart part;
  part.turns = turns;
  part.field = field;
  const Vec3i n = field.size();
  part.field.values = Array3D<float>(turns % 2 ? Vec3i{n.y, n.x, n.z} : n);
  for (std::size_t s = 0; s < part.field.values.count(); ++s) {
    part.field.values.values()[s] = field.values[part.unturned(part.field.values.ijk(s))];
  }
  return std::move(part.field);
}

std::size_t PyramidLevel::partOf(const Vec3i& cell) const {
  std::size_t part = 0;
  while (part + 1 < first.size() && cell.x >= first[part + 1].x - low.x) ++part;
  return part;
}

Array3D<std::uint8_t> PyramidLevel::airSamples() const {
  if (low == Vec3i{0, 0, 0} && high == Vec3i{0, 0, 0}) return {};
  Array3D<std::uint8_t> air(framedTarget());
  const Vec3i end = before + targetSize;
  for (std::size_t s = 0; s < air.count(); ++s) {
    const Vec3i p = air.ijk(s);
    for (int axis = 0; axis < 3; ++axis) {
      if (low[axis] > 0 && p[axis] <= before[axis]) air.values()[s] = 1;
      if (high[axis] > 0 && p[axis] >= end[axis] - 1) air.values()[s] = 1;
    }
  }
  return air;
}

PyramidLevel makeLevel(std::span<const SourcePart> parts, int l, const PyramidOptions& options) {
  const int shrink = 1 << l;
  const int sides = airSides(parts);
  const float limit = static_cast<float>(options.truncation);
  PyramidLevel level;
  level.periodic = options.periodic;
  for (int axis = 0; axis < 3; ++axis) {
    level.targetSize[axis] = (options.size[axis] + shrink - 1) / shrink;
    const bool frame = !options.periodic[axis];
    level.low[axis] = frame && (sides >> (2 * axis) & 1) ? options.patch / 2 : 0;
    level.high[axis] = frame && (sides >> (2 * axis) & 2) ? options.patch / 2 : 0;
    level.before[axis] = frame ? level.low[axis] : options.patch - 1;
    level.after[axis] = frame ? level.high[axis] : options.patch - 1;
  }

  std::vector<Array3D<float>> values;
  Vec3i size{0, 0, 0};
  bool masked = parts.size() > 1;
  for (const SourcePart& part : parts) {
    const DistanceField shrunk = shrink == 1 ? part.field : blockAverage(part.field, shrink);
    masked = masked || !part.usable.empty();
    level.first.push_back(Vec3i{size.x + (size.x > 0), 0, 0} + level.low);
    level.partSize.push_back(shrunk.size());
    const Vec3i framed = shrunk.size() + level.low + level.high;
    size = {level.first.back().x - level.low.x + framed.x, std::max(size.y, framed.y),
            std::max(size.z, framed.z)};
    values.push_back(shrunk.values);
    for (float& v : values.back().values()) v /= static_cast<float>(shrunk.voxelSize);
  }
  level.source = Array3D<float>(size, parts.size() > 1 ? -limit : limit);
  level.patch = Vec3i{options.patch, options.patch, options.patch};
  for (const Vec3i& part : level.partSize) {
    level.patch = min(level.patch, part + level.low + level.high);
  }
  level.patch = min(level.patch, level.framedTarget());

  if (masked) level.usable = Array3D<std::uint8_t>(size);
  if (options.guide) level.guideSource = Array3D<float>(size);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Vec3i framed = level.partSize[n] + level.low + level.high;
    Array3D<std::uint8_t> usable;
    if (!parts[n].usable.empty()) usable = shrunkMask(parts[n].usable, shrink);
    Array3D<float> part(framed, limit);
    for (std::size_t s = 0; s < values[n].count(); ++s) {
      part[values[n].ijk(s) + level.low] = std::clamp(values[n].values()[s], -limit, limit);
    }
    const Array3D<float> coarse = options.guide ? blurred(part, kGuideBlur) : Array3D<float>();
    for (std::size_t s = 0; s < part.count(); ++s) {
      const Vec3i p = part.ijk(s), cell = p + level.first[n] - level.low;
      level.source[cell] = part.values()[s];
      if (options.guide) level.guideSource[cell] = coarse.values()[s];
      if (masked) {
        level.usable[cell] =
            usable.empty() || !usable.contains(p - level.low) || usable[p - level.low];
      }
    }
  }
  if (masked) {
    // Between holes there may only be room for smaller patches.
    level.allowed = findAllowed(level);
    while (!anySet(level.allowed) && level.patch.x > kSmallestPatch) {
      level.patch = max(level.patch - Vec3i{2, 2, 2}, min(level.patch, Vec3i{1, 1, 1}));
      level.allowed = findAllowed(level);
    }
    if (!anySet(level.allowed)) level.allowed = {};
  }
  for (int axis = 0; axis < 3; ++axis) {
    level.after[axis] += (level.framedTarget()[axis] - level.patch[axis]) % options.stride;
  }

  if (options.kept) {
    level.kept = Array3D<std::uint8_t>(level.framedTarget());
    const Array3D<std::uint8_t> kept = shrunkMask(*options.kept, shrink);
    for (std::size_t s = 0; s < kept.count(); ++s) {
      const Vec3i p = kept.ijk(s) + level.before;
      level.kept[p] = kept.values()[s] && level.source.contains(level.keptSource(p));
    }
  }
  if (options.guide) {
    DistanceField guide;
    guide.values = *options.guide;
    const Array3D<float> shrunk = shrink == 1 ? guide.values : blockAverage(guide, shrink).values;
    level.guideTarget = Array3D<float>(level.framedTarget(), limit);
    for (std::size_t s = 0; s < level.guideTarget.count(); ++s) {
      const Vec3i p = wrapped(level, level.guideTarget.ijk(s)) - level.before;
      if (!shrunk.contains(p) && (level.low != Vec3i{0, 0, 0} || level.high != Vec3i{0, 0, 0})) {
        continue;
      }
      level.guideTarget.values()[s] =
          std::clamp(shrunk[shrunk.clamped(p)] / static_cast<float>(shrink), -limit, limit);
    }
    level.guideTarget = blurred(std::move(level.guideTarget), kGuideBlur);
  }
  return level;
}

PyramidSources refineSources(const PyramidLevel& coarse, const PyramidSources& from,
                             const PyramidLevel& fine) {
  PyramidSources sources(fine.framedTarget());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i inner = sources.ijk(s) - fine.before;  // may lie in the frame
    Vec3i half;
    for (int axis = 0; axis < 3; ++axis) half[axis] = inner[axis] >> 1;
    const Vec3i origin = from[from.clamped(half + coarse.before)];
    const std::size_t part = coarse.partOf(origin);
    Vec3i cell;
    for (int axis = 0; axis < 3; ++axis) {
      const int first = fine.first[part][axis];
      cell[axis] = std::clamp(
          2 * (origin[axis] - coarse.first[part][axis]) + (inner[axis] & 1) + first,
          first - fine.low[axis], first + fine.partSize[part][axis] + fine.high[axis] - 1);
    }
    sources.values()[s] = cell;
  }
  return sources;
}

Array3D<float> gather(const PyramidLevel& level, const PyramidSources& sources) {
  Array3D<float> target(sources.size());
  for (std::size_t s = 0; s < sources.count(); ++s) {
    target.values()[s] = level.source[sources.values()[s]];
  }
  return target;
}

void pinTarget(const PyramidLevel& level, float air, Array3D<float>& target) {
  const Vec3i end = level.before + level.targetSize;
  for (std::size_t s = 0; s < target.count(); ++s) {
    const Vec3i p = target.ijk(s), inside = wrapped(level, p);
    if (inside != p) {
      // Inside there may be something that is kept, or a frame along another axis.
      target.values()[s] = target[inside];
    }
    if (!level.kept.empty() && level.kept[inside]) {
      target.values()[s] = level.source[level.keptSource(inside)];
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (inside[axis] < level.before[axis] || inside[axis] >= end[axis]) {
        // Without air there the target only has some samples more than the result.
        const bool framed = inside[axis] < level.before[axis] || level.high[axis] > 0;
        if (framed) target.values()[s] = air;
      }
    }
  }
}

void pinSources(const PyramidLevel& level, PyramidSources& sources) {
  for (std::size_t s = 0; s < sources.count(); ++s) {
    const Vec3i p = sources.ijk(s), inside = wrapped(level, p);
    if (!level.kept.empty() && level.kept[inside]) {
      sources.values()[s] = level.keptSource(inside);
    } else if (inside != p) {
      sources.values()[s] = sources[inside];
    }
  }
}

}  // namespace exemplar
