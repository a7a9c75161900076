// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/seams/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "synth/geometry/seams/lattice_cut.h"

namespace exemplar {
namespace {

/// In the order of LatticeCut's directions.
constexpr std::array<Vec3i, 6> kSteps{
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

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
    // Rounded before they are compared: so a metric it is, which cuts rest on, to the last digit.
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
  Vec3i offset;
  std::vector<Vec3i> samples;
  Vec3i low, high;  ///< of its surroundings too, inclusive
};

std::vector<Piece> findPieces(const Origins& origins, const SeamOptions& options) {
  std::vector<Piece> pieces;
  Array3D<std::uint8_t> seen(origins.size());
  std::vector<Vec3i> stack;
  for (std::size_t s = 0; s < origins.count(); ++s) {
    if (seen.values()[s]) continue;
    const Vec3i first = origins.ijk(s);
    Piece piece{origins[first].cell() - first, {}, first, first};
    seen.values()[s] = 1;
    stack.assign(1, first);
    while (!stack.empty()) {
      const Vec3i x = stack.back();
      stack.pop_back();
      piece.samples.push_back(x);
      piece.low = min(piece.low, x);
      piece.high = max(piece.high, x);
      for (const Vec3i& step : kSteps) {
        const Vec3i y = x + step;
        if (!origins.contains(y) || seen[y] || origins[y].cell() - y != piece.offset) continue;
        seen[y] = 1;
        stack.push_back(y);
      }
    }
    if (static_cast<int>(piece.samples.size()) < options.smallest) continue;
    const Vec3i reach{options.reach, options.reach, options.reach};
    piece.low = max(piece.low - reach, Vec3i{0, 0, 0});
    piece.high = min(piece.high + reach, origins.size() - Vec3i{1, 1, 1});
    pieces.push_back(std::move(piece));
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return a.samples.size() > b.samples.size();
  });
  return pieces;
}

/// The samples of another offset within `reach` steps of a piece that could take its offset, as
/// `nodes` in the order found, and their numbers in the piece's box (-1 elsewhere).
void findSurroundings(const Piece& piece, const Origins& origins, const SeamEnergy& energy,
                      int reach, std::vector<Vec3i>& nodes, Array3D<std::int32_t>& number) {
  number = Array3D<std::int32_t>(piece.high - piece.low + Vec3i{1, 1, 1}, -1);
  nodes.clear();
  std::size_t begin = 0;
  const auto grow = [&](const Vec3i& x) {
    for (const Vec3i& step : kSteps) {
      const Vec3i y = x + step;
      if (!number.contains(y - piece.low) || number[y - piece.low] >= 0) continue;
      if (origins[y].cell() - y == piece.offset || !energy.possible(y, piece.offset)) continue;
      if (energy.fixed(y)) continue;
      number[y - piece.low] = static_cast<std::int32_t>(nodes.size());
      nodes.push_back(y);
    }
  };
  for (const Vec3i& x : piece.samples) grow(x);
  for (int step = 1; step < reach; ++step) {
    const std::size_t end = nodes.size();
    for (std::size_t n = begin; n < end; ++n) grow(Vec3i(nodes[n]));
    begin = end;
  }
}

/// One expansion move.
void expand(const Piece& piece, const SeamEnergy& energy, int reach, Origins& origins) {
  std::vector<Vec3i> nodes;
  Array3D<std::int32_t> number;
  findSurroundings(piece, origins, energy, reach, nodes, number);
  if (nodes.empty()) return;
  LatticeCut cut(static_cast<int>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Vec3i x = nodes[n];
    const Vec3i own = origins[x].cell() - x;
    std::int64_t difference = energy.sample(x, piece.offset) - energy.sample(x, own);
    for (int direction = 0; direction < 6; ++direction) {
      const Vec3i y = x + kSteps[direction];
      if (!origins.contains(y)) continue;
      const Vec3i other = origins[y].cell() - y;
      const int m = number.contains(y - piece.low) ? number[y - piece.low] : -1;
      if (m < 0) {
        difference += energy.face(x, piece.offset, y, other) - energy.face(x, own, y, other);
      } else if (direction % 2 == 0) {
        const std::int64_t taken = energy.face(x, own, y, piece.offset);    // y is taken
        const std::int64_t takes = energy.face(x, piece.offset, y, other);  // x is taken
        // A capacity cannot be below 0. Counting what is there as cheaper, and nothing as dearer,
        // a move that pays in the cut pays even more in truth.
        const std::int64_t keep = std::min(energy.face(x, own, y, other), taken + takes);
        difference += takes - keep;
        cut.addTerminal(m, -takes);
        cut.connect(static_cast<int>(n), m, direction, taken + takes - keep, 0);
      }
    }
    cut.addTerminal(static_cast<int>(n), difference);
  }
  cut.solve();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (cut.onSecondSide(static_cast<int>(n))) origins[nodes[n]] = Origin(nodes[n] + piece.offset);
  }
}

