// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/axes.h"
#include "core/progress.h"
#include "core/turn.h"
#include "core/warnings.h"
#include "engine/setting.h"
#include "engine/source.h"
#include "maps/height_map_file.h"
#include "maps/map.h"
#include "mesh/mesh_file.h"
#include "mesh/triangle_mesh.h"
#include "sdf/distance_field.h"
#include "sdf/mesh_to_sdf.h"
#include "synth/continuous/polygons.h"
#include "synth/continuous/solid_scene.h"
#include "voxelize/field_blocks.h"
#include "voxelize/label_grid.h"
#include "voxelize/label_image.h"
#include "voxelize/mesh_to_labels.h"
#include "voxelize/model_pieces.h"
#include "voxelize/tiled_map.h"

/// What an example is: the beginning of the main path.
namespace exemplar {

/// What an engine works on.
enum class Form {
  Field,     ///< signed distances (geometry synthesis)
  Labels,    ///< a grid of labels (model synthesis)
  Polygons,  ///< solids between planes (continuous model synthesis)
  Map,       ///< pictures seen from above (layered shape synthesis)
  Heights,   ///< height maps (terrain synthesis)
};

/// An example, or a result, as an engine sees it. In the order of `Form`.
using Representation =
    std::variant<DistanceField, LabelGrid, continuous::PolygonModel, Map, HeightMap>;

/// How distances become labels: blocks of the field.
struct LabeledField {
  DistanceField field;
  FieldBlocks blocks;
};
/// What a grid of labels was made of, and is made into again: nothing but itself, model pieces of a
/// mesh, pieces of a picture, or blocks of a distance field.
using LabelContent = std::variant<std::monostate, ModelPieces, ImageLabels, LabeledField, TiledMap>;

/// Good values for what a request does not say.
struct Hints {
  Vec3d scale{2, 2, 1};  ///< of the result, in boxes of the example
  int block = 16;        ///< samples a side of the blocks of `blocks` at the finest level
};

/// How large a result is; where neither is given, the example's hint says it.
struct Extent {
  std::optional<Vec3d> scale;  ///< in sizes of the example, each > 0
  std::optional<Vec3i> size;   ///< in samples (Field) or cells (Labels), each 1..32767
};

/// What is done about a mesh that lies turned about the vertical against its box.
enum class Align {
  Auto,  ///< it is sampled straight, and what is made of it is turned back
  None,  ///< it is sampled as it lies
};

/// How far from the surface an example's distances are exact, in voxels. Matching truncates
/// further.
inline constexpr double kExampleHalfWidth = 16;

/// How an example is read and sampled. What is left out follows from the kind of example.
struct ReadOptions {
  /// Labels for grids of labels and scenes of pieces, Polygons for scenes of solids, else Field; an
  /// engine's own (`Engine::form`) where it is read for one.
  std::optional<Form> form;
  /// Samples (Field) or cells (Labels) along the longest side, 4..4096 and 1..4096.
  std::optional<int> resolution;
  bool holdDetail = false;  ///< Field, in place of `resolution`: as many as a mesh's detail needs

  // Field, of a mesh:
  /// How large a result is wanted: it is read for that. Along axes that become longer, a mesh that
  /// goes on past its box (`looksCut`), as a wall does, is a piece of something longer and has no
  /// air at its ends, and one that lies turned is straightened. Where this has no value, it is an
  /// object with air around it, as it lies.
  std::optional<Extent> wanted;
  std::optional<Padding> padding;  ///< voxels of air around it, each 0..1024, in place of a choice
  bool scatter = false;            ///< strewn, not one object; a mesh has air on all sides
  Align align = Align::Auto;

  std::optional<std::uint64_t> sceneSeed;  ///< another sample of a scene's random process
  std::optional<Vec3d> sceneExtent;        ///< a larger sample of it, in its boxes, each 1..16
  MeshFileOptions mesh;
  std::optional<double> cellSize;     ///< world distance of a height map's points, > 0
  std::optional<double> heightScale;  ///< world height of one step of its integers, > 0
  std::string grid;                   ///< the name of a .vdb file's grid; empty: `readVdb` chooses

  // Labels only:
  std::optional<Vec3d> cell;         ///< sides of a cell of a mesh, world units, > 0
  std::optional<int> air;            ///< empty cells around a mesh, 0..1024
  bool voxels = false;               ///< a mesh as materials in cells, not as model pieces
  VoxelFill fill = VoxelFill::Both;  ///< of these voxels
  double tolerance = 1e-4;           ///< of equal model pieces, cells
  ImageLabelsOptions image;          ///< how a picture is cut
  FieldBlocksOptions blocks;         ///< how a distance field is cut

