// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <vector>

#include "core/progress.h"
#include "core/vec.h"

namespace exemplar {

/// Light with its noise: a mean over the paths of a pixel, and the variance of that mean's
/// luminance.
struct NoisyLight {
  Vec3f mean{};
  float variance = 0;
};

/// What a pixel saw. Its light is own + diffuse * (key + sky) + mirror * reflected, all linear,
/// component by component: reflectances are kept apart from the light that falls on them, since
/// light is smooth where textures and edges are not.
struct FilmPixel {
  NoisyLight key;        ///< of the key light, on a white Lambert surface
  NoisyLight sky;        ///< of everything else, on a white Lambert surface
  NoisyLight reflected;  ///< of everything, in the mirror part
  Vec3f diffuse{}, mirror{}, own{};

  // What the filter compares: means over the paths that hit the mesh or the floor.
  Vec3f normal{};    ///< zero where nothing was hit
  Vec3f position{};  ///< in units of the picture's scene
  float floor = 0;   ///< share of paths that did not hit the mesh, 0..1
  float size = 0;    ///< of the pixel's footprint at `position`

  Vec3f light() const {
    return own + scaled(diffuse, key.mean + sky.mean) + scaled(mirror, reflected.mean);
  }
};

/// A picture of light: pixels in rows from the top.
struct Film {
  int width = 0, height = 0;
  std::vector<FilmPixel> pixels;
};

/// Averages the noisy light of each pixel with that of neighbors that see the same surface and
/// differ from it by no more than their noise explains; what is noise-free stays as it is.
///
/// Source: C. Schied et al., "Spatiotemporal variance-guided filtering", HPG 2017,
/// doi:10.1145/3105762.3105770, section 4.2 and 4.3: an a-trous wavelet filter with edge-stopping
/// functions, here within one picture, with kernels of bounded support in place of exponentials.
/// O(pixels); the same at any number of threads. Throws `Cancelled`; the film is then half
/// filtered.
void denoise(Film& film, const Progress& progress = {});

}  // namespace exemplar
