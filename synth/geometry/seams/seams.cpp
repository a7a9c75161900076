// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/seams.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <vector>

#include "core/cells.h"
#include "core/parallel.h"
#include "search/lattice_cut.h"
#include "synth/geometry/seams/regions.h"

namespace exemplar {
namespace {

/// In millionths. (As fast as it gets: this is most of the work.)
std::int64_t rounded(double cost) {
  return static_cast<std::int64_t>(cost * 1e6 + (cost < 0 ? -0.5 : 0.5));
}

/// What the terms of the energy cost, for samples of the result and offsets into the example.
class SeamEnergy {
 public:
  SeamEnergy(const Array3D<float>& example, const Array3D<float>& target,
             const SeamOptions& options)
      : example_(example), target_(target), options_(options) {}

  bool possible(const Vec3i& x, const Vec3i& offset) const {
    const Vec3i cell = x + offset;
    if (!example_.contains(cell) || (options_.usable && !(*options_.usable)[cell])) return false;
    return !(options_.air && (*options_.air)[x] && example_[cell] < 0);
  }
  bool fixed(const Vec3i& x) const { return options_.fixed && (*options_.fixed)[x]; }

  std::int64_t sample(const Vec3i& x, const Vec3i& offset) const {
    const double d = limited(copied(x, offset)) - limited(target_[x]);
    return rounded(options_.fidelity * d * d);
  }
  std::int64_t face(const Vec3i& x, const Vec3i& a, const Vec3i& y, const Vec3i& b) const {
    if (a == b) return 0;
    const double xa = copied(x, a), xb = copied(x, b), ya = copied(y, a), yb = copied(y, b);
    // Rounded before they are compared: so it is a metric, as cuts require, to the last digit.
    const std::int64_t here = std::abs(rounded(limited(xa)) - rounded(limited(xb)));
    const std::int64_t there = std::abs(rounded(limited(ya)) - rounded(limited(yb)));
    const std::int64_t slopes =
        std::abs(rounded(options_.slope * (xa - ya)) - rounded(options_.slope * (xb - yb)));
    std::int64_t difference = here + there + slopes;
    if (options_.squared) {
      const double units = static_cast<double>(difference) * 1e-6;
      difference = rounded(units * units);
    }
    return difference + rounded(options_.length);
  }

 private:
  float copied(const Vec3i& x, const Vec3i& offset) const {
    return example_[example_.clamped(x + offset)];
  }
  double limited(double value) const {
    return std::clamp(value, -options_.truncation, options_.truncation);
  }

  const Array3D<float>& example_;
  const Array3D<float>& target_;
  const SeamOptions& options_;
};

/// A connected region of one offset.
struct Piece {
  /// Samples along x, first to last.
  struct Run {
    Vec3i first;
    int length;
  };
  Vec3i offset;
  std::vector<Run> runs;
  std::size_t samples = 0;
  Vec3i low, high;  ///< inclusive

  template <class Body>
  void forEachSample(const Body& body) const {
    for (const Run& run : runs) {
      Vec3i x = run.first;
      for (int n = 0; n < run.length; ++n, ++x.x) body(static_cast<const Vec3i&>(x));
    }
  }
};

/// All pieces of at least the least size, the largest first.
std::vector<Piece> findPieces(const Origins& origins, const SeamOptions& options) {
  const Regions regions =
      findRegions(origins.size(), [&](const Vec3i& x) { return origins[x].cell() - x; });
  std::vector<std::size_t> samples(regions.count);
  for (const Regions::Run& run : regions.runs) {
    samples[run.region] += static_cast<std::size_t>(run.end - run.begin);
  }
  constexpr std::size_t kSmall = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> number(regions.count, kSmall);
  std::vector<Piece> pieces;
  for (std::uint32_t region = 0; region < regions.count; ++region) {
    if (static_cast<std::int64_t>(samples[region]) < options.smallest) continue;
    number[region] = pieces.size();
    pieces.emplace_back();
  }
  regions.forEachRun([&](const Regions::Run& run, const Vec3i& first) {
    if (number[run.region] == kSmall) return;
    Piece& piece = pieces[number[run.region]];
    const Vec3i last{run.end - 1, first.y, first.z};
    if (piece.runs.empty()) {
      piece.offset = origins[first].cell() - first;
      piece.low = first;
      piece.high = last;
    }
    piece.low = min(piece.low, first);
    piece.high = max(piece.high, last);
    piece.samples += static_cast<std::size_t>(run.end - run.begin);
    piece.runs.push_back({first, run.end - run.begin});
  });
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.samples > b.samples; });
  return pieces;
}

