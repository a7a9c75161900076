// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "measure/figures.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <vector>

namespace exemplar {
namespace {

class List {
 public:
  std::vector<Figure> figures;

  void group(std::string name) { group_ = std::move(name); }
  template <class T>
  void add(std::string key, const T& value, const char* meaning) {
    figures.push_back({group_, key, value, meaning});
  }
  template <class T>
  void add(std::string key, const std::optional<T>& value, const char* meaning) {
    if (value) {
      add(key, *value, meaning);
    } else {
      add(key, std::monostate{}, meaning);
    }
  }

 private:
  std::string group_;
};

void addLikeness(List& list, const Likeness& l) {
  const auto share = [](const std::optional<PatchLikeness>& p) {
    return p ? std::optional(p->share) : std::nullopt;
  };
  list.group("likeness");
  list.add("lp_dense", l.dense.share, "of the result's windows, as in the example; 1 is best");
  list.add("coverage", l.coverage.share, "of the example's windows, as in the result; 1 is best");
  list.add("lp_dense_interior", share(l.denseInterior), "the same, wholly inside the box");
  list.add("coverage_interior", share(l.coverageInterior), "the same, wholly inside the box");
  list.add("lp_dense_mean_iou", l.dense.meanIou, "mean of the windows' best matches");
  list.add("coverage_mean_iou", l.coverage.meanIou, "mean of the windows' best matches");
  list.add("lp_published", l.published.share, "at stride 5: to compare with published work only");
  list.add("fpd", l.patches ? std::optional(l.patches->distance) : std::nullopt,
           "distance of the patches' distributions, voxels²; its floor is best");
  list.add("fpd_floor", l.patches ? std::optional(l.patches->floor) : std::nullopt,
           "of the example against itself");
  list.add("occupancy_ratio", l.occupancyRatio, "solid share over the example's; 1 is best");
  list.add("surface_ratio", l.surfaceRatio, "surface density over the example's; 1 is best");
  const auto pieces = [&](double Pieces::*figure) {
    return l.pieces ? std::optional((*l.pieces).*figure) : std::nullopt;
  };
  list.add("pieces_per_million_cells", pieces(&Pieces::resultPerMillion),
           "whole pieces in the result");
  list.add("pieces_per_million_cells_example", pieces(&Pieces::examplePerMillion),
           "whole pieces in the example");
  list.add("pieces_depth", pieces(&Pieces::depth), "voxels below the surface where pieces begin");
  list.add("broken_share", pieces(&Pieces::brokenShare),
           "solid in pieces under half of the example's smallest; 0 is best");
}

void addMultiscale(List& list, const std::optional<MultiscaleDistance>& m) {
  list.add("multiscale", m ? std::optional(m->ratio) : std::nullopt,
           "distance of shapes at several scales, over its floor; 1 for a fresh sample");
  for (const int scale : {1, 2, 4, 8}) {
    std::optional<double> ratio;
    for (const ScaleDistance& at : m ? m->scales : std::vector<ScaleDistance>{})
      if (at.scale == scale) ratio = at.ratio();
    list.add("multiscale_" + std::to_string(scale), ratio,
             scale == 1 ? "the same at samples of one voxel" : "at samples of that many voxels");
  }
}

void addWholeness(List& list, const Wholeness& w) {
  list.group("wholeness");
  list.add("pieces", w.pieces, "connected components of 8 cells or more");
  list.add("pieces_example", w.examplePieces, "the same in the example");
  list.add("largest_piece", w.largestShare, "its share of the solid");
  list.add("largest_piece_example", w.exampleLargestShare, "the same in the example");
  list.add("floating", w.floatingShare, "share of the solid with nothing under it");
  list.add("floating_example", w.exampleFloatingShare, "the same in the example");
  list.add("flat", w.flatShare, "share of the surface in flat squares that face an axis");
  list.add("flat_example", w.exampleFlatShare, "the same in the example");
  list.add("sliced", w.slicedShare, "how much more of it there is; 0 is best");
  list.add("open", w.openShare, "share of the surface cut by the box where the example has air");
  list.add("tunnels", w.tunnels, "ways through, for each 10,000 faces of the surface");
  list.add("tunnels_example", w.exampleTunnels, "the same in the example");
  list.add("bubbles", w.bubbles, "pockets of air, for each 10,000 faces of the surface");
  list.add("bubbles_example", w.exampleBubbles, "the same in the example");
  list.add("layers", w.layers, "difference of the solid shares of each height; 0 is best");
}

void addLandmarks(List& list, const Landmarks& l) {
  list.group("landmarks");
  list.add("landmarks", static_cast<std::int64_t>(l.occurrences.size()),
           "windows that the example has only once");
  const auto of = [&](double value) { return l.any() ? std::optional(value) : std::nullopt; };
  list.add("landmark_mean", of(l.mean()), "how often they are in the result");
  list.add("landmark_most", static_cast<std::int64_t>(l.most()), "the same of the commonest");
  list.add("landmarks_repeated", of(l.repeated()),
           "share that is there more than once, in larger results twice; 0 is best");
}

void addNovelty(List& list, const Novelty& n) {
  list.group("novelty");
  list.add("distance_to_example", n.distance, "1 - IoU, cell by cell; 0 is a copy");
  list.add("distance_to_shifted_example", n.copyDistance, "1 - IoU, best placed; 0 is a copy");
  list.add("distance_to_rolled_example", n.rolled.distance,
           "1 - IoU after the best cyclic shift; 0 is a moved copy or its halves exchanged");
  list.add("distance_to_rolled_example_least", n.rolled.least,
           "the same of the most alike window of the example's size");
  list.add("distance_to_turned_example", n.turned.distance,
           "the same over quarter turns and mirror images, too");
  std::string fair;
  for (int axis = 0; axis < 3; ++axis)
    if (n.rollingIsFair[axis]) fair += "xyz"[axis];
  list.add("rolling_is_fair", fair.empty() ? std::string("none") : fair,
           "axes along which the example fills its box evenly, so that moving it is no loss");
  list.add("verbatim_run", n.verbatimRun, "mean size of copied regions, in examples; 1 is a copy");
  list.add("use", n.use, "evenness of the use of the example's surface; 1 is even");
  list.add("used_share", n.usedShare, "share of the example's surface in use");
  const auto offsets = [&](auto OffsetUse::*figure) {
    return n.offsets ? std::optional((*n.offsets).*figure) : std::nullopt;
  };
  list.add("top_offset", offsets(&OffsetUse::top),
           "share of the surface from the commonest source offset; 1 is a moved copy");
  list.add("top_offset_rolled", offsets(&OffsetUse::topRolled),
           "the same modulo the example's size; 1 is a tiling or a rolled copy");
  list.add("offsets_95", offsets(&OffsetUse::offsets95),
           "how many offsets make 95 % of the surface");
}

void addSeams(List& list, const Seams& s) {
  list.group("seams");
  list.add("seam_jump", s.jump, "mean jump where the source changes, voxels; 0 is best");
  list.add("seam_jump_ratio", s.jumpRatio, "over the example's own second difference");
  list.add("seam_jump_near_surface", s.nearJump, "within 3 voxels of the surface, voxels");
  list.add("seam_jump_ratio_near_surface", s.nearJumpRatio, "over the example's, near its surface");
  list.add("seam_share", s.seamShare, "of the cell faces, where the source changes");
  list.add("eikonal_residual", s.eikonalResidual, "mean | |grad| - 1 | near the surface");
  list.add("eikonal_residual_example", s.exampleEikonalResidual, "the same in the example");
}

void addMesh(List& list, const MeshHealth& m) {
  list.group("mesh");
  list.add("closed", m.closed(), "no open edge");
  list.add("manifold", m.manifold(), "a surface around each edge and vertex");
  list.add("oriented", m.oriented(), "all triangles wind the same way");
  list.add("vertices", m.vertices, "");
  list.add("triangles", m.triangles, "");
  list.add("components", m.components, "connected by shared vertices");
  list.add("boundary_edges", m.boundaryEdges, "");
  list.add("non_manifold_edges", m.nonManifoldEdges, "");
  list.add("non_manifold_vertices", m.nonManifoldVertices, "");
  list.add("misoriented_edges", m.misorientedEdges, "");
  list.add("self_intersections", m.selfIntersections, "crossing pairs of triangles");
  list.add("degenerate_triangles", m.degenerateTriangles, "without area");
}

/// A figure that every map of terrain has.
struct TerrainRow {
  const char* key;
  std::optional<double> TerrainFigures::*figure;
  const char* meaning;
};
constexpr TerrainRow kTerrainRows[] = {
    {"flooded_share", &TerrainFigures::floodedShare, "of the cells, below where they spill over"},
    {"depressions_per_million_cells", &TerrainFigures::depressions, "closed ones"},
    {"depressions_per_km2", &TerrainFigures::depressionsKm2, "where the unit is known"},
    {"depression_depth", &TerrainFigures::depressionDepth, "mean"},
    {"drainage_density", &TerrainFigures::drainageDensity, "length of streams for each area"},
    {"bifurcation_ratio", &TerrainFigures::bifurcation, "streams of an order for each of the next"},
    {"highest_order", &TerrainFigures::highestOrder, "Strahler's; grows with the map"},
    {"valley_length", &TerrainFigures::valleyLength, "mean, between closed depressions"},
    {"valley_reach", &TerrainFigures::valleyReach, "mean, weighted by length"},
    {"ridge_length", &TerrainFigures::ridgeLength, "mean"},
    {"spectrum_slope", &TerrainFigures::spectrumSlope, "of power over wave number, logarithms"},
    {"relief", &TerrainFigures::relief, "highest less lowest"},
    {"largest_step", &TerrainFigures::largestStep, "between neighbors"},
    {"flat_share", &TerrainFigures::flatShare, "of the cells, with under 2 % of the mean slope"},
    {"repeated_peaks", &TerrainFigures::repeatedPeaks, "share of peaks that occur twice"},
    {"repeated_shapes", &TerrainFigures::repeatedShapes, "of shapes that do, at any angle"}};

std::string text(const Figure& figure) {
  char number[64];
  if (const auto* b = std::get_if<bool>(&figure.value)) return *b ? "yes" : "no";
  if (const auto* i = std::get_if<std::int64_t>(&figure.value)) return std::to_string(*i);
  if (const auto* s = std::get_if<std::string>(&figure.value)) return *s;
  if (const auto* d = std::get_if<double>(&figure.value)) {
    std::snprintf(number, sizeof number, *d != 0 && *d < 0.001 && *d > -0.001 ? "%.2e" : "%.4g",
                  *d);
    return number;
  }
  return "-";
}

}  // namespace

std::vector<Figure> figures(const Measures& measures) {
  List list;
  addLikeness(list, measures.likeness);
  addMultiscale(list, measures.multiscale);
  list.add("windows", measures.likeness.dense.windows, "windows drawn for lp_dense");
  addWholeness(list, measures.wholeness);
  addLandmarks(list, measures.landmarks);
  addNovelty(list, measures.novelty);
  list.group("frontier");
  list.add("likeness",
           measures.multiscale ? std::optional(measures.multiscale->ratio) : std::nullopt,
           "multiscale, to be read beside novelty: 2 or less is alike, 1.5 for a material");
  list.add("novelty", measures.novelty.rolled.distance,
           "distance_to_rolled_example: 0.2 or more is new");
  list.add("kind",
           measures.frontier ? std::optional(frontierName(*measures.frontier)) : std::nullopt,
           "new_and_alike, copied, strange (new, not alike) or neither");
  addSeams(list, measures.seams);
  if (measures.mesh) addMesh(list, *measures.mesh);
  list.group("collapse");
  list.add("kind", collapseName(measures.collapse), "none, all_empty, all_solid or repeated");
  list.group("doubts");
  const char* const meanings[] = {"it is the example, at rest, moved or tiled",
                                  "it fell into more pieces",
                                  "parts have nothing under them",
                                  "what the example has only once is there again and again",
                                  "it is fuller or emptier by 15 %",
                                  "flat cuts that the example does not have",
                                  "the box cuts it where the example ends in air"};
  for (std::size_t d = 0; d < kDoubts.size(); ++d) {
    const bool doubted = std::ranges::find(measures.doubts, kDoubts[d]) != measures.doubts.end();
    list.add(doubtName(kDoubts[d]), doubted, meanings[d]);
  }
  return std::move(list.figures);
}

std::vector<Figure> figures(const Content& c) {
  List list;
  list.group("content");
  list.add("labels_used", c.labelsUsed, "share of the example's labels; 1 is best");
  list.add("label_shares", c.labelShares, "distance of the labels' shares, 0..1; 0 is best");
  list.add("density", c.density, "built cells per column over the example's; 1 is best");
  list.add("layers", c.layers, "difference of what is built at each height; 0 is best");
  list.add("density_inside", c.densityInside, "of the columns that no vertical side touches");
  list.add("layers_inside", c.layersInside, "of the columns that no vertical side touches");
  list.add("objects", c.objects, "objects for each 100 columns");
  list.add("objects_example", c.exampleObjects, "objects for each 100 columns of the example");
  list.add("objects_from", std::int64_t{c.objectsFrom}, "the layer from which up they are counted");
  list.add("object_sizes", c.objectSizes, "Kolmogorov-Smirnov distance of sizes; 0 is best");
  list.add("runs_x", c.runs[0], "mean straight run over the example's; 1 is best");
  list.add("runs_y", c.runs[1], "the same along y");
  list.add("runs_z", c.runs[2], "the same along z");
  list.add("js1", c.divergence[0], "divergence of built labels, bits, 0..1; 0 is best");
  list.add("js2", c.divergence[1], "of blocks of 2 cells a side");
  list.add("js3", c.divergence[2], "of blocks of 3 cells a side");
  list.add("js1_halves", c.halvesDivergence[0], "between two halves of the example");
  list.add("js2_halves", c.halvesDivergence[1], "between two halves of the example");
  list.add("js3_halves", c.halvesDivergence[2], "between two halves of the example");
  list.add("in3", c.known, "blocks of 3 cells a side that the example shows; 1 for copies");
  list.add("copy8", c.copied, "windows of 8 x 8 columns verbatim in the example; 0 is new");
  std::optional<double> near, largest;
  if (c.nearCopies) {
    near = c.nearCopies->windows;
    largest = c.nearCopies->largest;
  }
  list.add("near8", near, "windows that agree with the example's but for 5 %; 0 is new");
  list.add("largest_copy", largest, "largest area of these, of the example's; 1 is all of it");
  return std::move(list.figures);
}

std::vector<Figure> figures(const LayersLikeness& l) {
  List list;
  list.group("layers");
  for (const LayerLikeness& layer : l.layers) {
    const std::string name = "layer" + std::to_string(layer.layer) + "_";
    list.add(name + "area_error", layer.areaError, "share of cells less the example's; 0 is best");
    list.add(name + "boundary_ratio", layer.boundaryRatio,
             "boundary over the example's; 1 is best");
    list.add(name + "to_example", layer.toExample,
             "distance of its patches to the example's, of a patch; 0 is best");
    list.add(name + "to_result", layer.toResult, "distance of the example's to its; 0 is best");
    list.add(name + "usage", layer.usage, "how evenly the example's boundary is used, 0 to 1");
    list.add(name + "longest_run", layer.longestRun,
             "pixels of boundary that are the example's, moved");
    list.add(name + "component_sizes", layer.componentSizes,
             "Kolmogorov-Smirnov distance of sizes; 0 is best");
  }
  list.add("skipping", l.skipping, "share of steps between layers that skip one");
  list.add("skipping_example", l.exampleSkipping, "the same in the example");
  list.add("repeated", l.repeated, "share of windows that occur twice; 0 is best");
  list.add("repeated_example", l.exampleRepeated, "the same in the example");
  return std::move(list.figures);
}

std::vector<Figure> figures(const TerrainLikeness& t) {
  List list;
  list.group("terrain");
  const auto distance = [&](const std::string& key, const TerrainLikeness::Distance& d) {
    list.add(key, d.result, "earth mover's, in deviations of the example; the floor is best");
    list.add(key + "_floor", d.floor, "between the example's halves");
  };
  distance("heights_distance", t.heights);
  distance("slopes_distance", t.slopes);
  distance("curvature_distance", t.curvature);
  for (const TerrainRow& row : kTerrainRows) {
    const std::string key = row.key;
    list.add(key, t.result.*row.figure, row.meaning);
    list.add(key + "_example", t.example.*row.figure, "the example's");
    list.add(key + "_half1", t.firstHalf.*row.figure, "of its first half");
    list.add(key + "_half2", t.secondHalf.*row.figure, "of its second half");
  }
  list.add("step_ratio", t.stepRatio, "the largest step over the example's; 1 is best");
  list.add("seam_step_ratio", t.seamStepRatio, "the largest across a seam; 1 or less is best");
  list.add("seam_mean_step_ratio", t.seamMeanStepRatio, "the mean across seams; 1 is best");
  list.add("verbatim_share", t.verbatimShare, "of windows that the example has; 0 is new");
  list.add("copied_shapes", t.copiedShapes.result, "that the example has at any angle");
  list.add("copied_shapes_floor", t.copiedShapes.floor, "of its one half in the other");
  list.add("copied_layout", t.copiedLayout.result, "the same of mountains and main valleys");
  list.add("copied_layout_floor", t.copiedLayout.floor, "of its one half in the other");
  return std::move(list.figures);
}

std::string figuresTable(const TerrainLikeness& t) {
  using Cell = std::optional<double>;
  struct Row {
    std::string key;
    Cell example, first, second, result;
    const char* meaning;
  };
  std::vector<Row> rows;
  const auto distance = [&](const char* key, const TerrainLikeness::Distance& d) {
    rows.push_back({key, {}, {}, d.floor, d.result, "to the example; its half's, to the other"});
  };
  distance("heights_distance", t.heights);
  distance("slopes_distance", t.slopes);
  distance("curvature_distance", t.curvature);
  for (const TerrainRow& row : kTerrainRows) {
    rows.push_back({row.key, t.example.*row.figure, t.firstHalf.*row.figure,
                    t.secondHalf.*row.figure, t.result.*row.figure, row.meaning});
  }
  rows.push_back({"step_ratio", {}, {}, {}, t.stepRatio, "the largest over the example's"});
  rows.push_back({"seam_step_ratio", {}, {}, {}, t.seamStepRatio, "the largest across a seam"});
  rows.push_back({"seam_mean_step_ratio", {}, {}, {}, t.seamMeanStepRatio, "mean across seams"});
  rows.push_back({"verbatim_share", {}, {}, {}, t.verbatimShare, "windows that the example has"});
  rows.push_back({"copied_shapes",
                  {},
                  {},
                  t.copiedShapes.floor,
                  t.copiedShapes.result,
                  "shapes that the example has, at any angle"});
  rows.push_back({"copied_layout",
                  {},
                  {},
                  t.copiedLayout.floor,
                  t.copiedLayout.result,
                  "the same of mountains and main valleys"});
  std::size_t keys = 0;
  for (const Row& row : rows) keys = std::max(keys, row.key.size());
  constexpr std::size_t kColumn = 11;
  const auto cell = [](const std::string& shown) {
    return std::string(shown.size() < kColumn ? kColumn - shown.size() : 1, ' ') + shown;
  };
  std::string table = "terrain" + std::string(keys - 5, ' ') + cell("example") + cell("its half") +
                      cell("other half") + cell("result") + "\n";
  for (const Row& row : rows) {
    table += "  " + row.key + std::string(keys - row.key.size(), ' ');
    for (const Cell& value : {row.example, row.first, row.second, row.result})
      table += cell(value ? text({{}, {}, *value, {}}) : "-");
    table += std::string("  ") + row.meaning + "\n";
  }
  return table;
}

std::string figuresTable(const std::vector<Figure>& figures) {
  std::size_t keys = 0, values = 0;
  for (const Figure& f : figures) {
    keys = std::max(keys, f.key.size());
    values = std::max(values, text(f).size());
  }
  std::string table;
  const std::string* group = nullptr;
  for (const Figure& f : figures) {
    if (!group || *group != f.group) table += (group ? "\n" : "") + f.group + "\n";
    group = &f.group;
    const std::string value = text(f);
    std::string line = "  " + f.key + std::string(keys - f.key.size() + 2, ' ') +
                       std::string(values - value.size(), ' ') + value;
    if (!f.meaning.empty()) line += "  " + f.meaning;
    table += line + "\n";
  }
  return table;
}

}  // namespace exemplar
