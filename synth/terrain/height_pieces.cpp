// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/height_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/parallel.h"
#include "core/random.h"

namespace exemplar {
namespace {

/// Pieces so many cells apart, or less, must not go on with one another.
constexpr int kNear = 2;
/// They are chosen in turns, so that none is chosen beside another at the same time.
constexpr int kTurns = (kNear + 1) * (kNear + 1);
/// How near a place is to another's continuation, to be its continuation; coarse samples.
constexpr int kContinues = 3;
/// Points of a patch at which that is looked at, and which of them is its middle.
constexpr int kPoints = 9, kMiddle = 4;
/// Of the random places, how many are bettered step by step.
constexpr std::size_t kBettered = 6;
/// How far pieces may reach, of their distance.
constexpr double kReach = 0.8;

/// Numbers of a resolution's pieces; the first fork is the layout's own.
Random pieceRandom(const PieceOptions& options) {
  return Random(options.seed, stream::kTerrainStart).fork(1 + options.level);
}

class Chooser {
 public:
  Chooser(std::span<const HeightSource> coarse, const Grid<float>& heights,
          const Grid<HeightOrigin>& origins, const PieceOptions& options, HeightPieces& pieces)
      : coarse_(coarse),
        heights_(heights),
        origins_(origins),
        options_(options),
        pieces_(pieces),
        random_(pieceRandom(options)),
        usable_(options.sources == 0 ? coarse.size() : options.sources),
        firsts_(pieces.middles.size()),
        windows_(pieces.middles.size()) {}

  void choose(std::uint32_t piece) {
    const Pixel first = windowOf(piece);
    HeightQuery query;
    query.take(heights_, first);
    const Taken taken = takenAround(piece, first);
    std::array<HeightMatch, kBettered> best;
    for (HeightMatch& match : best) match.cost = std::numeric_limits<float>::infinity();
    for (int n = 0; n < options_.tries; ++n) {
      HeightMatch match = anywhere(piece, static_cast<std::uint32_t>(4 * n));
      if (!fits(match)) continue;
      match.cost = costOf(query, match, best.back().cost);
      if (!(match.cost < best.back().cost) || isTaken(match, taken)) continue;
      std::size_t at = best.size() - 1;
      for (; at > 0 && match.cost < best[at - 1].cost; --at) best[at] = best[at - 1];
      best[at] = match;
    }
    HeightMatch found = best.front();
    for (HeightMatch& match : best) {
      if (std::isinf(match.cost)) break;
      better(query, taken, match);
      if (match.cost < found.cost) found = match;
    }
    // Where every place is taken, or the examples hardly have one: any.
    for (std::uint32_t n = 0; std::isinf(found.cost) && n < 1000; ++n) {
      const HeightMatch match = anywhere(piece, 4 * n);
      if (fits(match)) found = match, found.cost = 0;
    }
    windows_[piece] = first;
    firsts_[piece] = originOfFirst(found);
    pieces_.origins[piece] = fineOrigin(found, first, pieces_.middles[piece]);
  }

  /// In which turn a piece is chosen.
  int turnOf(std::uint32_t piece) const {
    const int column = static_cast<int>(piece) % pieces_.columns;
    const int row = static_cast<int>(piece) / pieces_.columns;
    return column % (kNear + 1) + (kNear + 1) * (row % (kNear + 1));
  }

 private:
  /// The first sample of the coarse patch around a piece's middle.
  Pixel windowOf(std::uint32_t piece) const {
    const Pixel middle = pieces_.middles[piece];
    Pixel first{middle.x / 2 - kHeightPatch / 2, middle.y / 2 - kHeightPatch / 2};
    if (!options_.wrapsX) first.x = std::clamp(first.x, 0, heights_.width() - kHeightPatch);
    if (!options_.wrapsY) first.y = std::clamp(first.y, 0, heights_.height() - kHeightPatch);
    return first;
  }

  HeightMatch anywhere(std::uint32_t piece, std::uint32_t draw) const {
    const std::uint64_t bits = random_.bits(piece, draw);
    const auto pick = [](std::uint64_t part, std::size_t n) {
      return static_cast<int>((part & 0xffff) * n >> 16);
    };
    HeightMatch match;
    match.example = static_cast<std::uint8_t>(
        usable_ == 1 ? 0 : random_.below(static_cast<std::uint32_t>(usable_), piece, draw + 1));
    match.turn = static_cast<std::uint8_t>(
        options_.turns[static_cast<std::size_t>(pick(bits, options_.turns.size()))]);
    const Grid<std::uint8_t>& whole = coarse_[match.example].whole;
    match.x = static_cast<std::int16_t>(
        pick(bits >> 16, static_cast<std::size_t>(whole.width() - kHeightPatch + 1)));
    match.y = static_cast<std::int16_t>(
        pick(bits >> 32, static_cast<std::size_t>(whole.height() - kHeightPatch + 1)));
    return match;
  }