  // Polygons only:
  std::optional<double> unit;  ///< of a mesh's grid, world units, > 0; found
  /// How far a mesh's surface may move, lengths of its longest side; 0.001 where it can be read
  /// exactly, else what is needed up to 0.07.
  std::optional<double> snap;
  std::optional<double> ground;  ///< world height below which all is ground; none

  // Maps only:
  /// Further pictures of the same surface, by the names of their channels: "normal=wall_n.png".
  std::vector<std::pair<std::string, std::string>> channels;
};

/// The settings that fill `ReadOptions`, for examples of a form.
const SettingTable<ReadOptions>& readingSettings(Form form);

/// Throws `InputError` where options exclude each other. `readExample` checks it, too.
void checkReading(const ReadOptions& options);

/// An example, read and sampled.
struct Example {
  Source source;
  ReadOptions reading;  ///< as it was read
  SourceKind kind = SourceKind::Mesh;
  std::string description;  ///< for people: "mesh of 23,952 triangles at 64 x 64 x 24 samples"
  /// Distances, truncated at `kExampleHalfWidth` voxels, labels, or faces.
  Representation data;
  LabelContent content;                          ///< of labels
  std::optional<continuous::SolidScene> solids;  ///< of polygons: exactly
  std::optional<TriangleMesh> mesh;  ///< where materials, colors and finer detail come from
  Hints hints;
  Axes continues;  ///< along which copies of it tile: a volume that says so
  // Of a mesh as distances:
  Axes goesOn;      ///< along which its box cuts it out of something longer
  Padding padding;  ///< voxels of air around it
  /// From where `data` and `mesh` are, straight, to where it lies in its file.
  Turn turn;
  std::optional<HeightSteps> heightSteps;  ///< of a height map, to write one alike
  Warnings warnings;  ///< what the file holds that was left out or taken otherwise
  std::vector<std::filesystem::path> beside;  ///< files that a mesh names: materials, pictures

  Form form() const { return static_cast<Form>(data.index()); }
  /// Throw `std::bad_variant_access` where it is of the other form.
  const DistanceField& field() const { return std::get<DistanceField>(data); }
  const LabelGrid& labels() const { return std::get<LabelGrid>(data); }
  const continuous::PolygonModel& polygons() const {
    return std::get<continuous::PolygonModel>(data);
  }
  const Map& map() const { return std::get<Map>(data); }
  const HeightMap& heights() const { return std::get<HeightMap>(data); }
  std::string name() const { return source.name(); }
};

/// Reads an example and samples it in the form that an engine works on.
///
/// As a field: a mesh gets a margin of air, because an object ends at its box; a scene and a volume
/// are windows into something larger, and get none. As labels: a mesh or scene is cut into model
/// pieces along `cell` or the scene's own grid; a picture into its pieces; what has no grid (a mesh
/// without `cell`, a height map, a volume) is sampled as a field, whose blocks are labels.
/// As a map: a picture, with the further pictures of its `channels`. As heights: a height map.
/// As polygons: a scene of solids, or a closed mesh, which is snapped to a grid.
/// Throws `InputError` and `Cancelled`.
Example readExample(const Source& source, const ReadOptions& options = {},
                    const Progress& progress = {});

/// The same as solid cells: of a volume or a height map, one label for what is inside, in cells of
/// its samples; of everything else as `readExample` does.
Example readSolid(const Source& source, const ReadOptions& options, const Progress& progress = {});

/// Reads examples that are used together. Fields are sampled with the voxels of the first; labels
/// share one numbering, by number in .txt and .vdb, by color in .vox and pictures, and the first
/// example knows the looks of all.
std::vector<Example> readExamples(std::span<const Source> sources, const ReadOptions& options = {},
                                  const Progress& progress = {});

/// An example's field cut into labeled blocks, as an example of the form Labels.
Example labeled(const Example& example, const FieldBlocksOptions& options,
                const Progress& progress = {});

/// The examples sampled `factor` times as finely, in their boxes. Throws `InputError` for volumes,
/// which have no finer samples.
std::vector<Example> refined(std::span<const Example> examples, int factor,
                             const Progress& progress = {});

/// The fields of examples, as the engines take them.
std::vector<const DistanceField*> fieldsOf(std::span<const Example> examples);

}  // namespace exemplar
