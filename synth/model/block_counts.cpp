// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/block_counts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "core/parallel.h"
#include "synth/model/column_ratios.h"

namespace exemplar {
namespace {

/// What a single cell of a label at a height counts for, in larger blocks: few labels too many or
/// too few change much.
constexpr double kSingle = 3;
double weightOf(int side) { return side == 0 ? kSingle : 1; }

std::uint64_t mixed(std::uint64_t v) {  // SplitMix64
  v += 0x9E3779B97F4A7C15u;
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
  return v ^ (v >> 31);
}

/// What the user's weights make of the number of blocks that hold these labels: the weight that is
/// furthest from 1 counts.
double strongerWeight(double a, double b) {
  return std::abs(std::log(a)) > std::abs(std::log(b)) ? a : b;
}

}  // namespace

BlockCounts::BlockCounts(const ModelProblem& problem, std::span<const PatchSource> sources,
                         const Progress& progress)
    : problem_(&problem),
      size_(problem.options().size),
      frames_(problem.options().frames),
      labels_(problem.network().labels),
      periodic_(problem.options().periodic),
      stands_(problem.heightsDiffer()) {
  Vec3i most = size_;
  for (const PatchSource& s : sources) most = min(most, s.size);
  for (int b = 0; b <= problem.network().labels; ++b) {
    code_.push_back(mixed(static_cast<std::uint64_t>(b)));
  }
  for (int side = 0; side < kSides; ++side) {
    shape_[side] = min(most, Vec3i{side + 1, side + 1, side + 1});
    for (int i = 0; i < shape_[side].x * shape_[side].y; ++i)
      across_[side].push_back(mixed(0x10000u * (side + 1) + i) | 1);
    for (int i = 0; i < shape_[side].z; ++i)
      up_[side].push_back(mixed(0x20000u * (side + 1) + i) | 1);
    for (int axis = 0; axis < 3; ++axis) {
      places1_[side][axis] = periodic_[axis] ? size_[axis] : size_[axis] - shape_[side][axis] + 1;
    }
  }
  slots_.resize(1024);
  countSources(sources, progress);
}

/// Of `layers` layers from `p` up (around, where the grid is periodic): the sum over the layer's
/// cells of a block.
void BlockCounts::sumLayers(int side, std::span<const Label> grid, const Vec3i& p, int frame,
                            int layers, std::vector<std::uint64_t>& sums) const {
  sums.assign(static_cast<std::size_t>(layers), 0);
  const std::size_t none = code_.size() - 1;
  const Vec3i n = shape_[side];
  const std::uint64_t* factor = across_[side].data();
  for (int x = p.x; x < p.x + n.x; ++x) {
    for (int y = p.y; y < p.y + n.y; ++y) {
      const int qx = x < size_.x ? x : x - size_.x, qy = y < size_.y ? y : y - size_.y;
      const Label* column = grid.data() + problem_->position({qx, qy, 0}, frame);
      for (int i = 0, z = p.z; i < layers; ++i, ++z) {
        if (z == size_.z) z = 0;
        const std::size_t label = column[static_cast<std::int64_t>(z) * frames_];
        sums[i] += code_[std::min(label, none)] * *factor;
      }
      ++factor;
    }
  }
}

std::uint64_t BlockCounts::hashOf(int side, const std::uint64_t* sums) const {
  std::uint64_t hash = 0;
  for (const std::uint64_t factor : up_[side]) {
    const std::uint64_t sum = *sums++;
    hash += (sum ^ sum >> 29) * factor;
  }
  return hash ^ hash >> 32;
}

std::uint64_t BlockCounts::hashAt(int side, const PatchSource& source, const Vec3i& p,
                                  int frame) const {
  const std::size_t none = code_.size() - 1;
  const Vec3i n = shape_[side];
  std::array<std::uint64_t, kSides> sums{};
  for (int z = 0; z < n.z; ++z) {
    const std::uint64_t* factor = across_[side].data();
    for (int x = 0; x < n.x; ++x) {
      for (int y = 0; y < n.y; ++y) {
        const std::size_t label = source.at(p + Vec3i{x, y, z}, frame);
        sums[z] += code_[std::min(label, none)] * *factor++;
      }
    }
  }
  return hashOf(side, sums.data());
}

std::int32_t BlockCounts::find(int side, std::uint64_t hash) const {
  hash += static_cast<std::uint64_t>(side);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = hash & mask;; i = (i + 1) & mask) {
    if (slots_[i].id == kUnknown) return kUnknown;
    if (slots_[i].hash == hash) return slots_[i].id;
  }
}