/// A piece and all that its move may reach, inside the result.
CellBox surroundings(const Piece& piece, int reach, const Vec3i& size) {
  return CellBox{piece.low, piece.high + Vec3i{1, 1, 1}}.grown(reach) & CellBox::of(size);
}

/// The samples of another offset within `reach` steps of a piece that could take its offset, as
/// `nodes`, and their numbers in the box of its surroundings (-1 elsewhere). What the piece has
/// lost meanwhile does not count.
void findNodes(const Piece& piece, const CellBox& box, const Origins& origins,
               const SeamEnergy& energy, int reach, std::vector<Vec3i>& nodes,
               Array3D<std::int32_t>& number) {
  number = Array3D<std::int32_t>(box.size(), -1);
  nodes.clear();
  std::size_t begin = 0;
  const auto grow = [&](const Vec3i& x) {
    for (const Vec3i& step : kLatticeSteps) {
      const Vec3i y = x + step;
      if (!number.contains(y - box.begin) || number[y - box.begin] >= 0) continue;
      if (origins[y].cell() - y == piece.offset || !energy.possible(y, piece.offset)) continue;
      if (energy.fixed(y)) continue;
      number[y - box.begin] = static_cast<std::int32_t>(nodes.size());
      nodes.push_back(y);
    }
  };
  piece.forEachSample([&](const Vec3i& x) {
    if (origins[x].cell() - x == piece.offset) grow(x);
  });
  for (int step = 1; step < reach; ++step) {
    const std::size_t end = nodes.size();
    for (std::size_t n = begin; n < end; ++n) grow(Vec3i(nodes[n]));
    begin = end;
  }
}

/// One expansion move.
void expand(const Piece& piece, const SeamEnergy& energy, int reach, Origins& origins,
            const Progress& progress) {
  const CellBox box = surroundings(piece, reach, origins.size());
  std::vector<Vec3i> nodes;
  Array3D<std::int32_t> number;
  findNodes(piece, box, origins, energy, reach, nodes, number);
  if (nodes.empty()) return;
  // What the move costs is found for all nodes at once; the cut then is of integers.
  struct Cost {
    std::int64_t own = 0;                 ///< of taking this node alone
    std::array<std::int64_t, 3> takes{};  ///< to be added where the neighbor along an axis is taken
    std::array<std::int64_t, 3> both{};   ///< saved where both are
    std::array<std::int32_t, 3> neighbor{-1, -1, -1};
  };
  std::vector<Cost> costs(nodes.size());
  parallelFor(0, nodes.size(), 512, [&](std::size_t from, std::size_t to) {
    for (std::size_t n = from; n < to; ++n) {
      Cost& cost = costs[n];
      const Vec3i x = nodes[n];
      const Vec3i own = origins[x].cell() - x;
      cost.own = energy.sample(x, piece.offset) - energy.sample(x, own);
      for (int direction = 0; direction < 6; ++direction) {
        const Vec3i y = x + kLatticeSteps[direction];
        if (!origins.contains(y)) continue;
        const Vec3i other = origins[y].cell() - y;
        const int m = number.contains(y - box.begin) ? number[y - box.begin] : -1;
        if (m < 0) {
          cost.own += energy.face(x, piece.offset, y, other) - energy.face(x, own, y, other);
        } else if (direction % 2 == 0) {
          const std::int64_t taken = energy.face(x, own, y, piece.offset);    // y is taken
          const std::int64_t takes = energy.face(x, piece.offset, y, other);  // x is taken
          // A capacity cannot be below 0. Counting the present state as cheaper, and nothing as
          // dearer, a move that pays in the cut pays even more in truth.
          const std::int64_t keep = std::min(energy.face(x, own, y, other), taken + takes);
          cost.own += takes - keep;
          cost.takes[direction / 2] = takes;
          cost.both[direction / 2] = taken + takes - keep;
          cost.neighbor[direction / 2] = m;
        }
      }
    }
  });
  LatticeCut cut(static_cast<int>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Cost& cost = costs[n];
    for (int axis = 0; axis < 3; ++axis) {
      if (cost.neighbor[axis] < 0) continue;
      cut.addTerminal(cost.neighbor[axis], -cost.takes[axis]);
      cut.connect(static_cast<int>(n), cost.neighbor[axis], 2 * axis, cost.both[axis], 0);
    }
    cut.addTerminal(static_cast<int>(n), cost.own);
  }
  cut.solve(progress);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (cut.onSecondSide(static_cast<int>(n))) origins[nodes[n]] = Origin(nodes[n] + piece.offset);
  }
}

