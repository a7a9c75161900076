// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/model_request.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/file.h"
#include "engine/words.h"
#include "mesh/image.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

using O = ModelSettings;

/// A row for texts, of which there may be several.
SettingTable<O>::Row textsRow(std::string key, std::vector<std::string> O::*member,
                              std::string meaning) {
  return {{.key = std::move(key),
           .type = SettingType::Text,
           .meaning = std::move(meaning),
           .repeats = true},
          [member](const Setting&, const std::string& text, O& o) { (o.*member).push_back(text); }};
}

/// "SIDE=RULE": the side, none for all, and the rule.
std::pair<std::optional<Side>, std::string> sideAndRule(const std::string& text) {
  static const std::map<std::string, Side> names{{"left", Side::MinX},   {"right", Side::MaxX},
                                                 {"front", Side::MinY},  {"back", Side::MaxY},
                                                 {"bottom", Side::MinZ}, {"top", Side::MaxZ}};
  const auto [name, rule] =
      keyAndValue(text, "`side`", "SIDE=free, SIDE=example or SIDE=LABEL,...");
  if (name == "all") return {std::nullopt, rule};
  const auto side = names.find(name);
  if (side == names.end())
    throw InputError("`side` " + text + ": expected left, right, front, back, bottom, top or all");
  return {side->second, rule};
}

void readSides(const std::vector<std::string>& texts, const LabelGrid& grid, ModelOptions& model) {
  for (const std::string& text : texts) {
    const auto [side, rule] = sideAndRule(text);
    SideRule parsed;
    if (rule == "free") {
      parsed.kind = SideRule::Kind::Free;
    } else if (rule != "example") {
      parsed.kind = SideRule::Kind::Labels;
      parsed.labels = parseLabels(rule, grid, "`side` " + text);
    }
    for (int s = 0; s < 6; ++s) {
      if (!side || static_cast<int>(*side) == s) model.sides[s] = parsed;
    }
  }
}

/// "LABEL,...=NUMBER": the labels and their weight.
std::pair<std::string, double> labelsAndWeight(const std::string& text) {
  const auto [labels, value] = keyAndValue(text, "`weight`", "LABEL,...=NUMBER");
  const double weight = parseNumber(value, "`weight` " + text);
  if (weight < 0) throw InputError("`weight` " + text + ": a weight is 0 or more");
  return {labels, weight};
}
std::pair<std::string, std::string> labelsAndMap(const std::string& text) {
  return keyAndValue(text, "`weight-map`", "LABEL,...=PICTURE.png");
}

/// "LABEL,...=LEAST..MOST": the labels, and a limit without them.
std::pair<std::string, CountLimit> labelsAndCount(const std::string& text) {
  const std::string what = "`count` " + text;
  const auto [labels, range] = keyAndValue(text, "`count`", "LABEL,...=LEAST..MOST");
  const std::size_t dots = range.find("..");
  CountLimit limit;
  const std::string least = range.substr(0, dots);
  if (!least.empty()) limit.least = wholeNumber(parseNumber(least, what), what);
  const std::string most = dots == std::string::npos ? least : range.substr(dots + 2);
  if (!most.empty()) limit.most = wholeNumber(parseNumber(most, what), what);
  return {labels, limit};
}

/// Adds what labels become, "LABEL=LABEL", to a table of a symmetry. A mirror image's image is the
/// label itself.
void readImages(const std::vector<std::string>& texts, const std::string& what, bool mirror,
                const LabelGrid& grid, std::vector<Label>& table) {
  for (const std::string& text : texts) {
    const auto [from, to] = keyAndValue(text, what, "LABEL=LABEL");
    const std::vector<Label> a = parseLabels(from, grid, what), b = parseLabels(to, grid, what);
    if (a.size() != 1 || b.size() != 1)
      throw InputError(what + " " + text + ": expected one label on each side");
    if (table.empty()) {
      for (int label = 0; label < grid.labelCount(); ++label)
        table.push_back(static_cast<Label>(label));
    }
    table[a[0]] = b[0];
    if (mirror) table[b[0]] = a[0];
  }
}