  bool fits(const HeightMatch& match) const {
    const Grid<std::uint8_t>& whole = coarse_[match.example].whole;
    return whole.contains(match.x, match.y) && whole(match.x, match.y);
  }

  float costOf(HeightQuery& query, const HeightMatch& match, float most) const {
    return query.cost(coarse_[match.example], match, static_cast<float>(options_.meanCost),
                      static_cast<float>(options_.slopes), most);
  }

  /// A sample of an example itself; of none for what lies beside a bent copy.
  struct Place {
    int example = -1;
    Pixel at;

    bool isNear(const Place& other) const {
      return example >= 0 && example == other.example &&
             std::abs(at.x - other.at.x) <= kContinues && std::abs(at.y - other.at.y) <= kContinues;
    }
  };
  Place placeOf(const HeightOrigin& origin) const {
    const HeightSource& source = coarse_[origin.example];
    if (source.from.empty()) return {origin.example, {origin.x, origin.y}};
    if (!source.from.contains(origin.x, origin.y)) return {};
    return {source.copyOf, source.from(origin.x, origin.y)};
  }

  /// Places that a piece's coarse patch must not have: at its middle, and at points of it.
  struct Taken {
    std::array<Place, kPoints> points;
    std::vector<Place> middle;
  };
  /// The steps from the first sample of a patch to the points that are looked at.
  static Pixel pointOf(int n) {
    return {n % 3 * (kHeightPatch - 1) / 2, n / 3 * (kHeightPatch - 1) / 2};
  }

  /// What the coarse patch of a piece would come from if it went on with what lies there, or with a
  /// piece near it.
  Taken takenAround(std::uint32_t piece, Pixel first) const {
    Taken taken;
    for (int n = 0; n < kPoints; ++n) {
      const Pixel step = pointOf(n);
      taken.points[static_cast<std::size_t>(n)] =
          placeOf(origins_[origins_.wrapped(first.x + step.x, first.y + step.y)]);
    }
    const Pixel middle = pointOf(kMiddle);
    const int column = static_cast<int>(piece) % pieces_.columns;
    const int row = static_cast<int>(piece) / pieces_.columns;
    for (int dy = -kNear; dy <= kNear; ++dy) {
      for (int dx = -kNear; dx <= kNear; ++dx) {
        int c = column + dx, r = row + dy;
        Pixel offset{0, 0};
        if (options_.wrapsX && c < 0) c += pieces_.columns, offset.x = -heights_.width();
        if (options_.wrapsX && c >= pieces_.columns)
          c -= pieces_.columns, offset.x = heights_.width();
        if (options_.wrapsY && r < 0) r += pieces_.rows, offset.y = -heights_.height();
        if (options_.wrapsY && r >= pieces_.rows) r -= pieces_.rows, offset.y = heights_.height();
        if (c < 0 || r < 0 || c >= pieces_.columns || r >= pieces_.rows) continue;
        const auto other = static_cast<std::uint32_t>(r * pieces_.columns + c);
        if (turnOf(other) >= turnOf(piece)) continue;
        const Pixel window = windows_[other];
        taken.middle.push_back(
            placeOf(stepped(firsts_[other], {first.x + middle.x - window.x - offset.x,
                                             first.y + middle.y - window.y - offset.y})));
      }
    }
    return taken;
  }

  bool isTaken(const HeightMatch& match, const Taken& taken) const {
    const HeightOrigin first = originOfFirst(match);
    for (int n = 0; n < kPoints; ++n) {
      if (placeOf(stepped(first, pointOf(n))).isNear(taken.points[static_cast<std::size_t>(n)]))
        return true;
    }
    const Place middle = placeOf(stepped(first, pointOf(kMiddle)));
    return std::ranges::any_of(taken.middle,
                               [&](const Place& other) { return middle.isNear(other); });
  }

