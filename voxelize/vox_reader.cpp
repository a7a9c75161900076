// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// MagicaVoxel's .vox files: chunks of an id, two lengths, content and children. Written from the
// format's description (github.com/ephtracy/voxel-model); the default palette follows its rule.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/memory.h"
#include "mesh/color.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

using Rgba = std::array<std::uint8_t, 4>;
using Attributes = std::map<std::string, std::string, std::less<>>;

/// Of a model: coordinates are bytes.
constexpr std::int32_t kLongestSide = 256;
/// Groups may hold groups; a file that puts one into itself must not keep us forever.
constexpr int kDeepest = 64;
constexpr int kMostShapes = 1 << 16;
/// A grid of more cells than this is refused where it has more than `kSparse` for each voxel.
constexpr double kManyCells = 1 << 26, kSparse = 4096;

/// Little-endian numbers and strings, one after the other; every step beyond the end is an error.
class Bytes {
 public:
  Bytes(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(&name) {}

  bool atEnd() const { return bytes_.empty(); }
  std::size_t left() const { return bytes_.size(); }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) fail("the file, or one of its parts, ends too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::int32_t integer() {
    std::uint32_t value = 0;
    const std::string_view four = take(4);
    for (int i = 0; i < 4; ++i) {
      value |= std::uint32_t{static_cast<unsigned char>(four[i])} << (8 * i);
    }
    return static_cast<std::int32_t>(value);
  }
  /// A number of things to come, each of at least `bytesEach` bytes.
  std::int32_t count(std::size_t bytesEach) {
    const std::int32_t n = integer();
    if (n < 0 || static_cast<std::size_t>(n) > left() / bytesEach) {
      fail("a part says that it holds " + std::to_string(n) + " items, and has no room for them");
    }
    return n;
  }
  std::string string() { return std::string(take(static_cast<std::size_t>(count(1)))); }
  Attributes attributes() {
    Attributes result;
    for (std::int32_t n = count(8); n > 0; --n) {
      std::string key = string();
      result[std::move(key)] = string();
    }
    return result;
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(*name_ + ": " + what); }

 private:
  std::string_view bytes_;
  const std::string* name_;
};

struct Model {
  Vec3i size;
  std::string_view voxels;  ///< x, y, z, color of each
};

/// A rotation by quarter turns and mirrorings, and a translation: q = M p + t, row by row.
struct Placement {
  std::array<int, 3> axis{0, 1, 2};  ///< which component of p a row takes
  std::array<int, 3> sign{1, 1, 1};
  std::array<std::int64_t, 3> shift{};

  std::array<std::int64_t, 3> apply(const std::array<std::int64_t, 3>& p) const {
    std::array<std::int64_t, 3> q;
    for (int row = 0; row < 3; ++row) q[row] = sign[row] * p[axis[row]] + shift[row];
    return q;
  }
  /// This after `inner`.
  Placement operator*(const Placement& inner) const {
    Placement both;
    for (int row = 0; row < 3; ++row) {
      both.axis[row] = inner.axis[axis[row]];
      both.sign[row] = sign[row] * inner.sign[axis[row]];
      both.shift[row] = sign[row] * inner.shift[axis[row]] + shift[row];
    }
    return both;
  }
};

struct Node {
  Placement placement;                 ///< of a transform
  bool hidden = false;                 ///< a transform's mark
  std::int32_t layer = -1;             ///< of a transform
  std::vector<std::int32_t> children;  ///< of a transform (one) or group
  std::vector<std::int32_t> models;    ///< of a shape
};

/// A model where the scene shows it, positions doubled so that the middle of a cell is whole.
struct Shown {
  const Model* model;
  Placement doubled;
};

bool isHidden(const Attributes& attributes) {
  const auto found = attributes.find("_hidden");
  return found != attributes.end() && found->second == "1";
}

class VoxReader {
 public:
  VoxReader(std::string_view bytes, const std::string& name) : name_(name), file_(bytes, name_) {}

