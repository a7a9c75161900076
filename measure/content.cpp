// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/content.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/array3d.h"
#include "core/cells.h"
#include "core/disjoint_sets.h"
#include "core/error.h"
#include "measure/distribution.h"

namespace exemplar {
namespace {

constexpr int kWindow = 8;  // columns a side of the windows of `copied`

using Grids = std::span<const LabelGrid* const>;

/// A well-mixed 64-bit number for each label (the finalizer of splitmix64).
std::uint64_t mixed(std::uint64_t label) {
  std::uint64_t x = (label + 1) * 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// What is background in each layer of the example, and what is built in a grid.
class Background {
 public:
  Background(Grids examples, int labelCount) {
    int layers = 0;
    for (const LabelGrid* grid : examples) layers = std::max(layers, grid->size().z);
    std::vector<std::vector<std::int64_t>> counts(
        static_cast<std::size_t>(layers),
        std::vector<std::int64_t>(static_cast<std::size_t>(labelCount)));
    for (const LabelGrid* grid : examples)
      forEachCell(grid->size(), [&](const Vec3i& p) { ++counts[p.z][grid->cells[p]]; });
    for (const auto& layer : counts)
      common_.push_back(static_cast<Label>(std::ranges::max_element(layer) - layer.begin()));
    for (const LabelLook& look : examples.front()->labels) empty_.push_back(isEmpty(look));
  }

  Array3D<std::uint8_t> built(const LabelGrid& grid) const {
    Array3D<std::uint8_t> built(grid.size());
    forEachCell(grid.size(), [&](const Vec3i& p) {
      const auto layer = std::min<std::size_t>(static_cast<std::size_t>(p.z), common_.size() - 1);
      const Label label = grid.cells[p];
      built[p] = !empty_[label] && label != common_[layer];
    });
    return built;
  }

 private:
  std::vector<Label> common_;  // of each layer
  std::vector<bool> empty_;    // of each label
};

/// A grid, and which of its cells are built.
struct Measured {
  const LabelGrid* grid;
  Array3D<std::uint8_t> built;

  Vec3i size() const { return grid->size(); }
};

/// Sums windows of `width` values along an axis, each value weighted by a power of `factor`; what
/// does not begin a whole window is left as it is.
void sumWindows(Array3D<std::uint64_t>& values, int axis, int width, std::uint64_t factor) {
  const Vec3i n = values.size();
  Vec3i end = n, step{};
  end[axis] = n[axis] - width + 1;
  step[axis] = 1;
  // In place: a window reads only what comes after its first value in storage.
  forEachCell(CellBox{{}, end}, [&](const Vec3i& p) {
    std::uint64_t sum = 0, power = 1;
    Vec3i q = p;
    for (int w = 0; w < width; ++w, q += step, power *= factor) sum += power * values[q];
    values[p] = sum;
  });
}

/// Calls `visit(hash)` for each block of `block` cells in the grid that holds a built cell. The
/// hash is a polynomial in three odd numbers, so that blocks are summed axis by axis.
template <class Visit>
void forEachBlock(const Measured& m, const Vec3i& block, const Progress& progress,
                  const Visit& visit) {
  const Vec3i n = m.size();
  if (block.x > n.x || block.y > n.y || block.z > n.z) return;
  Array3D<std::uint64_t> hashes(n), built(n);
  forEachCell(n, [&](const Vec3i& p) {
    hashes[p] = mixed(m.grid->cells[p]);
    built[p] = m.built[p];
  });
  constexpr std::uint64_t kFactors[] = {0xd1342543de82ef95u, 0xaf251af3b0f025b5u,
                                        0xda942042e4dd58b5u};
  for (int axis = 0; axis < 3; ++axis) {
    progress.check();
    sumWindows(hashes, axis, block[axis], kFactors[axis]);
    sumWindows(built, axis, block[axis], 1);
  }
  forEachCell(CellBox{{}, n - block + Vec3i{1, 1, 1}}, [&](const Vec3i& p) {
    if (built[p] > 0) visit(hashes[p]);
  });
}

/// How often each block occurs.
struct BlockCounts {
  std::unordered_map<std::uint64_t, std::int64_t> counts;
  std::int64_t total = 0;

  void add(const Measured& m, const Vec3i& block, const Progress& progress) {
    forEachBlock(m, block, progress, [&](std::uint64_t hash) {
      ++counts[hash];
      ++total;
    });
  }
};

/// Jensen-Shannon divergence of two distributions, bits. 1 where only one has anything.
double divergence(const BlockCounts& a, const BlockCounts& b) {
  if (a.total == 0 || b.total == 0) return a.total == b.total ? 0 : 1;
  // Summed in the order of the hashes, for the same bytes whatever the table's order is.
  std::vector<std::pair<std::uint64_t, std::int64_t>> all(a.counts.begin(), a.counts.end());
  for (const auto& [hash, count] : b.counts)
    if (!a.counts.contains(hash)) all.emplace_back(hash, 0);
  std::ranges::sort(all);
  double sum = 0;
  for (const auto& [hash, count] : all) {
    const auto other = b.counts.find(hash);
    const double p = static_cast<double>(count) / static_cast<double>(a.total);
    const double q = other == b.counts.end()
                         ? 0
                         : static_cast<double>(other->second) / static_cast<double>(b.total);
    const double mean = (p + q) / 2;
    if (p > 0) sum += p * std::log2(p / mean) / 2;
    if (q > 0) sum += q * std::log2(q / mean) / 2;
  }
  return std::clamp(sum, 0.0, 1.0);
}

BlockCounts countBlocks(std::span<const Measured> grids, const Vec3i& block,
                        const Progress& progress) {
  BlockCounts counts;
  for (const Measured& m : grids) counts.add(m, block, progress);
  return counts;
}

/// The two halves of a grid along the longer of x and y.
std::optional<std::pair<LabelGrid, LabelGrid>> halves(const LabelGrid& grid) {
  const Vec3i n = grid.size();
  const int axis = n.x >= n.y ? 0 : 1;
  if (n[axis] < 6) return std::nullopt;
  Vec3i size = n;
  size[axis] /= 2;
  Vec3i second{};
  second[axis] = n[axis] - size[axis];
  const auto part = [&](const Vec3i& from) {
    LabelGrid half;
    half.labels = grid.labels;
    half.cells = Array3D<Label>(size);
    forEachCell(size, [&](const Vec3i& p) { half.cells[p] = grid.cells[p + from]; });
    return half;
  };
  return std::pair(part({}), part(second));
}

std::vector<double> labelShares(std::span<const Measured> grids, int labelCount) {
  std::vector<double> shares(static_cast<std::size_t>(labelCount));
  double all = 0;
  for (const Measured& m : grids) {
    for (const Label label : m.grid->cells.values()) ++shares[label];
    all += static_cast<double>(m.grid->cells.count());
  }
  for (double& share : shares) share /= all;
  return shares;
}

/// The built share of each layer, the grids together; with `inside` of the columns that no
/// vertical side touches.
std::vector<double> builtByLayer(std::span<const Measured> grids, bool inside) {
  std::vector<double> built, columns;
  for (const Measured& m : grids) {
    const Vec3i n = m.size();
    const auto layers = static_cast<std::size_t>(n.z);
    built.resize(std::max(built.size(), layers));
    columns.resize(built.size());
    CellBox box = CellBox::of(n);
    for (int axis = 0; axis < 2 && inside; ++axis) {
      if (n[axis] < 3) continue;
      ++box.begin[axis];
      --box.end[axis];
    }
    const Vec3i size = box.size();
    for (std::size_t z = 0; z < layers; ++z) columns[z] += static_cast<double>(size.x) * size.y;
    forEachCell(box, [&](const Vec3i& p) { built[p.z] += m.built[p]; });
  }
  for (std::size_t z = 0; z < built.size(); ++z) built[z] /= columns[z];
  return built;
}

double columnsOf(std::span<const Measured> grids) {
  double columns = 0;
  for (const Measured& m : grids) columns += static_cast<double>(m.size().x) * m.size().y;
  return columns;
}

/// The sizes of objects in cells, ascending.
struct Objects {
  std::vector<double> whole, cut;

  double perHundredColumns(double columns) const {
    return 100 * (static_cast<double>(whole.size()) + 0.5 * static_cast<double>(cut.size())) /
           columns;
  }
};

/// The objects of the layers from `lowest` up.
Objects findObjects(std::span<const Measured> grids, int lowest, const Progress& progress) {
  Objects objects;
  for (const Measured& m : grids) {
    const Vec3i n = m.size();
    const Array3D<std::uint8_t>& built = m.built;
    DisjointSets sets(built.count());
    const CellBox box{{0, 0, lowest}, n};
    forEachCell(box, [&](const Vec3i& p) {
      if (p.x == 0) progress.check();
      if (!built[p]) return;
      for (int side = 1; side < 6; side += 2) {
        const Vec3i q = p + kFaceSteps[side];
        if (built.contains(q) && built[q])
          sets.join(static_cast<std::uint32_t>(built.index(p)),
                    static_cast<std::uint32_t>(built.index(q)));
      }
    });
    std::vector<std::int64_t> cells(built.count());
    std::vector<std::uint8_t> touches(built.count());
    forEachCell(box, [&](const Vec3i& p) {
      if (!built[p]) return;
      const std::uint32_t set = sets.find(static_cast<std::uint32_t>(built.index(p)));
      ++cells[set];
      touches[set] |=
          (n.x > 1 && (p.x == 0 || p.x == n.x - 1)) || (n.y > 1 && (p.y == 0 || p.y == n.y - 1));
    });
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i] > 0)
        (touches[i] ? objects.cut : objects.whole).push_back(static_cast<double>(cells[i]));
  }
  std::ranges::sort(objects.whole);
  std::ranges::sort(objects.cut);
  return objects;
}

/// The layer from which up objects are counted.
int layerOfObjects(std::span<const Measured> examples, const Progress& progress) {
  int layers = 0, best = 0;
  for (const Measured& m : examples) layers = std::max(layers, m.size().z);
  double most = -1;
  for (int lowest = 0; lowest < layers; ++lowest) {
    const Objects objects = findObjects(examples, lowest, progress);
    double cells = 0;
    for (const auto* sizes : {&objects.whole, &objects.cut})
      for (const double size : *sizes) cells += size;
    const double score = objects.perHundredColumns(1) * cells;
    if (score > most) {
      most = score;
      best = lowest;
    }
  }
  return best;
}

std::optional<double> compareSizes(const Objects& example, const Objects& result) {
  std::vector<double> a = example.whole, b = result.whole;
  if (a.empty() || b.empty()) {
    a.insert(a.end(), example.cut.begin(), example.cut.end());
    b.insert(b.end(), result.cut.begin(), result.cut.end());
    std::ranges::sort(a);
    std::ranges::sort(b);
  }
  if (a.empty() || b.empty()) return std::nullopt;
  return kolmogorovSmirnov(a, b);
}

/// Mean length of straight runs of one label over built cells along an axis.
std::optional<double> meanRun(std::span<const Measured> grids, int axis) {
  std::int64_t cells = 0, runs = 0;
  for (const Measured& m : grids) {
    if (m.size()[axis] < 2) return std::nullopt;
    Vec3i back{};
    back[axis] = -1;
    forEachCell(m.size(), [&](const Vec3i& p) {
      if (!m.built[p]) return;
      ++cells;
      const Vec3i q = p + back;
      const bool goesOn = q[axis] >= 0 && m.built[q] && m.grid->cells[q] == m.grid->cells[p];
      if (!goesOn) ++runs;
    });
  }
  if (runs == 0) return std::nullopt;
  return static_cast<double>(cells) / static_cast<double>(runs);
}

Vec3i smallestOf(std::span<const Measured> examples, const Measured& result) {
  Vec3i size = result.size();
  for (const Measured& m : examples) size = min(size, m.size());
  return size;
}

double copiedShare(std::span<const Measured> examples, const Measured& result,
                   const Progress& progress) {
  const Vec3i size = smallestOf(examples, result);
  const Vec3i window = min(size, Vec3i{kWindow, kWindow, size.z});
  std::unordered_set<std::uint64_t> shown;
  for (const Measured& m : examples)
    forEachBlock(m, window, progress, [&](std::uint64_t hash) { shown.insert(hash); });
  std::int64_t windows = 0, copied = 0;
  forEachBlock(result, window, progress, [&](std::uint64_t hash) {
    ++windows;
    copied += shown.contains(hash);
  });
  return windows > 0 ? static_cast<double>(copied) / static_cast<double>(windows) : 0;
}

void measureBlocks(std::span<const Measured> examples, const Measured& result,
                   const Background& background, const Progress& progress, Content& content) {
  const auto split = halves(*examples.front().grid);
  for (int side = 1; side <= 3; ++side) {
    const auto i = static_cast<std::size_t>(side - 1);
    const Vec3i block = min(smallestOf(examples, result), Vec3i{side, side, side});
    const BlockCounts example = countBlocks(examples, block, progress);
    const BlockCounts made = countBlocks({&result, 1}, block, progress);
    content.divergence[i] = divergence(example, made);
    if (split) {
      const Measured first{&split->first, background.built(split->first)};
      const Measured second{&split->second, background.built(split->second)};
      content.halvesDivergence[i] = divergence(countBlocks({&first, 1}, block, progress),
                                               countBlocks({&second, 1}, block, progress));
    }
    if (side < 3 || made.total == 0) continue;
    std::int64_t known = 0;
    for (const auto& [hash, count] : made.counts)
      if (example.counts.contains(hash)) known += count;
    content.known = static_cast<double>(known) / static_cast<double>(made.total);
  }
}

void measureLabels(std::span<const Measured> examples, const Measured& result, Content& content) {
  const int labelCount = result.grid->labelCount();
  const std::vector<double> wanted = labelShares(examples, labelCount);
  const std::vector<double> shares = labelShares({&result, 1}, labelCount);
  int shown = 0, used = 0;
  for (std::size_t label = 0; label < wanted.size(); ++label) {
    content.labelShares += std::abs(wanted[label] - shares[label]) / 2;
    shown += wanted[label] > 0;
    used += wanted[label] > 0 && shares[label] > 0;
  }
  content.labelsUsed = static_cast<double>(used) / shown;
}

/// How much is built in each column, and how far that differs by height.
std::pair<std::optional<double>, std::optional<double>> densityAndLayers(
    std::span<const Measured> examples, const Measured& result, bool inside) {
  std::vector<double> wanted = builtByLayer(examples, inside);
  std::vector<double> layers = builtByLayer({&result, 1}, inside);
  const std::size_t count = std::max(wanted.size(), layers.size());
  wanted.resize(count);
  layers.resize(count);
  double difference = 0, all = 0, made = 0;
  for (std::size_t z = 0; z < count; ++z) {
    difference += std::abs(layers[z] - wanted[z]);
    all += wanted[z];
    made += layers[z];
  }
  if (!(all > 0)) return {};
  return {made / all, difference / all};
}

/// Columns of the result x cells of the examples up to which all offsets are compared.
constexpr double kMostCompared = 3e8;

std::optional<NearCopies> nearCopiesOf(std::span<const Measured> examples, const Measured& result,
                                       const Progress& progress) {
  const auto builtLabels = [](const Measured& m) {
    BuiltLabels labels(m.size(), kNotBuilt);
    forEachCell(m.size(), [&](const Vec3i& p) {
      if (m.built[p]) labels[p] = m.grid->cells[p];
    });
    return labels;
  };
  double cells = 0;
  for (const Measured& m : examples) cells += static_cast<double>(m.built.count());
  if (cells * columnsOf({&result, 1}) > kMostCompared) return std::nullopt;
  std::vector<BuiltLabels> wanted;
  for (const Measured& m : examples) wanted.push_back(builtLabels(m));
  return findNearCopies(wanted, builtLabels(result), progress);
}

}  // namespace