/// The grays of a picture seen from above, 0..1, for each cell of a layer. A cell has the mean of
/// its pixels; a picture smaller than the result gives its nearest ones.
Array3D<float> graysOf(const Image16& image, const Vec3i& size) {
  const auto gray = [&](int x, int y) {
    const std::uint16_t* p = image.at(x, y);
    const double v = image.channels < 3 ? p[0] : 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    return v / 65535;
  };
  Array3D<float> map({size.x, size.y, 1});
  forEachCell(map.size(), [&](const Vec3i& cell) {
    const int x0 = static_cast<int>(std::int64_t{cell.x} * image.width / size.x);
    const int x1 = static_cast<int>((std::int64_t{cell.x} + 1) * image.width / size.x);
    const int row = size.y - 1 - cell.y;
    const int y0 = static_cast<int>(std::int64_t{row} * image.height / size.y);
    const int y1 = static_cast<int>((std::int64_t{row} + 1) * image.height / size.y);
    double sum = 0;
    int pixels = 0;
    for (int j = y0; j < std::max(y1, y0 + 1); ++j) {
      for (int i = x0; i < std::max(x1, x0 + 1); ++i, ++pixels) sum += gray(i, j);
    }
    map[cell] = static_cast<float>(sum / pixels);
  });
  return map;
}

/// A map of the result: a picture seen from above, or, from a grid of the result's own size, the
/// number in each cell.
Array3D<float> readMap(const std::string& path, const Vec3i& size, const std::string& what) {
  if (lowerExtension(path) != ".png") {
    const LabelGrid grid = readLabelGrid(path);
    if (grid.size() != size) {
      throw InputError(what + ": " + path + " has " + readableSize(grid.size(), "cells") +
                       ", and the result " + readableSize(size, "cells"));
    }
    Array3D<float> map(size);
    for (std::size_t n = 0; n < map.count(); ++n)
      map.values()[n] = static_cast<float>(grid.cells.values()[n]);
    return map;
  }
  const Image16 image = readPng16(path);
  // The picture may be larger or smaller, but not of another shape: within a pixel or a cell.
  const double width = static_cast<double>(image.height) * size.x / size.y;
  if (std::abs(width - image.width) > 1 + width / std::min(size.x, size.y)) {
    throw InputError(what + ": " + path + " has " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " pixels, and the result " +
                     std::to_string(size.x) + " x " + std::to_string(size.y) +
                     " cells seen from above: not of one shape");
  }
  return graysOf(image, size);
}

void readWeights(const ModelSettings& settings, const LabelGrid& grid, ModelOptions& model) {
  for (const std::string& text : settings.weight) {
    const auto [labels, weight] = labelsAndWeight(text);
    if (model.weights.empty()) model.weights.assign(grid.labels.size(), 1.0);
    for (const Label label : parseLabels(labels, grid, "`weight` " + text))
      model.weights[label] = weight;
  }
  for (const std::string& text : settings.weightMap) {
    const auto [labels, path] = labelsAndMap(text);
    model.weightMaps.push_back({parseLabels(labels, grid, "`weight-map` " + text),
                                readMap(path, model.size, "`weight-map`")});
  }
}

void readMask(const std::string& path, ModelOptions& model) {
  if (path.empty()) return;
  const Array3D<float> map = readMap(path, model.size, "`mask`");
  model.mask = Array3D<std::uint8_t>(model.size);
  forEachCell(model.size, [&](const Vec3i& c) {
    model.mask[c] = map(c.x, c.y, std::min(c.z, map.size().z - 1)) >= 0.5f;
  });
}

void readLimits(const ModelSettings& settings, const LabelGrid& grid, ModelOptions& model) {
  for (const std::string& text : settings.count) {
    auto [labels, limit] = labelsAndCount(text);
    limit.labels = parseLabels(labels, grid, "`count` " + text);
    model.counts.push_back(std::move(limit));
  }
  for (const std::string& text : settings.connect)
    model.connected.push_back(parseLabels(text, grid, "`connect`"));
}

/// Whether the outermost layers across `axis` (x or y) cut objects off: show, beside what is most
/// frequent at a height, labels that occur further inside, too. The ends of a ground do not, for
/// they are pieces of their own.
bool cutsObjects(const LabelGrid& grid, int axis) {
  const Vec3i n = grid.size();
  if (n.x < 3 || n.y < 3) return false;
  for (int z = 0; z < n.z; ++z) {
    std::map<Label, int> all;
    std::set<Label> inside, outermost;
    Vec3i p{0, 0, z};
    for (p.y = 0; p.y < n.y; ++p.y) {
      for (p.x = 0; p.x < n.x; ++p.x) {
        const Label label = grid.cells[p];
        ++all[label];
        if (p[axis] == 0 || p[axis] == n[axis] - 1) {
          outermost.insert(label);
        } else if (p.x > 0 && p.y > 0 && p.x < n.x - 1 && p.y < n.y - 1) {
          inside.insert(label);
        }
      }
    }
    const auto most = std::max_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const Label label : outermost) {
      if (label != most->first && !isEmpty(grid.labels[label]) && inside.contains(label))
        return true;
    }
  }
  return false;
}

