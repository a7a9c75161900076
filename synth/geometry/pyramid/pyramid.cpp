// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/pyramid/pyramid.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "sdf/resample.h"

namespace exemplar {
namespace {

/// A guide is about more than single samples: both sides are means this far around, samples.
constexpr int kGuideBlur = 1;
/// Patches do not become smaller than this to fit between holes, samples a side.
constexpr int kSmallestPatch = 3;
/// Samples that one task works on at least.
constexpr std::size_t kGrain = 1 << 14;

/// Whether a part is air all over one of the sides of its box.
bool isAir(const Array3D<float>& values, int axis, bool high) {
  CellBox side = CellBox::of(values.size());
  (high ? side.begin : side.end)[axis] = high ? side.end[axis] - 1 : 1;
  bool air = true;
  forEachCell(side, [&](const Vec3i& p) { air = air && values[p] > 0; });
  return air;
}
bool allAreAir(std::span<const SourcePart> parts, int axis, bool high) {
  return std::ranges::all_of(
      parts, [&](const SourcePart& part) { return isAir(part.field.values, axis, high); });
}

/// A cell of a coarser grid has its samples' value where all have the same, else 0.
Array3D<std::uint8_t> shrunkMask(const Array3D<std::uint8_t>& mask, int shrink) {
  const Vec3i n = mask.size();
  Array3D<std::uint8_t> coarse(
      {(n.x + shrink - 1) / shrink, (n.y + shrink - 1) / shrink, (n.z + shrink - 1) / shrink});
  forEachCell(coarse.size(), [&](const Vec3i& p) { coarse[p] = mask[p * shrink]; });
  forEachCell(n, [&](const Vec3i& p) {
    std::uint8_t& cell = coarse(p.x / shrink, p.y / shrink, p.z / shrink);
    if (mask[p] != cell) cell = 0;
  });
  return coarse;
}

/// The mean over boxes of 2 `reach` + 1 samples a side, cut off at the grid's faces.
Array3D<float> blurred(Array3D<float> grid, int reach) {
  const Vec3i n = grid.size();
  for (int axis = 0; axis < 3; ++axis) {
    Array3D<float> next(n);
    parallelForEachCell(n, [&](const Vec3i& cell) {
      Vec3i p = cell;
      const int from = std::max(0, p[axis] - reach), to = std::min(n[axis] - 1, p[axis] + reach);
      float sum = 0;
      for (int i = from; i <= to; ++i) {
        p[axis] = i;
        sum += grid[p];
      }
      next[cell] = sum / static_cast<float>(to - from + 1);
    });
    grid = std::move(next);
  }
  return grid;
}

/// Where patches may be matched: wholly inside one part's frame and on usable samples only.
Array3D<std::uint8_t> findMatchable(const LevelSource& source, const Vec3i& patch) {
  const Vec3i n = source.values.size();
  Array3D<std::uint8_t> free(n);
  for (std::size_t part = 0; part < source.parts.size(); ++part) {
    forEachCell(source.framed(part), [&](const Vec3i& p) { free[p] = source.usable[p]; });
  }
  for (int axis = 0; axis < 3; ++axis) {
    Array3D<std::uint8_t> next(n);
    parallelForEachCell(n, [&](const Vec3i& cell) {
      Vec3i p = cell;
      if (p[axis] + patch[axis] > n[axis]) return;
      std::uint8_t all = 1;
      for (int i = 0; i < patch[axis] && all; ++i, ++p[axis]) all = free[p];
      next[cell] = all;
    });
    free = std::move(next);
  }
  return free;
}

bool anySet(const Array3D<std::uint8_t>& mask) {
  return std::any_of(mask.values().begin(), mask.values().end(), [](auto m) { return m != 0; });
}

/// A part, shrunk, in voxels of the level and cut off at `limit`, with its frame of air.
Array3D<float> framedPart(const DistanceField& field, const Margin& air, float limit) {
  Array3D<float> framed(field.size() + air.before + air.after, limit);
  const auto voxel = static_cast<float>(field.voxelSize);
  parallelForEachCell(field.size(), [&](const Vec3i& p) {
    framed[p + air.before] = std::clamp(field.values[p] / voxel, -limit, limit);
  });
  return framed;
}

/// The largest patch up to `patch` that fits into the target and each framed part.
Vec3i fittingPatch(const PyramidLevel& level, int patch) {
  Vec3i fitting = min(Vec3i{patch, patch, patch}, level.target.framed());
  for (std::size_t n = 0; n < level.source.parts.size(); ++n) {
    fitting = min(fitting, level.source.framed(n).size());
  }
  return fitting;
}

/// Finds where patches may be matched; between holes there may only be room for smaller ones.
void fitMatchable(PyramidLevel& level) {
  LevelSource& source = level.source;
  source.matchable = findMatchable(source, level.patch);
  while (!anySet(source.matchable) && level.patch.x > kSmallestPatch) {
    level.patch = max(level.patch - Vec3i{2, 2, 2}, min(level.patch, Vec3i{1, 1, 1}));
    source.matchable = findMatchable(source, level.patch);
  }
  if (!anySet(source.matchable)) source.matchable = {};
}

/// The target's guide, in voxels of the level: at its margins what lies at the other side, or what
/// its own edge shows; air where there is a frame.
Array3D<float> targetGuide(const PyramidLevel& level, const Array3D<float>& given, int shrink,
                           float limit) {
  DistanceField guide;
  guide.values = given;
  const Array3D<float> shrunk = shrink == 1 ? guide.values : blockAverage(guide, shrink).values;
  Array3D<float> target(level.target.framed(), limit);
  parallelForEachCell(target.size(), [&](const Vec3i& cell) {
    const Vec3i p = level.target.wrapped(cell) - level.target.margin.before;
    if (!shrunk.contains(p) && level.source.air.any()) return;
    target[cell] =
        std::clamp(shrunk[shrunk.clamped(p)] / static_cast<float>(shrink), -limit, limit);
  });
  return blurred(std::move(target), kGuideBlur);
}

}  // namespace

void checkPyramid(std::span<const DistanceField* const> examples, bool turned,
                  const PyramidOptions& options, std::optional<int> levels) {
  const auto fail = [](const std::string& what) { throw InputError(what); };
  if (examples.empty()) fail("no example is given");
  if (examples.size() > 255) fail("more than 255 examples");
  std::int64_t along = 0;
  for (const DistanceField* example : examples) {
    if (volume(example->size()) == 0) fail("the example has no samples");
    if (std::abs(example->voxelSize / examples[0]->voxelSize - 1) > 1e-3) {
      fail("the examples' voxels differ in size; sample them alike");
    }
    const Vec3i n = example->size();
    for (int axis = 0; axis < 3; ++axis) {
      if (n[axis] > 32767) fail("the example is longer than 32,767 samples");
    }
    along += turned ? 2 * (n.x + n.y + 2) : n.x + 1;
  }
  if (along > 32767) {
    fail(
        "the examples, turned and side by side, are longer than 32,767 samples; use a lower "
        "`resolution`");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (options.size[axis] < 1) fail("`size` must be at least 1 sample along each axis");
  }
  if (options.patch < 3 || options.patch > 15)
    fail("`patch` " + std::to_string(options.patch) + ": expected 3 to 15");
  if (levels && (*levels < 1 || *levels > 8))
    fail("`levels` " + std::to_string(*levels) + ": expected 1 to 8");
  if (!(options.truncation > 0)) fail("`truncation` must be above 0");
  requireMemory(120.0 * static_cast<double>(volume(options.size)), "a result of this size",
                "use a lower `resolution` or a smaller `scale`");
}

Progress levelProgress(const Progress& progress, int l, int levels) {
  // The levels before have 8^-1 + 8^-2 + ... of this one's samples.
  const double all = (1 - std::pow(8.0, -levels)), done = std::pow(8.0, -l - 1);
  const double coarsest = std::pow(8.0, -levels);
  return progress.part((done - coarsest) / all, (8 * done - coarsest) / all);
}

std::size_t LevelSource::partOf(const Vec3i& cell) const {
  std::size_t part = 0;
  while (part + 1 < parts.size() && cell.x >= parts[part + 1].begin.x - air.before.x) ++part;
  return part;
}

Vec3i LevelTarget::wrapped(Vec3i p) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (!periodic[axis]) continue;
    const int inner = (p[axis] - margin.before[axis]) % size[axis];
    p[axis] = margin.before[axis] + (inner < 0 ? inner + size[axis] : inner);
  }
  return p;
}

