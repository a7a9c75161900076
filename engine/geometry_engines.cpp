// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Geometry synthesis: from fields to a field.

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/cells.h"
#include "core/error.h"
#include "core/memory.h"
#include "engine/engines.h"
#include "engine/field_control.h"
#include "engine/words.h"
#include "measure/collapse.h"
#include "measure/novelty.h"
#include "measure/occupancy.h"
#include "measure/offsets.h"
#include "synth/geometry/blocks.h"
#include "synth/geometry/kept_places.h"
#include "synth/geometry/objects/objects.h"
#include "synth/geometry/quilting/quilting.h"
#include "synth/geometry/stationary.h"
#include "synth/geometry/voting/voting.h"

namespace exemplar {
namespace {

/// About what a sample of a result takes: the field, its origins, the search and the surface.
constexpr double kBytesPerSample = 80;

/// A variation of an object that differs from it by less, 1 - IoU, is hardly one.
constexpr double kVaried = 0.12;

/// A mix is what was asked for up to this, of the surface.
constexpr double kMixOff = 0.1;

Vec3i fieldSize(std::span<const Example> examples, const Request& request) {
  const Example& example = examples.front();
  const Vec3i size = resultSize(request, example.field().size(), example.hints.scale, "samples");
  requireMemory(kBytesPerSample * static_cast<double>(volume(size)),
                "a result of " + readableSize(size, "samples"),
                "use a lower `resolution` or a smaller `scale`");
  return size;
}

/// Warns where the result is all solid, all empty or one part repeated.
void warnOfCollapse(std::span<const Example> examples, const SynthesisResult& made,
                    Result& result) {
  const Occupancy before(examples.front().field()), after(made.field);
  CollapseSigns signs;
  signs.exampleOccupancy = solidFraction(before);
  signs.resultOccupancy = solidFraction(after);
  signs.exampleSurface = surfaceDensity(before);
  signs.resultSurface = surfaceDensity(after);
  if (examples.size() == 1) signs.usedShare = surfaceUse(before, made.origins).usedShare;
  const Collapse collapse = detectCollapse(signs);
  result.statistics.emplace_back("collapse", collapseName(collapse));
  if (collapse != Collapse::None) {
    result.warnings.push_back(
        collapseSentence(collapse, signs) +
        "; try another `seed`, one of `levels` less, or another `stationary`");
  }
}

/// A result of what an algorithm made by a method of that name.
Result resultOf(SynthesisResult made, const std::string& method,
                std::span<const Example> examples) {
  const DistanceField& example = examples.front().field();
  Result result;
  result.statistics = {{"method", method},
                       {"example_samples", example.size()},
                       {"result_samples", made.field.size()},
                       {"voxel_size", example.voxelSize},
                       {"matches", made.matches}};
  warnOfCollapse(examples, made, result);
  result.data = std::move(made.field);
  result.origins = std::move(made.origins);
  return result;
}

/// Axes that were found: parts of what goes on along some move along the others only where the
/// result is longer there, too; a wall stays as high as it is.
Axes withoutSideways(Axes found, const Example& example, const Vec3i& size) {
  if (!example.goesOn.any()) return found;
  for (int axis = 0; axis < 3; ++axis)
    found[axis] =
        found[axis] && (example.goesOn[axis] || size[axis] > example.field().size()[axis]);
  return found;
}

/// Notes along which axes parts were moved, and whether that was found.
void noteStationary(const Axes& axes, bool found, Result& result) {
  result.statistics.emplace_back("stationary", readableAxes(axes));
  result.notes.emplace_back(
      "stationary", readableAxes(axes) + (found ? ", found from the example (`stationary`)" : ""));
}

/// Lays a result so that what is kept, which is `offset` samples from where the example has it,
/// stays where it is in space.
void placeAround(const Vec3i& offset, Result& result) {
  DistanceField& field = std::get<DistanceField>(result.data);
  for (int axis = 0; axis < 3; ++axis) field.origin[axis] -= offset[axis] * field.voxelSize;
}

/// Notes how much of the surface each example made, and warns where that is not what was asked for.
void noteMix(std::span<const Example> examples, const MixOptions& mix, Result& result) {
  const std::vector<double> made =
      surfaceShares(Occupancy(result.field()), result.origins, examples.size());
  std::string text;
  double farthest = 0;
  for (std::size_t e = 0; e < made.size(); ++e) {
    text += (e > 0 ? ", " : "") + std::to_string(std::lround(100 * made[e])) + " % of " +
            examples[e].name();
    const double wanted =
        mix.shares.empty() ? 1.0 / static_cast<double>(made.size()) : mix.shares[e];
    farthest = std::max(farthest, std::abs(made[e] - wanted));
    result.statistics.emplace_back("surface_share_" + std::to_string(e + 1), made[e]);
  }
  result.notes.emplace_back("mix", text + " (of the surface)");
  if (!mix.map && farthest > kMixOff) {
    result.warnings.push_back(
        "the examples do not have the shares of the surface that were asked for (" + text +
        "): they hardly meet; try another `seed` or a larger `scale`, or say where each of them "
        "is wanted (`mix-map`)");
  }
}

constexpr const char* kStationary =
    "axes along which the example is stationary (repeats itself), so that its parts may move along "
    "them: xyz, xy, none, ...";
constexpr const char* kTruncation = "distances are compared up to here";

template <class O>
typename SettingTable<O>::Row stationaryRow() {
  return settingRow<O>("stationary", &O::stationary, kStationary, {}, "",
                       "auto: found from the example");
}
template <class O>
typename SettingTable<O>::Row truncationRow() {
  return settingRow<O>("truncation", &O::truncation, kTruncation, kAboveZero, "voxels");
}

const SettingTable<QuiltingOptions>& quiltingTable() {
  using O = QuiltingOptions;
  static const SettingTable<O> table{
      stationaryRow<O>(),
      settingRow<O>("levels", &O::levels, "levels of resolution", {1, 8}, "",
                    "by the example's size"),
      settingRow<O>("patch", &O::patch, "side of the patches that repair a seam", {3, 15},
                    "samples"),
      settingRow<O>("rounds", &O::rounds, "searches and votes of a repair", {1, 100}),
      truncationRow<O>()};
  return table;
}

/// Shares: what they are depends on the number of examples, so they are read where that is known.
SettingTable<VotingOptions>::Row mixRow() {
  return {{.key = "mix",
           .type = SettingType::Text,
           .meaning = "the second of two examples' share of the result's surface, 0 to 1; of more "
                      "examples the share of each but the first: 0.3,0.2",
           .byDefault = "equal shares"},
          [](const Setting&, const std::string&, VotingOptions&) {}};
}

const SettingTable<VotingOptions>& votingTable() {
  using O = VotingOptions;
  static const SettingTable<O> table{
      stationaryRow<O>(),
      settingRow<O>("rotations", &O::rotations, "parts may be turned by quarter turns about z"),
      settingRow<O>("patch", &O::patch, "side of a patch", {3, 15}, "samples"),
      settingRow<O>("levels", &O::levels, "levels of resolution", {1, 8}, "",
                    "by the example's size"),
      settingRow<O>("rounds", &O::rounds, "searches and votes a level", {1, 100}),
      settingRow<O>("completeness", &O::completeness,
                    "the smaller, the more each part of the example gets its turn; inf for none",
                    kAboveZero, "squared voxels"),
      mixRow(),
      settingRow<O>("guide-weight", &O::guideWeight, "weight of the guide beside the example",
                    kAboveZero),
      truncationRow<O>()};
  return table;
}

/// What the engines on fields have in common.
class FieldEngine : public Engine {
 public:
  Form form() const override { return Form::Field; }
  Vec3i extentOf(std::span<const Example> examples, const Request& request) const override {
    return fieldSize(examples, request);
  }

