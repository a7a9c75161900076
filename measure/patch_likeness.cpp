// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/patch_likeness.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "core/loop_progress.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/simd.h"

namespace exemplar {
namespace {

constexpr int kHalf = kLikenessWindow / 2;
constexpr int kStride = kLikenessStride;
constexpr int kGuard = kLikenessWindow / 2 + 1;
constexpr int kWords = 2 * kLikenessWindow;  // each layer of 121 cells takes two words
constexpr int kPaddedWords = 24;             // and empty ones, for eight lanes of three
constexpr int kParts = 27;                   // parts of 4, 4 and 3 cells along each axis
constexpr int kBlock = 64;                   // windows that are bounded together
constexpr std::array<int, 4> kCuts{0, 4, 8, kLikenessWindow};

static_assert(kGuard <= Occupancy::kMargin);

/// The bits of a layer: cell (x, y) of a window is bit 11 y + x.
struct LayerBits {
  std::uint64_t low = 0, high = 0;

  constexpr void add(int row, std::uint64_t cells) {
    const int at = row * kLikenessWindow;
    if (at < 64) low |= cells << at;
    if (at >= 64) {
      high |= cells << (at - 64);
    } else if (at + kLikenessWindow > 64) {
      high |= cells >> (64 - at);
    }
  }
};

/// A rectangle of cells of a layer.
constexpr LayerBits rectangle(int x0, int x1, int y0, int y1) {
  LayerBits bits;
  for (int y = y0; y < y1; ++y) bits.add(y, ((1u << x1) - 1) & ~((1u << x0) - 1));
  return bits;
}

constexpr LayerBits kCore = rectangle(kHalf - 1, kHalf + 2, kHalf - 1, kHalf + 2);

constexpr std::array<LayerBits, 9> kRectangles = [] {
  std::array<LayerBits, 9> rectangles;
  for (int r = 0; r < 9; ++r)
    rectangles[r] = rectangle(kCuts[r % 3], kCuts[r % 3 + 1], kCuts[r / 3], kCuts[r / 3 + 1]);
  return rectangles;
}();

/// The windows of one column: those that start at (x, y) and any z. Layers are cut out of the
/// volume once and shared by the eleven windows that they are part of.
class Column {
 public:
  Column(const Occupancy& volume, int low, int high)
      : volume_(volume),
        low_(low),
        bits_(2 * static_cast<std::size_t>(high - low + kLikenessWindow) + kPaddedWords - kWords),
        parts_(static_cast<std::size_t>(high - low + kLikenessWindow) + 1),
        core_(static_cast<std::size_t>(high - low + kLikenessWindow)) {}

  /// Cuts out the layers of the windows at (x, y) from `low` to `high` (excluded) of construction.
  EXEMPLAR_MULTIVERSION void cut(int x, int y);

  /// Whether the core of the window that starts at z is partly solid, partly empty.
  bool surface(int z) const {
    const std::uint8_t* c = &core_[z - low_ + kHalf - 1];
    const int solid = c[0] + c[1] + c[2];
    return solid > 0 && solid < 27;
  }
  /// The `kWords` words of the window that starts at z; what follows may be read, and is of others.
  const std::uint64_t* words(int z) const { return &bits_[2 * (z - low_)]; }
  /// The solid cells of its 27 parts; returns their sum.
  int parts(int z, std::array<std::uint16_t, kParts>& counts) const {
    int sum = 0;
    for (int g = 0; g < 3; ++g) {
      const auto& above = parts_[z - low_ + kCuts[g + 1]];
      const auto& below = parts_[z - low_ + kCuts[g]];
      for (int r = 0; r < 9; ++r) {
        counts[9 * g + r] = static_cast<std::uint16_t>(above[r] - below[r]);
        sum += counts[9 * g + r];
      }
    }
    return sum;
  }

 private:
  const Occupancy& volume_;
  int low_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::array<std::uint32_t, 9>> parts_;  // running sums over the layers below
  std::vector<std::uint8_t> core_;                   // solid cells of the layer's central 3²
};

void Column::cut(int x, int y) {
  parts_[0] = {};
  for (std::size_t layer = 0; layer < core_.size(); ++layer) {
    const int z = low_ + static_cast<int>(layer);
    LayerBits bits;
    for (int row = 0; row < kLikenessWindow; ++row)
      bits.add(row, volume_.bits(x, y + row, z) & ((1u << kLikenessWindow) - 1));
    bits_[2 * layer] = bits.low;
    bits_[2 * layer + 1] = bits.high;
    core_[layer] = static_cast<std::uint8_t>(std::popcount(bits.low & kCore.low) +
                                             std::popcount(bits.high & kCore.high));
    for (int r = 0; r < 9; ++r)
      parts_[layer + 1][r] = parts_[layer][r] + static_cast<std::uint32_t>(
                                                    std::popcount(bits.low & kRectangles[r].low) +
                                                    std::popcount(bits.high & kRectangles[r].high));
  }
}

/// Where windows may start along each axis: low, low + stride, ... below high.
struct Starts {
  Vec3i low, high;
  int stride = 1;