Array3D<std::uint8_t> PyramidLevel::airSamples() const {
  const Margin& air = source.air;
  if (!air.any()) return {};
  Array3D<std::uint8_t> samples(target.framed());
  const Vec3i begin = target.margin.before, end = begin + target.size;
  parallelForEachCell(samples.size(), [&](const Vec3i& p) {
    for (int axis = 0; axis < 3; ++axis) {
      if (air.before[axis] > 0 && p[axis] <= begin[axis]) samples[p] = 1;
      if (air.after[axis] > 0 && p[axis] >= end[axis] - 1) samples[p] = 1;
    }
  });
  return samples;
}

PyramidLevel makeLevel(std::span<const SourcePart> parts, int l, const PyramidOptions& options) {
  const int shrink = 1 << l;
  const float limit = static_cast<float>(options.truncation);
  PyramidLevel level;
  LevelSource& source = level.source;
  LevelTarget& target = level.target;
  target.periodic = options.periodic;
  for (int axis = 0; axis < 3; ++axis) {
    target.size[axis] = (options.size[axis] + shrink - 1) / shrink;
    if (options.periodic[axis]) {
      target.margin.before[axis] = target.margin.after[axis] = options.patch - 1;
      continue;
    }
    source.air.before[axis] = allAreAir(parts, axis, false) ? options.patch / 2 : 0;
    source.air.after[axis] = allAreAir(parts, axis, true) ? options.patch / 2 : 0;
    target.margin.before[axis] = source.air.before[axis];
    target.margin.after[axis] = source.air.after[axis];
  }

  std::vector<Array3D<float>> values;
  Vec3i size{0, 0, 0};
  bool masked = parts.size() > 1;
  for (const SourcePart& part : parts) {
    masked = masked || !part.usable.empty();
    values.push_back(shrink == 1 ? framedPart(part.field, source.air, limit)
                                 : framedPart(blockAverage(part.field, shrink), source.air, limit));
    const Vec3i framed = values.back().size();
    const Vec3i first = Vec3i{size.x + (size.x > 0), 0, 0} + source.air.before;
    source.parts.push_back({first, first + framed - source.air.before - source.air.after});
    size = {first.x - source.air.before.x + framed.x, std::max(size.y, framed.y),
            std::max(size.z, framed.z)};
  }
  source.values = Array3D<float>(size, parts.size() > 1 ? -limit : limit);
  level.patch = fittingPatch(level, options.patch);

  if (masked) source.usable = Array3D<std::uint8_t>(size);
  if (options.guide) level.guide.source = Array3D<float>(size);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Array3D<float>& part = values[n];
    Array3D<std::uint8_t> usable;
    if (!parts[n].usable.empty()) usable = shrunkMask(parts[n].usable, shrink);
    const Array3D<float> coarse = options.guide ? blurred(part, kGuideBlur) : Array3D<float>();
    parallelForEachCell(part.size(), [&](const Vec3i& p) {
      const Vec3i inside = p - source.air.before, cell = inside + source.parts[n].begin;
      source.values[cell] = part[p];
      if (options.guide) level.guide.source[cell] = coarse[p];
      if (masked) {
        source.usable[cell] = usable.empty() || !usable.contains(inside) || usable[inside];
      }
    });
  }
  if (masked) fitMatchable(level);
  for (int axis = 0; axis < 3; ++axis) {
    target.margin.after[axis] += (target.framed()[axis] - level.patch[axis]) % options.stride;
  }

  if (options.kept) {
    target.kept = Array3D<std::uint8_t>(target.framed());
    for (const Vec3i& offset : options.keptOffsets) {
      Vec3i coarse;
      for (int axis = 0; axis < 3; ++axis)
        coarse[axis] = static_cast<int>(std::lround(static_cast<double>(offset[axis]) / shrink));
      target.keptOffsets.push_back(coarse);
    }
    const Array3D<std::uint8_t> kept = shrunkMask(*options.kept, shrink);
    forEachCell(kept.size(), [&](const Vec3i& cell) {
      const Vec3i p = cell + target.margin.before;
      target.kept[p] = kept[cell];
      if (kept[cell] && !source.parts[0].contains(level.keptSource(p))) target.kept[p] = 0;
    });
  }
  if (options.guide) level.guide.target = targetGuide(level, *options.guide, shrink, limit);
  return level;
}

