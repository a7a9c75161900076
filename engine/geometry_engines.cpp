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
#include "engine/words.h"
#include "measure/collapse.h"
#include "measure/novelty.h"
#include "measure/occupancy.h"
#include "sdf/mesh_to_sdf.h"
#include "sdf/resample.h"
#include "synth/geometry/blocks.h"
#include "synth/geometry/objects/objects.h"
#include "synth/geometry/quilting/quilting.h"
#include "synth/geometry/stationary.h"
#include "synth/geometry/voting/voting.h"

namespace exemplar {
namespace {

/// A mesh is sampled with this many voxels of air around it, to ask what is inside it.
constexpr int kRegionPadding = 2;
/// About what a sample of a result takes: the field, its origins, the search and the surface.
constexpr double kBytesPerSample = 80;

/// A variation of an object that differs from it by less, 1 - IoU, is hardly one.
constexpr double kVaried = 0.12;

Vec3i fieldSize(std::span<const Example> examples, const Request& request) {
  const Example& example = examples.front();
  const Vec3i size = resultSize(request, example.field().size(), example.hints.scale, "samples");
  requireMemory(kBytesPerSample * static_cast<double>(volume(size)),
                "a result of " + readableSize(size, "samples"),
                "use a lower `resolution` or a smaller `scale`");
  return size;
}

void requireRegion(const Source& source) {
  requireThere(source);
  const SourceKind kind = sourceKind(source);
  if (kind != SourceKind::Mesh && kind != SourceKind::Volume)
    throw InputError("`keep`: " + source.name() + " is neither a mesh nor a .vdb");
}

void requireGuide(const Source& source) {
  requireThere(source);
  const SourceKind kind = sourceKind(source);
  if (kind == SourceKind::Labels || kind == SourceKind::Picture)
    throw InputError("`guide`: " + source.name() + " is neither a mesh, a volume nor a height map");
}

/// A solid to ask for what is inside: a mesh's, or a volume's, and from there to where it lies.
struct Region {
  DistanceField field;
  Turn turn;
};
Region readRegion(const Source& source, double voxelSize, const ReadOptions& reading,
                  const Progress& progress) {
  Region region;
  requireRegion(source);
  switch (sourceKind(source)) {
    case SourceKind::Mesh:
      region.field = meshToSdf(readTriangles(source, reading.mesh),
                               {.voxelSize = voxelSize, .padding = kRegionPadding}, progress);
      return region;
    default:
      region.field =
          readDistances(source, {.turn = &region.turn, .yUp = reading.mesh.up == UpAxis::Y});
      return region;
  }
}

/// Which samples of a result are inside the solid that is kept.
Array3D<std::uint8_t> keptSamples(const Source& source, const Example& in, const Vec3i& size,
                                  const ReadOptions& reading, const Progress& progress) {
  const DistanceField& example = in.field();
  const Region region = readRegion(source, example.voxelSize, reading, progress);
  const Box3d box = region.field.box();
  const Turn back = region.turn.back();
  Array3D<std::uint8_t> kept(size);
  bool any = false;
  forEachCell(min(size, example.size()), [&](const Vec3i& p) {
    const Vec3d xyz = back(in.turn(example.position(cast<double>(p))));
    if (!box.contains(xyz)) return;
    kept[p] = sampleTrilinear(region.field, xyz) < 0;
    any = any || kept[p];
  });
  if (!any) {
    throw InputError("`keep`: no sample of the example is inside " + source.name() +
                     "; it must be a solid in the example's own coordinates");
  }
  return kept;
}

/// The guide, stretched to the result's box, in voxels of the result.
Array3D<float> guideDistances(const Source& source, const Vec3i& size, const ReadOptions& reading,
                              const Progress& progress) {
  ReadOptions options = reading;
  options.form = Form::Field;
  options.holdDetail = options.scatter = false;
  options.wanted.reset();
  options.padding = 0;
  const Example guideExample = readExample(source, options, progress);
  const DistanceField& field = guideExample.field();
  double stretch = 0;
  Vec3d scale;
  for (int axis = 0; axis < 3; ++axis) {
    scale[axis] = static_cast<double>(field.size()[axis]) / size[axis];
    stretch += 1 / scale[axis] / 3;
  }
  Array3D<float> guide(size);
  parallelForEachCell(size, [&](const Vec3i& cell) {
    const Vec3d p = cast<double>(cell);
    Vec3d index;
    for (int axis = 0; axis < 3; ++axis) index[axis] = (p[axis] + 0.5) * scale[axis] - 0.5;
    guide[cell] = static_cast<float>(sampleTrilinear(field, field.position(index)) /
                                     field.voxelSize * stretch);
  });
  return guide;
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
  void checkFurther(const Request& request, std::size_t) const override {
    if (request.settings.has("guide-weight") && !request.guide)
      throw InputError("`guide-weight`: there is no `guide` to weigh");
    if (request.decided.keep) requireRegion(*request.decided.keep);
    if (request.guide) requireGuide(*request.guide);
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
    static constexpr std::string_view keys[] = {"periodic", "keep", "guide"};
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
    if (request.decided.keep) {
      options.kept = keptSamples(*request.decided.keep, examples.front(), options.size,
                                 request.reading, progress.part(0, 0.05));
    }
    if (request.guide) {
      options.guide =
          guideDistances(*request.guide, options.size, request.reading, progress.part(0.05, 0.1));
    }
    const std::vector<const DistanceField*> fields = fieldsOf(examples);
    const bool found = !options.stationary;
    if (found)
      options.stationary =
          withoutSideways(stationaryAxes(fields, options.kept ? &*options.kept : nullptr),
                          examples.front(), options.size);
    Result result =
        resultOf(synthesizeByVoting(fields, options, progress.part(0.1, 1)), "voting", examples);
    noteStationary(*options.stationary, found, result);
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
    say(Growth::Repeated, "repeated");
    if (same) text += "; varied, with " + std::to_string(made.parts) + " of its parts exchanged";
    result.notes.emplace_back("object", text);
    result.statistics.emplace_back("parts_exchanged", static_cast<std::int64_t>(made.parts));
    if (along(Growth::Repeated).any())
      result.warnings.push_back(
          "the object has no part along " + readableAxes(along(Growth::Repeated)) +
          " that could be repeated within it, so variations of it are placed side by side; `scale` "
          "1 along these axes gives a single one");
    if (along(Growth::Padded).any())
      result.warnings.push_back(
          "the object has no part that could be repeated to make it higher, so there is air above "
          "it; give `scale` 1 along z");
    if (same && made.distance < kVaried)
      result.warnings.push_back("the result is nearly the example (" +
                                std::to_string(static_cast<int>(std::lround(100 * made.distance))) +
                                " % of the solid differ): the object has few parts that can be "
                                "exchanged or made longer and shorter; a larger `resolution` may "
                                "show more of them");
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
