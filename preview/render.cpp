// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "preview/render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/loop_progress.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "mesh/color.h"
#include "preview/baked_light.h"
#include "preview/camera.h"
#include "preview/film.h"
#include "preview/normals.h"
#include "preview/paints.h"
#include "preview/sampling.h"
#include "preview/shading.h"
#include "preview/tracer.h"

namespace exemplar {
namespace {

constexpr int kRaysOfPath = 4;        // camera, key, sky, key seen from there
constexpr int kTile = 32;             // pixels
constexpr float kLift = 2e-5f;        // start of rays above their surface, scene units
constexpr float kDeepAmbient = 0.4f;  // share of open light after the bounces that are traced
constexpr float kBrightest = 12;      // cap on the light that one path brings
constexpr float kPi = std::numbers::pi_v<float>;

void check(bool good, const std::string& what) {
  if (!good) throw InputError("render: " + what);
}

void validate(const RenderOptions& o) {
  const auto within = [](double v, double low, double high) { return v >= low && v <= high; };
  constexpr double kRight = std::numbers::pi / 2 + 1e-9;
  check(within(o.width, 1, 16384) && within(o.height, 1, 16384),
        "a picture of " + std::to_string(o.width) + " x " + std::to_string(o.height) +
            " pixels; each side must be 1..16384");
  check(!o.crop || (within(o.crop->width, 1, 16384) && within(o.crop->height, 1, 16384) &&
                    within(o.crop->left, -65536, 65536) && within(o.crop->top, -65536, 65536)),
        "the sides of what is taken of the picture must be 1..16384 pixels");
  check(std::isfinite(o.view.azimuth), "the view's azimuth must be finite");
  check(within(o.view.elevation, -kRight, kRight), "the view's elevation must be -pi/2..pi/2");
  check(within(o.samples, 1, 4096),
        "samples is " + std::to_string(o.samples) + "; it must be 1..4096");
  check(!o.frame || (!o.frame->empty() && isFinite(o.frame->min) && isFinite(o.frame->max)),
        "the frame must be a finite box");
  check(within(o.margin, 0, 0.45), "margin must be 0..0.45");
  check(within(o.fieldOfView, 0.01, 2.5), "fieldOfView must be 0.01..2.5 radians");
  check(std::isfinite(o.keyAzimuth), "keyAzimuth must be finite");
  check(within(o.keyElevation, 0.05, kRight), "keyElevation must be 0.05..pi/2");
  check(within(o.keyRadius, 0.001, 0.5), "keyRadius must be 0.001..0.5 radians");
  check(within(o.creaseAngle, 0, kRight), "creaseAngle must be 0..pi/2");
}

Crop takenOf(const RenderOptions& options) {
  return options.crop.value_or(Crop{0, 0, options.width, options.height});
}

// A point on the mesh or the floor that light is gathered for.
struct Place {
  bool floor = false;
  Vec3f position;  // where rays from here start
  Scatter scatter;
  float weight = 1;  // of what is gathered against the open floor; below 1 far out on the floor
  Vec3f emission{};
};

// The whole picture's constants, and the light that one path carries.
class Photographer {
 public:
  Photographer(const TriangleMesh& mesh, const RenderOptions& options, const Progress& progress);

  int paths() const { return paths_; }
  // The pixels of one tile.
  void expose(Film& film, int left, int top, const Progress& progress) const;

 private:
  struct PathLight {
    Vec3f key{}, sky{}, reflected{};
  };
  using Places = std::array<Place, kLanes>;

  FilmPixel pixel(const PixelSampler& sampler, int x, int y) const;
  Ray cameraRay(double x, double y, double* skipped) const;
  Place meshPlace(const Hit& hit, const Vec3f& direction) const;
  Place floorPlace(const Vec3f& position) const;
  // Share of what is gathered on the floor that shows there: 1 under the mesh, 0 far out.
  float floorWeight(const Vec3f& position) const;
  // Where a ray meets the floor; kFar where it does not.
  float floorDistance(const Ray& ray) const;
  std::array<PathLight, kLanes> gather(const Places& places, const Lanes& live,
                                       const PixelSampler& sampler, int firstPath) const;
  // The light that comes along rays that start on a surface: true for those that meet nothing.
  std::array<Vec3f, kLanes> incoming(const Rays& rays, const Lanes& live, Lanes* missed,
                                     const PixelSampler& sampler, int firstPath) const;