/// Where a result may end: a picture, a field cut by its box, and labels that reach their sides are
/// windows into something larger.
void usualSides(const Example& example, ModelOptions& model) {
  const Axes& periodic = example.reading.image.periodic;
  for (int axis = 0; axis < 3; ++axis) {
    if (!periodic[axis]) continue;
    for (const int side : {2 * axis, 2 * axis + 1})
      model.sides[side] = SideRule{SideRule::Kind::Free, {}};
  }
  if (std::holds_alternative<ImageLabels>(example.content) ||
      std::holds_alternative<TiledMap>(example.content)) {
    model.sides.fill(SideRule{SideRule::Kind::Free, {}});
    const Axes directed = directedAxes(example);
    for (int side = 0; side < 4; ++side)
      if (directed[side / 2]) model.sides[side].kind = SideRule::Kind::Example;
  }
  if (const auto* labeled = std::get_if<LabeledField>(&example.content)) {
    const std::array<bool, 6> cut = cutSides(labeled->field);
    for (std::size_t side = 0; side < cut.size(); ++side)
      if (cut[side]) model.sides[side].kind = SideRule::Kind::Free;
    return;
  }
  const Axes cut = cutAtSides(example);
  for (int axis = 0; axis < 2; ++axis) {
    if (!cut[axis]) continue;
    // What runs along an axis and is cut at one end may be cut at the other, too.
    model.sides[2 * axis].kind = model.sides[2 * axis + 1].kind = SideRule::Kind::Open;
  }
}

void readSymmetry(const ModelSettings& settings, const Example& example, ModelOptions& model) {
  model.symmetry.mirrorX = settings.mirror.x;
  model.symmetry.mirrorY = settings.mirror.y;
  if (const auto* pieces = std::get_if<ModelPieces>(&example.content)) {
    model.symmetry.mirroredX = pieces->mirroredX;
    model.symmetry.mirroredY = pieces->mirroredY;
    model.symmetry.turned = pieces->turned;
  } else if (const auto* tiles = std::get_if<TiledMap>(&example.content)) {
    model.symmetry.mirroredX = tiles->mirroredX;
    model.symmetry.mirroredY = tiles->mirroredY;
    model.symmetry.turned = tiles->turned;
  }
  const LabelGrid& grid = example.labels();
  readImages(settings.mirroredX, "`mirrored-x`", true, grid, model.symmetry.mirroredX);
  readImages(settings.mirroredY, "`mirrored-y`", true, grid, model.symmetry.mirroredY);
  readImages(settings.turned, "`turned`", false, grid, model.symmetry.turned);
}

}  // namespace