 protected:
  void checkFurther(const Request& request, std::size_t examples) const override {
    if (request.settings.has("guide-weight") && !request.guide)
      throw InputError("`guide-weight`: there is no `guide` to weigh");
    if (request.decided.keep) requireKeep(*request.decided.keep);
    if (request.guide) requireGuide(*request.guide);
    if (request.mixMap) requireMixMap(*request.mixMap);
    if (request.mixMap && examples < 2)
      throw InputError("`mix-map`: there is no second example to mix with the first");
    if (request.mixMap && request.settings.has("mix"))
      throw InputError("`mix-map` and `mix` both say how examples share; give one of the two");
    mixShares(request.settings.text("mix"), examples);
  }
};

class QuiltingEngine final : public FieldEngine {
 public:
  std::string_view name() const override { return "quilting"; }
  std::string_view meaning() const override {
    return "large pieces of the example, joined by cuts where both sides agree best (after Efros "
           "and Freeman 2001, Kwatra et al. 2003)";
  }
  std::span<const Setting> settings() const override { return quiltingTable().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"periodic"};
    return keys;
  }

  static QuiltingOptions optionsOf(std::span<const Example> examples, const Request& request) {
    QuiltingOptions options;
    quiltingTable().apply(request.settings, options);
    options.size = fieldSize(examples, request);
    options.seed = request.seed;
    options.periodic = request.periodic;
    return options;
  }