  int along(int axis) const { return std::max(0, (high[axis] - low[axis] + stride - 1) / stride); }
  std::size_t columns() const { return static_cast<std::size_t>(along(0)) * along(1); }
  Vec3i column(std::size_t c) const {
    return {low.x + static_cast<int>(c % along(0)) * stride,
            low.y + static_cast<int>(c / along(0)) * stride, 0};
  }
};

/// A window that is `out` cells beyond the box at most; interior ones have `out` = 0.
Starts starts(const Vec3i& size, WindowBorder border, int out, int stride) {
  if (border == WindowBorder::Interior) out = 0;
  const int high = 1 - kLikenessWindow + out;
  return {{-out, -out, -out}, size + Vec3i{high, high, high}, stride};
}

constexpr std::size_t kColumnsAtOnce = 16;

/// The starts of `volume`'s surface windows among `s`, in the order of their columns.
std::vector<Vec3i> surfaceWindows(const Occupancy& volume, const Starts& s,
                                  const Progress& progress) {
  if (s.along(2) == 0) return {};
  std::vector<std::vector<Vec3i>> found((s.columns() + kColumnsAtOnce - 1) / kColumnsAtOnce);
  parallelFor(0, found.size(), 1, [&](std::size_t begin, std::size_t end) {
    Column column(volume, s.low.z, s.high.z);
    for (std::size_t f = begin; f < end; ++f) {
      progress.check();
      for (std::size_t c = f * kColumnsAtOnce; c < std::min(s.columns(), (f + 1) * kColumnsAtOnce);
           ++c) {
        const Vec3i at = s.column(c);
        column.cut(at.x, at.y);
        for (int z = s.low.z; z < s.high.z; z += s.stride)
          if (column.surface(z)) found[f].push_back({at.x, at.y, z});
      }
    }
  });
  std::vector<Vec3i> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// `count` of the windows, in random order.
std::vector<Vec3i> draw(const std::vector<Vec3i>& windows, std::size_t count, std::uint64_t seed) {
  const Random random(seed, stream::kLikenessWindows);
  std::vector<std::pair<std::uint64_t, std::size_t>> keys(windows.size());
  for (std::size_t w = 0; w < windows.size(); ++w) keys[w] = {random.bits(w), w};
  count = std::min(count, windows.size());
  std::partial_sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(count), keys.end());
  std::vector<Vec3i> drawn;
  for (std::size_t w = 0; w < count; ++w) drawn.push_back(windows[keys[w].second]);
  return drawn;
}

/// The solid cells that two windows have in common. Three words are added bit by bit before their
/// bits are counted within words, in eight lanes side by side: twice as fast as counting word by
/// word with AVX-512, and seven times where the machine may not have a popcount instruction.
inline int common(const std::uint64_t* a, const std::uint64_t* b) {
  constexpr std::uint64_t odd = 0x5555555555555555, pairs = 0x3333333333333333,
                          nibbles = 0x0f0f0f0f0f0f0f0f, bytes = 0x00ff00ff00ff00ff;
  constexpr int lanes = 8;
  static_assert(kPaddedWords == 3 * lanes);
  std::array<std::uint64_t, lanes> counts;  // eight bytes each, of 24 at most
  for (int l = 0; l < lanes; ++l) {
    const std::uint64_t x = a[l] & b[l], y = a[lanes + l] & b[lanes + l],
                        z = a[2 * lanes + l] & b[2 * lanes + l];
    std::uint64_t ones = x ^ y;
    std::uint64_t twos = (x & y) | (ones & z);
    ones ^= z;
    ones -= (ones >> 1) & odd;
    ones = (ones & pairs) + ((ones >> 2) & pairs);
    twos -= (twos >> 1) & odd;
    twos = (twos & pairs) + ((twos >> 2) & pairs);
    counts[l] = (ones & nibbles) + ((ones >> 4) & nibbles) +
                2 * ((twos & nibbles) + ((twos >> 4) & nibbles));
  }
  std::uint64_t sum = 0;  // bytes of 192 at most
  for (int l = 0; l < lanes; ++l) sum += counts[l];
  const std::uint64_t halves = (sum & bytes) + ((sum >> 8) & bytes);
  return static_cast<int>((halves * 0x0001000100010001) >> 48);
}

/// 64 of the windows asked about, with their counts side by side for the bound.
struct Block {
  std::array<std::array<std::uint16_t, kBlock>, kParts> parts{};
  std::array<std::array<std::uint64_t, kPaddedWords>, kBlock> words{};
  std::array<float, kBlock> solid{};
  float start = 0;  // the IoU from which better ones are looked for
  int count = 0;
  float fewest = 0, most = 0;  // solid cells
};

/// The best IoU so far of a block's windows.
struct Best {
  std::array<float, kBlock> iou{};
  // A pair beats `iou` if its common cells exceed `need` times the sum of both windows' cells; a
  // little less is stored, so that rounding cannot pass over a winner.
  std::array<float, kBlock> need{};
  float least = 0;

