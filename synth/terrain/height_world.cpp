// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/terrain/height_world.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/memory.h"
#include "core/random.h"
#include "maps/drainage.h"

namespace exemplar {
namespace {

/// Parts of a window's pitch: its rim; by how much that may be wider; where old and new mix; and
/// how many samples the heights of the wider rim are apart.
constexpr int kRimPart = 8, kWavePart = 16, kBlendPart = 8, kNoisePart = 12;
/// Around the place where water ends, samples: what stays, and where that mixes.
constexpr double kStays = 2, kMixes = 12;
/// How far heights may leave the examples', of the relief.
constexpr float kBeyond = 0.25f;

/// One sample of the plane.
struct Column {
  float height = 0;
  HeightOrigin origin;
};
static_assert(sizeof(Column) == 12);

std::uint64_t packed(std::int64_t x, std::int64_t y) {
  return (static_cast<std::uint64_t>(x) << 32) | (static_cast<std::uint64_t>(y) & 0xffffffffu);
}

/// Smooth random heights between 0 and 1, a function of the place alone.
class Waves {
 public:
  Waves(const Random& random, int apart) : random_(random), apart_(apart) {}

  double at(std::int64_t x, std::int64_t y) const {
    const std::int64_t i = floorDivide(x, apart_), j = floorDivide(y, apart_);
    const double u = smooth(static_cast<double>(x - i * apart_) / apart_);
    const double v = smooth(static_cast<double>(y - j * apart_) / apart_);
    const auto value = [&](int dx, int dy) { return random_.uniform(packed(i + dx, j + dy)); };
    return (1 - v) * ((1 - u) * value(0, 0) + u * value(1, 0)) +
           v * ((1 - u) * value(0, 1) + u * value(1, 1));
  }