  LabelGrid read() {
    if (file_.left() < 8 || file_.take(4) != "VOX ") file_.fail("not a MagicaVoxel file");
    const std::int32_t version = file_.integer();
    if (version != 150 && version != 200) {
      file_.fail("version " + std::to_string(version) + " is not known; 150 and 200 are");
    }
    readMain();
    if (models_.empty()) file_.fail("holds no model");
    return merge(shown());
  }

 private:
  void readMain() {
    if (file_.take(4) != "MAIN") file_.fail("its first chunk is not MAIN");
    const std::int32_t content = file_.integer(), children = file_.integer();
    if (content < 0 || children < 0) file_.fail("chunk MAIN has a negative length");
    file_.take(static_cast<std::size_t>(content));
    Bytes chunks(file_.take(static_cast<std::size_t>(children)), name_);
    std::optional<Vec3i> size;
    while (!chunks.atEnd()) {
      const std::string_view id = chunks.take(4);
      const std::int32_t length = chunks.integer(), inner = chunks.integer();
      if (length < 0 || inner < 0) file_.fail("a chunk has a negative length");
      Bytes chunk(chunks.take(static_cast<std::size_t>(length)), name_);
      chunks.take(static_cast<std::size_t>(inner));
      if (id == "SIZE") {
        size = readSize(chunk);
      } else if (id == "XYZI") {
        if (!size) file_.fail("a model's voxels come before its size");
        readVoxels(chunk, *size);
        size.reset();
      } else if (id == "RGBA") {
        for (int c = 1; c <= 256; ++c) {
          const std::string_view four = chunk.take(4);
          if (c > 255) break;
          for (int i = 0; i < 4; ++i) palette_[c][i] = static_cast<std::uint8_t>(four[i]);
        }
      } else if (id == "nTRN") {
        readTransform(chunk);
      } else if (id == "nGRP") {
        Node& node = addNode(chunk);
        for (std::int32_t n = chunk.count(4); n > 0; --n) node.children.push_back(chunk.integer());
      } else if (id == "nSHP") {
        Node& node = addNode(chunk);
        for (std::int32_t n = chunk.count(8); n > 0; --n) {
          node.models.push_back(chunk.integer());
          chunk.attributes();
        }
      } else if (id == "LAYR") {
        const std::int32_t layer = chunk.integer();
        if (isHidden(chunk.attributes())) hiddenLayers_.insert(layer);
      }
    }
    if (size) file_.fail("a model has a size and no voxels");
  }

  Vec3i readSize(Bytes& chunk) const {
    Vec3i size;
    for (int axis = 0; axis < 3; ++axis) {
      size[axis] = chunk.integer();
      if (size[axis] < 1 || size[axis] > kLongestSide) {
        file_.fail("a model is " + std::to_string(size[axis]) + " cells long; expected 1 to " +
                   std::to_string(kLongestSide));
      }
    }
    return size;
  }

  void readVoxels(Bytes& chunk, const Vec3i& size) {
    const auto count = static_cast<std::size_t>(chunk.count(4));
    if (count * 4 != chunk.left()) file_.fail("a model's voxels are not as many as it says");
    const std::string_view voxels = chunk.take(count * 4);
    for (std::size_t n = 0; n < voxels.size(); n += 4) {
      const auto at = [&](int i) { return static_cast<unsigned char>(voxels[n + i]); };
      if (at(0) >= size.x || at(1) >= size.y || at(2) >= size.z) {
        file_.fail("a voxel at (" + std::to_string(at(0)) + ", " + std::to_string(at(1)) + ", " +
                   std::to_string(at(2)) + ") is outside its model of " + std::to_string(size.x) +
                   " x " + std::to_string(size.y) + " x " + std::to_string(size.z) + " cells");
      }
      if (at(3) == 0) file_.fail("a voxel has color 0; expected 1 to 255");
    }
    models_.push_back({size, voxels});
  }

  Node& addNode(Bytes& chunk) {
    const std::int32_t id = chunk.integer();
    chunkAttributes_ = chunk.attributes();
    if (nodes_.contains(id)) {
      file_.fail("the scene has two nodes with the number " + std::to_string(id));
    }
    if (nodes_.empty()) root_ = id;
    return nodes_[id];
  }

