// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/axes.h"
#include "core/origin.h"
#include "core/origin_map.h"
#include "core/outcome.h"
#include "engine/example.h"
#include "maps/layer_map.h"
#include "synth/terrain/height_origin.h"

/// What came out of an engine.
namespace exemplar {

/// One figure of a run.
using Statistic = std::variant<bool, std::int64_t, double, std::string, Vec3i>;
/// Figures of a run by their keys (lower case, words joined by underscores), in the order in which
/// they are reported.
using Statistics = std::vector<std::pair<std::string, Statistic>>;

/// Why nothing meets a request: a smallest set of demands that exclude each other.
struct Conflict {
  std::string text;                ///< one sentence, for people
  std::vector<int> pins;           ///< indices into `Decided::pins`
  std::vector<std::string> sides;  ///< sides of the result with a rule: "left", "top", ...
};

/// More of an example: a field or grids of labels, and where each part of it came from.
struct Result {
  Outcome outcome = Outcome::Complete;
  std::string why;  ///< where it is not complete: one sentence
  std::string engine;
  std::uint64_t seed = 0;
  Axes periodic;  ///< along which copies tile

  /// The result, where it is complete; of labels that change over time, the first frame.
  Representation data;
  std::vector<LabelGrid> laterFrames;
  /// For each sample the example's sample that it was taken from, or for each cell a cell of the
  /// example with its label.
  Origins origins;
  /// Of a field that was laid on a surface: where its points came from, in place of `origins`,
  /// which then only name the nearest sample. It lies in the surface's coordinates.
  std::shared_ptr<const OriginMap> originMap;

  /// Of heights: where each came from.
  Grid<HeightOrigin> heightOrigins;
  /// Of what was made by layers: which layer shows, in the example and in the result.
  std::optional<LayerVolume> exampleLayers, layers;

  Statistics statistics;
  std::optional<Conflict> conflict;  ///< where it is impossible
  /// What people should know of a complete result: a label and a text, "stationary" and "x, y".
  std::vector<std::pair<std::string, std::string>> notes;
  std::vector<std::string> warnings;  ///< what is doubtful about it, and what to change

  Form form() const { return static_cast<Form>(data.index()); }
  const DistanceField& field() const { return std::get<DistanceField>(data); }
  const LabelGrid& labels() const { return std::get<LabelGrid>(data); }
  const Map& map() const { return std::get<Map>(data); }
  const HeightMap& heights() const { return std::get<HeightMap>(data); }
  const continuous::PolygonModel& polygons() const {
    return std::get<continuous::PolygonModel>(data);
  }
};

/// From where a result's field is to where it lies: as its example does, or on a surface.
Turn turnOf(const Result& result, const Example& example);

/// "128 x 128 x 24 samples" or "80 x 80 x 10 cells".
std::string readableExtent(const Result& result);

/// A result's samples, whatever it was made of.
struct SampledResult {
  DistanceField field;
  Origins origins;
};
/// The field of a result of the form Field, or of labels that stand for blocks of one; nothing for
/// other labels.
std::optional<SampledResult> sampled(const Result& result, const Example& example);

/// A result of the form Field, re-made from its origins at `factor` times its resolution; `finer`
/// are its examples, `refined`. Throws `InputError` where the origins do not fit, and `Cancelled`.
Result withDetail(const Result& result, std::span<const Example> finer, int factor,
                  const Progress& progress = {});

/// Reads a result of the form Field back: its .vdb and that of its origins. Throws `InputError`
/// where they do not fit each other or the examples.
Result readResult(const Source& field, const Source& origins, std::span<const Example> examples);

}  // namespace exemplar
