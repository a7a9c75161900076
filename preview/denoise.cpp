// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>

#include "core/loop_progress.h"
#include "core/parallel.h"
#include "preview/film.h"

namespace exemplar {
namespace {

constexpr int kPasses = 4;
constexpr float kTolerance = 3.0f;  // difference in light, in standard deviations, that ends it

constexpr NoisyLight FilmPixel::*kLights[] = {&FilmPixel::key, &FilmPixel::sky,
                                              &FilmPixel::reflected};
constexpr int kLightCount = 3;
using Lights = std::array<NoisyLight, kLightCount>;

float luminance(const Vec3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// 1 at 0 falling smoothly to 0 at 1.
float fall(float x) {
  const float rest = std::max(0.0f, 1 - x * x);
  return rest * rest;
}

float power(float v, int doublings) {
  for (int n = 0; n < doublings; ++n) v *= v;
  return v;
}

// How far two pixels see the same surface, 0..1.
float likeness(const FilmPixel& p, const FilmPixel& q, int step) {
  const float facing = dot(p.normal, q.normal);
  if (facing <= 0) return 0;
  const float floor = fall((p.floor - q.floor) * 4);
  if (floor == 0) return 0;
  const Vec3f apart = q.position - p.position;
  const float off = std::max(std::abs(dot(apart, p.normal)), std::abs(dot(apart, q.normal)));
  return floor * power(facing, 5) * fall(off / (4 * p.size * static_cast<float>(step)));
}

// The mean variance of the 3 x 3 pixels around: a pixel's own estimate is noisy itself, and zero
// where all of a few paths happened to agree.
Lights meanVariances(const Film& film, const std::vector<Lights>& lights, int x, int y) {
  Lights sum{};
  float weights = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= film.width || v >= film.height) continue;
      const float weight = static_cast<float>((2 - std::abs(dx)) * (2 - std::abs(dy)));
      const Lights& near = lights[static_cast<std::size_t>(v) * film.width + u];
      for (int n = 0; n < kLightCount; ++n) sum[n].variance += weight * near[n].variance;
      weights += weight;
    }
  for (NoisyLight& light : sum) light.variance /= weights;
  return sum;
}

Lights filtered(const Film& film, const std::vector<Lights>& lights, int x, int y, int step) {
  constexpr float kSpline[] = {3.0f / 8, 1.0f / 4, 1.0f / 16};
  const std::size_t at = static_cast<std::size_t>(y) * film.width + x;
  const FilmPixel& own = film.pixels[at];
  if (own.normal == Vec3f{}) return lights[at];
  const Lights noise = meanVariances(film, lights, x, y);
  std::array<float, kLightCount> ownLight, scale, weights{};
  bool noisy = false;
  for (int n = 0; n < kLightCount; ++n) {
    ownLight[n] = luminance(lights[at][n].mean);
    scale[n] = 1 / (kTolerance * std::sqrt(noise[n].variance) + 1e-6f);
    noisy |= noise[n].variance > 1e-9f;
  }
  if (!noisy) return lights[at];

  Lights sum{};
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx) {
      const int u = x + dx * step, v = y + dy * step;
      if (u < 0 || v < 0 || u >= film.width || v >= film.height) continue;
      const std::size_t there = static_cast<std::size_t>(v) * film.width + u;
      const float spline = kSpline[std::abs(dx)] * kSpline[std::abs(dy)];
      const float like = there == at ? 1 : likeness(own, film.pixels[there], step);
      if (like <= 0) continue;
      for (int n = 0; n < kLightCount; ++n) {
        const NoisyLight& light = lights[there][n];
        const float w = spline * like * fall((luminance(light.mean) - ownLight[n]) * scale[n]);
        sum[n].mean += light.mean * w;
        sum[n].variance += light.variance * (w * w);
        weights[n] += w;
      }
    }
  for (int n = 0; n < kLightCount; ++n) {  // weights hold the pixel's own: never zero
    sum[n].mean = sum[n].mean / weights[n];
    sum[n].variance /= weights[n] * weights[n];
  }
  return sum;
}

}  // namespace

void denoise(Film& film, const Progress& progress) {
  const std::size_t count = film.pixels.size();
  std::vector<Lights> lights(count), next(count);
  for (std::size_t p = 0; p < count; ++p)
    for (int n = 0; n < kLightCount; ++n) lights[p][n] = film.pixels[p].*kLights[n];
  LoopProgress rows(progress, "filtering the picture",
                    static_cast<std::size_t>(kPasses) * film.height);
  for (int pass = 0; pass < kPasses; ++pass) {
    parallelFor(0, film.height, 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        rows.check();
        for (int x = 0; x < film.width; ++x)
          next[y * film.width + x] = filtered(film, lights, x, static_cast<int>(y), 1 << pass);
      }
      rows.advance(end - begin);
    });
    lights.swap(next);
  }
  for (std::size_t p = 0; p < count; ++p)
    for (int n = 0; n < kLightCount; ++n) film.pixels[p].*kLights[n] = lights[p][n];
}

}  // namespace exemplar