  void better(HeightQuery& query, const Taken& taken, HeightMatch& match) const {
    for (int step = 4; step >= 1; step /= 2) {
      for (bool moved = true; moved;) {
        moved = false;
        const HeightMatch from = match;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            HeightMatch near = from;
            near.x = static_cast<std::int16_t>(near.x + dx * step);
            near.y = static_cast<std::int16_t>(near.y + dy * step);
            if (!fits(near)) continue;
            near.cost = costOf(query, near, match.cost);
            if (!(near.cost < match.cost) || isTaken(near, taken)) continue;
            match = near;
            moved = true;
          }
        }
      }
    }
  }

  /// What a sample comes from where the coarse patch with first sample `first` comes from `match`.
  static HeightOrigin fineOrigin(const HeightMatch& match, Pixel first, Pixel at) {
    constexpr int kLast = 2 * kHeightPatch - 1;
    // Twice the steps from the middle of the patch.
    const Pixel back =
        turnedStep({2 * (at.x - 2 * first.x) - kLast, 2 * (at.y - 2 * first.y) - kLast},
                   turnedBackBy(match.turn));
    return {static_cast<std::int16_t>(2 * match.x + (back.x + kLast) / 2),
            static_cast<std::int16_t>(2 * match.y + (back.y + kLast) / 2), match.example,
            match.turn};
  }

  std::span<const HeightSource> coarse_;
  const Grid<float>& heights_;
  const Grid<HeightOrigin>& origins_;
  const PieceOptions& options_;
  HeightPieces& pieces_;
  Random random_;
  std::size_t usable_;                // sources, the first ones
  std::vector<HeightOrigin> firsts_;  // what the first samples of the coarse patches come from
  std::vector<Pixel> windows_;        // which samples these are
};

HeightPieces laidOut(Pixel size, const PieceOptions& options) {
  HeightPieces pieces;
  pieces.width = size.x;
  pieces.height = size.y;
  pieces.wrapsX = options.wrapsX;
  pieces.wrapsY = options.wrapsY;
  pieces.columns = std::max(1, (size.x + options.size / 2) / options.size);
  pieces.rows = std::max(1, (size.y + options.size / 2) / options.size);
  pieces.reach = static_cast<int>(std::lround(kReach * options.size));
  const Random random = pieceRandom(options);
  for (int r = 0; r < pieces.rows; ++r) {
    for (int c = 0; c < pieces.columns; ++c) {
      const auto piece =
          static_cast<std::uint64_t>(pieces.middles.size()) + (std::uint64_t{1} << 40);
      pieces.middles.push_back(
          {static_cast<int>((c + random.uniform(0.2, 0.8, piece, 0)) * size.x / pieces.columns),
           static_cast<int>((r + random.uniform(0.2, 0.8, piece, 1)) * size.y / pieces.rows)});
    }
  }
  pieces.origins.resize(pieces.middles.size());
  return pieces;
}

}  // namespace

HeightPieces::Share HeightPieces::over(Pixel at) const {
  Share share{0, {0, 0}};
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  const int column = at.x * columns / width, row = at.y * rows / height;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      int c = column + dx, r = row + dy;
      Pixel step = at;
      if (wrapsX && c < 0) c += columns, step.x += width;
      if (wrapsX && c >= columns) c -= columns, step.x -= width;
      if (wrapsY && r < 0) r += rows, step.y += height;
      if (wrapsY && r >= rows) r -= rows, step.y -= height;
      if (c < 0 || r < 0 || c >= columns || r >= rows) continue;
      const auto piece = static_cast<std::uint32_t>(r * columns + c);
      step.x -= middles[piece].x;
      step.y -= middles[piece].y;
      const std::int64_t distance = std::int64_t{step.x} * step.x + std::int64_t{step.y} * step.y;
      if (distance >= nearest) continue;
      nearest = distance;
      share = {piece, step};
    }
  }
  return share;
}

HeightPieces choosePieces(std::span<const HeightSource> coarse, const Grid<float>& heights,
                          const Grid<HeightOrigin>& origins, Pixel size,
                          const PieceOptions& options, const Progress& progress) {
  HeightPieces pieces = laidOut(size, options);
  Chooser chooser(coarse, heights, origins, options, pieces);
  std::vector<std::vector<std::uint32_t>> turns(kTurns);
  for (std::uint32_t piece = 0; piece < pieces.middles.size(); ++piece)
    turns[static_cast<std::size_t>(chooser.turnOf(piece))].push_back(piece);
  for (const std::vector<std::uint32_t>& turn : turns) {
    parallelFor(0, turn.size(), 8, [&](std::size_t first, std::size_t last) {
      for (std::size_t n = first; n < last; ++n) {
        progress.check();
        chooser.choose(turn[n]);
      }
    });
  }
  return pieces;
}

}  // namespace exemplar