std::int32_t BlockCounts::findOrAdd(int side, std::uint64_t hash) {
  const std::int32_t known = find(side, hash);
  if (known != kUnknown) return known;
  if (2 * ++used_ > slots_.size()) grow();
  hash += static_cast<std::uint64_t>(side);
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hash & mask;
  while (slots_[i].id != kUnknown) i = (i + 1) & mask;
  slots_[i] = {hash, static_cast<std::int32_t>(target_.size())};
  target_.push_back(0);
  return slots_[i].id;
}

void BlockCounts::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  const std::size_t mask = slots_.size() - 1;
  for (const Slot& s : old) {
    if (s.id == kUnknown) continue;
    std::size_t i = s.hash & mask;
    while (slots_[i].id != kUnknown) i = (i + 1) & mask;
    slots_[i] = s;
  }
}

void BlockCounts::countSources(std::span<const PatchSource> sources, const Progress& progress) {
  const ModelOptions& o = problem_->options();
  std::array<bool, 2> ends{};
  bool nothingCut = true;
  for (int axis = 0; axis < 2; ++axis) {
    const SideRule &low = o.sides[2 * axis], &high = o.sides[2 * axis + 1];
    ends[axis] = !o.periodic[axis] && low.likeExample() && high.likeExample();
    nothingCut = nothingCut && ends[axis] && low.excludes() && high.excludes();
  }
  const auto none = static_cast<std::size_t>(labels_);
  // Single cells: their labels, perhaps at each height, are their numbers.
  target_.assign(none * (stands_ ? size_.z : 1), 0);
  std::vector<ColumnRatios> columnsOf;
  for (const PatchSource& source : sources)
    columnsOf.emplace_back(source, size_, ends, nothingCut, o.reach);
  struct Shown {
    std::int32_t block;
    Place place;
  };
  std::vector<Shown> shown;
  for (int side = 0; side < kSides; ++side) {
    firstOf_[side] = side == 0 ? 0 : static_cast<std::int32_t>(target_.size());
    const Vec3i n = shape_[side];
    for (std::size_t s = 0; s < sources.size(); ++s) {
      const PatchSource& source = sources[s];
      const Vec3i from = source.size - n + Vec3i{1, 1, 1};
      const double times = source.share * frames_ / source.frames;
      const std::vector<double> ratio = columnsOf[s].of(n, from, places1_[side]);
      const std::int64_t sz = source.frames, sy = sz * source.size.z, sx = sy * source.size.y;
      for (int x = 0; x < from.x; ++x) {
        progress.check();
        for (int y = 0; y < from.y; ++y) {
          const double wy = times * ratio[static_cast<std::size_t>(x) * from.y + y];
          for (int z = 0; z < from.z; ++z) {
            if (side == 0 && stands_ && z >= size_.z) break;
            const double wz =
                stands_ || source.size.z == size_.z ? wy : wy * places1_[side].z / from.z;
            for (int t = 0; t < source.frames; ++t) {
              const std::int64_t at = source.position({x, y, z}, t);
              const Label* lowest = source.labels.data() + at;
              double weight = 1;
              bool whole = true;
              for (int i = 0; i < n.x; ++i) {
                for (int j = 0; j < n.y; ++j) {
                  for (int k = 0; k < n.z; ++k) {
                    const Label b = lowest[i * sx + j * sy + k * sz];
                    whole = whole && b < none;
                    if (whole && !o.weights.empty()) weight = strongerWeight(weight, o.weights[b]);
                  }
                }
              }
              if (!whole) continue;
              const std::int32_t id = side == 0
                                          ? single(*lowest, z)
                                          : findOrAdd(side, hashAt(side, source, {x, y, z}, t));
              target_[id] += wz * weight;
              if (side == 2) {
                shown.push_back(
                    {id, {static_cast<std::int32_t>(s), static_cast<std::int32_t>(at)}});
              }
            }
          }
        }
      }
    }
  }
  std::stable_sort(shown.begin(), shown.end(),
                   [](const Shown& a, const Shown& b) { return a.block < b.block; });
  placeBegin_.assign(target_.size() - firstOf_[2] + 1, 0);
  for (const Shown& s : shown) {
    places_.push_back(s.place);
    ++placeBegin_[s.block - firstOf_[2] + 1];
  }
  for (std::size_t b = 1; b < placeBegin_.size(); ++b) placeBegin_[b] += placeBegin_[b - 1];

  if (stands_) fillUp(sources[0]);
}