  void readTransform(Bytes& chunk) {
    Node& node = addNode(chunk);
    node.hidden = isHidden(chunkAttributes_);
    node.children.push_back(chunk.integer());
    chunk.integer();
    node.layer = chunk.integer();
    const std::int32_t frames = chunk.count(4);
    if (frames == 0) return;
    const Attributes frame = chunk.attributes();  // the first one; animations are not played
    if (const auto turn = frame.find("_r"); turn != frame.end()) {
      setRotation(turn->second, node.placement);
    }
    if (const auto shift = frame.find("_t"); shift != frame.end()) {
      const char* p = shift->second.data();
      const char* end = p + shift->second.size();
      for (std::int64_t& component : node.placement.shift) {
        while (p != end && *p == ' ') ++p;
        std::int32_t value = 0;
        const auto [next, error] = std::from_chars(p, end, value);
        if (error != std::errc{}) file_.fail("a node's translation is not three whole numbers");
        component = value;
        p = next;
      }
    }
  }

  /// Bits 0-1 and 2-3: where the first and second row have their one; bits 4-6: signs of the rows.
  void setRotation(const std::string& text, Placement& placement) const {
    int bits = -1;
    std::from_chars(text.data(), text.data() + text.size(), bits);
    const int first = bits & 3, second = bits >> 2 & 3;
    if (bits < 0 || bits > 127 || first > 2 || second > 2 || first == second) {
      file_.fail("a node's rotation is none: " + std::to_string(bits));
    }
    placement.axis = {first, second, 3 - first - second};
    for (int row = 0; row < 3; ++row) placement.sign[row] = (bits >> (4 + row) & 1) ? -1 : 1;
  }

  std::vector<Shown> shown() {
    std::vector<Shown> result;
    if (nodes_.empty()) {
      result.push_back({&models_.front(), placed({}, models_.front())});
    } else {
      visit(root_, {}, 0, result);
    }
    if (result.empty()) file_.fail("its scene shows no model");
    return result;
  }

  void visit(std::int32_t id, const Placement& outer, int depth, std::vector<Shown>& result) {
    const auto found = nodes_.find(id);
    if (found == nodes_.end()) {
      file_.fail("the scene has no node with the number " + std::to_string(id));
    }
    if (depth > kDeepest || ++visits_ > kMostShapes) {
      file_.fail("its scene holds itself, or more than " + std::to_string(kMostShapes) + " parts");
    }
    const Node& node = found->second;
    if (node.hidden || hiddenLayers_.contains(node.layer)) return;
    const Placement here = outer * node.placement;
    for (const std::int64_t s : here.shift) {
      if (std::abs(s) > std::numeric_limits<std::int32_t>::max()) {
        file_.fail("a node is too far away");
      }
    }
    for (const std::int32_t child : node.children) visit(child, here, depth + 1, result);
    // Several models are frames of an animation: the first one shows.
    if (node.models.empty()) return;
    const std::int32_t model = node.models.front();
    if (model < 0 || static_cast<std::size_t>(model) >= models_.size()) {
      file_.fail("the scene shows model " + std::to_string(model) + " of " +
                 std::to_string(models_.size()));
    }
    result.push_back({&models_[model], placed(here, models_[model])});
  }

  /// A model turns about its middle, rounded down; the middle of cell p is at p + 1/2. Doubled,
  /// all of that is whole.
  static Placement placed(const Placement& placement, const Model& model) {
    Placement inner, outer = placement;
    for (int i = 0; i < 3; ++i) {
      inner.shift[i] = 1 - 2 * (model.size[i] / 2);
      outer.shift[i] *= 2;
    }
    return outer * inner;
  }

  static std::int64_t halved(std::int64_t twice) { return (twice - (twice & 1)) / 2; }