/// Whether moves in two boxes could see each other.
bool touch(const CellBox& a, const CellBox& b) { return !(a.grown(1) & b).empty(); }

/// Pieces that may move at once: which round of pieces that do not touch each is in, by the boxes
/// of their surroundings. A round is the first piece that waits, and all after it that are free.
std::vector<std::vector<std::uint32_t>> roundsOf(const std::vector<CellBox>& boxes) {
  constexpr std::size_t kMost = 64;  // pieces in a round
  std::vector<std::uint32_t> waiting(boxes.size());
  std::iota(waiting.begin(), waiting.end(), 0u);
  std::vector<std::vector<std::uint32_t>> rounds;
  while (!waiting.empty()) {
    std::vector<std::uint32_t> round, later;
    for (const std::uint32_t piece : waiting) {
      const bool free = round.size() < kMost &&
                        std::none_of(round.begin(), round.end(), [&](std::uint32_t other) {
                          return touch(boxes[piece], boxes[other]);
                        });
      (free ? round : later).push_back(piece);
    }
    rounds.push_back(std::move(round));
    waiting = std::move(later);
  }
  return rounds;
}

/// Runs `move(piece)` for all pieces, in parallel, each after those of earlier rounds that it
/// touches: the same result as one round after another. Throws what a move throws.
template <class Move>
void inOrder(const std::vector<CellBox>& boxes, const Move& move) {
  const std::vector<std::vector<std::uint32_t>> rounds = roundsOf(boxes);
  std::vector<std::vector<std::uint32_t>> after(boxes.size());
  std::vector<std::atomic<int>> waitsFor(boxes.size());
  std::vector<std::uint32_t> before, ready;
  for (const std::vector<std::uint32_t>& round : rounds) {
    for (const std::uint32_t piece : round) {
      int count = 0;
      for (const std::uint32_t other : before) {
        if (!touch(boxes[piece], boxes[other])) continue;
        after[other].push_back(piece);
        ++count;
      }
      waitsFor[piece] = count;
      if (count == 0) ready.push_back(piece);
    }
    before.insert(before.end(), round.begin(), round.end());
  }
  tbb::task_group tasks;
  std::function<void(std::uint32_t)> start = [&](std::uint32_t piece) {
    tasks.run([&, piece] {
      move(piece);
      for (const std::uint32_t next : after[piece]) {
        if (waitsFor[next].fetch_sub(1) == 1) start(next);
      }
    });
  };
  for (const std::uint32_t piece : ready) start(piece);
  tasks.wait();
}

}  // namespace

void refineSeams(const Array3D<float>& example, const Array3D<float>& target, Origins& origins,
                 const SeamOptions& options, const Progress& progress) {
  const SeamEnergy energy(example, target, options);
  for (int pass = 0; pass < options.passes; ++pass) {
    const Progress passing = progress.part(static_cast<double>(pass) / options.passes,
                                           static_cast<double>(pass + 1) / options.passes);
    passing.report("cutting seams", 0);
    const std::vector<Piece> pieces = findPieces(origins, options);
    std::vector<CellBox> boxes;
    for (const Piece& piece : pieces) {
      boxes.push_back(surroundings(piece, options.reach, origins.size()));
    }
    std::mutex reporting;
    std::size_t done = 0;
    inOrder(boxes, [&](std::uint32_t n) {
      passing.check();
      expand(pieces[n], energy, options.reach, origins, passing);
      const std::lock_guard lock(reporting);
      ++done;
      passing.report("cutting seams",
                     static_cast<double>(done) / static_cast<double>(pieces.size()));
    });
  }
}