 private:
  static double smooth(double t) { return t * t * (3 - 2 * t); }
  Random random_;
  std::int64_t apart_;
};

}  // namespace

WindowLattice heightLattice(int pitch) { return {.pitch = pitch, .separator = pitch / kRimPart}; }

Grid<float> heightWorldStart(std::span<const Grid<float>> examples,
                             const TerrainSynthesisOptions& options, const WindowLattice& lattice,
                             const Progress& progress) {
  TerrainSynthesisOptions torus = options;
  torus.width = torus.height = 8 * lattice.pitch / 3;
  torus.wrapsX = torus.wrapsY = true;
  torus.seed = Random(options.seed, stream::kWorldStart).bits(0);
  return synthesizeTerrain(examples, torus, progress).heights;
}

HeightRange heightWorldRange(std::span<const Grid<float>> examples, const Grid<float>& start) {
  HeightRange all{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  const auto include = [&](const Grid<float>& heights) {
    const std::optional<HeightRange> range = rangeOf(heights);
    if (!range) return;
    all.low = std::min(all.low, range->low);
    all.high = std::max(all.high, range->high);
  };
  for (const Grid<float>& example : examples) include(example);
  const float beyond = kBeyond * (all.high - all.low);
  all.low -= beyond;
  all.high += beyond;
  include(start);
  return all;
}

struct HeightWorld::State {
  State(std::span<const Grid<float>> examples, const TerrainSynthesisOptions& request,
        Grid<float> begin, const WindowLattice& windows, WindowCache& cache,
        const Progress& progress);

  static TerrainSynthesisOptions windowOptions(const TerrainSynthesisOptions& request, int side) {
    TerrainSynthesisOptions options = request;
    options.width = options.height = side;
    options.wrapsX = options.wrapsY = false;
    options.control = {};
    return options;
  }

  void fillStart(const PlaneBox& box, std::span<char> columns) const;
  void make(int phase, const PlanePoint& window, const PlaneBox& box, std::span<Column> columns,
            const Progress& progress) const;
  /// What of a window stays, and where its water leaves.
  TerrainControl controlOf(int phase, const PlaneBox& box, Grid<float> before) const;
  void holdEnds(const PlaneBox& box, TerrainControl& control) const;

  Grid<float> start;
  PlanePoint lowest;  // its lowest sample
  WindowLattice lattice;
  int side;  // of a window with its rim, samples
  std::uint64_t seed;
  HeightRange range;         // of all heights
  std::vector<Waves> waves;  // for each phase
  TerrainSynthesizer synthesizer;
  PhasedPlane plane;
};

HeightWorld::State::State(std::span<const Grid<float>> examples,
                          const TerrainSynthesisOptions& request, Grid<float> begin,
                          const WindowLattice& windows, WindowCache& cache,
                          const Progress& progress)
    : start(std::move(begin)),
      lattice(windows),
      side(windows.pitch + windows.separator),
      seed(request.seed),
      range(heightWorldRange(examples, start)),
      synthesizer(examples, windowOptions(request, side), progress),
      plane(lattice,
            {sizeof(Column),
             [this](const PlaneBox& box, std::span<char> columns) { fillStart(box, columns); },
             [this](int phase, const PlanePoint& window, const PlaneBox& box,
                    std::span<char> columns, const Progress& hears) {
               std::vector<Column> samples(columns.size() / sizeof(Column));
               std::memcpy(samples.data(), columns.data(), columns.size());
               make(phase, window, box, samples, hears);
               std::memcpy(columns.data(), samples.data(), columns.size());
             }},
            cache) {
  const auto at = std::ranges::min_element(start.values()) - start.values().begin();
  lowest = {at % start.width(), at / start.width()};
  const Random rims = Random(seed, stream::kWorldWindows).fork(0);
  for (int phase = 0; phase < WindowLattice::phases; ++phase) {
    // Windows draw from the forks of phases from 1 on.
    waves.emplace_back(rims.fork(static_cast<std::uint64_t>(phase)),
                       std::max(2, lattice.pitch / kNoisePart));
  }
}

void HeightWorld::State::fillStart(const PlaneBox& box, std::span<char> columns) const {
  const std::int64_t n = start.width();
  char* to = columns.data();
  for (std::int64_t x = box.begin.x; x < box.end.x; ++x) {
    for (std::int64_t y = box.begin.y; y < box.end.y; ++y, to += sizeof(Column)) {
      const Column column{start(static_cast<int>(x - floorDivide(x, n) * n),
                                static_cast<int>(y - floorDivide(y, n) * n)),
                          {}};
      std::memcpy(to, &column, sizeof column);
    }
  }
}

/// Holds the start's lowest samples, where water ends.
void HeightWorld::State::holdEnds(const PlaneBox& box, TerrainControl& control) const {
  const std::int64_t n = start.width();
  const auto first = [&](int axis) {
    return lowest[axis] - floorDivide(lowest[axis] - box.begin[axis], n) * n;
  };
  for (std::int64_t x = first(0); x < box.end.x; x += n) {
    for (std::int64_t y = first(1); y < box.end.y; y += n) {
      const int cx = static_cast<int>(x - box.begin.x), cy = static_cast<int>(y - box.begin.y);
      control.outlets(cx, cy) = 1;
      const int reach = static_cast<int>(kStays + kMixes);
      for (int j = std::max(0, cy - reach); j <= std::min(side - 1, cy + reach); ++j) {
        for (int i = std::max(0, cx - reach); i <= std::min(side - 1, cx + reach); ++i) {
          const double away = std::hypot(i - cx, j - cy) - kStays;
          const auto firm = static_cast<float>(std::clamp(1 - away / kMixes, 0.0, 1.0));
          control.hold(i, j) = std::max(control.hold(i, j), firm);
        }
      }
    }
  }
}

TerrainControl HeightWorld::State::controlOf(int phase, const PlaneBox& box,
                                             Grid<float> before) const {
  TerrainControl control;
  control.hold = Grid<float>(side, side);
  control.outlets = Grid<std::uint8_t>(side, side);
  const int rim = lattice.separator;
  const double wave = static_cast<double>(lattice.pitch) / kWavePart,
               blend = static_cast<double>(lattice.pitch) / kBlendPart;
  const Waves& waved = waves[static_cast<std::size_t>(phase - 1)];
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int inside = std::min(std::min(x, y) + 1 - rim, side - rim - std::max(x, y));
      double firm = 1;
      if (inside > 0) {
        const double wide = wave * waved.at(box.begin.x + x, box.begin.y + y);
        firm = std::clamp(1 - (inside - wide) / (blend + 1), 0.0, 1.0);
      }
      control.hold(x, y) = static_cast<float>(firm);
      if (x > 0 && y > 0 && x < side - 1 && y < side - 1) continue;
      bool leaves = true;
      for (const Pixel& step : kNeighbors) {
        const Pixel to{x + step.x, y + step.y};
        leaves &= !before.contains(to.x, to.y) || before(to.x, to.y) >= before(x, y);
      }
      control.outlets(x, y) = leaves;
    }
  }
  control.given = std::move(before);
  holdEnds(box, control);
  return control;
}

