// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/objects/loose_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/cells.h"
#include "core/random.h"
#include "synth/geometry/seams/regions.h"

namespace exemplar {
namespace {

// What these constants trade and what chose them: docs/synthesis.md, "Constants".

/// Parts are apart where the example is no farther from its solid than this, voxels: so there are
/// twice as many samples of air between any two.
constexpr float kApart = 1;
/// Fewest parts that lie about, and the most that one of them may be of all solid.
constexpr std::size_t kFewest = 3;
constexpr double kLargest = 0.5;
/// Parts hang in each other, as rings do, where their boxes share more than this of the smaller.
constexpr double kEntangled = 0.1;
/// A part brings the air around it, up to so many samples.
constexpr int kAir = 5;
/// How far parts are moved from their places, of the mean distance of places; how often that is
/// tried, and how often what found no room is tried elsewhere.
constexpr double kMoved = 0.25;
constexpr int kMoves = 6, kElsewhere = 60;

/// What is random: the order of parts, and where they go.
constexpr std::uint32_t kOrder = 0, kAlong = 1, kSlot = 4;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Part {
  CellBox box{{0, 0, 0}, {0, 0, 0}};  ///< of its solid
  std::int64_t solid = 0;
};

/// An example's parts; around each the samples that are nearest to it.
struct Parts {
  std::vector<Part> all;
  Array3D<std::uint32_t> nearest;  ///< kNone far from all
};

bool areEntangled(const std::vector<Part>& parts) {
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const CellBox both = parts[a].box & parts[b].box;
      const std::int64_t smaller =
          std::min(volume(parts[a].box.size()), volume(parts[b].box.size()));
      if (static_cast<double>(volume(both.size())) > kEntangled * static_cast<double>(smaller))
        return true;
    }
  }
  return false;
}

std::optional<Parts> findParts(const DistanceField& example) {
  const Vec3i n = example.size();
  const float apart = kApart * static_cast<float>(example.voxelSize);
  const auto isNear = [&](const Vec3i& p) { return example.values[p] < apart; };
  const Regions regions = findRegions(n, isNear);
  std::vector<Part> found(regions.count);
  std::int64_t solid = 0;
  regions.forEachRun([&](const Regions::Run& run, Vec3i p) {
    Part& part = found[run.region];
    for (; p.x < run.end; ++p.x) {
      if (!(example.values[p] < 0)) continue;
      if (part.solid++ == 0) part.box = {p, p + Vec3i{1, 1, 1}};
      part.box.begin = min(part.box.begin, p);
      part.box.end = max(part.box.end, p + Vec3i{1, 1, 1});
      ++solid;
    }
  });
  Parts parts;
  std::vector<std::uint32_t> numberOf(found.size(), kNone);
  for (std::size_t f = 0; f < found.size(); ++f) {
    const double share =
        static_cast<double>(found[f].solid) / static_cast<double>(std::max<std::int64_t>(1, solid));
    if (share > kLargest) return std::nullopt;
    if (found[f].solid == 0) continue;
    numberOf[f] = static_cast<std::uint32_t>(parts.all.size());
    parts.all.push_back(found[f]);
  }
  if (parts.all.size() < kFewest || areEntangled(parts.all)) return std::nullopt;
  parts.nearest = Array3D<std::uint32_t>(n, kNone);
  regions.forEachRun([&](const Regions::Run& run, Vec3i p) {
    if (!isNear(p)) return;
    for (; p.x < run.end; ++p.x) parts.nearest[p] = numberOf[run.region];
  });
  for (int step = 0; step < kAir; ++step) {
    const Array3D<std::uint32_t> before = parts.nearest;
    forEachCell(n, [&](const Vec3i& p) {
      if (before[p] != kNone) return;
      for (const Vec3i& d : kFaceSteps) {
        if (before.contains(p + d)) parts.nearest[p] = std::min(parts.nearest[p], before[p + d]);
      }
    });
  }
  return parts;
}

/// Where a part may go: the middle of its box, and its lowest layer.
struct Slot {
  Vec3d middle;
  int bottom;
};

class Strewing {
 public:
  Strewing(const DistanceField& example, const Parts& parts, const StrewOptions& options)
      : example_(example),
        parts_(parts),
        size_(options.size),
        random_(options.seed, stream::kParts),
        near_(kApart * static_cast<float>(example.voxelSize)) {
    const auto& values = example.values.values();
    const auto far = std::max_element(values.begin(), values.end());
    const Vec3i air = example.values.ijk(static_cast<std::size_t>(far - values.begin()));
    made_.field = {Array3D<float>(size_, *far), example.voxelSize, example.origin,
                   example.truncation};
    made_.origins = Origins(size_, Origin(air, 0, 0));
    taken_ = Array3D<std::uint8_t>(size_);
    const double larger = static_cast<double>(volume(size_)) / static_cast<double>(values.size());
    std::int64_t solid = 0;
    for (const Part& part : parts.all) solid += part.solid;
    wanted_ = static_cast<double>(solid) * larger;
    findSlots();
  }