 protected:
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    QuiltingOptions options = optionsOf(examples, request);
    const DistanceField& example = examples.front().field();
    const bool found = !options.stationary;
    if (found) {
      options.stationary =
          withoutSideways(findStationaryAxes(example), examples.front(), options.size);
      if (examples.front().goesOn.any())
        for (int axis = 0; axis < 3; ++axis) options.inPlace[axis] = !(*options.stationary)[axis];
    }
    Result result =
        resultOf(synthesizeByQuilting(example, options, progress), "quilting", examples);
    noteStationary(*options.stationary, found, result);
    return result;
  }
};

class VotingEngine final : public FieldEngine {
 public:
  std::string_view name() const override { return "voting"; }
  std::string_view meaning() const override {
    return "overlapping patches matched and voted, coarse to fine (after Kwatra et al. 2005, "
           "Simakov et al. 2008)";
  }
  bool mixes() const override { return true; }
  std::span<const Setting> settings() const override { return votingTable().settings(); }
  std::span<const std::string_view> honors() const override {
    static constexpr std::string_view keys[] = {"periodic", "keep", "guide", "mix-map"};
    return keys;
  }

 protected:
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    VotingOptions options;
    votingTable().apply(request.settings, options);
    options.size = fieldSize(examples, request);
    options.seed = request.seed;
    options.periodic = request.periodic;
    std::optional<Array3D<std::uint8_t>> kept;
    KeptPlaces places;
    if (request.decided.keep) {
      const DistanceField& example = examples.front().field();
      kept = keptSamples(*request.decided.keep, examples.front(), request.reading,
                         progress.part(0, 0.05));
      places = placeKept(example, *kept, options.size, options.periodic);
      options.kept = places.kept;
      options.keptOffsets = places.offsets;
    }
    if (request.guide) {
      options.guide =
          guideDistances(*request.guide, options.size, request.reading, progress.part(0.05, 0.1));
    }
    options.mix.shares = mixShares(request.settings.text("mix"), examples.size());
    if (request.mixMap) {
      options.mix.map =
          mixMap(*request.mixMap, options.size, request.reading, progress.part(0.05, 0.1));
    }
    const std::vector<const DistanceField*> fields = fieldsOf(examples);
    const bool found = !options.stationary;
    if (found)
      options.stationary = withoutSideways(stationaryAxes(fields, kept ? &*kept : nullptr),
                                           examples.front(), options.size);
    Result result =
        resultOf(synthesizeByVoting(fields, options, progress.part(0.1, 1)), "voting", examples);
    noteStationary(*options.stationary, found, result);
    if (kept) placeAround(places.offset, result);
    if (examples.size() > 1) noteMix(examples, options.mix, result);
    return result;
  }
};