  RenderOptions options_;
  Crop taken_;
  SceneScale scale_;
  Tracer tracer_;
  std::vector<std::array<Vec3f, 3>> normals_;
  Paints paints_;
  Studio studio_;
  Camera camera_;
  int paths_;
  bool floor_;
  float floorHeight_, fadeStart_;
  Vec3f floorAlbedo_;  // makes the open floor come out as the background
};

// The light that `filmic` shows as the background.
Vec3f backgroundLight() {
  const Vec3f wanted{srgb8ToLinear(kBackground[0]), srgb8ToLinear(kBackground[1]),
                     srgb8ToLinear(kBackground[2])};
  Vec3f light = wanted;
  for (int n = 0; n < 100; ++n) {
    const Vec3f shown = filmic(light);
    for (int c = 0; c < 3; ++c) light[c] *= wanted[c] / shown[c];
  }
  return light;
}

Photographer::Photographer(const TriangleMesh& mesh, const RenderOptions& options,
                           const Progress& progress)
    : options_(options),
      taken_(takenOf(options)),
      scale_(sceneScale(boundingBox(mesh), options.view.elevation < 0)),
      tracer_(mesh, scale_, progress),
      normals_(cornerNormals(mesh, options.creaseAngle, progress)),
      paints_(mesh, options.warnings),
      studio_(cast<float>(keyDirection(options)), static_cast<float>(options.keyRadius)),
      paths_(std::max(1, options.samples / kRaysOfPath)) {
  // The camera is fitted before the scene is turned over, and turned with it: what it shows stays.
  SceneScale upright = scale_;
  upright.turnedOver = false;
  CameraFit fit(options);
  double reach = 0;
  forEachHeldPoint(mesh, options, [&](const Vec3d& p) {
    const Vec3d q = upright(p);
    fit.add(q);
    reach = std::max({reach, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  });
  camera_ = fit.camera(reach > 0 ? 0.05 * reach : 1);
  if (scale_.turnedOver) {
    camera_.position = SceneScale::turn(camera_.position);
    camera_.right = SceneScale::turn(camera_.right);
    camera_.up = SceneScale::turn(camera_.up);
    camera_.forward = SceneScale::turn(camera_.forward);
    for (auto& normals : normals_)
      for (Vec3f& normal : normals) normal = SceneScale::turn(normal);
  }

  const Box3d box = boundingBox(mesh);
  const Vec3f half = cast<float>(box.size() * (0.5 * scale_.factor));
  // A hair below, so that a flat mesh that lies on its floor is seen on top of it.
  floorHeight_ = -half.z - 1e-3f;
  floor_ = options.ground && !scale_.turnedOver && camera_.position.z > floorHeight_;
  const float footprint = std::sqrt(half.x * half.x + half.y * half.y);
  fadeStart_ = footprint + half.z;
  const Vec3f open = studio_.keyIrradiance() * (studio_.toKey().z / kPi) + studio_.floorSky();
  const Vec3f background = backgroundLight();
  floorAlbedo_ = {background.x / open.x, background.y / open.y, background.z / open.z};
}

Ray Photographer::cameraRay(double x, double y, double* skipped) const {
  const Vec3d direction =
      normalized(camera_.forward + camera_.right * ((2 * x / options_.width - 1) * camera_.tanX) +
                 camera_.up * ((1 - 2 * y / options_.height) * camera_.tanY));
  // Far cameras (a large frame, a narrow field) start nearer, where single precision is finer.
  *skipped = std::max(0.0, -dot(camera_.position, direction) - 8);
  return {cast<float>(camera_.position + direction * *skipped), cast<float>(direction)};
}

float Photographer::floorDistance(const Ray& ray) const {
  if (!floor_ || ray.direction.z >= 0 || ray.origin.z <= floorHeight_) return kFar;
  return std::min(kFar, (floorHeight_ - ray.origin.z) / ray.direction.z);
}

float Photographer::floorWeight(const Vec3f& p) const {
  const float away = std::sqrt(p.x * p.x + p.y * p.y) / fadeStart_;
  const float t = std::clamp((away - 1) / 1.2f, 0.0f, 1.0f);
  return 1 - t * t * (3 - 2 * t);
}

Place Photographer::floorPlace(const Vec3f& position) const {
  Place place;
  place.floor = true;
  place.position = position;
  place.position.z = floorHeight_;
  place.weight = floorWeight(position);
  place.scatter.normal = {0, 0, 1};
  place.scatter.diffuse = floorAlbedo_;
  place.scatter.mirror = {};
  return place;
}

Place Photographer::meshPlace(const Hit& hit, const Vec3f& direction) const {
  const std::array<Vec3f, 3> corners = tracer_.corners(hit.triangle);
  const std::array<float, 3> share{1 - hit.u - hit.v, hit.u, hit.v};
  Vec3f flat = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  const float side = dot(flat, direction) > 0 ? -1.0f : 1.0f;
  flat = flat * side;
  // The scene is turned over or not; its winding then too, but corner normals say what is out.
  Vec3f position{}, normal{};
  std::array<Vec3f, 3> normals = normals_[hit.triangle];
  for (int c = 0; c < 3; ++c) {
    if (dot(normals[c], flat) < 0) normals[c] = -normals[c];
    position += corners[c] * share[c];
    normal += normals[c] * share[c];
  }
  // Rays start from the smooth surface that the normals speak of, or facets would shadow
  // themselves where it turns from the light (J. Hanika, "Hacking the shadow terminator", Ray
  // Tracing Gems II, 2021, chapter 4).
  Vec3f smooth = position;
  for (int c = 0; c < 3; ++c) {
    const float below = std::min(0.0f, dot(position - corners[c], normals[c]));
    smooth += normals[c] * (-below * share[c]);
  }
  const Paint paint = paints_.at(hit.triangle, hit.u, hit.v);
  normal = normalized(normal);
  if (normal == Vec3f{}) normal = flat;
  Place place;
  place.position = smooth + flat * kLift;
  place.scatter = Scatter(normal, -direction, paint.color, paint.metallic, paint.roughness);
  place.emission = paint.emission;
  return place;
}

std::array<Vec3f, kLanes> Photographer::incoming(const Rays& rays, const Lanes& live, Lanes* missed,
                                                 const PixelSampler& sampler, int firstPath) const {
  std::array<Vec3f, kLanes> light{}, albedo{}, normal{};
  const Hits hits = tracer_.nearest(rays, live, false);
  Lanes lit{};
  std::array<bool, kLanes> onFloor{};
  Rays keyRays{};
  *missed = {};
  for (int k = 0; k < kLanes; ++k) {
    if (!live[k]) continue;
    const float floorAt = floorDistance(rays[k]);
    const float at = std::min(floorAt, hits[k].distance);
    if (at >= kFar) {
      (*missed)[k] = true;
      light[k] = studio_.sky(rays[k].direction);
      continue;
    }
    onFloor[k] = !hits[k].mesh || floorAt < hits[k].distance;
    if (onFloor[k]) {
      normal[k] = {0, 0, 1};
    } else {
      const std::array<Vec3f, 3> p = tracer_.corners(hits[k].triangle);
      normal[k] = normalized(cross(p[1] - p[0], p[2] - p[0]));
      if (dot(normal[k], rays[k].direction) > 0) normal[k] = -normal[k];
      const Paint paint = paints_.at(hits[k].triangle, hits[k].u, hits[k].v);
      albedo[k] = paint.color;
      light[k] = paint.emission;
    }
    keyRays[k].origin = rays[k].origin + rays[k].direction * at + normal[k] * kLift;
    keyRays[k].direction = studio_.sampleKey(sampler.get(firstPath + k, 3));
    lit[k] = dot(keyRays[k].direction, normal[k]) > 0;
  }
  const Lanes open = tracer_.open(keyRays, lit, false);
  for (int k = 0; k < kLanes; ++k) {
    if (!live[k] || (*missed)[k]) continue;
    if (onFloor[k]) {
      light[k] = studio_.floorRadiance(open[k] ? 1.0f : 0.0f);
      continue;
    }
    Vec3f fall = studio_.ambient(normal[k]) * kDeepAmbient;
    if (open[k]) fall += studio_.keyIrradiance() * (dot(keyRays[k].direction, normal[k]) / kPi);
    light[k] += scaled(albedo[k], fall);
  }
  return light;
}

std::array<Photographer::PathLight, kLanes> Photographer::gather(const Places& places,
                                                                 const Lanes& live,
                                                                 const PixelSampler& sampler,
                                                                 int firstPath) const {
  std::array<PathLight, kLanes> light{};
  // The key light, sampled by its disc.
  Rays rays{};
  Lanes wanted{};
  for (int k = 0; k < kLanes; ++k) {
    if (!live[k]) continue;
    rays[k] = {places[k].position, studio_.sampleKey(sampler.get(firstPath + k, 1))};
    wanted[k] = dot(rays[k].direction, places[k].scatter.normal) > 0;
  }
  const Lanes open = tracer_.open(rays, wanted, true);
  for (int k = 0; k < kLanes; ++k) {
    if (!open[k]) continue;
    const Scatter& scatter = places[k].scatter;
    if (places[k].floor) {
      light[k].key = studio_.keyIrradiance() * (studio_.toKey().z / kPi);
      continue;
    }
    // Balance heuristic with the sky ray below, which may end in the disc too.
    const float share =
        studio_.keyDensity() / (studio_.keyDensity() + scatter.density(rays[k].direction));
    const Scatter::Response response = scatter.response(rays[k].direction);
    light[k].key = studio_.keyIrradiance() * (response.diffuse * share);
    light[k].reflected = scaled(studio_.keyIrradiance() * share, response.mirror);
  }

  // Everything else, sampled by what the surface scatters.
  std::array<float, kLanes> density{};
  Lanes going{}, missed{};
  for (int k = 0; k < kLanes; ++k) {
    if (!live[k]) continue;
    const Sample2 at = sampler.get(firstPath + k, 2);
    const Scatter& scatter = places[k].scatter;
    if (places[k].floor) {
      const float r = std::sqrt(at.x), phi = 2 * kPi * at.y;
      const float z = std::sqrt(std::max(1e-6f, 1 - at.x));
      rays[k].direction = {r * std::cos(phi), r * std::sin(phi), z};
      density[k] = z / kPi;
    } else {
      rays[k].direction = scatter.sample(at, sampler.get(firstPath + k, 4).x);
      density[k] = scatter.density(rays[k].direction);
    }
    going[k] = density[k] > 0;
  }
  const std::array<Vec3f, kLanes> arriving = incoming(rays, going, &missed, sampler, firstPath);
  for (int k = 0; k < kLanes; ++k) {
    if (!live[k]) continue;
    if (places[k].floor) {
      // Against the open floor, whose sky light is known: no noise where nothing is near.
      light[k].sky = studio_.floorSky();
      if (!missed[k]) light[k].sky += arriving[k] - studio_.sky(rays[k].direction);
      continue;
    }
    if (!going[k]) continue;
    Vec3f sky = arriving[k];
    const Scatter& scatter = places[k].scatter;
    if (missed[k] && studio_.inKey(rays[k].direction))
      sky += studio_.keyRadiance() * (density[k] / (density[k] + studio_.keyDensity()));
    const Scatter::Response response = scatter.response(rays[k].direction);
    light[k].sky = sky * (response.diffuse / density[k]);
    light[k].reflected += min(scaled(sky, response.mirror) * (1 / density[k]),
                              Vec3f{kBrightest, kBrightest, kBrightest});
  }
  return light;
}

float luminance(const Vec3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

// Sums light that falls on known reflectances, and its noise.
class LightSum {
 public:
  void add(const Vec3f& reflectance, const Vec3f& light) {
    const float l = luminance(light);
    reflectance_ += reflectance;
    reflected_ += scaled(reflectance, light);
    sum_ += l;
    squares_ += l * l;
  }
  Vec3f reflectance(int paths) const { return reflectance_ / static_cast<float>(paths); }
  // The light that, on the mean reflectance, gives the mean of what was reflected.
  NoisyLight light(int paths) const {
    NoisyLight result;
    for (int c = 0; c < 3; ++c)
      if (reflectance_[c] > 0) result.mean[c] = reflected_[c] / reflectance_[c];
    const float n = static_cast<float>(paths), mean = sum_ / n;
    // One path has no variance: take all of its light for noise.
    const float spread = paths > 1 ? (squares_ / n - mean * mean) / (n - 1) : mean * mean;
    result.variance = std::max(0.0f, spread);
    return result;
  }

 private:
  Vec3f reflectance_{}, reflected_{};
  float sum_ = 0, squares_ = 0;
};

FilmPixel Photographer::pixel(const PixelSampler& sampler, int x, int y) const {
  FilmPixel pixel;
  LightSum key, sky, reflected;
  const Vec3f openKey = studio_.keyIrradiance() * (studio_.toKey().z / kPi);
  int seen = 0;
  for (int first = 0; first < paths_; first += kLanes) {
    const int lanes = std::min(kLanes, paths_ - first);
    Rays rays{};
    Lanes live{}, gathers{};
    std::array<double, kLanes> skipped{};
    for (int k = 0; k < lanes; ++k) {
      // A tent of half-width 0.75 pixels about the pixel's center.
      const Sample2 at = sampler.get(first + k, 0);
      const auto tent = [](double t) {
        return 0.75 * (t < 0.5 ? std::sqrt(2 * t) - 1 : 1 - std::sqrt(2 - 2 * t));
      };
      rays[k] = cameraRay(x + taken_.left + 0.5 + tent(at.x), y + taken_.top + 0.5 + tent(at.y),
                          &skipped[k]);
      live[k] = true;
    }
    const Hits hits = tracer_.nearest(rays, live, true);
    Places places{};
    for (int k = 0; k < lanes; ++k) {
      const float floorAt = floorDistance(rays[k]);
      if (hits[k].mesh && hits[k].distance <= floorAt) {
        places[k] = meshPlace(hits[k], rays[k].direction);
        gathers[k] = true;
      } else {
        pixel.floor += 1;
        if (floorAt < kFar) {
          places[k] = floorPlace(rays[k].origin + rays[k].direction * floorAt);
          gathers[k] = places[k].weight > 0;
        }
      }
      if (!gathers[k]) continue;
      ++seen;
      const float away =
          static_cast<float>(skipped[k] + (places[k].floor ? floorAt : hits[k].distance));
      pixel.normal += places[k].scatter.normal;
      pixel.position += places[k].position;
      pixel.size += away * static_cast<float>(2 * camera_.tanX / options_.width);
    }
    const auto light = gather(places, gathers, sampler, first);
    for (int k = 0; k < lanes; ++k) {
      if (!gathers[k]) {
        key.add(floorAlbedo_, openKey);
        sky.add(floorAlbedo_, studio_.floorSky());
        reflected.add({}, {});
        continue;
      }
      const Place& place = places[k];
      const float w = place.weight;
      key.add(place.scatter.diffuse, light[k].key * w + openKey * (1 - w));
      sky.add(place.scatter.diffuse, light[k].sky * w + studio_.floorSky() * (1 - w));
      reflected.add(place.scatter.mirror, light[k].reflected);
      pixel.own += place.emission;
    }
  }
  pixel.key = key.light(paths_);
  pixel.sky = sky.light(paths_);
  pixel.reflected = reflected.light(paths_);
  pixel.diffuse = key.reflectance(paths_);
  pixel.mirror = reflected.reflectance(paths_);
  const float per = 1 / static_cast<float>(paths_);
  pixel.own *= per;
  pixel.floor *= per;
  if (seen > 0) {
    pixel.normal = normalized(pixel.normal);
    pixel.position *= 1 / static_cast<float>(seen);
    pixel.size *= 1 / static_cast<float>(seen);
  }
  return pixel;
}

void Photographer::expose(Film& film, int left, int top, const Progress& progress) const {
  PixelSampler sampler(options_.seed, paths_);
  for (int y = top; y < std::min(top + kTile, film.height); ++y) {
    progress.check();
    for (int x = left; x < std::min(left + kTile, film.width); ++x) {
      sampler.startPixel(x, y);
      film.pixels[static_cast<std::size_t>(y) * film.width + x] = pixel(sampler, x, y);
    }
  }
}

}  // namespace

Image8 render(const TriangleMesh& mesh, const RenderOptions& options, const Progress& progress) {
  validate(options);
  validate(mesh, "render");
  const auto [left, top, width, height] = takenOf(options);
  const double pixels = static_cast<double>(width) * height;
  requireMemory(
      pixels * (sizeof(FilmPixel) + 2 * 3 * sizeof(NoisyLight)) +
          300.0 * static_cast<double>(mesh.triangles.size()),
      "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
      "ask for a smaller one");
  progress.report("preparing the picture", 0);
  const Photographer photographer(mesh, options, progress.part(0, 0.02));

  Film film{width, height, std::vector<FilmPixel>(static_cast<std::size_t>(width) * height)};
  const int columns = (width + kTile - 1) / kTile;
  const int tiles = columns * ((height + kTile - 1) / kTile);
  const Progress exposing = progress.part(0.02, 0.95);
  LoopProgress exposed(exposing, "rendering", static_cast<std::size_t>(tiles));
  parallelFor(0, tiles, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      exposed.check();
      const int tile = static_cast<int>(t);
      photographer.expose(film, tile % columns * kTile, tile / columns * kTile, exposing);
      exposed.advance();
    }
  });
  denoise(film, progress.part(0.95, 1));

  Image8 image{width, height, 3, {}};
  image.pixels.resize(film.pixels.size() * 3);
  parallelFor(0, film.pixels.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const Vec3f shown = filmic(film.pixels[p].light());
      for (int c = 0; c < 3; ++c) image.pixels[3 * p + c] = linearToSrgb8(shown[c]);
    }
  });
  return image;
}

}  // namespace exemplar