const SettingTable<ModelSettings>& modelSettings() {
  static const SettingTable<O> table{
      choiceRow<O, ModelMethod>(
          "method", [](O & o) -> auto& { return o.options.method; },
          "label the whole grid in one pass, or modify a consistent start block by block; auto: "
          "whole, and blocks where that does not end",
          {{"auto", ModelMethod::Auto},
           {"whole", ModelMethod::Whole},
           {"blocks", ModelMethod::Blocks}}),
      choiceRow<O, LabelChoice>(
          "choice", [](O & o) -> auto& { return o.options.choice; },
          "how probable labels are: as frequent as in the example beside the neighbors, in like "
          "surroundings of 3 x 3 x 3 cells (resemblance), or all over (frequency); or all alike "
          "(uniform); with `moves` that of cells between patches",
          {{"neighbors", LabelChoice::Neighbors},
           {"resemblance", LabelChoice::Resemblance},
           {"frequency", LabelChoice::Frequency},
           {"uniform", LabelChoice::Uniform}}),
      settingRow<O>(
          "block", [](O & o) -> auto& { return o.options.block; },
          "method blocks: the size of a block", {2, 32767}, "cells", "10"),
      settingRow<O>("rounds", [](O & o) -> auto& { return o.options.rounds; },
                    "method blocks: rounds over all blocks", {1, 100}),
      settingRow<O>("patience", [](O & o) -> auto& { return o.options.patience; },
                    "method auto: blocks take over where repairs have taken this many times the "
                    "work of labeling so far",
                    {0, 1e6}),
      settingRow<O>(
          "metropolis", [](O & o) -> auto& { return o.options.metropolis; },
          "weights and maps decide whether a modified block is kept (Metropolis; Merrell 2007, "
          "section 4.2), not which labels are chosen; implies method blocks"),
      settingRow<O>("budget", [](O & o) -> auto& { return o.options.budget; },
                    "conflicts that the exact solver may meet in one region", {1, 1e12}),
      settingRow<O>(
          "moves", [](O & o) -> auto& { return o.options.moves; },
          "patches of the example that are tried in each column of the result once it is labeled; "
          "one is kept if blocks of 1, 2 and 3 cells a side then occur more nearly as often as in "
          "the example; fewer where a result of more than 12,000 columns is made of windows of a "
          "smaller one; 0: none",
          {0, 10000}),
      settingRow<O>(
          "copy-price", [](O & o) -> auto& { return o.options.copyPrice; },
          "what a window of 8 x 8 columns costs that stands verbatim in the example, in blocks "
          "that occur too often; 0: copies are as good as anything",
          {0, 1e6}),
      textsRow(
          "side", &O::side,
          "what may be at a side of the result: SIDE=example (the default), SIDE=free (that of "
          "pictures and maps of tiles, except at ends as different as earth and sky, and of sides "
          "at which the example cuts objects off) or SIDE=LABEL,...; left, right, front, back, "
          "bottom, top or all"),
      {{.key = "mask",
        .type = SettingType::File,
        .meaning = "a .png seen from above: black cells are holes, left empty; or a .txt, .vox or "
                   ".vdb of the result's size, whose cells with 0 are"},
       [](const Setting&, const std::string& text, O& o) { o.mask = text; }},
      textsRow("weight", &O::weight,
               "make labels more or less frequent: LABEL,...=NUMBER (1); 0 forbids them"),
      textsRow("weight-map", &O::weightMap,
               "make labels frequent where a picture seen from above is white: "
               "LABEL,...=PICTURE.png; or as often as the numbers in a .txt, .vox or .vdb of the "
               "result's size say"),
      textsRow("count", &O::count, "how many cells have some labels: LABEL,...=LEAST..MOST"),
      textsRow("connect", &O::connect,
               "labels whose cells must form one connected piece: LABEL,..."),
      settingRow<O>("mirror", &O::mirror,
                    "make the result its own mirror image across x, y or both (xy)"),
      choiceRow<O, int>("turns", [](O & o) -> auto& { return o.options.symmetry.turns; },
                        "alike after a half (2) or quarter (4) turn",
                        {{"1", 1}, {"2", 2}, {"4", 4}}),
      settingRow<O>("copies", [](O & o) -> auto& { return o.options.symmetry.copies; },
                    "equal parts along each axis; each divides the size there", {1, 32767}),
      textsRow("mirrored-x", &O::mirroredX,
               "labels that are mirror images of each other across x: LABEL=LABEL (known of model "
               "pieces; others are their own)"),
      textsRow("mirrored-y", &O::mirroredY, "the same across y"),
      textsRow("turned", &O::turned,
               "what a label becomes by a quarter turn anticlockwise: LABEL=LABEL"),
      textsRow("offset", &O::offset,
               "keep the example's pairs at a further offset, too: X,Y,Z, as 1,1,0"),
      settingRow<O>("frames", &O::frames,
                    "the examples are the frames of one that changes over time; make this many of "
                    "the result",
                    {1, 10000}, "", "none"),
      settingRow<O>(
          "loop", [](O & o) -> auto& { return o.options.loop; },
          "the last frame is followed by the first")};
  return table;
}