/// The settings of both methods.
class GeometryEngine final : public FieldEngine {
 public:
  std::string_view name() const override { return "geometry"; }
  std::string_view meaning() const override {
    return "quilting where the example and the request suit it, else voting; the default for "
           "meshes and volumes";
  }
  bool mixes() const override { return true; }
  std::span<const Setting> settings() const override { return votingEngine().settings(); }
  std::span<const std::string_view> honors() const override { return votingEngine().honors(); }

 protected:
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    if (isObject(examples, request)) return objectResult(examples, request, progress);
    if (mayExtend(examples, request)) {
      if (std::optional<Result> extended = extendedResult(examples, request, progress))
        return std::move(*extended);
    }
    if (const std::optional<Request> quilted = quiltingRequest(examples, request))
      return quiltingEngine().run(examples, *quilted, progress);
    return votingEngine().run(examples, request, progress);
  }

 private:
  /// Whether the example is an object to be made more of as one.
  static bool isObject(std::span<const Example> examples, const Request& request) {
    const Example& example = examples.front();
    return examples.size() == 1 && !example.reading.scatter && !example.goesOn.any() &&
           !request.decided.keep && !request.guide && !request.periodic.any() &&
           request.settings.given().empty() && isFreeStanding(example.field());
  }
  static Result objectResult(std::span<const Example> examples, const Request& request,
                             const Progress& progress) {
    ObjectOptions options;
    options.size = fieldSize(examples, request);
    options.seed = request.seed;
    ObjectResult made = synthesizeObject(examples.front().field(), options, progress);
    const bool same = options.size == examples.front().field().size();
    Result result = resultOf(std::move(made.made), "object", examples);
    const auto along = [&](Growth growth) {
      Axes axes;
      for (int axis = 0; axis < 3; ++axis)
        axes[axis] = made.growth[static_cast<std::size_t>(axis)] == growth;
      return axes;
    };
    std::string text = "stands alone";
    const auto say = [&](Growth growth, const std::string& what) {
      if (along(growth).any()) text += "; " + what + " along " + readableAxes(along(growth));
    };
    say(Growth::Fitted, "extended in its own structure");
    say(Growth::Grown, "grown as one");
    if (made.strewn > 0)
      text = "loose parts; " + std::to_string(made.strewn) + " of them strewn anew";
    else if (same)
      text += "; varied, with " + std::to_string(made.parts) + " of its parts exchanged";
    result.notes.emplace_back("object", text);
    result.statistics.emplace_back("parts_exchanged", static_cast<std::int64_t>(made.parts));
    if (same && made.distance < kVaried)
      result.warnings.push_back("the result is nearly the example (" +
                                std::to_string(static_cast<int>(std::lround(100 * made.distance))) +
                                " % of the solid differ): the object has few parts that can be "
                                "exchanged or made longer and shorter; a larger `resolution` may "
                                "show more of them");
    return result;
  }

  /// Whether what is kept may be gone on from as an object is made longer.
  static bool mayExtend(std::span<const Example> examples, const Request& request) {
    return examples.size() == 1 && request.decided.keep && !request.guide &&
           !request.periodic.any() && request.settings.given().empty() &&
           fieldSize(examples, request) != examples.front().field().size();
  }
  /// The example made longer in its own structure where nothing is kept; nothing where it has none.
  static std::optional<Result> extendedResult(std::span<const Example> examples,
                                              const Request& request, const Progress& progress) {
    ObjectOptions options;
    options.size = fieldSize(examples, request);
    options.seed = request.seed;
    options.kept = keptSamples(*request.decided.keep, examples.front(), request.reading,
                               progress.part(0, 0.05));
    ObjectResult made = synthesizeObject(examples.front().field(), options, progress.part(0.05, 1));
    if (volume(made.made.field.size()) == 0) return std::nullopt;
    Result result = resultOf(std::move(made.made), "extension", examples);
    placeAround(made.keptOffset, result);
    Axes longer;
    for (int axis = 0; axis < 3; ++axis)
      longer[axis] = made.growth[static_cast<std::size_t>(axis)] == Growth::Fitted;
    result.notes.emplace_back("keep", "extended in its own structure along " +
                                          readableAxes(longer) + ", around what is kept");
    return result;
  }

  /// The request as quilting takes it; nothing where the example or the request does not suit it.
  static std::optional<Request> quiltingRequest(std::span<const Example> examples,
                                                const Request& request) {
    const bool turns = request.settings.text("rotations") == "true";
    if (examples.size() > 1 || request.decided.keep || request.guide || turns) return std::nullopt;
    Request quilted = request;
    quilted.settings.remove("rotations");
    if (request.settings.has("rounds")) {
      // A repair takes a sixth of the rounds of a level of votes.
      VotingOptions voting;
      votingTable().apply(request.settings, voting);
      quilted.settings.set("rounds", (voting.rounds + 5) / 6);
    }
    // What quilting does not have is asked of voting.
    for (const auto& [key, text] : quilted.settings.given()) {
      if (std::ranges::find(quiltingEngine().settings(), key, &Setting::key) ==
          quiltingEngine().settings().end())
        return std::nullopt;
    }
    const QuiltingOptions options = QuiltingEngine::optionsOf(examples, quilted);
    if (!suitsQuilting(examples.front().field(), options)) return std::nullopt;
    return quilted;
  }
};