/// More or less air above is as it must be: what is alike all through makes up the number.
void BlockCounts::fillUp(const PatchSource& source) {
  const Label top = source.at(source.size - Vec3i{1, 1, 1}, 0);
  if (source.size.z == size_.z || top >= labels_) return;
  const double columns = double(size_.x) * size_.y * frames_;
  for (int z = 0; z < size_.z; ++z) {
    const auto first = target_.begin() + single(0, z);
    const double all = std::accumulate(first, first + labels_, 0.0);
    target_[single(top, z)] += std::max(columns - all, 0.0);
  }
  for (int side = 1; side < kSides; ++side) {
    const auto first = target_.begin() + firstOf_[side];
    const auto last = side + 1 < kSides ? target_.begin() + firstOf_[side + 1] : target_.end();
    const double all = std::accumulate(first, last, 0.0);
    const std::int32_t air = find(side, hashAt(side, source, source.size - shape_[side], 0));
    target_[air] += static_cast<double>(volume(places1_[side])) * frames_ - all;
    target_[air] = std::max(target_[air], 0.0);
  }
}

void BlockCounts::count(std::span<const Label> grid, const Progress& progress) {
  count_.assign(target_.size(), 0);
  unknown_ = 0;
  for (std::size_t at = 0; at < grid.size(); ++at) {
    const Label b = grid[at];
    if (b < labels_)
      count_[single(b, static_cast<int>(static_cast<std::int64_t>(at) / frames_ % size_.z))] += 1;
  }
  for (int side = 1; side < kSides; ++side) {
    ids_[side].assign(grid.size(), kUnknown);
    const Vec3i n = places1_[side];
    parallelFor(0, static_cast<std::size_t>(n.x), 1, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint64_t> sums;
      for (int x = static_cast<int>(begin); x < static_cast<int>(end); ++x) {
        progress.check();
        for (int y = 0; y < n.y; ++y) {
          for (int t = 0; t < frames_; ++t) {
            sumLayers(side, grid, {x, y, 0}, t, n.z + shape_[side].z - 1, sums);
            for (int z = 0; z < n.z; ++z) {
              ids_[side][problem_->position({x, y, z}, t)] =
                  find(side, hashOf(side, sums.data() + z));
            }
          }
        }
      }
    });
    double places = static_cast<double>(volume(n)) * frames_;
    for (const std::int32_t id : ids_[side]) {
      if (id == kUnknown) continue;
      count_[id] += 1;
      places -= 1;
    }
    unknown_ += places;
  }
}

