// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/example.h"
#include "core/progress.h"
#include "mesh/triangle_mesh.h"
#include "voxelize/adjacency.h"
#include "voxelize/field_blocks.h"
#include "voxelize/label_grid.h"
#include "voxelize/label_image.h"
#include "voxelize/mesh_to_labels.h"
#include "voxelize/model_pieces.h"

namespace CLI {
class App;
}

namespace exemplar {

/// How an example becomes labels. Left out, the kind of example decides.
struct LabelReading {
  std::string cell;               ///< side of a cell of a mesh, world units: "2", or "1,1,2"
  bool voxels = false;            ///< a mesh as materials in cells, not as model pieces
  std::optional<int> resolution;  ///< cells along a mesh's longest side where `cell` is not given
  VoxelFill fill = VoxelFill::Both;
  std::optional<int> air;  ///< empty cells around a mesh
  double tolerance = 1e-4;
  ImageLabelsOptions image;
  std::string fieldBlock;     ///< samples a side of a distance field's blocks: "8", "8,8,12"
  FieldBlocksOptions blocks;  ///< the rest of how a field is cut
  std::optional<double> pointDistance, heightScale;  ///< of a height map, world units
  std::optional<std::uint64_t> sceneSeed;
  MeshFileOptions mesh;
};
void addLabelReadingOptions(CLI::App& command, LabelReading& options);

/// A distance field whose blocks are labels: what compares the two families on one input.
struct QuantizedExample {
  Example example;
  FieldBlocks blocks;
};

/// An example of model synthesis, and what puts a result back together as the example was.
struct LabelExample {
  std::filesystem::path path;
  std::string description;  ///< for people: "12 x 8 x 5 cells of 62 labels, cut from a mesh"
  LabelGrid grid;
  std::optional<ModelPieces> pieces;      ///< of a mesh or scene
  std::optional<ImageLabels> image;       ///< of a picture
  std::optional<QuantizedExample> field;  ///< of a mesh without pieces, a height map, a volume
  Vec3d scale{2, 2, 1};                   ///< a good size of a result, in boxes of the example
};

/// Reads `.txt .vox`, `.vdb` (a grid of labels), `.png .jpg` (a flat grid), meshes and scenes (cut
/// into model pieces, or into voxels of their materials). A mesh or scene that has no grid of
/// pieces and is given none, a height map (`.pgm .asc`) and a `.vdb` of distances are sampled as a
/// distance field, whose blocks are labels. Throws `InputError`.
LabelExample loadLabelExample(const std::filesystem::path& path, const LabelReading& options,
                              const Progress& progress);

/// Reads one example, or the frames of one that changes over time: label grids or pictures, which
/// then share one numbering of labels: by number in `.txt` and `.vdb`, by colour in `.vox` and
/// pictures. `grids` receives the frames; the result describes the first and knows every label.
LabelExample loadLabelFrames(const std::vector<std::string>& paths, const LabelReading& options,
                             std::vector<LabelGrid>& grids, const Progress& progress);

/// What stands beside what in an example whose grids these are: as counted in them, or, where
/// blocks of a field overlap, as they agree. Throws `InputError` for options that do not go
/// together with the latter.
Adjacency findAdjacency(const LabelExample& example, const std::vector<LabelGrid>& grids,
                        const AdjacencyOptions& options = {});

/// Cells of a result that is as large as the example: the example's own, but where blocks overlap.
Vec3i cellsOfSize(const LabelExample& example);

/// Whether a path's ending is one of labels alone (.txt .vox), or of a scene made of model pieces.
bool isLabelExample(const std::filesystem::path& path);

/// What labels can be written to, for help and errors.
inline constexpr const char* kLabelOutputEndings = ".txt .vox .vdb .png .obj .ply .stl .off .glb";

/// The result as triangles: the example's model pieces or blocks of its field where it has them,
/// else boxes.
TriangleMesh labelsToMesh(const LabelGrid& grid, const LabelExample& example);

/// Writes a grid of an example's labels in the format of the path's ending; `instances`: a `.glb`
/// that holds each piece once. Returns a line for people about what was written.
std::string writeLabelResult(const std::filesystem::path& path, const LabelGrid& grid,
                             const LabelExample& example, bool instances,
                             const MeshFileOptions& options);

/// "4,5,6" as a size in cells, each 1..32767; throws `InputError` naming `option`.
Vec3i parseCells(const std::string& text, const std::string& option);

/// "3,wall,7": numbers or names of labels; a name may stand for several. Throws `InputError` naming
/// `option` and what labels there are.
std::vector<Label> parseLabels(const std::string& text, const LabelGrid& grid,
                               const std::string& option);

/// "80 x 80 x 10 cells".
std::string readableCells(const Vec3i& size);

}  // namespace exemplar
