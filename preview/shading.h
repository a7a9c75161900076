// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include "core/vec.h"
#include "preview/sampling.h"

namespace exemplar {

/// How a point of a surface scatters light: Lambert under a GGX layer, the core of glTF 2.0's
/// metallic-roughness model (its appendix B). Two-sided.
///
/// Sources: B. Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007
/// (distribution); E. Heitz, "Understanding the masking-shadowing function in microfacet-based
/// BRDFs", JCGT 3(2), 2014 (height-correlated Smith term, equation 99); E. Heitz, "Sampling the GGX
/// distribution of visible normals", JCGT 7(4), 2018. Light between facets is not counted.
struct Scatter {
  Vec3f normal;     ///< shading normal, on the viewer's side
  Vec3f viewer;     ///< unit, away from the surface
  Vec3f diffuse;    ///< albedo of the Lambert part, 0..1
  Vec3f mirror;     ///< reflectance of the GGX part at normal incidence, 0..1
  float alpha = 1;  ///< GGX width: roughness squared, > 0

  Scatter() = default;
  /// `baseColor` linear; `metallic` and `roughness` in 0..1.
  Scatter(const Vec3f& normal, const Vec3f& viewer, const Vec3f& baseColor, float metallic,
          float roughness);

  /// What part of the light from `light` (unit) goes to the viewer, times the cosine there: as a
  /// multiple of `diffuse` (one number for all colors) and of `mirror` (one each).
  struct Response {
    float diffuse = 0;
    Vec3f mirror{};
  };
  Response response(const Vec3f& light) const;

  /// A direction for light to come from, and its density a steradian under the mixture of both
  /// parts; density 0 where the direction came out below the surface.
  Vec3f sample(const Sample2& s, float choice) const;
  float density(const Vec3f& light) const;

 private:
  float mirrorShare_ = 0;  // probability of sampling the GGX part
};

/// The studio: a key light, a sky of soft gradients and a light floor. Directions are unit vectors
/// in the world, z up (turned over for views from below).
class Studio {
 public:
  /// `toKey` points to the key light, whose angular radius is `keyRadius` (radians). `floor` says
  /// whether there is one below; without it light comes from there as from a white floor.
  Studio(const Vec3f& toKey, float keyRadius);

  /// Radiance from a direction, the key light left out. Below the horizon: of an open floor.
  Vec3f sky(const Vec3f& direction) const;

  /// A direction within the key light's disc, uniform in solid angle; its density a steradian; and
  /// whether a direction is in it.
  Vec3f sampleKey(const Sample2& s) const;
  float keyDensity() const { return 1 / keyAngle_; }
  bool inKey(const Vec3f& direction) const { return dot(direction, toKey_) > keyCosine_; }
  const Vec3f& keyRadiance() const { return keyRadiance_; }
  /// On a surface that faces the key light.
  const Vec3f& keyIrradiance() const { return keyIrradiance_; }

  /// Irradiance of the sky and of the lit floor on an open surface, over pi; `key` says whether the
  /// floor is lit. A smooth guess of what arrives after many bounces.
  Vec3f ambient(const Vec3f& normal) const;

  /// Sky irradiance on the open floor, over pi; and the radiance that leaves the floor under the
  /// given share (0..1) of the key light.
  const Vec3f& floorSky() const { return floorSky_; }
  Vec3f floorRadiance(float keyShare) const;

  const Vec3f& toKey() const { return toKey_; }

 private:
  Vec3f aboveHorizon(const Vec3f& direction) const;

  Vec3f toKey_, side_, over_, toRim_;
  float keyCosine_, keyAngle_;
  Vec3f keyIrradiance_, keyRadiance_, floorSky_, skyMean_;
};

/// Scene light to display light in 0..1, linear both: straight up to a shoulder, then a soft
/// roll-off that loses color as it nears white.
Vec3f filmic(const Vec3f& light);

}  // namespace exemplar