Content measureContent(Grids examples, const LabelGrid& result, const Progress& progress) {
  for (const LabelGrid* grid : examples) {
    if (grid->cells.empty() || result.cells.empty())
      throw InputError("content: a grid of labels without cells cannot be measured");
    if (grid->labelCount() != result.labelCount()) {
      throw InputError("content: the example has " + std::to_string(grid->labelCount()) +
                       " labels and the result " + std::to_string(result.labelCount()) +
                       "; read them with one numbering");
    }
  }
  progress.report("measuring what labels hold", 0);
  const Background background(examples, result.labelCount());
  std::vector<Measured> wanted;
  for (const LabelGrid* grid : examples) wanted.push_back({grid, background.built(*grid)});
  const Measured made{&result, background.built(result)};

  Content content;
  measureLabels(wanted, made, content);
  std::tie(content.density, content.layers) = densityAndLayers(wanted, made, false);
  std::tie(content.densityInside, content.layersInside) = densityAndLayers(wanted, made, true);
  measureBlocks(wanted, made, background, progress.part(0.1, 0.6), content);
  progress.report("measuring what labels hold", 0.6);
  const int lowest = content.objectsFrom = layerOfObjects(wanted, progress);
  const Objects wholes = findObjects(wanted, lowest, progress);
  const Objects objects = findObjects({&made, 1}, lowest, progress);
  content.exampleObjects = wholes.perHundredColumns(columnsOf(wanted));
  content.objects = objects.perHundredColumns(columnsOf({&made, 1}));
  content.objectSizes = compareSizes(wholes, objects);
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<double> example = meanRun(wanted, axis), run = meanRun({&made, 1}, axis);
    if (example && run) content.runs[static_cast<std::size_t>(axis)] = *run / *example;
  }
  progress.report("measuring what labels hold", 0.8);
  content.copied = copiedShare(wanted, made, progress);
  content.nearCopies = nearCopiesOf(wanted, made, progress);
  return content;
}

Content measureContent(const LabelGrid& example, const LabelGrid& result,
                       const Progress& progress) {
  const LabelGrid* const examples[] = {&example};
  return measureContent(examples, result, progress);
}

}  // namespace exemplar
