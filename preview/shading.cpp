// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace exemplar {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Two unit vectors perpendicular to `n` and to each other (T. Duff et al., "Building an
// orthonormal basis, revisited", JCGT 6(1), 2017).
struct Frame {
  Vec3f t, b, n;

  explicit Frame(const Vec3f& normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z), c = n.x * n.y * a;
    t = {1 + sign * n.x * n.x * a, sign * c, -sign * n.x};
    b = {c, sign + n.y * n.y * a, -n.y};
  }
  Vec3f toWorld(const Vec3f& v) const { return t * v.x + b * v.y + n * v.z; }
  Vec3f toLocal(const Vec3f& v) const { return {dot(v, t), dot(v, b), dot(v, n)}; }
};

Vec3f mix(const Vec3f& a, const Vec3f& b, float t) { return a * (1 - t) + b * t; }

float luminance(const Vec3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

float power5(float v) { return (v * v) * (v * v) * v; }

Vec3f cosineDirection(const Sample2& s) {
  const float r = std::sqrt(s.x), phi = 2 * kPi * s.y;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - s.x))};
}

// The GGX distribution for a facet whose cosine to the normal is `nh`.
float facetDensity(float nh, float alpha) {
  const float a2 = alpha * alpha, d = (nh * a2 - nh) * nh + 1;
  return a2 / (kPi * d * d);
}

// The root in Smith's masking term: sqrt(alpha² + (1 - alpha²) c²) = c (1 + 2 Lambda(c)).
float smithRoot(float c, float alpha) {
  const float a2 = alpha * alpha;
  return std::sqrt(a2 + (1 - a2) * c * c);
}

}  // namespace

Scatter::Scatter(const Vec3f& n, const Vec3f& v, const Vec3f& baseColor, float metallic,
                 float roughness)
    : normal(n), viewer(v) {
  const Vec3f base = min(max(baseColor, Vec3f{}), Vec3f{1, 1, 1});
  const float metal = std::clamp(metallic, 0.0f, 1.0f);
  const float rough = std::clamp(roughness, 0.08f, 1.0f);
  // A facet seen from below its shading normal (a smooth edge) counts as seen edge-on.
  const float facing = dot(normal, viewer);
  if (facing < 0.02f) normal = normalized(normal + viewer * (0.02f - facing));
  diffuse = base * (1 - metal);
  // Never quite black: the response is given as a multiple of it.
  mirror = mix({0.04f, 0.04f, 0.04f}, max(base, Vec3f{0.004f, 0.004f, 0.004f}), metal);
  alpha = rough * rough;
  const float glance = power5(1 - std::max(0.0f, dot(normal, viewer)));
  const float m = luminance(mix(mirror, {1, 1, 1}, glance * (1 - rough)));
  const float d = luminance(diffuse);
  mirrorShare_ = std::clamp(m / (m + d + 1e-6f), 0.1f, 0.95f);
  if (d <= 0) mirrorShare_ = 0.95f;
}

Scatter::Response Scatter::response(const Vec3f& light) const {
  const float nl = dot(normal, light), nv = dot(normal, viewer);
  if (nl <= 0 || nv <= 0) return {};
  const Vec3f half = normalized(light + viewer);
  const float vh = std::clamp(dot(viewer, half), 0.0f, 1.0f),
              nh = std::min(1.0f, dot(normal, half));
  const float fresnel = power5(1 - vh);
  const float visible = 0.5f / (nl * smithRoot(nv, alpha) + nv * smithRoot(nl, alpha));
  const float lobe = facetDensity(nh, alpha) * visible * nl;
  // Schlick's term f0 + (1 - f0) f, as a multiple of f0 so that a texture can be divided out.
  const auto share = [&](float f0) { return lobe * (1 - fresnel + fresnel / f0); };
  return {(1 - 0.04f - 0.96f * fresnel) * nl / kPi,
          {share(mirror.x), share(mirror.y), share(mirror.z)}};
}

Vec3f Scatter::sample(const Sample2& s, float choice) const {
  const Frame frame(normal);
  if (choice >= mirrorShare_) return frame.toWorld(cosineDirection(s));
  // Heitz 2018, section 3: the surface stretched by alpha is a hemisphere; the viewer sees it as a
  // disc of which one half is foreshortened; a uniform point there is a visible normal.
  const Vec3f v = frame.toLocal(viewer);
  const Vec3f stretched = normalized(Vec3f{alpha * v.x, alpha * v.y, std::max(v.z, 1e-4f)});
  const float r = std::sqrt(s.x), phi = 2 * kPi * s.y;
  const float t1 = r * std::cos(phi);
  const float lean = 0.5f * (1 + stretched.z);
  const float flat = std::sqrt(stretched.x * stretched.x + stretched.y * stretched.y);
  const Vec3f along =
      flat > 1e-6f ? Vec3f{-stretched.y / flat, stretched.x / flat, 0} : Vec3f{1, 0, 0};
  const Vec3f rise = cross(stretched, along);
  const float t2 = (1 - lean) * std::sqrt(std::max(0.0f, 1 - t1 * t1)) + lean * r * std::sin(phi);
  const Vec3f h =
      along * t1 + rise * t2 + stretched * std::sqrt(std::max(0.0f, 1 - t1 * t1 - t2 * t2));
  const Vec3f facet = normalized(Vec3f{alpha * h.x, alpha * h.y, std::max(h.z, 1e-6f)});
  return frame.toWorld(normalized(facet * (2 * dot(v, facet)) - v));
}

