// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/volume_scene.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "core/cells.h"
#include "core/error.h"
#include "core/random.h"
#include "core/random_streams.h"
#include "mesh/color.h"
#include "mesh/toml_text.h"

namespace exemplar {
namespace {

struct VolumeLayer {
  LabelLook look;
  double share = 1, feature = 16, up = 0;
  int octaves = 3, within = 0;
};

struct VolumeScene {
  Vec3i size{64, 64, 64};
  std::uint64_t seed = 0;
  std::vector<VolumeLayer> layers;
};

/// Reads the file's tables and says where something is wrong.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name)
      : name_(name), root_(parseToml(text, name)) {}

  VolumeScene read() {
    requireKeys(root_, {"kind", "size", "seed", "layer"});
    VolumeScene scene;
    scene.seed = static_cast<std::uint64_t>(real(root_, "seed", 0, 0, 2147483647));
    if (const toml::node* size = root_.get("size")) {
      const toml::array* sides = size->as_array();
      if (!sides || sides->size() != 3) fail(*size, "'size' must be three numbers of cells");
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t cells = sides->get(axis)->value<std::int64_t>().value_or(0);
        if (cells < 1 || cells > 512) fail(*size, "'size' must be of 1 to 512 cells");
        scene.size[static_cast<int>(axis)] = static_cast<int>(cells);
      }
    }
    const toml::node* layers = root_.get("layer");
    if (!layers || !layers->as_array() || layers->as_array()->size() < 2)
      throw InputError(name_ + ": a volume needs two [[layer]]s or more");
    for (const toml::node& layer : *layers->as_array()) {
      if (!layer.as_table()) fail(layer, "'layer' must be tables, each [[layer]]");
      scene.layers.push_back(readLayer(*layer.as_table()));
    }
    return scene;
  }

 private:
  VolumeLayer readLayer(const toml::table& table) {
    requireKeys(table, {"name", "color", "share", "feature", "octaves", "within", "up"});
    VolumeLayer layer;
    layer.look = emptyLook();
    layer.look.name = table["name"].value<std::string>().value_or("");
    if (const toml::node* color = table.get("color")) {
      const std::string text = color->value<std::string>().value_or("");
      unsigned rgb = 0;
      const char* end = text.data() + text.size();
      if (text.size() != 7 || text[0] != '#' ||
          std::from_chars(text.data() + 1, end, rgb, 16).ptr != end)
        fail(*color, "'color' must be \"#rrggbb\"");
      for (std::size_t c = 0; c < 3; ++c)
        layer.look.color[c] = srgb8ToLinear(static_cast<std::uint8_t>(rgb >> (8 * (2 - c))));
      layer.look.color[3] = 1;
    }
    layer.share = real(table, "share", 1, 0, 1);
    layer.feature = real(table, "feature", 16, 1, 1024);
    layer.up = real(table, "up", 0, 0, 1);
    layer.octaves = static_cast<int>(real(table, "octaves", 3, 1, 8));
    layer.within = static_cast<int>(real(table, "within", 0, 0, 512));
    return layer;
  }

  double real(const toml::table& table, const char* key, double standard, double low, double high) {
    const toml::node* node = table.get(key);
    if (!node) return standard;
    const auto value = node->value<double>();
    if (!value || !(*value >= low && *value <= high))
      fail(*node, "'" + std::string(key) + "' must be a number from " +
                      std::to_string(static_cast<long long>(low)) + " to " +
                      std::to_string(static_cast<long long>(high)));
    return *value;
  }
  void requireKeys(const toml::table& table, std::initializer_list<std::string_view> known) {
    for (const auto& [key, node] : table) {
      if (std::ranges::find(known, key.str()) == known.end())
        fail(node, "unknown key '" + std::string(key.str()) + "'");
    }
  }
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(node.source().begin.line) + ": " + what);
  }

  std::string name_;
  toml::table root_;
};

