// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/outlets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"

namespace exemplar {
namespace {

constexpr std::array<Pixel, 8> kSteps{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
constexpr std::uint8_t kOutlet = 8, kUnseen = 9;
/// How often lakes get levels: where banks have changed, water runs to others.
constexpr int kLevelings = 2;
/// Cuts that are less deep than this, of what banks rise in a step, have none.
constexpr float kShallow = 0.25f;
/// How much deeper, of the relief, land is cut rather than what is held passed over.
constexpr std::array<float, 6> kDeepCuts{0.03f, 0.06f, 0.12f, 0.25f, 0.5f, 1.0f};

/// Samples in the order of their heights, first come first served among about equal ones: a queue
/// of 2^18 buckets, in constant time. One that is empty may be used again.
class HeightQueue {
 public:
  explicit HeightQueue(std::size_t samples) : next_(samples), buckets_(kBuckets) {}
  /// The heights to come, of an empty queue.
  void setRange(float least, float most) {
    least_ = least;
    scale_ = most > least ? static_cast<float>(kBuckets - 1) / (most - least) : 0;
  }

  void push(std::uint32_t sample, float height) {
    const float place = (height - least_) * scale_;
    const auto bucket =
        static_cast<std::uint32_t>(std::clamp(place, 0.0f, static_cast<float>(kBuckets - 1)));
    Bucket& of = buckets_[bucket];
    next_[sample] = kNone;
    if (of.first == kNone) {
      of.first = sample;
      fine_[bucket >> 6] |= std::uint64_t{1} << (bucket & 63);
      middle_[bucket >> 12] |= std::uint64_t{1} << ((bucket >> 6) & 63);
      coarse_ |= std::uint64_t{1} << (bucket >> 12);
    } else {
      next_[of.last] = sample;
    }
    of.last = sample;
  }
  bool empty() const { return coarse_ == 0; }
  std::uint32_t pop() {
    const auto c = static_cast<std::uint32_t>(std::countr_zero(coarse_));
    const auto m = (c << 6) | static_cast<std::uint32_t>(std::countr_zero(middle_[c]));
    const auto bucket = (m << 6) | static_cast<std::uint32_t>(std::countr_zero(fine_[m]));
    Bucket& of = buckets_[bucket];
    const std::uint32_t sample = of.first;
    of.first = next_[sample];
    if (of.first == kNone) {
      fine_[m] &= fine_[m] - 1;
      if (fine_[m] == 0) middle_[c] &= middle_[c] - 1;
      if (middle_[c] == 0) coarse_ &= coarse_ - 1;
    }
    return sample;
  }

 private:
  static constexpr std::uint32_t kBuckets = 1u << 18, kNone = 0xffffffffu;
  struct Bucket {
    std::uint32_t first = kNone, last = kNone;
  };
  float least_ = 0, scale_ = 0;
  std::vector<std::uint32_t> next_;
  std::vector<Bucket> buckets_;
  std::array<std::uint64_t, kBuckets / 64> fine_{};
  std::array<std::uint64_t, kBuckets / 4096> middle_{};
  std::uint64_t coarse_ = 0;
};

/// The same, exactly in the order of heights: in logarithmic time.
class ExactQueue {
 public:
  void push(std::uint32_t sample, float height) {
    samples_.push_back({height, count_++, sample});
    std::ranges::push_heap(samples_, after);
  }
  bool empty() const { return samples_.empty(); }
  std::uint32_t pop() {
    std::ranges::pop_heap(samples_, after);
    const std::uint32_t sample = samples_.back().sample;
    samples_.pop_back();
    return sample;
  }

 private:
  struct Queued {
    float height;
    std::uint32_t number, sample;
  };
  static bool after(const Queued& a, const Queued& b) {
    return a.height != b.height ? a.height > b.height : a.number > b.number;
  }
  std::vector<Queued> samples_;
  std::uint32_t count_ = 0;
};

class Outlets {
 public:
  Outlets(Grid<float>& heights, const Grid<std::uint8_t>& held, const OutletOptions& options,
          const WaterBodies* water, const Progress& progress)
      : heights_(heights), held_(held), options_(options), water_(water), progress_(progress) {
    for (const float h : heights.values()) {
      if (std::isnan(h)) {
        hasGaps_ = true;
        continue;
      }
      least_ = std::min(least_, h);
      most_ = std::max(most_, h);
    }
    for (std::size_t d = 0; d < kSteps.size(); ++d)
      offsets_[d] = static_cast<std::uint32_t>(kSteps[d].y * heights.width() + kSteps[d].x);
  }

  OutletsCut run() {
    OutletsCut made;
    if (!(most_ > least_)) return made;
    if (water_) {
      lowerShores();
      for (int n = 0; n < kLevelings && water_->count > kFirstLake; ++n) levelLakes();
    }
    if (!options_.kept.empty()) keepHollows();
    if (!options_.outlets.empty()) liftToOutlets();
    fill(made);
    cut(made);
    return made;
  }

 private:
  /// The neighbor of a sample in a direction; false beyond the map.
  bool neighbor(std::uint32_t sample, int direction, std::uint32_t& found) const {
    const int width = heights_.width(), height = heights_.height();
    int x = static_cast<int>(sample % static_cast<std::uint32_t>(width)) + kSteps[direction].x;
    int y = static_cast<int>(sample / static_cast<std::uint32_t>(width)) + kSteps[direction].y;
    if (x < 0 || x >= width) {
      if (!options_.wrapsX) return false;
      x = x < 0 ? width - 1 : 0;
    }
    if (y < 0 || y >= height) {
      if (!options_.wrapsY) return false;
      y = y < 0 ? height - 1 : 0;
    }
    found = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) +
            static_cast<std::uint32_t>(x);
    return true;
  }

  /// Calls `visit(neighbor, direction)` for all neighbors, as `neighbor` has them, until it returns
  /// false.
  template <class Visit>
  void forNeighbors(std::uint32_t sample, const Visit& visit) const {
    const auto width = static_cast<std::uint32_t>(heights_.width());
    const auto height = static_cast<std::uint32_t>(heights_.height());
    const std::uint32_t y = sample / width, x = sample - y * width;
    if (x - 1 < width - 2 && y - 1 < height - 2 && width > 2 && height > 2) {
      for (int d = 0; d < 8; ++d)
        if (!visit(sample + offsets_[static_cast<std::size_t>(d)], d)) return;
      return;
    }
    for (int d = 0; d < 8; ++d) {
      std::uint32_t n;
      if (neighbor(sample, d, n) && !visit(n, d)) return;
    }
  }

  /// Whether water leaves the sample at (x, y).
  bool isOutlet(std::uint32_t sample, int x, int y) const {
    if (bodyOf(sample) == kSeaBody) return true;
    if (!options_.outlets.empty()) return options_.outlets[sample] != 0;
    if (!options_.wrapsX && (x == 0 || x + 1 == heights_.width())) return true;
    if (!options_.wrapsY && (y == 0 || y + 1 == heights_.height())) return true;
    bool beside = false;
    if (hasGaps_) {
      forNeighbors(sample, [&](std::uint32_t n, int) {
        beside |= std::isnan(heights_[n]);
        return !beside;
      });
    }
    return beside;
  }

  /// Visits every sample from the outlets upwards: `enter(sample, from)` says the height by which
  /// it is queued.
  template <class Enter, class Leave>
  void flood(const Enter& enter, const Leave& leave) {
    if (options_.outlets.empty()) {
      floodBy(queueOf(least_, most_), enter, leave);
    } else {
      // Ways out are few and may fall by next to nothing.
      ExactQueue queue;
      floodBy(queue, enter, leave);
    }
  }

  /// The empty queue, for heights within a range.
  HeightQueue& queueOf(float least, float most) {
    if (!queue_) queue_.emplace(heights_.count());
    queue_->setRange(least, most);
    return *queue_;
  }

  template <class Queue, class Enter, class Leave>
  void floodBy(Queue& queue, const Enter& enter, const Leave& leave) {
    const std::size_t count = heights_.count();
    toward_.assign(count, kUnseen);
    bool any = false;
    std::uint32_t at = 0;
    for (int y = 0; y < heights_.height(); ++y) {
      for (int x = 0; x < heights_.width(); ++x, ++at) {
        if (std::isnan(heights_[at])) {
          toward_[at] = kOutlet;
        } else if (isOutlet(at, x, y)) {
          toward_[at] = kOutlet;
          queue.push(at, heights_[at]);
          any = true;
        }
      }
    }
    if (!any) {
      // A torus: all water runs to its lowest place.
      std::uint32_t lowest = 0;
      for (std::uint32_t s = 1; s < count; ++s)
        if (heights_[s] < heights_[lowest]) lowest = s;
      toward_[lowest] = kOutlet;
      queue.push(lowest, heights_[lowest]);
    }
    std::size_t visits = 0;
    while (!queue.empty()) {
      if ((++visits & 0xffff) == 0) progress_.check();
      const std::uint32_t s = queue.pop();
      leave(s);
      forNeighbors(s, [&](std::uint32_t n, int d) {
        if (toward_[n] != kUnseen) return true;
        toward_[n] = static_cast<std::uint8_t>(7 - d);
        queue.push(n, enter(n, s));
        return true;
      });
    }
  }

  std::uint32_t bodyOf(std::size_t s) const { return water_ ? water_->bodies[s] : 0; }
  /// What must not be moved.
  bool isHeld(std::size_t s) const { return (!held_.empty() && held_[s]) || bodyOf(s) != 0; }
  bool isKept(std::size_t s) const { return !kept_.empty() && kept_[s]; }

  /// Connected samples that lie below these levels.
  std::vector<std::vector<std::uint32_t>> hollowsBelow(const std::vector<float>& level) const {
    std::vector<std::vector<std::uint32_t>> hollows;
    std::vector<std::uint8_t> seen(level.size());
    for (std::uint32_t s = 0; s < level.size(); ++s) {
      if (seen[s] || !(level[s] > heights_[s])) continue;
      std::vector<std::uint32_t> hollow{s};
      seen[s] = 1;
      for (std::size_t at = 0; at < hollow.size(); ++at) {
        forNeighbors(hollow[at], [&](std::uint32_t n, int) {
          if (seen[n] || !(level[n] > heights_[n])) return true;
          seen[n] = 1;
          hollow.push_back(n);
          return true;
        });
      }
      hollows.push_back(std::move(hollow));
    }
    return hollows;
  }

  /// Of each sample below its spill `level`, the lowest one that drains through its hollow from
  /// beyond that; `order` is that in which the samples were reached.
  std::vector<float> lowestUpstream(const std::vector<float>& level,
                                    const std::vector<std::uint32_t>& order) const {
    const float none = std::numeric_limits<float>::infinity();
    // Land that stays under water is not lifted.
    std::vector<float> all(heights_.values().begin(), heights_.values().end());
    for (std::size_t s = 0; s < all.size(); ++s)
      if (isKept(s)) all[s] = level[s];
    std::vector<float> beyond(all.size(), none);
    for (std::size_t n = order.size(); n-- > 0;) {
      const std::uint32_t s = order[n];
      if (toward_[s] == kOutlet) continue;
      std::uint32_t down = s;
      neighbor(s, toward_[s], down);
      all[down] = std::min(all[down], all[s]);
      if (!(level[down] > heights_[down])) continue;
      const bool within = level[s] > heights_[s];
      beyond[down] = std::min(beyond[down], within ? beyond[s] : all[s]);
    }
    return beyond;
  }

  /// Gives up hollows through which land drains that lies lower than their bottom and does not stay
  /// as it is: it would have to be lifted by more than they are deep, above their water.
  void dropThoseAboveLand(const std::vector<std::vector<std::uint32_t>>& hollows,
                          const std::vector<float>& level,
                          const std::vector<std::uint32_t>& order) {
    for (bool dropped = true; dropped;) {
      dropped = false;
      const std::vector<float> upstream = lowestUpstream(level, order);
      for (const std::vector<std::uint32_t>& hollow : hollows) {
        if (!isKept(hollow.front())) continue;
        float bottom = most_;
        for (const std::uint32_t s : hollow) bottom = std::min(bottom, heights_[s]);
        const auto drainsLower = [&](std::uint32_t s) { return upstream[s] < bottom; };
        if (std::ranges::none_of(hollow, drainsLower)) continue;
        for (const std::uint32_t s : hollow) {
          kept_[s] = 0;
          standing_[s] = least_;
        }
        dropped = true;
      }
    }
  }

  /// Finds the hollows that stay.
  void keepHollows() {
    std::vector<float> level(heights_.values().begin(), heights_.values().end());
    std::vector<std::uint32_t> order;
    order.reserve(level.size());
    flood([&](std::uint32_t n,
              std::uint32_t from) { return level[n] = std::max(level[n], level[from]); },
          [&](std::uint32_t s) { order.push_back(s); });
    std::vector<std::vector<std::uint32_t>> hollows = hollowsBelow(level);
    // From the largest size down; those of one size in an order without direction.
    const auto sizeOf = [](const auto& hollow) {
      return static_cast<std::size_t>(std::bit_width(hollow.size())) - 1;
    };
    const auto orderOf = [](const auto& hollow) { return hollow.front() * 2654435769u; };
    std::ranges::stable_sort(hollows, [&](const auto& a, const auto& b) {
      return sizeOf(a) != sizeOf(b) ? sizeOf(a) > sizeOf(b) : orderOf(a) < orderOf(b);
    });
    kept_.assign(level.size(), 0);
    standing_.assign(level.size(), least_);
    double all = 0, most = 0;
    for (const auto& hollow : hollows) all += static_cast<double>(hollow.size());
    for (const double share : options_.kept) most += share * static_cast<double>(level.size());
    double left = all <= most ? most : 0;
    std::size_t next = all <= most ? 0 : options_.kept.size();
    for (const std::vector<std::uint32_t>& hollow : hollows) {
      for (; next > sizeOf(hollow); --next)
        left += options_.kept[next - 1] * static_cast<double>(level.size());
      if (static_cast<double>(hollow.size()) > left) continue;
      left -= static_cast<double>(hollow.size());
      for (const std::uint32_t s : hollow) {
        kept_[s] = 1;
        standing_[s] = level[s];
      }
    }
    dropThoseAboveLand(hollows, level, order);
  }

  /// Lowers the land beside water that came to a level below what lay there: no cliffs.
  void lowerShores() {
    if (water_->before.empty()) return;
    flood([&](std::uint32_t n, std::uint32_t) { return heights_[n]; }, [](std::uint32_t) {});
    std::vector<std::uint32_t> lowered;
    for (std::uint32_t s = 0; s < heights_.count(); ++s)
      if (bodyOf(s) != 0 && heights_[s] < water_->before[s]) lowered.push_back(s);
    shapeBanks(lowered, {water_->before.values().begin(), water_->before.values().end()});
  }

  /// Which lake the water of each comes to next; 0 for none. Lakes are numbered as in `water_`.
  std::vector<std::uint32_t> lakesBelow() {
    std::vector<std::uint32_t> below(water_->count);
    std::vector<std::uint8_t> reached(water_->count);
    flood([&](std::uint32_t n, std::uint32_t) { return heights_[n]; },
          [&](std::uint32_t s) {
            const std::uint32_t lake = bodyOf(s);
            if (lake < kFirstLake || std::exchange(reached[lake], 1)) return;
            for (std::uint32_t at = s; toward_[at] != kOutlet;) {
              neighbor(at, toward_[at], at);
              if (bodyOf(at) == 0 || bodyOf(at) == lake) continue;
              below[lake] = bodyOf(at) == kSeaBody ? 0 : bodyOf(at);
              break;
            }
          });
    return below;
  }

  /// Gives lakes levels at which none runs up into the next: a lake and the one that it runs to
  /// have the mean level of both where it would be the lower one (pooled adjacent violators: Ayer
  /// et al., "An empirical distribution function for sampling with incomplete information", 1955).
  void levelLakes() {
    const std::vector<std::uint32_t> below = lakesBelow();
    std::vector<double> level(below.size()), area(below.size());
    for (std::size_t s = 0; s < heights_.count(); ++s) {
      level[bodyOf(s)] = heights_[s];
      area[bodyOf(s)] += 1;
    }
    DisjointSets pools(below.size());
    for (bool joined = true; joined;) {
      joined = false;
      for (std::uint32_t lake = kFirstLake; lake < below.size(); ++lake) {
        const std::uint32_t a = pools.find(lake), b = pools.find(below[lake]);
        if (below[lake] == 0 || a == b || level[a] >= level[b]) continue;
        const double sum = level[a] * area[a] + level[b] * area[b], both = area[a] + area[b];
        pools.join(a, b);
        level[pools.find(a)] = sum / both;
        area[pools.find(a)] = both;
        joined = true;
      }
    }
    std::vector<float> wanted(below.size());
    for (std::uint32_t lake = kFirstLake; lake < below.size(); ++lake)
      wanted[lake] = static_cast<float>(level[pools.find(lake)]);
    moveLakes(wanted);
  }

  /// Moves lakes to levels: land that lies lower beside a lake that rises comes to its level, and
  /// the banks of one that falls come with it.
  void moveLakes(const std::vector<float>& level) {
    const std::vector<float> before(heights_.values().begin(), heights_.values().end());
    std::vector<std::uint32_t> lowered, raised;
    for (std::uint32_t s = 0; s < before.size(); ++s) {
      const std::uint32_t lake = bodyOf(s);
      if (lake < kFirstLake || level[lake] == before[s]) continue;
      (level[lake] < before[s] ? lowered : raised).push_back(s);
      heights_[s] = level[lake];
    }
    for (std::size_t at = 0; at < raised.size(); ++at) {
      for (int d = 0; d < 8; ++d) {
        std::uint32_t n;
        if (!neighbor(raised[at], d, n) || isHeld(n)) continue;
        if (!(heights_[n] < heights_[raised[at]])) continue;
        heights_[n] = heights_[raised[at]];
        raised.push_back(n);
      }
    }
    shapeBanks(lowered, before);
  }

  /// Lakes are water that stands, as that in hollows that stay.
  void standAtLakes() {
    if (!water_ || water_->count <= kFirstLake) return;
    if (standing_.empty()) standing_.assign(heights_.count(), least_);
    for (std::size_t s = 0; s < standing_.size(); ++s)
      if (bodyOf(s) >= kFirstLake) standing_[s] = heights_[s];
  }

  /// Fills hollows by their share, and those that drain through water that stands up to that, which
  /// would flood them.
  void fill(OutletsCut& made) {
    std::vector<float> level(heights_.values().begin(), heights_.values().end());
    const auto fall = static_cast<float>(options_.fall);
    standAtLakes();
    flood(
        [&](std::uint32_t n, std::uint32_t from) {
          if (!standing_.empty()) standing_[n] = std::max(standing_[n], standing_[from]);
          return level[n] = std::max(level[n], level[from] + fall);
        },
        [](std::uint32_t) {});
    std::size_t flooded = 0;
    // Where some of a hollow is held, the rest would rise beside it: it is only cut.
    std::vector<std::uint8_t> cutOnly;
    if (!options_.outlets.empty()) {
      cutOnly.resize(level.size());
      for (const std::vector<std::uint32_t>& hollow : hollowsBelow(level)) {
        if (std::ranges::none_of(hollow, [&](std::uint32_t s) { return isHeld(s); })) continue;
        for (const std::uint32_t s : hollow) cutOnly[s] = 1;
      }
    }
    for (std::size_t s = 0; s < level.size(); ++s) {
      if (!(level[s] > heights_[s])) continue;
      ++flooded;
      if (isHeld(s) || isKept(s) || (!cutOnly.empty() && cutOnly[s])) continue;
      heights_[s] += static_cast<float>(options_.fill) * (level[s] - heights_[s]);
      if (!standing_.empty()) heights_[s] = std::max(heights_[s], std::min(standing_[s], level[s]));
    }
    made.flooded = static_cast<double>(flooded) / static_cast<double>(level.size());
  }

  void cut(OutletsCut& made) {
    const std::vector<float> before(heights_.values().begin(), heights_.values().end());
    shapeBanks(carve(made), before);
    double sum = 0;
    for (std::size_t s = 0; s < before.size(); ++s) {
      const double depth = before[s] - heights_[s];
      if (!(depth > 0)) continue;
      sum += depth;
      made.deepest = std::max(made.deepest, depth);
    }
    made.mean = sum / static_cast<double>(before.size());
  }

  /// A step that heights of this size can take.
  float leastStep() const { return std::max((most_ - least_) * 1e-6f, std::abs(most_) * 2.4e-7f); }

  /// Lifts what lies below every way out: what is held cannot be cut.
  void liftToOutlets() {
    const float step = leastStep();
    std::vector<float> lowest(heights_.values().begin(), heights_.values().end());
    flood(
        [&](std::uint32_t n, std::uint32_t from) {
          return lowest[n] = isHeld(n) ? std::max(heights_[n], lowest[from]) : lowest[from] + step;
        },
        [](std::uint32_t) {});
    for (std::size_t s = 0; s < lowest.size(); ++s)
      if (!isHeld(s) && !isKept(s)) heights_[s] = std::max(heights_[s], lowest[s]);
  }

  /// Cuts a way from every pit, by own heights: a hollow's pit is reached first over its lowest
  /// saddle, and the way back is the way that the water takes. Returns what was lowered.
  std::vector<std::uint32_t> carve(OutletsCut& made) {
    std::vector<std::uint32_t> changed;
    made.left =
        carveAlong([&](std::uint32_t n, std::uint32_t) { return heights_[n]; }, changed, made);
    if (options_.outlets.empty()) return changed;
    // The lowest way leads over what is held: others, through land that may be cut, the shallow
    // cuts first.
    for (float deep : kDeepCuts) {
      if (made.left == 0) break;
      deep *= most_ - least_;
      std::vector<float> highest(heights_.count(), least_ - deep);
      made.left = carveAlong(
          [&](std::uint32_t n, std::uint32_t from) {
            const float free = options_.hold.empty() ? !isHeld(n) : 1 - options_.hold[n];
            const float own = heights_[n] - free * deep;
            return highest[n] = std::max(highest[from], own);
          },
          changed, made);
    }
    return changed;
  }

  /// The same along the ways on which a flood whose samples `enter` by such heights returns.
  /// Returns from how many pits the way was blocked by what is held.
  template <class Enter>
  std::int64_t carveAlong(const Enter& enter, std::vector<std::uint32_t>& changed,
                          OutletsCut& made) {
    std::int64_t blocked = 0;
    std::vector<std::uint8_t> drained(water_ ? water_->count : 0);
    const auto wantsOutlet = [&](std::uint32_t s) {
      if (toward_[s] == kOutlet || isKept(s)) return false;
      const std::uint32_t body = bodyOf(s);
      // A lake's first sample is reached over its lowest saddle.
      return body != 0 ? !std::exchange(drained[body], 1) : isPit(s);
    };
    flood(enter, [&](std::uint32_t s) {
      if (!wantsOutlet(s)) return;
      const std::optional<Bed> bed = bedFrom(s);
      blocked += !bed;
      float target = heights_[s];
      bool any = false;
      for (std::uint32_t at = s; toward_[at] != kOutlet;) {
        neighbor(at, toward_[at], at);
        target = bed ? std::max(target - bed->step, bed->least) : target - leastStep();
        if (heights_[at] <= target || isHeld(at)) break;
        heights_[at] = target;
        changed.push_back(at);
        any = true;
      }
      made.outlets += any;
    });
    return blocked;
  }

  /// The bed of a cut: by how much it falls in each step, and no lower than to where.
  struct Bed {
    float step, least = -std::numeric_limits<float>::infinity();
  };
  /// That of a cut from a pit: it falls by less where what is held on its way is not low enough;
  /// none where that is higher.
  std::optional<Bed> bedFrom(std::uint32_t s) const {
    Bed bed{std::max(static_cast<float>(options_.fall), leastStep())};
    if (options_.outlets.empty() && !water_) return bed;
    int steps = 0;
    for (std::uint32_t at = s; toward_[at] != kOutlet;) {
      neighbor(at, toward_[at], at);
      ++steps;
      if (heights_[at] <= heights_[s] - static_cast<float>(steps) * bed.step) break;
      if (!isHeld(at)) continue;
      if (heights_[at] > heights_[s]) return std::nullopt;
      // Steps add up to a little more or less than what they are shares of.
      bed = {std::min(bed.step, (heights_[s] - heights_[at]) / static_cast<float>(steps)),
             heights_[at]};
      break;
    }
    return bed;
  }

  bool isPit(std::uint32_t s) const {
    bool isLowest = true;
    forNeighbors(s, [&](std::uint32_t n, int) { return isLowest = !(heights_[n] < heights_[s]); });
    return isLowest;
  }

  /// Lowers what lies beside a cut with it, by less the farther it is away: the land there keeps
  /// its shape, as far as it still falls to the cut.
  void shapeBanks(const std::vector<std::uint32_t>& changed, const std::vector<float>& before) {
    if (!std::isfinite(options_.bank)) return;
    const auto bank = static_cast<float>(options_.bank);
    const float rise = leastStep();
    std::vector<float> lowered(before.size());
    std::vector<std::uint32_t> cut;
    float most = 0;
    for (const std::uint32_t s : changed) {
      const float depth = before[s] - heights_[s];
      if (depth <= kShallow * bank || lowered[s] > 0) continue;
      lowered[s] = depth;
      most = std::max(most, depth);
      cut.push_back(s);
    }
    if (cut.empty()) return;
    // The deepest first, so that each sample is lowered once.
    HeightQueue& queue = queueOf(0, most);
    for (const std::uint32_t s : cut) queue.push(s, most - lowered[s]);
    std::size_t visits = 0;
    while (!queue.empty()) {
      if ((++visits & 0xffff) == 0) progress_.check();
      const std::uint32_t s = queue.pop();
      forNeighbors(s, [&](std::uint32_t n, int d) {
        if (lowered[n] > 0 || !(toward_[n] < kUnseen) || isHeld(n) || isKept(n)) return true;
        if (hasGaps_ && std::isnan(heights_[n])) return true;
        const bool straight = kSteps[d].x == 0 || kSteps[d].y == 0;
        const float by = lowered[s] - bank * (straight ? 1.0f : 1.41421356f);
        // Above what it falls to, so that no way to the cut is closed.
        float to = std::max(before[n] - by, heights_[s] + rise);
        // And above water that stays.
        if (!standing_.empty()) to = std::max(to, standing_[n]);
        if (by <= 0 || to >= heights_[n]) return true;
        heights_[n] = to;
        lowered[n] = before[n] - to;
        queue.push(n, most - lowered[n]);
        return true;
      });
    }
  }

  Grid<float>& heights_;
  const Grid<std::uint8_t>& held_;
  const OutletOptions& options_;
  const WaterBodies* water_;
  const Progress& progress_;
  float least_ = std::numeric_limits<float>::infinity();
  float most_ = -std::numeric_limits<float>::infinity();
  bool hasGaps_ = false;                  // samples without a height
  std::array<std::uint32_t, 8> offsets_;  // of neighbors inside the map
  std::optional<HeightQueue> queue_;      // when first wanted
  std::vector<std::uint8_t> toward_;      // the direction back to the outlet
  std::vector<std::uint8_t> kept_;        // 1 in hollows that stay; may be empty
  std::vector<float> standing_;           // the level of standing water, and where it would flood
};

}  // namespace

OutletsCut cutOutlets(Grid<float>& heights, const Grid<std::uint8_t>& held,
                      const OutletOptions& options, const WaterBodies* water,
                      const Progress& progress) {
  assert(options.bank > 0);
  assert(!water || water->bodies.sameSize(heights));
  assert(!water || water->before.empty() || water->before.sameSize(heights));
  return Outlets(heights, held, options, water, progress).run();
}

}  // namespace exemplar