float Scatter::density(const Vec3f& light) const {
  const float nl = dot(normal, light), nv = dot(normal, viewer);
  if (nl <= 0 || nv <= 0) return 0;
  const float nh = std::clamp(dot(normal, normalized(light + viewer)), 0.0f, 1.0f);
  // Density of visible normals over 4 (v h): G1 D / (4 nv), with G1 = 2 nv / (nv + root).
  const float lobe = facetDensity(nh, alpha) / (2 * (nv + smithRoot(nv, alpha)));
  return mirrorShare_ * lobe + (1 - mirrorShare_) * nl / kPi;
}

Studio::Studio(const Vec3f& toKey, float keyRadius) : toKey_(normalized(toKey)) {
  const Frame frame(toKey_);
  side_ = frame.t;
  over_ = frame.b;
  // A rim light is behind, opposite the key light and lower.
  toRim_ = normalized(Vec3f{-toKey_.x, -toKey_.y, 0.35f});
  keyCosine_ = std::cos(keyRadius);
  const float s = std::sin(keyRadius / 2);
  keyAngle_ = 4 * kPi * s * s;  // 2 pi (1 - cos r)
  keyIrradiance_ = Vec3f{1.0f, 0.955f, 0.89f} * (0.86f * kPi);
  keyRadiance_ = keyIrradiance_ / keyAngle_;

  // Midpoints of a grid that is uniform in the cosine-weighted measure.
  constexpr int kSteps = 64;
  Vec3f sum{}, all{};
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const Sample2 at{(i + 0.5f) / kSteps, (j + 0.5f) / kSteps};
      sum += aboveHorizon(cosineDirection(at));
      const float z = at.x, r = std::sqrt(1 - z * z), phi = 2 * kPi * at.y;
      all += aboveHorizon({r * std::cos(phi), r * std::sin(phi), z});
    }
  floorSky_ = sum / static_cast<float>(kSteps * kSteps);
  skyMean_ = all / static_cast<float>(kSteps * kSteps);
}

Vec3f Studio::aboveHorizon(const Vec3f& direction) const {
  const float z = std::clamp(direction.z, 0.0f, 1.0f);
  const Vec3f horizon{0.46f, 0.475f, 0.49f}, zenith{0.25f, 0.285f, 0.34f};
  const float t = 1 - z;
  Vec3f light = mix(zenith, horizon, t * t);
  // Soft boxes: a broad one around the key light, a narrower one behind.
  const float key = dot(direction, toKey_), rim = dot(direction, toRim_);
  light += Vec3f{1.0f, 0.97f, 0.92f} * (0.75f * std::exp(6.0f * (key - 1)));
  light += Vec3f{0.90f, 0.95f, 1.0f} * (0.45f * std::exp(9.0f * (rim - 1)));
  return light;
}

Vec3f Studio::sky(const Vec3f& direction) const {
  if (direction.z >= 0) return aboveHorizon(direction);
  return floorRadiance(1);
}

Vec3f Studio::sampleKey(const Sample2& s) const {
  const float z = 1 - s.x * (1 - keyCosine_), phi = 2 * kPi * s.y;
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return normalized(side_ * (r * std::cos(phi)) + over_ * (r * std::sin(phi)) + toKey_ * z);
}

Vec3f Studio::floorRadiance(float keyShare) const {
  constexpr float kAlbedo = 0.62f;
  // In shadow much of the sky is hidden too.
  const Vec3f sky = floorSky_ * (0.55f + 0.45f * keyShare);
  return (keyIrradiance_ * (std::max(0.0f, toKey_.z) * keyShare / kPi) + sky) * kAlbedo;
}

Vec3f Studio::ambient(const Vec3f& normal) const {
  return mix(floorRadiance(0.5f), floorSky_, 0.5f + 0.5f * normal.z);
}

Vec3f filmic(const Vec3f& light) {
  // Khronos "PBR Neutral" tone mapper (2024), without its toe offset's special case at black: the
  // largest channel is compressed from 0.76 on, and color mixes toward white with it.
  constexpr float kStart = 0.76f, kDesaturation = 0.15f;
  const Vec3f c = max(light, Vec3f{});
  const float peak = std::max({c.x, c.y, c.z});
  if (peak <= kStart) return c;
  constexpr float kRoom = 1 - kStart;
  const float squeezed = 1 - kRoom * kRoom / (peak + kRoom - kStart);
  const float white = 1 - 1 / (kDesaturation * (peak - squeezed) + 1);
  return mix(c * (squeezed / peak), {squeezed, squeezed, squeezed}, white);
}

}  // namespace exemplar