/// Smooth noise in space: random values at the points of a unit lattice, blended by fifth-degree
/// steps; octaves of it, each twice as fine and half as strong.
double noiseAt(const Random& random, Vec3d p, int octaves) {
  double sum = 0, amplitude = 1;
  for (int octave = 0; octave < octaves; ++octave, amplitude /= 2, p = p * 2.0) {
    Vec3i low;
    Vec3d t;
    for (int axis = 0; axis < 3; ++axis) {
      const double floor = std::floor(p[axis]);
      low[axis] = static_cast<int>(floor);
      const double u = p[axis] - floor;
      t[axis] = u * u * u * (u * (6 * u - 15) + 10);
    }
    double value = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3i step{corner & 1, corner >> 1 & 1, corner >> 2 & 1};
      double weight = 1;
      for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? t[axis] : 1 - t[axis];
      const Vec3i at = low + step;
      const auto key = (static_cast<std::uint64_t>(at.z) << 42) ^
                       (static_cast<std::uint64_t>(at.y) << 21) ^ static_cast<std::uint64_t>(at.x);
      value += weight * random.uniform(-1, 1, key, static_cast<std::uint32_t>(octave));
    }
    sum += amplitude * value;
  }
  return sum;
}

/// How many steps along the axes each cell that has at least the label `layer` is from one that
/// does not, up to `most`; `most` + 1 beyond that.
Array3D<int> depthsOf(const Array3D<Label>& cells, Label layer, int most) {
  Array3D<int> depths(cells.size(), most + 1);
  for (std::size_t p = 0; p < cells.count(); ++p)
    if (cells.data()[p] < layer) depths.data()[p] = 0;
  for (int depth = 1; depth <= most; ++depth) {
    forEachCell(cells.size(), [&](const Vec3i& p) {
      if (depths[p] <= most) return;
      for (const Vec3i& step : kFaceSteps)
        if (cells.contains(p + step) && depths[p + step] == depth - 1) depths[p] = depth;
    });
  }
  return depths;
}

/// Cuts a layer out of the one below it.
void cut(Array3D<Label>& cells, Label layer, const VolumeLayer& how, const Random& random) {
  const Array3D<int> depths =
      how.within > 0 ? depthsOf(cells, layer - 1, how.within) : Array3D<int>();
  Array3D<float> wish(cells.size());
  parallelForEachCell(cells.size(), [&](const Vec3i& p) {
    double value = noiseAt(random, cast<double>(p) * (1 / how.feature), how.octaves);
    bool open = false;
    for (int above = 1; above <= std::max(1, how.within) && !open; ++above) {
      const Vec3i q = p + Vec3i{0, 0, above};
      open = cells.contains(q) && cells[q] < layer - 1;
    }
    if (open) value += how.up;
    wish[p] = static_cast<float>(value);
  });
  std::vector<std::pair<float, std::size_t>> order;
  std::size_t below = 0;
  for (std::size_t p = 0; p < cells.count(); ++p) {
    if (cells.data()[p] != layer - 1) continue;
    ++below;
    if (depths.empty() || depths.data()[p] <= how.within) order.emplace_back(-wish.data()[p], p);
  }
  std::ranges::sort(order);
  const auto wanted =
      static_cast<std::size_t>(std::llround(how.share * static_cast<double>(below)));
  for (std::size_t n = 0; n < std::min(wanted, order.size()); ++n)
    cells.data()[order[n].second] = layer;
}

}  // namespace

bool isVolumeScene(std::string_view text) {
  try {
    return parseToml(text, {})["kind"].value<std::string>() == "volume";
  } catch (const InputError&) {
    return false;
  }
}

LabelGrid readVolumeScene(std::string_view text, const std::string& name,
                          const Progress& progress) {
  const VolumeScene scene = Reader(text, name).read();
  LabelGrid grid;
  grid.name = name;
  grid.cells = Array3D<Label>(scene.size);
  for (std::size_t n = 0; n < scene.layers.size(); ++n) {
    progress.report("making the scene",
                    static_cast<double>(n) / static_cast<double>(scene.layers.size()));
    grid.labels.push_back(scene.layers[n].look);
    if (n > 0)
      cut(grid.cells, static_cast<Label>(n), scene.layers[n],
          Random(scene.seed, stream::kVolumeLayers).fork(n));
  }
  return grid;
}

}  // namespace exemplar