/// Whether two pieces' moves could see each other.
bool touch(const Piece& a, const Piece& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.low[axis] > b.high[axis] + 1 || b.low[axis] > a.high[axis] + 1) return false;
  }
  return true;
}

}  // namespace

void refineSeams(const Array3D<float>& example, const Array3D<float>& target, Origins& origins,
                 const SeamOptions& options, const Progress& progress) {
  const SeamEnergy energy(example, target, options);
  for (int pass = 0; pass < options.passes; ++pass) {
    std::vector<Piece> waiting = findPieces(origins, options);
    const double all = static_cast<double>(waiting.size());
    // Rounds of pieces that do not touch: the first that waits, and all after it that are free. A
    // piece may have lost samples to earlier ones; those it has not any more are checked below.
    while (!waiting.empty()) {
      progress.report("cutting seams",
                      (pass + 1 - static_cast<double>(waiting.size()) / all) / options.passes);
      std::vector<Piece> round, later;
      for (Piece& piece : waiting) {
        const bool free = round.size() < 64 &&
                          std::none_of(round.begin(), round.end(),
                                       [&](const Piece& other) { return touch(piece, other); });
        (free ? round : later).push_back(std::move(piece));
      }
      parallelFor(0, round.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
          Piece& piece = round[n];
          std::erase_if(piece.samples,
                        [&](const Vec3i& x) { return origins[x].cell() - x != piece.offset; });
          expand(piece, energy, options.reach, origins);
        }
      });
      waiting = std::move(later);
    }
  }
}

int alignPieces(const Array3D<float>& example, Origins& origins, int reach,
                const SeamOptions& options) {
  // Samples have no say: what they should be near to was made with the pieces where they were.
  const SeamEnergy energy(example, example, options);
  struct Face {
    Vec3i x, y, other;
  };
  const int side = 2 * reach + 1, candidates = side * side * side;
  int moved = 0;
  std::vector<Face> faces;
  for (const Piece& piece : findPieces(origins, options)) {
    if (options.fixed && std::any_of(piece.samples.begin(), piece.samples.end(),
                                     [&](const Vec3i& x) { return energy.fixed(x); })) {
      continue;
    }
    faces.clear();
    Vec3i low = piece.samples.front(), high = low;
    for (const Vec3i& x : piece.samples) {
      low = min(low, x);
      high = max(high, x);
      for (const Vec3i& step : kSteps) {
        const Vec3i y = x + step;
        if (!origins.contains(y)) continue;
        const Vec3i other = origins[y].cell() - y;
        if (other != piece.offset) faces.push_back({x, y, other});
      }
    }
    const auto cost = [&](const Vec3i& offset, std::int64_t limit) {
      std::int64_t sum = 0;
      for (const Face& face : faces) {
        sum += energy.face(face.x, offset, face.y, face.other);
        if (sum >= limit) break;
      }
      return sum;
    };
    Vec3i best = piece.offset;
    std::int64_t least = cost(best, std::numeric_limits<std::int64_t>::max());
    for (int n = 0; n < candidates; ++n) {
      const Vec3i offset = piece.offset + Vec3i{n % side, n / side % side, n / side / side} -
                           Vec3i{reach, reach, reach};
      if (!example.contains(low + offset) || !example.contains(high + offset)) continue;
      if ((options.usable || options.air) &&
          !std::all_of(piece.samples.begin(), piece.samples.end(),
                       [&](const Vec3i& x) { return energy.possible(x, offset); })) {
        continue;
      }
      const std::int64_t sum = cost(offset, least);
      if (sum >= least) continue;
      least = sum;
      best = offset;
    }
    if (best == piece.offset) continue;
    ++moved;
    for (const Vec3i& x : piece.samples) origins[x] = Origin(x + best);
  }
  return moved;
}

std::int64_t seamCost(const Array3D<float>& example, const Array3D<float>& target,
                      const Origins& origins, const SeamOptions& options) {
  const SeamEnergy energy(example, target, options);
  std::int64_t sum = 0;
  for (std::size_t s = 0; s < origins.count(); ++s) {
    const Vec3i x = origins.ijk(s);
    const Vec3i a = origins.values()[s].cell() - x;
    sum += energy.sample(x, a);
    for (int direction = 0; direction < 6; direction += 2) {
      const Vec3i y = x + kSteps[direction];
      if (origins.contains(y)) sum += energy.face(x, a, y, origins[y].cell() - y);
    }
  }
  return sum;
}

}  // namespace exemplar
