// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/block_counts.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace exemplar {
namespace {

std::uint64_t mixed(std::uint64_t v) {  // SplitMix64
  v += 0x9E3779B97F4A7C15u;
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
  return v ^ (v >> 31);
}

/// How often a block at a place along an axis of the example should occur along that axis of the
/// result, `from` and `to` being how many places there are.
double ratioAlong(int place, int from, int to, bool sides) {
  if (!sides || from < 3 || to < 3) return double(to) / from;
  return place == 0 || place == from - 1 ? 1 : double(to - 2) / (from - 2);
}

/// What the user's weights make of the number of blocks that hold these labels: the weight that is
/// furthest from 1 counts.
double weightOf(double a, double b) { return std::abs(std::log(a)) > std::abs(std::log(b)) ? a : b; }

}  // namespace

BlockCounts::BlockCounts(const ModelProblem& problem, std::span<const PatchSource> sources,
                         const Progress& progress)
    : problem_(&problem),
      size_(problem.options().size),
      frames_(problem.options().frames),
      periodic_(problem.options().periodic) {
  Vec3i most = size_;
  for (const PatchSource& s : sources) most = min(most, s.size);
  for (int b = 0; b <= problem.network().labels; ++b) {
    code_.push_back(mixed(static_cast<std::uint64_t>(b)));
  }
  for (int side = 0; side < kSides; ++side) {
    shape_[side] = min(most, Vec3i{side + 1, side + 1, side + 1});
    for (int i = 0; i < volume(shape_[side]); ++i) {
      factor_[side].push_back(mixed(0x10000u * (side + 1) + i) | 1);
    }
    for (int axis = 0; axis < 3; ++axis) {
      places1_[side][axis] = periodic_[axis] ? size_[axis] : size_[axis] - shape_[side][axis] + 1;
    }
  }
  slots_.resize(1024);
  countSources(sources, progress);
}

std::uint64_t BlockCounts::hashAt(int side, const Label* lowest, std::int64_t sx, std::int64_t sy,
                                  std::int64_t sz) const {
  const Vec3i n = shape_[side];
  const std::uint64_t* factor = factor_[side].data();
  const std::size_t none = code_.size() - 1;
  std::uint64_t hash = 0;
  for (int x = 0; x < n.x; ++x) {
    for (int y = 0; y < n.y; ++y) {
      const Label* p = lowest + x * sx + y * sy;
      for (int z = 0; z < n.z; ++z) {
        hash += code_[std::min<std::size_t>(p[z * sz], none)] * *factor++;
      }
    }
  }
  return hash ^ hash >> 32;
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
  // Along which axes the result has sides like the example's.
  std::array<bool, 3> sides{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto kind = [&](int s) { return o.sides[2 * axis + s].kind; };
    sides[axis] = !o.periodic[axis] && kind(0) == SideRule::Kind::Example &&
                  kind(1) == SideRule::Kind::Example;
  }
  const bool stands = !o.periodic.z && (o.sides[4].kind != SideRule::Kind::Free ||
                                        o.sides[5].kind != SideRule::Kind::Free);
  const std::size_t none = code_.size() - 1;
  const int labels = problem_->network().labels;
  target_.assign(labels, 0);  // single cells: their labels are their numbers
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
      const std::int64_t sz = source.frames, sy = sz * source.size.z, sx = sy * source.size.y;
      for (int x = 0; x < from.x; ++x) {
        progress.check();
        const double wx = times * ratioAlong(x, from.x, places1_[side].x, sides[0]);
        for (int y = 0; y < from.y; ++y) {
          const double wy = wx * ratioAlong(y, from.y, places1_[side].y, sides[1]);
          for (int z = 0; z < from.z; ++z) {
            const double wz =
                stands || source.size.z == size_.z ? wy : wy * places1_[side].z / from.z;
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
                    if (whole && !o.weights.empty()) weight = weightOf(weight, o.weights[b]);
                  }
                }
              }
              if (!whole) continue;
              const std::int32_t id = side == 0 ? std::int32_t{*lowest}
                                                : findOrAdd(side, hashAt(side, lowest, sx, sy, sz));
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

  // More or less air above is as it must be: what is alike all through makes up the number.
  for (int side = 0; side < kSides && stands; ++side) {
    double all = 0;
    const std::size_t last =
        side + 1 < kSides ? static_cast<std::size_t>(firstOf_[side + 1]) : target_.size();
    for (std::size_t b = firstOf_[side]; b < last; ++b) all += target_[b];
    const PatchSource& source = sources[0];
    const std::int64_t sz = source.frames, sy = sz * source.size.z, sx = sy * source.size.y;
    const Vec3i corner = source.size - shape_[side];
    const Label* top = source.labels.data() + source.position(corner, 0);
    if (source.size.z == size_.z || *top >= none) continue;
    const std::int32_t air =
        side == 0 ? std::int32_t{*top} : find(side, hashAt(side, top, sx, sy, sz));
    target_[air] += static_cast<double>(volume(places1_[side])) * frames_ - all;
    target_[air] = std::max(target_[air], 0.0);
  }
}

