// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <string>

#include "engine/request.h"
#include "engine/result.h"
#include "engine/setting.h"
#include "synth/layered/layers.h"
#include "synth/layered/texture_by_numbers.h"

/// The settings of layered shape synthesis, of pictures and of volumes.
namespace exemplar {

enum class PictureKind { Auto, Texture, Heights };

struct LayeredSettings {
  DecompositionOptions decomposition;
  PictureKind kind = PictureKind::Auto;
  std::string order, layersFrom, paint, inpaint;
  bool regions = false;  ///< beside each other, without an order
  int turns = 0;         ///< 0: found
  LayerOptions layers;
  TextureOptions texture{.guide = 3};
};

/// Those of pictures, and those of grids of labels.
const SettingTable<LayeredSettings>& layeredPictureSettings();
const SettingTable<LayeredSettings>& layeredVolumeSettings();

/// Warns of layers, of `count`, whose areas are not what they should be.
void warnOfAreas(const SynthesizedLayers& made, int count, Result& result);
/// Warns where patches were dealt out greedily though the optimum was `asked`.
void warnOfDealing(const SynthesizedLayers& made, AssignmentKind asked, Result& result);

/// What a request says; throws `InputError` for what cannot be.
LayeredSettings layeredPictureSettingsOf(const Request& request);
LayeredSettings layeredVolumeSettingsOf(const Request& request);

}  // namespace exemplar