void BlockCounts::look(std::span<const Label> grid, std::span<const Changed> changed,
                       Change& change, bool largestOnly) const {
  for (auto& list : change.touched) list.clear();
  if (changed.empty()) return;
  const auto number = [&](Label label, int z) {
    return label < labels_ ? single(label, z) : kUnknown;
  };
  Vec3i low = changed[0].cell, high = low;
  int first = changed[0].frame, last = first;
  for (const Changed& c : changed) {
    const std::int64_t at = problem_->position(c.cell, c.frame);
    change.touched[0].push_back(
        {static_cast<std::int32_t>(at), number(c.before, c.cell.z), number(grid[at], c.cell.z)});
    low = min(low, c.cell);
    high = max(high, c.cell);
    first = std::min(first, c.frame);
    last = std::max(last, c.frame);
  }
  const int frames = last - first + 1;
  for (int side = largestOnly ? kSides - 1 : 1; side < kSides; ++side) {
    const Vec3i n = shape_[side];
    Vec3i corner = low - n + Vec3i{1, 1, 1};
    Vec3i box = high - corner + Vec3i{1, 1, 1};
    for (int axis = 0; axis < 3; ++axis) {
      // Around a periodic axis a block would come twice.
      if (!periodic_[axis] || corner[axis] >= 0) continue;
      corner[axis] = 0;
      box[axis] = size_[axis];
    }
    const std::size_t words = (static_cast<std::size_t>(box.z) + 63) / 64;
    change.seen.assign(static_cast<std::size_t>(box.x) * box.y * frames * words, 0);
    const auto columnAt = [&](int x, int y, int t) {
      return change.seen.data() + ((static_cast<std::size_t>(x) * box.y + y) * frames + t) * words;
    };
    for (const Changed& c : changed) {
      const Vec3i q = c.cell - corner;
      for (int i = q.x - n.x + 1; i <= q.x; ++i) {
        const int x = i < 0 ? i + box.x : i;
        for (int j = q.y - n.y + 1; j <= q.y; ++j) {
          const int y = j < 0 ? j + box.y : j;
          std::uint64_t* column = columnAt(x, y, c.frame - first);
          if (words == 1 && q.z >= n.z - 1) {
            *column |= ((std::uint64_t{1} << n.z) - 1) << (q.z - n.z + 1);
            continue;
          }
          for (int k = q.z - n.z + 1; k <= q.z; ++k) {
            const int z = k < 0 ? k + box.z : k;
            column[z / 64] |= std::uint64_t{1} << (z % 64);
          }
        }
      }
    }
    for (int x = 0; x < box.x; ++x) {
      for (int y = 0; y < box.y; ++y) {
        Vec3i p = corner + Vec3i{x, y, 0};
        bool inside = true;
        for (int axis = 0; axis < 2; ++axis) {
          inside = inside && p[axis] >= 0 && p[axis] < places1_[side][axis];
        }
        if (!inside) continue;
        for (int t = 0; t < frames; ++t) {
          const std::span<const std::uint64_t> column(columnAt(x, y, t), words);
          int begin = 0, end = box.z;
          const auto touched = [&](int z) { return column[z / 64] >> (z % 64) & 1; };
          if (words == 1) {
            if (column[0] == 0) continue;
            begin = std::countr_zero(column[0]);
            end = 64 - std::countl_zero(column[0]);
          }
          while (begin < end && !touched(begin)) ++begin;
          while (begin < end && !touched(end - 1)) --end;
          if (begin == end) continue;
          if (!periodic_.z) {
            begin = std::max(begin, -corner.z);
            end = std::min(end, places1_[side].z - corner.z);
            if (begin >= end) continue;
          }
          p.z = corner.z + begin;
          sumLayers(side, grid, p, first + t, end - begin + n.z - 1, change.sums);
          for (int z = begin; z < end; ++z, ++p.z) {
            if (!touched(z)) continue;
            const std::int64_t at = problem_->position(p, first + t);
            const std::int32_t now = find(side, hashOf(side, change.sums.data() + (z - begin)));
            const std::int32_t before = ids_[side][at];
            if (now == before) continue;
            change.touched[side].push_back({static_cast<std::int32_t>(at), before, now});
          }
        }
      }
    }
  }
}

double BlockCounts::shift(std::int32_t id, int by) {
  if (id == kUnknown) {
    unknown_ += by;
    return by;
  }
  const double before = std::abs(count_[id] - target_[id]);
  count_[id] += by;
  return std::abs(count_[id] - target_[id]) - before;
}

double BlockCounts::estimate(const Change& change) const {
  const auto shifted = [&](std::int32_t id, int by) {
    if (id == kUnknown) return double(by);
    return std::abs(count_[id] + by - target_[id]) - std::abs(count_[id] - target_[id]);
  };
  double more = 0;
  for (int side = 0; side < kSides; ++side) {
    double here = 0;
    for (const Touched& t : change.touched[side]) here += shifted(t.before, -1) + shifted(t.now, 1);
    more += weightOf(side) * here;
  }
  return more;
}

double BlockCounts::add(const Change& change) {
  double more = 0;
  for (int side = 0; side < kSides; ++side) {
    double here = 0;
    for (const Touched& t : change.touched[side]) here += shift(t.before, -1) + shift(t.now, 1);
    more += weightOf(side) * here;
  }
  return more;
}

void BlockCounts::takeOut(const Change& change) {
  for (const auto& list : change.touched) {
    for (const Touched& t : list) {
      shift(t.now, -1);
      shift(t.before, 1);
    }
  }
}

void BlockCounts::keep(const Change& change) {
  for (int side = 1; side < kSides; ++side) {
    for (const Touched& t : change.touched[side]) ids_[side][t.place] = t.now;
  }
}

double BlockCounts::energy() const {
  double sum = unknown_;
  for (std::size_t b = 0; b < target_.size(); ++b) {
    const bool single = static_cast<std::int32_t>(b) < firstOf_[1];
    sum += weightOf(single ? 0 : 1) * std::abs(count_[b] - target_[b]);
  }
  return sum;
}

}  // namespace exemplar