PyramidSources refineSources(const PyramidLevel& coarse, const PyramidSources& from,
                             const PyramidLevel& fine) {
  PyramidSources sources(fine.target.framed());
  parallelForEachCell(sources.size(), [&](const Vec3i& p) {
    const Vec3i inner = p - fine.target.margin.before;  // may lie in the frame
    Vec3i half;
    for (int axis = 0; axis < 3; ++axis) half[axis] = inner[axis] >> 1;
    const Vec3i origin = from[from.clamped(half + coarse.target.margin.before)];
    const std::size_t part = coarse.source.partOf(origin);
    const CellBox framed = fine.source.framed(part);
    const Vec3i first = fine.source.parts[part].begin;
    Vec3i cell;
    for (int axis = 0; axis < 3; ++axis) {
      const int within =
          2 * (origin[axis] - coarse.source.parts[part].begin[axis]) + (inner[axis] & 1);
      cell[axis] = std::clamp(within + first[axis], framed.begin[axis], framed.end[axis] - 1);
    }
    sources[p] = cell;
  });
  return sources;
}

Array3D<float> gather(const PyramidLevel& level, const PyramidSources& sources) {
  Array3D<float> target(sources.size());
  parallelFor(0, target.count(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      target.values()[s] = level.source.values[sources.values()[s]];
    }
  });
  return target;
}