void checkTexts(const ModelSettings& settings) {
  if (settings.mirror.z) throw InputError("`mirror`: expected x, y or xy");
  for (const std::string& text : settings.side) sideAndRule(text);
  for (const std::string& text : settings.weight) labelsAndWeight(text);
  for (const std::string& text : settings.weightMap)
    requireThere(Source(labelsAndMap(text).second));
  for (const std::string& text : settings.count) labelsAndCount(text);
  if (!settings.mask.empty()) requireThere(Source(settings.mask));
  for (const auto& [texts, what] : {std::pair{&settings.mirroredX, "`mirrored-x`"},
                                    {&settings.mirroredY, "`mirrored-y`"},
                                    {&settings.turned, "`turned`"}})
    for (const std::string& text : *texts) keyAndValue(text, what, "LABEL=LABEL");
  adjacencyOptions(settings);
}

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Whether a word says a label's number, its name, a part of its name between commas ("concrete"
/// of "roof 12, concrete"), or such a part without its number ("roof").
bool says(std::string_view word, int label, const std::string& name) {
  int number = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc{} && end == word.data() + word.size()) return label == number;
  if (word == name) return true;
  for (const std::string& text : split(name, ',')) {
    const std::string_view part = trimmed(text);
    if (part == word) return true;
    const std::size_t space = part.find_last_of(' ');
    if (space != part.npos && part.substr(0, space) == word &&
        part.find_first_not_of("0123456789", space + 1) == part.npos)
      return true;
  }
  return false;
}

}  // namespace

std::vector<Label> parseLabels(const std::string& text, const LabelGrid& grid,
                               const std::string& what) {
  std::set<Label> labels;
  const std::vector<std::string> words = split(text, ',');
  for (std::size_t w = 0; w < words.size();) {
    if (words[w].empty()) {
      ++w;
      continue;
    }
    // The longest name with commas that the words from here on make; else what each word says.
    std::string name = words[w], longest;
    std::size_t after = w;
    for (std::size_t end = w + 1; end < words.size(); ++end) {
      name += "," + words[end];
      const bool known = std::any_of(grid.labels.begin(), grid.labels.end(),
                                     [&](const LabelLook& look) { return look.name == name; });
      if (!known) continue;
      longest = name;
      after = end + 1;
    }
    if (after > w) {
      for (int label = 0; label < grid.labelCount(); ++label)
        if (grid.labels[label].name == longest) labels.insert(static_cast<Label>(label));
      w = after;
      continue;
    }
    bool found = false;
    const std::vector<std::string> all = split(words[w], '+');
    for (int label = 0; label < grid.labelCount(); ++label) {
      const bool match = std::all_of(all.begin(), all.end(), [&](const std::string& word) {
        return says(trimmed(word), label, grid.labels[label].name);
      });
      if (!match && !says(trimmed(words[w]), label, grid.labels[label].name)) continue;
      labels.insert(static_cast<Label>(label));
      found = true;
    }
    if (!found) {
      throw InputError(what + ": there is no label '" + words[w] + "'; labels are 0 to " +
                       std::to_string(grid.labelCount() - 1) +
                       ", their names, or words of these (see exemplar info)");
    }
    ++w;
  }
  if (labels.empty()) throw InputError(what + ": no label is given");
  return {labels.begin(), labels.end()};
}

ModelOptions modelOptions(const Request& request, const ModelSettings& settings,
                          const Example& example) {
  ModelOptions model = settings.options;
  const LabelGrid& grid = example.labels();
  model.seed = request.seed;
  model.size = resultSize(request, cellsOfExample(example), example.hints.scale, "cells");
  model.periodic = request.periodic;
  model.frames = settings.frames.value_or(1);
  if (const auto* image = std::get_if<ImageLabels>(&example.content);
      image && image->options.overlap) {
    for (int axis = 0; axis < 2; ++axis)
      model.reach[axis] = image->options.periodic[axis] ? 0 : image->options.piece - 1;
  }
  usualSides(example, model);
  readSides(settings.side, grid, model);
  readSymmetry(settings, example, model);
  for (const Pin& pin : request.decided.pins)
    model.pins.push_back({pin.cell, parseLabels(pin.labels, grid, "`pin`"), pin.frame});
  readWeights(settings, grid, model);
  readMask(settings.mask, model);
  readLimits(settings, grid, model);
  return model;
}

AdjacencyOptions adjacencyOptions(const ModelSettings& settings) {
  AdjacencyOptions adjacency;
  adjacency.frames = settings.frames.has_value();
  for (const std::string& text : settings.offset) {
    const Vec3i offset = parseCell(text, "`offset` " + text);
    adjacency.offsets.push_back({offset.x, offset.y, offset.z});
  }
  return adjacency;
}

std::vector<LabelGrid> modelGrids(std::span<const Example> examples) {
  std::vector<LabelGrid> grids;
  for (const Example& example : examples) grids.push_back(example.labels());
  for (const Example& example : examples) {
    if (const auto* image = std::get_if<ImageLabels>(&example.content))
      for (const ImageLabels::Turned& turned : image->turned) grids.push_back(turned.grid);
  }
  return grids;
}