  LabelGrid merge(const std::vector<Shown>& parts) {
    std::array<std::int64_t, 3> low, high;
    low.fill(std::numeric_limits<std::int64_t>::max());
    high.fill(std::numeric_limits<std::int64_t>::min());
    for (const Shown& part : parts) {
      const Vec3i& s = part.model->size;
      for (const std::array<std::int64_t, 3>& corner :
           {std::array<std::int64_t, 3>{0, 0, 0},
            std::array<std::int64_t, 3>{2 * s.x - 2, 2 * s.y - 2, 2 * s.z - 2}}) {
        const auto q = part.doubled.apply(corner);
        for (int i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], halved(q[i]));
          high[i] = std::max(high[i], halved(q[i]));
        }
      }
    }
    Vec3i size;
    double cells = 1;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t length = high[i] - low[i] + 1;
      if (length > std::numeric_limits<std::int16_t>::max()) {
        file_.fail("its scene is " + std::to_string(length) + " cells long; at most 32767 fit");
      }
      size[i] = static_cast<int>(length);
      cells *= static_cast<double>(length);
    }
    std::size_t voxelCount = 0;
    for (const Shown& part : parts) voxelCount += part.model->voxels.size() / 4;
    // A grid holds the empty cells too; where they are thousands to a voxel, models lie far apart.
    if (cells > kManyCells && cells > kSparse * static_cast<double>(voxelCount)) {
      file_.fail("its models lie so far apart that " + std::to_string(size.x) + " x " +
                 std::to_string(size.y) + " x " + std::to_string(size.z) + " cells hold only " +
                 std::to_string(voxelCount) + " voxels; move them closer together");
    }
    requireMemory(3 * cells, name_ + ": its cells", "put its models closer together");

    Array3D<std::uint8_t> colors(size);
    std::array<bool, 256> used{};
    for (const Shown& part : parts) {
      const std::string_view voxels = part.model->voxels;
      for (std::size_t n = 0; n < voxels.size(); n += 4) {
        const auto at = [&](int i) { return static_cast<unsigned char>(voxels[n + i]); };
        const auto q = part.doubled.apply({2 * at(0), 2 * at(1), 2 * at(2)});
        colors(static_cast<int>(halved(q[0]) - low[0]), static_cast<int>(halved(q[1]) - low[1]),
               static_cast<int>(halved(q[2]) - low[2])) = at(3);
      }
    }
    for (const std::uint8_t c : colors.values()) used[c] = true;

    LabelGrid grid;
    grid.labels.push_back(emptyLook());
    std::array<Label, 256> labelOf{};
    for (int c = 1; c < 256; ++c) {
      if (!used[c]) continue;
      labelOf[c] = static_cast<Label>(grid.labels.size());
      LabelLook& look = grid.labels.emplace_back();
      look.name = "color " + std::to_string(c);
      for (int i = 0; i < 3; ++i) look.color[i] = srgb8ToLinear(palette_[c][i]);
    }
    grid.cells = Array3D<Label>(size);
    for (std::size_t n = 0; n < colors.count(); ++n) {
      grid.cells.values()[n] = labelOf[colors.values()[n]];
    }
    return grid;
  }

  /// A cube of six levels a channel without black, blue fastest, then ramps of red, green, blue and
  /// gray.
  static std::array<Rgba, 256> defaultPalette() {
    std::array<Rgba, 256> palette{};
    for (int n = 0; n < 215; ++n) {
      const auto level = [](int i) { return static_cast<std::uint8_t>(255 - 51 * i); };
      palette[n + 1] = {level(n / 36), level(n / 6 % 6), level(n % 6), 255};
    }
    const std::uint8_t ramp[] = {0xee, 0xdd, 0xbb, 0xaa, 0x88, 0x77, 0x55, 0x44, 0x22, 0x11};
    for (int n = 0; n < 40; ++n) {
      const std::uint8_t v = ramp[n % 10];
      const auto channel = [&](int c) { return n / 10 == c || n / 10 == 3 ? v : std::uint8_t{0}; };
      palette[n + 216] = {channel(0), channel(1), channel(2), 255};
    }
    return palette;
  }

  std::string name_;
  Bytes file_;
  std::vector<Model> models_;
  std::array<Rgba, 256> palette_ = defaultPalette();
  std::map<std::int32_t, Node> nodes_;
  std::set<std::int32_t> hiddenLayers_;
  Attributes chunkAttributes_;
  std::int32_t root_ = 0;
  int visits_ = 0;
};

}  // namespace

LabelGrid parseVox(std::string_view bytes, const std::string& name) {
  return VoxReader(bytes, name).read();
}

}  // namespace exemplar
