// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/array3d.h"
#include "core/progress.h"
#include "engine/example.h"
#include "engine/source.h"

/// Files by which results of distance fields are controlled. Each function throws `InputError`
/// naming the setting, and those that read throw `Cancelled`.
namespace exemplar {

/// Refuses what cannot be a solid that is kept, a guide, or a map of a mix, before it is read.
void requireKeep(const Source& source);
void requireGuide(const Source& source);
void requireMixMap(const Source& source);

/// Which samples of the example are inside the solid that is kept.
Array3D<std::uint8_t> keptSamples(const Source& source, const Example& example,
                                  const ReadOptions& reading, const Progress& progress);

/// The guide, stretched to the result's box, in voxels of the result.
Array3D<float> guideDistances(const Source& source, const Vec3i& size, const ReadOptions& reading,
                              const Progress& progress);

/// The map of a mix, stretched to the result's box, 0..1: a picture's grays, or 1 inside a volume's
/// solid.
Array3D<float> mixMap(const Source& source, const Vec3i& size, const ReadOptions& reading,
                      const Progress& progress);

/// The shares that `mix` stands for ("0.3", or "0.3,0.2" of three examples): of all examples but
/// the first, which has the rest. One for each of `examples`; empty where `text` is.
std::vector<double> mixShares(const std::string& text, std::size_t examples);

}  // namespace exemplar