int alignPieces(const Array3D<float>& example, Origins& origins, int reach,
                const SeamOptions& options, const Progress& progress) {
  // What samples should be near to does not count: it was made with the pieces where they were.
  const SeamEnergy energy(example, example, options);
  struct Face {
    Vec3i x, y, other;
  };
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const int side = 2 * reach + 1, candidates = side * side * side;
  int moved = 0;
  std::vector<Face> faces;
  std::vector<std::int64_t> costs(candidates);
  for (const Piece& piece : findPieces(origins, options)) {
    progress.check();
    const auto anyOf = [&](const auto& test) {
      bool any = false;
      piece.forEachSample([&](const Vec3i& x) { any = any || test(x); });
      return any;
    };
    if (options.fixed && anyOf([&](const Vec3i& x) { return energy.fixed(x); })) continue;
    faces.clear();
    piece.forEachSample([&](const Vec3i& x) {
      for (const Vec3i& step : kLatticeSteps) {
        const Vec3i y = x + step;
        if (!origins.contains(y)) continue;
        const Vec3i other = origins[y].cell() - y;
        if (other != piece.offset) faces.push_back({x, y, other});
      }
    });
    // A candidate is given up where it costs more than the best so far: never the best itself.
    std::atomic<std::int64_t> least = kMost;
    const auto cost = [&](const Vec3i& offset) {
      std::int64_t sum = 0;
      for (std::size_t n = 0; n < faces.size(); ++n) {
        sum += energy.face(faces[n].x, offset, faces[n].y, faces[n].other);
        if (n % 64 == 0 && sum > least.load(std::memory_order_relaxed)) return kMost;
      }
      std::int64_t before = least.load(std::memory_order_relaxed);
      while (sum < before && !least.compare_exchange_weak(before, sum)) {
      }
      return sum;
    };
    const auto offsetOf = [&](int n) {
      return piece.offset + Vec3i{n % side, n / side % side, n / side / side} -
             Vec3i{reach, reach, reach};
    };
    const std::int64_t present = cost(piece.offset);
    const std::size_t grain = std::max<std::size_t>(1, 4096 / (faces.size() + 1));
    parallelFor(0, costs.size(), grain, [&](std::size_t from, std::size_t to) {
      for (std::size_t n = from; n < to; ++n) {
        const Vec3i offset = offsetOf(static_cast<int>(n));
        costs[n] = kMost;
        if (!example.contains(piece.low + offset) || !example.contains(piece.high + offset)) {
          continue;
        }
        if ((options.usable || options.air) &&
            anyOf([&](const Vec3i& x) { return !energy.possible(x, offset); })) {
          continue;
        }
        costs[n] = cost(offset);
      }
    });
    const auto best = std::min_element(costs.begin(), costs.end());
    if (*best >= present) continue;
    ++moved;
    const Vec3i offset = offsetOf(static_cast<int>(best - costs.begin()));
    piece.forEachSample([&](const Vec3i& x) { origins[x] = Origin(x + offset); });
  }
  return moved;
}

std::int64_t seamCost(const Array3D<float>& example, const Array3D<float>& target,
                      const Origins& origins, const SeamOptions& options) {
  const SeamEnergy energy(example, target, options);
  std::int64_t sum = 0;
  forEachCell(origins.size(), [&](const Vec3i& x) {
    const Vec3i a = origins[x].cell() - x;
    sum += energy.sample(x, a);
    for (int direction = 0; direction < 6; direction += 2) {
      const Vec3i y = x + kLatticeSteps[direction];
      if (origins.contains(y)) sum += energy.face(x, a, y, origins[y].cell() - y);
    }
  });
  return sum;
}

}  // namespace exemplar