  void refresh(const Block& block) {
    least = 1;
    for (int w = 0; w < kBlock; ++w) {
      // Above a threshold that was the start, how far above is of no interest.
      const bool done = w >= block.count || (block.start > 0 && iou[w] > block.start);
      need[w] = done ? 2 : iou[w] / (1 + iou[w]) - 1e-6f;
      if (!done) least = std::min(least, iou[w]);
    }
  }
};

/// Compares one window of the reference with a block of those asked about.
EXEMPLAR_MULTIVERSION
void compare(const Block& block, Best& best, const std::uint64_t* words,
             const std::array<std::uint16_t, kParts>& parts, float solid) {
  std::array<std::uint16_t, kBlock> most{};
  for (int p = 0; p < kParts; ++p) {
    const std::uint16_t part = parts[p];
    for (int w = 0; w < kBlock; ++w)
      most[w] = static_cast<std::uint16_t>(most[w] + std::min(block.parts[p][w], part));
  }
  std::array<std::uint8_t, kBlock> keep;
  int kept = 0;
  for (int w = 0; w < kBlock; ++w) {
    keep[w] = most[w] > best.need[w] * (block.solid[w] + solid) ? 1 : 0;
    kept += keep[w];
  }
  if (kept == 0) return;
  bool better = false;
  for (int w = 0; w < kBlock; ++w) {
    if (!keep[w]) continue;
    const auto both = static_cast<float>(common(block.words[w].data(), words));
    const float iou = both / (block.solid[w] + solid - both);
    if (iou > best.iou[w]) {
      best.iou[w] = iou;
      better = true;
    }
  }
  if (better) best.refresh(block);
}

/// Adds blocks of the windows asked about, those with like numbers of solid cells together.
void addBlocks(std::vector<Block>& blocks, const Occupancy& volume, std::span<const Vec3i> windows,
               float start) {
  struct Window {
    int solid;
    std::array<std::uint16_t, kParts> parts;
    std::array<std::uint64_t, kPaddedWords> words{};
  };
  std::vector<Window> cut(windows.size());
  parallelFor(0, windows.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) {
      const Vec3i at = windows[w];
      Column column(volume, at.z, at.z + 1);
      column.cut(at.x, at.y);
      cut[w].solid = column.parts(at.z, cut[w].parts);
      std::copy_n(column.words(at.z), kWords, cut[w].words.begin());
    }
  });
  std::stable_sort(cut.begin(), cut.end(),
                   [](const Window& a, const Window& b) { return a.solid < b.solid; });
  for (std::size_t w = 0; w < cut.size(); ++w) {
    if (w % kBlock == 0) blocks.emplace_back();
    Block& block = blocks.back();
    const int slot = block.count++;
    for (int p = 0; p < kParts; ++p) block.parts[p][slot] = cut[w].parts[p];
    block.words[slot] = cut[w].words;
    block.solid[slot] = static_cast<float>(cut[w].solid);
    block.start = start;
    if (slot == 0) block.fewest = block.solid[slot];
    block.most = block.solid[slot];
  }
}

/// Raises a shared best to `iou`; the outcome does not depend on who comes first.
void raise(std::atomic<float>& shared, float iou) {
  float seen = shared.load(std::memory_order_relaxed);
  while (seen < iou && !shared.compare_exchange_weak(seen, iou, std::memory_order_relaxed)) {
  }
}

struct Matches {
  std::vector<float> iou;       // of each window, in the order of the blocks; not below their start
  std::int64_t references = 0;  // the windows of the reference
};