  StrewnParts run(const Progress& progress) {
    if (slots_.empty()) return {std::move(made_), 0};
    std::vector<std::uint32_t> left;
    const std::vector<std::uint32_t> order = drawnParts();
    for (std::size_t s = 0; s < slots_.size(); ++s) {
      progress.check();
      progress.report("strewing parts",
                      static_cast<double>(s) / static_cast<double>(slots_.size()));
      if (isWanted(order[s]) && !layAt(slots_[s], order[s], s)) left.push_back(order[s]);
    }
    // What found no room, and what is still missing.
    for (std::uint64_t attempt = 0; attempt < kElsewhere * (left.size() + 1); ++attempt) {
      progress.check();
      const std::uint32_t part =
          left.empty() ? random_.below(count(), attempt, kOrder) : left.back();
      if (!isWanted(part) && left.empty()) continue;
      const std::uint64_t draw = slots_.size() + attempt;
      const auto slot = random_.below(static_cast<std::uint32_t>(slots_.size()), draw, kSlot);
      Vec3d middle = slots_[slot].middle;
      for (int axis = 0; axis < 2; ++axis)
        middle[axis] = random_.uniform(0, size_[axis], draw, kAlong + static_cast<unsigned>(axis));
      if (lay(part, middle, slots_[slot].bottom) && !left.empty()) left.pop_back();
    }
    return {std::move(made_), laid_};
  }

 private:
  std::uint32_t count() const { return static_cast<std::uint32_t>(parts_.all.size()); }

  /// Whether there is nearer to as much solid as there should be with a part than without it.
  bool isWanted(std::uint32_t part) const {
    return wanted_ - static_cast<double>(solid_) >= static_cast<double>(parts_.all[part].solid) / 2;
  }

  /// The example's places, laid side by side as far as the result goes.
  void findSlots() {
    const Vec3i n = example_.size();
    Vec3i copies;
    for (int axis = 0; axis < 3; ++axis) copies[axis] = (size_[axis] + n[axis] - 1) / n[axis];
    forEachCell(copies, [&](const Vec3i& copy) {
      for (const Part& part : parts_.all) {
        const Vec3i low = part.box.begin + Vec3i{copy.x * n.x, copy.y * n.y, copy.z * n.z};
        const Vec3d middle = cast<double>(low) + cast<double>(part.box.size()) * 0.5;
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) inside = inside && middle[axis] < size_[axis];
        if (inside) slots_.push_back({middle, low.z});
      }
    });
    const double area = static_cast<double>(size_.x) * size_.y;
    spacing_ = std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, slots_.size())));
  }

  /// Parts for all places, each as often as the others, in an order drawn for each round.
  std::vector<std::uint32_t> drawnParts() const {
    std::vector<std::uint32_t> drawn;
    for (std::uint64_t round = 0; drawn.size() < slots_.size(); ++round) {
      std::vector<std::uint32_t> parts(count());
      std::iota(parts.begin(), parts.end(), 0U);
      const auto key = [&](std::uint32_t part) {
        return random_.bits(round * count() + part, kOrder);
      };
      std::sort(parts.begin(), parts.end(),
                [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
      drawn.insert(drawn.end(), parts.begin(), parts.end());
    }
    return drawn;
  }

  bool layAt(const Slot& slot, std::uint32_t part, std::size_t number) {
    for (int move = 0; move <= kMoves; ++move) {
      Vec3d middle = slot.middle;
      const double reach = kMoved * spacing_ * (kMoves - move) / kMoves;
      for (int axis = 0; axis < 2; ++axis)
        middle[axis] += random_.uniform(-reach, reach, number * (kMoves + 1) + move,
                                        kAlong + static_cast<unsigned>(axis));
      if (lay(part, middle, slot.bottom)) return true;
    }
    return false;
  }

  /// Lays a part where nothing else is, inside the box with a sample of air; false where it cannot.
  bool lay(std::uint32_t number, const Vec3d& middle, int bottom) {
    const Part& part = parts_.all[number];
    Vec3i offset;
    for (int axis = 0; axis < 3; ++axis) {
      const double to = axis == 2 ? bottom : middle[axis] - part.box.size()[axis] / 2.0;
      const int most = size_[axis] - 1 - part.box.size()[axis];
      if (most < 1) return false;
      offset[axis] = std::clamp(static_cast<int>(std::lround(to)), 1, most) - part.box.begin[axis];
    }
    bool free = true;
    const CellBox box = part.box.grown(kAir);
    const auto overPart = [&](const auto& body) {
      forEachCell(box, [&](const Vec3i& from) {
        if (!example_.values.contains(from) || parts_.nearest[from] != number) return;
        if (taken_.contains(from + offset)) body(from, from + offset);
      });
    };
    overPart([&](const Vec3i& from, const Vec3i& p) {
      free = free && !(example_.values[from] < near_ && taken_[p]);
    });
    if (!free) return false;
    overPart([&](const Vec3i& from, const Vec3i& p) {
      const float value = example_.values[from];
      taken_[p] = taken_[p] || value < near_;
      if (value >= made_.field.values[p]) return;
      made_.field.values[p] = value;
      made_.origins[p] = Origin(from, 0, 0);
    });
    solid_ += part.solid;
    ++laid_;
    return true;
  }

  const DistanceField& example_;
  const Parts& parts_;
  Vec3i size_;
  Random random_;
  float near_;
  double wanted_ = 0, spacing_ = 0;
  std::vector<Slot> slots_;
  Array3D<std::uint8_t> taken_;  ///< where parts are, with the air that keeps them apart
  std::int64_t solid_ = 0;
  int laid_ = 0;
  SynthesisResult made_;
};

}  // namespace

std::optional<StrewnParts> strewParts(const DistanceField& example, const StrewOptions& options,
                                      const Progress& progress) {
  const std::optional<Parts> parts = findParts(example);
  if (!parts) return std::nullopt;
  return Strewing(example, *parts, options).run(progress);
}

}  // namespace exemplar