std::int32_t BlockCounts::blockIn(int side, std::span<const Label> grid, const Vec3i& p,
                                  int frame) const {
  const Vec3i n = shape_[side];
  const std::int64_t sz = frames_, sy = sz * size_.z, sx = sy * size_.y;
  const Label* lowest = grid.data() + (p.x * sx + p.y * sy + p.z * sz + frame);
  if (p.x + n.x <= size_.x && p.y + n.y <= size_.y && p.z + n.z <= size_.z) {
    return find(side, hashAt(side, lowest, sx, sy, sz));
  }
  // It goes on at the other end of a periodic axis.
  std::array<Label, 27> labels;
  std::size_t i = 0;
  for (int x = 0; x < n.x; ++x) {
    for (int y = 0; y < n.y; ++y) {
      for (int z = 0; z < n.z; ++z) {
        const Vec3i q{(p.x + x) % size_.x, (p.y + y) % size_.y, (p.z + z) % size_.z};
        labels[i++] = grid[q.x * sx + q.y * sy + q.z * sz + frame];
      }
    }
  }
  return find(side, hashAt(side, labels.data(), n.y * n.z, n.z, 1));
}

void BlockCounts::count(std::span<const Label> grid, const Progress& progress) {
  count_.assign(target_.size(), 0);
  unknown_ = 0;
  for (const Label b : grid) {
    if (b + std::size_t{1} < code_.size()) count_[b] += 1;
  }
  for (int side = 1; side < kSides; ++side) {
    ids_[side].assign(grid.size(), kUnknown);
    const Vec3i n = places1_[side];
    parallelFor(0, static_cast<std::size_t>(n.x), 1, [&](std::size_t begin, std::size_t end) {
      for (int x = static_cast<int>(begin); x < static_cast<int>(end); ++x) {
        progress.check();
        for (int y = 0; y < n.y; ++y) {
          for (int z = 0; z < n.z; ++z) {
            for (int t = 0; t < frames_; ++t) {
              ids_[side][problem_->position({x, y, z}, t)] = blockIn(side, grid, {x, y, z}, t);
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
                       Change& change) const {
  for (auto& list : change.touched) list.clear();
  if (changed.empty()) return;
  const std::int32_t none = static_cast<std::int32_t>(code_.size()) - 1;
  Vec3i low = changed[0].cell, high = low;
  int first = changed[0].frame, last = first;
  for (const Changed& c : changed) {
    const std::int64_t at = problem_->position(c.cell, c.frame);
    const std::int32_t now = grid[at], before = c.before;
    change.touched[0].push_back({static_cast<std::int32_t>(at), before < none ? before : kUnknown,
                                 now < none ? now : kUnknown});
    low = min(low, c.cell);
    high = max(high, c.cell);
    first = std::min(first, c.frame);
    last = std::max(last, c.frame);
  }
  for (int side = 1; side < kSides; ++side) {
    const Vec3i n = shape_[side];
    const Vec3i corner = low - n + Vec3i{1, 1, 1};
    const Vec3i box = high - corner + Vec3i{1, 1, 1};
    const int frames = last - first + 1;
    change.seen.assign((static_cast<std::size_t>(volume(box)) * frames + 63) / 64, 0);
    for (const Changed& c : changed) {
      for (int x = 0; x < n.x; ++x) {
        for (int y = 0; y < n.y; ++y) {
          for (int z = 0; z < n.z; ++z) {
            Vec3i p = c.cell - Vec3i{x, y, z};
            const Vec3i q = p - corner;
            const std::size_t bit =
                ((static_cast<std::size_t>(q.x) * box.y + q.y) * box.z + q.z) * frames +
                (c.frame - first);
            if (change.seen[bit / 64] >> (bit % 64) & 1) continue;
            change.seen[bit / 64] |= std::uint64_t{1} << (bit % 64);
            bool inside = true;
            for (int axis = 0; axis < 3; ++axis) {
              if (p[axis] < 0 && periodic_[axis]) p[axis] += size_[axis];
              inside = inside && p[axis] >= 0 && p[axis] < places1_[side][axis];
            }
            if (!inside) continue;
            const std::int64_t at = problem_->position(p, c.frame);
            const std::int32_t now = blockIn(side, grid, p, c.frame), before = ids_[side][at];
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

double BlockCounts::add(const Change& change) {
  static const double w1 = getenv("W1") ? atof(getenv("W1")) : 1, w2 = getenv("W2") ? atof(getenv("W2")) : 1;
  double more = 0;
  for (const auto& list : change.touched) {
    double here = 0;
    for (const Touched& t : list) here += shift(t.before, -1) + shift(t.now, 1);
    more += here * (&list == &change.touched[0] ? w1 : &list == &change.touched[1] ? w2 : 1);
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
  for (std::size_t b = 0; b < target_.size(); ++b) sum += std::abs(count_[b] - target_[b]);
  return sum;
}

}  // namespace exemplar