void originsInExamples(std::span<const Example> examples, Origins& origins) {
  std::vector<std::pair<std::uint16_t, const ImageLabels::Turned*>> turned;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    if (const auto* image = std::get_if<ImageLabels>(&examples[e].content))
      for (const ImageLabels::Turned& t : image->turned)
        turned.emplace_back(static_cast<std::uint16_t>(e), &t);
  }
  if (turned.empty()) return;
  for (Origin& origin : origins.values()) {
    if (origin.example < examples.size()) continue;
    const auto& [example, grid] = turned[origin.example - examples.size()];
    origin = {grid->from[origin.cell()], example};
  }
}

Adjacency adjacencyOf(std::span<const Example> examples, const AdjacencyOptions& options) {
  const auto* labeled = std::get_if<LabeledField>(&examples.front().content);
  if (labeled && labeled->blocks.stride != labeled->blocks.block) {
    if (!options.offsets.empty() || options.frames || options.periodic.any()) {
      throw InputError(
          "`field-overlap`: which blocks are neighbors follows from the samples they share; leave "
          "out settings about the example's pairs, or the overlap");
    }
    return labeled->blocks.adjacency;
  }
  const std::vector<LabelGrid> grids = modelGrids(examples);
  AdjacencyOptions all = options;
  all.periodic = examples.front().reading.image.periodic;
  const auto* image = std::get_if<ImageLabels>(&examples.front().content);
  if (!image) return findAdjacency(grids, all);
  if (image->turned.empty()) return imageAdjacency(grids, *image, all);
  if (options.frames)
    throw InputError("`symmetry`: a picture that changes over time is not turned; leave it out");
  Adjacency adjacency = imageAdjacency(grids, *image, all);
  // What is turned does not stand on the ground.
  std::vector<LabelGrid> upright;
  for (const Example& example : examples) {
    upright.push_back(example.labels());
    if (const auto* other = std::get_if<ImageLabels>(&example.content))
      for (const ImageLabels::Turned& t : other->turned)
        if (t.upright) upright.push_back(t.grid);
  }
  adjacency.sides = findAdjacency(upright, all).sides;
  return adjacency;
}

Axes directedAxes(const Example& example) {
  const auto* image = std::get_if<ImageLabels>(&example.content);
  if (!image && !std::holds_alternative<TiledMap>(example.content)) return {};
  const LabelGrid& grid = example.labels();
  // Windows of several pixels are known by one of them: hardly two rows have a window in common.
  const auto shownAt = [&](int axis, int end) {
    std::set<std::array<float, 4>> looks;
    Vec3i p{};
    p[axis] = end ? grid.size()[axis] - 1 : 0;
    for (int i = 0; i < grid.size()[1 - axis]; ++i) {
      p[1 - axis] = i;
      const Label label = grid.cells[p];
      looks.insert(image ? grid.labels[label].color
                         : std::array<float, 4>{static_cast<float>(label), 0, 0, 0});
    }
    return looks;
  };
  Axes directed;
  for (int axis = 0; axis < 2; ++axis) {
    // Mirrored pictures have no left and right, turned ones no up and down.
    if (image && (image->options.periodic[axis] || image->options.symmetry > axis + 1)) continue;
    const auto first = shownAt(axis, 0), last = shownAt(axis, 1);
    directed[axis] =
        std::ranges::none_of(first, [&](const auto& look) { return last.contains(look); });
  }
  return directed;
}

Axes cutAtSides(const Example& example) {
  Axes cut;
  if (std::holds_alternative<ImageLabels>(example.content) ||
      std::holds_alternative<TiledMap>(example.content) ||
      std::holds_alternative<LabeledField>(example.content))
    return cut;
  for (int axis = 0; axis < 2; ++axis) cut[axis] = cutsObjects(example.labels(), axis);
  return cut;
}

Vec3i cellsOfExample(const Example& example) {
  Vec3i cells = example.labels().size();
  const auto* labeled = std::get_if<LabeledField>(&example.content);
  if (!labeled) return cells;
  const FieldBlocks& blocks = labeled->blocks;
  for (int axis = 0; axis < 3; ++axis)
    cells[axis] = (cells[axis] - 1) * blocks.step[axis] / blocks.stride[axis] + 1;
  return cells;
}

}  // namespace exemplar