Matches bestMatches(const std::vector<Block>& blocks, const Occupancy& reference, const Starts& s,
                    const Progress& progress) {
  LoopProgress columns(progress, "measuring likeness", s.columns());
  std::vector<std::atomic<float>> shared(blocks.size() * kBlock);
  for (std::size_t w = 0; w < shared.size(); ++w) shared[w] = blocks[w / kBlock].start;
  std::atomic<std::int64_t> references = 0;
  parallelFor(
      0, s.along(2) == 0 ? 0 : s.columns(), kColumnsAtOnce,
      [&](std::size_t begin, std::size_t end) {
        Column column(reference, s.low.z, s.high.z);
        // What other threads have found so far makes the bounds tighter, never the answer
        // different.
        std::vector<Best> best(blocks.size());
        for (std::size_t b = 0; b < blocks.size(); ++b) {
          for (int w = 0; w < kBlock; ++w)
            best[b].iou[w] = shared[b * kBlock + w].load(std::memory_order_relaxed);
          best[b].refresh(blocks[b]);
        }
        std::int64_t seen = 0;
        std::array<std::uint16_t, kParts> parts;
        for (std::size_t c = begin; c < end; ++c) {
          columns.check();
          const Vec3i at = s.column(c);
          column.cut(at.x, at.y);
          for (int z = s.low.z; z < s.high.z; z += s.stride) {
            if (!column.surface(z)) continue;
            ++seen;
            const auto solid = static_cast<float>(column.parts(z, parts));
            for (std::size_t b = 0; b < blocks.size(); ++b) {
              // IoU <= the smaller count over the larger.
              const float nearest = std::clamp(solid, blocks[b].fewest, blocks[b].most);
              if (std::min(solid, nearest) < best[b].least * std::max(solid, nearest) - 1e-3f)
                continue;
              compare(blocks[b], best[b], column.words(z), parts, solid);
            }
          }
        }
        references += seen;
        columns.advance(end - begin);
        for (std::size_t b = 0; b < blocks.size(); ++b)
          for (int w = 0; w < blocks[b].count; ++w) raise(shared[b * kBlock + w], best[b].iou[w]);
      });
  Matches matches{{}, references.load()};
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int w = 0; w < blocks[b].count; ++w) matches.iou.push_back(shared[b * kBlock + w].load());
  return matches;
}

}  // namespace

bool hasInteriorWindows(const Vec3i& size) {
  return size.x >= kLikenessWindow && size.y >= kLikenessWindow && size.z >= kLikenessWindow;
}

PatchLikeness patchLikeness(const Occupancy& asked, const Occupancy& reference,
                            const PatchLikenessOptions& options, const Progress& progress) {
  assert(options.referenceStride >= 1 && options.windows >= 1);
  // The dense reference reaches one cell further out; the published one is on the same lattice.
  const int out = options.referenceStride == 1 ? kGuard : kHalf;
  const Starts referenceStarts =
      starts(reference.size(), options.border, out, options.referenceStride);
  auto found =
      surfaceWindows(asked, starts(asked.size(), options.border, kHalf, kStride), progress);
  // A few cells of surface can slip between the lattice's cores.
  if (found.empty())
    found = surfaceWindows(asked, starts(asked.size(), options.border, kHalf, 1), progress);
  const auto windows = draw(found, static_cast<std::size_t>(options.windows), options.seed);
  const auto averaged = std::min(windows.size(), static_cast<std::size_t>(options.averaged));
  const auto threshold = static_cast<float>(options.threshold);

  // Of most windows it is enough to know whether anything exceeds the threshold, which their bounds
  // decide at once where nothing does.
  std::vector<Block> blocks;
  addBlocks(blocks, asked, std::span(windows).first(averaged), 0);
  addBlocks(blocks, asked, std::span(windows).subspan(averaged), threshold);
  const Matches matches = bestMatches(blocks, reference, referenceStarts, progress);

  PatchLikeness likeness;
  likeness.windows = static_cast<std::int64_t>(windows.size());
  likeness.references = matches.references;
  if (windows.empty()) {
    likeness.share = matches.references == 0 ? 1 : 0;
    if (options.averaged > 0) likeness.meanIou = likeness.share;
    return likeness;
  }
  double sum = 0;
  for (std::size_t w = 0; w < averaged; ++w) sum += matches.iou[w];
  if (averaged > 0) likeness.meanIou = sum / static_cast<double>(averaged);
  const auto above = std::count_if(matches.iou.begin(), matches.iou.end(),
                                   [&](float iou) { return iou > threshold; });
  likeness.share = static_cast<double>(above) / static_cast<double>(windows.size());
  return likeness;
}

}  // namespace exemplar