void pinTarget(const PyramidLevel& level, float air, Array3D<float>& target) {
  const LevelTarget& made = level.target;
  const Vec3i begin = made.margin.before, end = begin + made.size;
  parallelForEachCell(target.size(), [&](const Vec3i& p) {
    // Whatever is repeated at the other side, a frame along another axis and what is kept, too.
    const Vec3i inside = made.wrapped(p);
    bool framed = false;
    for (int axis = 0; axis < 3; ++axis) {
      // Without air at its end the target only has some samples more than the result.
      framed = framed || inside[axis] < begin[axis] ||
               (inside[axis] >= end[axis] && level.source.air.after[axis] > 0);
    }
    if (framed) {
      target[p] = air;
    } else if (!made.kept.empty() && made.kept[inside]) {
      target[p] = level.source.values[level.keptSource(inside)];
    } else if (inside != p) {
      target[p] = target[inside];
    }
  });
}

void pinSources(const PyramidLevel& level, PyramidSources& sources) {
  const LevelTarget& made = level.target;
  if (made.kept.empty() && !made.periodic.any()) return;
  parallelForEachCell(sources.size(), [&](const Vec3i& p) {
    const Vec3i inside = made.wrapped(p);
    if (!made.kept.empty() && made.kept[inside]) {
      sources[p] = level.keptSource(inside);
    } else if (inside != p) {
      sources[p] = sources[inside];
    }
  });
}

}  // namespace exemplar
