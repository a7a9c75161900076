// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

/// Every place in the program that draws random numbers has a stream of its own (`core/random.h`),
/// so that no two share a draw. A stream's number is part of the results' bytes: never change one.
namespace exemplar::stream {

enum Name : std::uint32_t {
  // search
  kCellFeatures = 0x6366,  ///< which cells of a source its features are chosen by
  kPatchMatch = 0x706d,
  kPatchFeatures = 0x7063,  ///< which patches their principal components are taken from
  // synth/geometry
  kBlockSeeding = 0xb10c,    ///< what samples that are not made yet count as
  kBlockStart = 0xb10d,      ///< where the first block of a level comes from
  kSmallBlocks = 0x0b71,     ///< a start from small blocks
  kPatchSearch = 0x0b72,     ///< PatchMatch
  kQuilt = 0x0b73,           ///< a start from large blocks
  kSeamRepair = 0x0b74,      ///< PatchMatch where a seam shows
  kExampleRegions = 0x0b77,  ///< where which of several examples is
  kParts = 0x0b76,           ///< which parts of an object are exchanged
  kSlices = 0x0b75,          ///< which slices of an object are repeated or left out
  // synth/surface
  kSurfaceField = 0x73661,    ///< where the iteration for a direction field starts
  kSurfaceStripes = 0x73662,  ///< where that for phases starts
  kSurfacePlaces = 0x73664,   ///< where the first placement comes from
  kSurfaceSeeds = 0x73663,    ///< the order in which nodes become the middle of a placement
  // synth/model
  kLabelChoice = 0x4C424C31,  ///< which label a cell takes
  kBlockAccept = 0x4C424C32,  ///< whether a modified block is kept
  kLimits = 0x4C424C33,       ///< where a limit on counts or connectedness is worked on
  // synth/layered
  kLayers = 0x4C594552,         ///< the shapes of layers
  kLayerClusters = 0x4C594343,  ///< where clusters of neighborhoods begin
  kTextureStart = 0x4C595458,   ///< where a texture's pixels first come from
  // synth/terrain
  kTerrainStart = 0x54455253,    ///< which regions a terrain begins with
  kTerrainPatches = 0x54455250,  ///< where patches of heights are looked for
  // synth/continuous
  kFigureChoice = 0x46494731,    ///< which figure a vertex takes
  kFigureLearning = 0x46494732,  ///< trial results in which weights are learned
  // sdf
  kDetailPlaces = 0xde7a,      ///< where a surface is looked at for its detail
  kPatchMoves = 0x4C424C34,    ///< which patch of the example goes where
  kPatchRims = 0x4C424C36,     ///< which labels close the gap around a patch
  kPatchPlaces = 0x4C424C35,   ///< where patches go that are tried at once
  kQuiltPlaces = 0x4C424C37,   ///< where windows of a smaller result come from
  kQuiltRims = 0x4C424C38,     ///< which labels close the gaps around them
  kWorldStart = 0x574C4431,    ///< of what a world begins with
  kWorldWindows = 0x574C4432,  ///< of each window of a world
  // voxelize
  kVolumeLayers = 0x564f4c31,  ///< the noise that volumes of labels are cut out of
  // measure
  kExampleWindows = 0x66706465,
  kResultWindows = 0x66706472,
  kLikenessWindows = 0x77696e64,
  kPatchDirections = 0x70646972,  ///< on which patches are projected
  kLandmarks = 0x6c6d726b,        ///< which windows are asked whether they are landmarks
  // preview
  kPixels = 0x70726576,
  kBakedLight = 3,
  // the processes of scenes (mesh/procedural)
  kFiberPlaces = 0xf1b1,
  kFiberShapes = 0xf1b2,
  kTerrain = 0x7e44,
  kChainmail = 0xc4a1,
  kGrassPlaces = 0x6a51,
  kGrassShapes = 0x6a52,
  kBalls = 0xba11,
  kGrid = 0x6f1d,
  kMetalPlaces = 0x3e71,
  kMetalShapes = 0x3e72,
  kMetalRoughness = 0x3e73,
  kBricks = 0xb71c,
  kScales = 0x5ca1,
  kBarkPlaces = 0xba41,
  kBarkShapes = 0xba42,
  kBarkNoise = 0xba43,
};

}  // namespace exemplar::stream