class BlocksEngine final : public FieldEngine {
 public:
  std::string_view name() const override { return "blocks"; }
  std::string_view meaning() const override {
    return "best-matching blocks, copied coarse to fine, as published (Lagae, Dumont, Dutré 2004)";
  }
  std::span<const Setting> settings() const override { return table().settings(); }
  std::span<const std::string_view> honors() const override { return {}; }

 protected:
  void checkFurther(const Request& request, std::size_t) const override {
    BlocksOptions options;
    table().apply(request.settings, options);
    if (!std::has_single_bit(static_cast<unsigned>(options.block)))
      throw InputError("`block` " + std::to_string(options.block) +
                       ": expected a power of two, 2 to 256");
  }
  Result synthesize(std::span<const Example> examples, const Request& request,
                    const Progress& progress) const override {
    BlocksOptions options;
    options.block = examples.front().hints.block;
    table().apply(request.settings, options);
    options.size = fieldSize(examples, request);
    options.seed = request.seed;
    return resultOf(synthesizeBlocks(examples.front().field(), options, progress), "blocks",
                    examples);
  }

 private:
  static const SettingTable<BlocksOptions>& table() {
    using O = BlocksOptions;
    static const SettingTable<O> settings{
        settingRow<O>("block", &O::block, "side of a block at the finest level; a power of two",
                      {2, 256}, "samples", "16; a scene's own"),
        settingRow<O>("levels", &O::iterations, "levels of resolution", {1, 8}),
        choiceRow<O, BlockSeeding>(
            "seeding", &O::seeding,
            "what samples that are not made yet count as: random ones of the example (as "
            "published), or nothing",
            {{"random", BlockSeeding::Random}, {"masked", BlockSeeding::Masked}}),
        choiceRow<O, BlockSearch>(
            "search", &O::search,
            "how best matches are found, all exact: an index of blocks, the paper's search tree "
            "(section 4), or a linear scan",
            {{"index", BlockSearch::Index},
             {"tree", BlockSearch::Tree},
             {"scan", BlockSearch::Scan}}),
        truncationRow<O>()};
    return settings;
  }
};

}  // namespace

const Engine& geometryEngine() {
  static const GeometryEngine engine;
  return engine;
}
const Engine& quiltingEngine() {
  static const QuiltingEngine engine;
  return engine;
}
const Engine& votingEngine() {
  static const VotingEngine engine;
  return engine;
}
const Engine& blocksEngine() {
  static const BlocksEngine engine;
  return engine;
}

}  // namespace exemplar