void HeightWorld::State::make(int phase, const PlanePoint& window, const PlaneBox& box,
                              std::span<Column> columns, const Progress& progress) const {
  // Columns come x outermost; rows of the grid are along x.
  const auto column = [&](int x, int y) -> Column& {
    return columns[static_cast<std::size_t>(x) * static_cast<std::size_t>(side) +
                   static_cast<std::size_t>(y)];
  };
  Grid<float> before(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) before(x, y) = column(x, y).height;
  const TerrainControl control = controlOf(phase, box, std::move(before));
  const Random random = Random(seed, stream::kWorldWindows).fork(static_cast<std::uint64_t>(phase));
  // Windows are many: they hear of cancellation, and report nothing.
  const Progress hearing([&](std::string_view, double) { progress.check(); });
  const SynthesizedTerrain made =
      synthesizer.make(random.bits(packed(window.x, window.y)), control, hearing);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (control.hold(x, y) >= 1) continue;
      column(x, y) = {std::clamp(made.heights(x, y), range.low, range.high), made.origins(x, y)};
    }
  }
}

HeightWorld::HeightWorld(std::span<const Grid<float>> examples,
                         const TerrainSynthesisOptions& options, Grid<float> start,
                         const WindowLattice& lattice, WindowCache& cache, const Progress& progress)
    : state_(
          std::make_unique<State>(examples, options, std::move(start), lattice, cache, progress)) {}

HeightWorld::~HeightWorld() = default;

HeightWorld::Region HeightWorld::region(const PlaneBox& box, const Progress& progress) const {
  requireMemory(static_cast<double>(box.columns()) * 2 * (sizeof(Column) + sizeof(float)),
                "a region of " + std::to_string(box.size(0)) + " x " + std::to_string(box.size(1)) +
                    " points",
                "make fewer tiles at once");
  // The plane's y runs along rows, from the north.
  const PlaneBox rows{{box.begin.x, 1 - box.end.y}, {box.end.x, 1 - box.begin.y}};
  const std::string columns = state_->plane.columns(rows, progress);
  const int width = static_cast<int>(box.size(0)), height = static_cast<int>(box.size(1));
  Region region{Grid<float>(width, height), Grid<HeightOrigin>(width, height)};
  const char* from = columns.data();
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y, from += sizeof(Column)) {
      Column column;
      std::memcpy(&column, from, sizeof column);
      region.heights(x, y) = column.height;
      region.origins(x, y) = column.origin;
    }
  }
  return region;
}

bool HeightWorld::takesWater(const PlanePoint& at) const {
  const std::int64_t n = state_->start.width();
  return (at.x - state_->lowest.x) % n == 0 && (-at.y - state_->lowest.y) % n == 0;
}

}  // namespace exemplar
