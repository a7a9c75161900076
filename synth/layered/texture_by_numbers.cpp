// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/layered/texture_by_numbers.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/random_streams.h"
#include "maps/halved.h"

namespace exemplar {
namespace {

constexpr int kSweeps = 4;  // of PatchMatch in a round
constexpr float kFar = std::numeric_limits<float>::infinity();

/// Pixels with several values each, those of a pixel together: what patches compare.
struct Features {
  int width = 0, height = 0, values = 0;
  std::vector<float> data;

  Features() = default;
  Features(int w, int h, int n)
      : width(w), height(h), values(n), data(static_cast<std::size_t>(w) * h * n) {}
  const float* at(int x, int y) const {
    return &data[(static_cast<std::size_t>(y) * width + x) * values];
  }
  float* at(int x, int y) { return &data[(static_cast<std::size_t>(y) * width + x) * values]; }
};

int wrappedIndex(int x, int n) {
  x %= n;
  return x < 0 ? x + n : x;
}

/// One resolution of the work: the example's pixels and the result's, guide first.
class Level {
 public:
  Level(const Features& example, Features result, const TextureOptions& options,
        const Random& random)
      : example_(example),
        result_(std::move(result)),
        options_(options),
        random_(random),
        half_(options.patch / 2),
        origins_(result_.width, result_.height),
        costs_(result_.width, result_.height, kFar),
        uses_(example.width, example.height) {}

  /// Begins with places whose guide is like the pixel's: the best of a few drawn.
  void startAtRandom() {
    constexpr std::uint32_t kDrawn = 24;
    forEachPixel([&](int x, int y) {
      const std::size_t p = origins_.index(x, y);
      float least = kFar;
      for (std::uint32_t d = 0; d < kDrawn; ++d) {
        const Pixel place = anyPlace(random_.bits(p, d));
        const float step = example_.at(place.x, place.y)[0] - result_.at(x, y)[0];
        if (step * step >= least) continue;
        least = step * step;
        origins_[p] = place;
      }
    });
    vote(nullptr);
  }
  /// Begins with the places of the coarser level.
  void startFrom(const PixelOrigins& coarser) {
    forEachPixel([&](int x, int y) {
      const Pixel& place =
          coarser(std::min(x / 2, coarser.width() - 1), std::min(y / 2, coarser.height() - 1));
      origins_(x, y) = inside({2 * place.x + x % 2, 2 * place.y + y % 2});
    });
    vote(nullptr);
  }

  void run(int rounds, const Progress& progress) {
    for (int round = 0; round < rounds; ++round) {
      progress.report("following the layers", static_cast<double>(round) / rounds);
      countUses();
      parallelRows([&](int x, int y) { costs_(x, y) = cost(x, y, origins_(x, y), kFar); });
      for (int sweep = 0; sweep < kSweeps; ++sweep) {
        progress.check();
        search(round * kSweeps + sweep, kSweeps - 1 - sweep);
      }
      vote(&costs_);
    }
  }

  const PixelOrigins& origins() const { return origins_; }
  const Grid<float>& costs() const { return costs_; }

 private:
  template <class Body>
  void parallelRows(const Body& body) {
    parallelFor(0, static_cast<std::size_t>(result_.height), 8,
                [&](std::size_t first, std::size_t last) {
                  for (auto y = static_cast<int>(first); y < static_cast<int>(last); ++y)
                    for (int x = 0; x < result_.width; ++x) body(x, y);
                });
  }
  template <class Body>
  void forEachPixel(const Body& body) {
    parallelRows(body);
  }

  /// A place whose patch lies in the example, nearest to this one.
  Pixel inside(Pixel place) const {
    if (options_.exampleWraps)
      return {wrappedIndex(place.x, example_.width), wrappedIndex(place.y, example_.height)};
    return {std::clamp(place.x, half_, example_.width - 1 - half_),
            std::clamp(place.y, half_, example_.height - 1 - half_)};
  }
  bool isInside(const Pixel& place) const {
    return options_.exampleWraps ||
           (place.x >= half_ && place.y >= half_ && place.x < example_.width - half_ &&
            place.y < example_.height - half_);
  }
  Pixel anyPlace(std::uint64_t bits) const {
    const int margin = options_.exampleWraps ? 0 : half_;
    const auto w = static_cast<std::uint32_t>(example_.width - 2 * margin);
    const auto h = static_cast<std::uint32_t>(example_.height - 2 * margin);
    return {margin + static_cast<int>(((bits & 0xffffffffu) * w) >> 32),
            margin + static_cast<int>(((bits >> 32) * h) >> 32)};
  }

  /// The squared difference of the patches, and what the place's overuse costs; at least `limit`
  /// where it is not below.
  float cost(int x, int y, const Pixel& place, float limit) const {
    float sum = overuse(place);
    const int n = example_.values;
    const bool plain = x >= half_ && y >= half_ && x < result_.width - half_ &&
                       y < result_.height - half_ && isInsideUnwrapped(place);
    for (int dy = -half_; dy <= half_; ++dy) {
      if (plain) {
        const float* a = result_.at(x - half_, y + dy);
        const float* b = example_.at(place.x - half_, place.y + dy);
        const int count = n * options_.patch;
        for (int v = 0; v < count; ++v) sum += (a[v] - b[v]) * (a[v] - b[v]);
      } else {
        for (int dx = -half_; dx <= half_; ++dx) {
          const float* a = resultAt(x + dx, y + dy);
          const float* b = example_.at(wrappedIndex(place.x + dx, example_.width),
                                       wrappedIndex(place.y + dy, example_.height));
          for (int v = 0; v < n; ++v) sum += (a[v] - b[v]) * (a[v] - b[v]);
        }
      }
      if (sum >= limit) return sum;
    }
    return sum;
  }
  bool isInsideUnwrapped(const Pixel& place) const {
    return place.x >= half_ && place.y >= half_ && place.x < example_.width - half_ &&
           place.y < example_.height - half_;
  }
  const float* resultAt(int x, int y) const {
    if (options_.wraps)
      return result_.at(wrappedIndex(x, result_.width), wrappedIndex(y, result_.height));
    return result_.at(std::clamp(x, 0, result_.width - 1), std::clamp(y, 0, result_.height - 1));
  }

  /// How often places were used, in fair shares, when the round began.
  void countUses() {
    Grid<float> counts(example_.width, example_.height);
    for (const Pixel& place : origins_.values()) ++counts(place.x, place.y);
    // A patch covers all its pixels, so that what counts is the mean over it.
    const float fair = static_cast<float>(origins_.count()) / static_cast<float>(counts.count());
    Grid<float> rows(counts.width(), counts.height());
    for (int y = 0; y < counts.height(); ++y) {
      for (int x = 0; x < counts.width(); ++x) {
        float sum = 0;
        for (int d = -half_; d <= half_; ++d) sum += counts[counts.wrapped(x + d, y)];
        rows(x, y) = sum;
      }
    }
    for (int y = 0; y < counts.height(); ++y) {
      for (int x = 0; x < counts.width(); ++x) {
        float sum = 0;
        for (int d = -half_; d <= half_; ++d) sum += rows[rows.wrapped(x, y + d)];
        uses_(x, y) = sum / (fair * static_cast<float>(options_.patch * options_.patch));
      }
    }
  }
  float overuse(const Pixel& place) const {
    const float excess = uses_(place.x, place.y) - 1;
    return excess > 0 ? static_cast<float>(options_.evenness) * 0.02f * excess *
                            static_cast<float>(options_.patch * options_.patch)
                      : 0;
  }

  /// One sweep: neighbors' places, moved along, and a few drawn around the own one. Pixels read the
  /// places that the sweep began with, so that their order does not matter.
  void search(int sweep, int reach) {
    const PixelOrigins before = origins_;
    const int step = 1 << reach;
    const int width = result_.width, height = result_.height;
    parallelRows([&](int x, int y) {
      const std::size_t p = origins_.index(x, y);
      Pixel best = before[p];
      float least = costs_[p];
      const auto offer = [&](const Pixel& place) {
        if (!isInside(place) || place == best) return;
        const Pixel there = options_.exampleWraps ? inside(place) : place;
        const float found = cost(x, y, there, least);
        if (found >= least) return;
        least = found;
        best = there;
      };
      const Pixel steps[] = {{-step, 0}, {step, 0}, {0, -step}, {0, step}};
      for (const Pixel& s : steps) {
        int nx = x + s.x, ny = y + s.y;
        if (options_.wraps) {
          nx = wrappedIndex(nx, width);
          ny = wrappedIndex(ny, height);
        } else if (nx < 0 || ny < 0 || nx >= width || ny >= height) {
          continue;
        }
        const Pixel& place = before(nx, ny);
        offer({place.x - s.x, place.y - s.y});
      }
      int radius = std::max(example_.width, example_.height);
      for (std::uint32_t draw = 0; radius >= 1; radius /= 4, ++draw) {
        const std::uint64_t bits =
            random_.bits(p, 1000 + static_cast<std::uint32_t>(sweep) * 16 + draw);
        const auto span = static_cast<std::uint64_t>(2 * radius + 1);
        const int dx = static_cast<int>(((bits & 0xffffffffu) * span) >> 32) - radius;
        const int dy = static_cast<int>(((bits >> 32) * span) >> 32) - radius;
        offer(inside({best.x + dx, best.y + dy}));
      }
      origins_[p] = best;
      costs_[p] = least;
    });
  }

  /// Sets each pixel's texture to the mean of what the patches over it say, those that fit well
  /// counting more. The guide stays.
  void vote(const Grid<float>* costs) {
    float spread = 1;
    if (costs) {
      std::vector<float> sorted(costs->values().begin(), costs->values().end());
      const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
      std::ranges::nth_element(sorted, at);
      spread = std::max(*at, 1e-6f);
    }
    Grid<float> weights(result_.width, result_.height, 1.0f);
    if (costs)
      for (std::size_t p = 0; p < weights.count(); ++p)
        weights[p] = std::exp(-std::min((*costs)[p] / spread, 40.0f)) + 1e-6f;
    const int n = example_.values;
    Features voted = result_;
    parallelRows([&](int x, int y) {
      float sums[64] = {}, all = 0;
      for (int dy = -half_; dy <= half_; ++dy) {
        for (int dx = -half_; dx <= half_; ++dx) {
          int px = x + dx, py = y + dy;
          if (options_.wraps) {
            px = wrappedIndex(px, result_.width);
            py = wrappedIndex(py, result_.height);
          } else if (px < 0 || py < 0 || px >= result_.width || py >= result_.height) {
            continue;
          }
          const Pixel& place = origins_(px, py);
          const float* from = example_.at(wrappedIndex(place.x - dx, example_.width),
                                          wrappedIndex(place.y - dy, example_.height));
          const float weight = weights(px, py);
          for (int v = 1; v < n; ++v) sums[v] += weight * from[v];
          all += weight;
        }
      }
      float* to = voted.at(x, y);
      for (int v = 1; v < n; ++v) to[v] = sums[v] / all;
    });
    result_ = std::move(voted);
  }

  const Features& example_;
  Features result_;
  const TextureOptions& options_;
  Random random_;
  int half_;
  PixelOrigins origins_;
  Grid<float> costs_;
  Grid<float> uses_;
};

/// Values at a resolution: the guide, then the texture's planes.
Features featuresOf(const Grid<float>& guide, const std::vector<Grid<float>>& planes,
                    float guideWeight, const std::vector<float>& planeWeights) {
  Features features(guide.width(), guide.height(), 1 + static_cast<int>(planes.size()));
  for (int y = 0; y < guide.height(); ++y) {
    for (int x = 0; x < guide.width(); ++x) {
      float* to = features.at(x, y);
      to[0] = guideWeight * guide(x, y);
      for (std::size_t v = 0; v < planes.size(); ++v) to[v + 1] = planeWeights[v] * planes[v](x, y);
    }
  }
  return features;
}

float spreadOf(const Grid<float>& values) {
  double sum = 0, squares = 0;
  for (const float v : values.values()) {
    sum += v;
    squares += static_cast<double>(v) * v;
  }
  const double n = static_cast<double>(values.count());
  return static_cast<float>(std::sqrt(std::max(squares / n - sum / n * (sum / n), 1e-12)));
}

/// All pictures of the example, put together by the patches' places as the last vote was.
Map compose(const Map& example, const PixelOrigins& origins, const Grid<float>& costs,
            const TextureOptions& options) {
  const int width = origins.width(), height = origins.height(), half = options.patch / 2;
  std::vector<float> sorted(costs.values().begin(), costs.values().end());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, at);
  // Sharper than while searching: the best patches alone, nearly.
  const float spread = std::max(*at, 1e-6f) / 4;
  Map map;
  for (const MapLayer& layer : example.layers) {
    MapLayer made{layer.name, {}, layer.bits};
    for (const Grid<float>& plane : layer.planes) {
      Grid<float> values(width, height);
      parallelFor(0, static_cast<std::size_t>(height), 8, [&](std::size_t y0, std::size_t y1) {
        for (auto y = static_cast<int>(y0); y < static_cast<int>(y1); ++y) {
          for (int x = 0; x < width; ++x) {
            float sum = 0, all = 0;
            for (int dy = -half; dy <= half; ++dy) {
              for (int dx = -half; dx <= half; ++dx) {
                if (!options.wraps && !origins.contains(x + dx, y + dy)) continue;
                const std::size_t p = origins.wrapped(x + dx, y + dy);
                const Pixel& place = origins[p];
                const float fall = std::exp(-0.5f * static_cast<float>(dx * dx + dy * dy));
                const float weight = fall * (std::exp(-std::min(costs[p] / spread, 40.0f)) + 1e-6f);
                sum += weight * plane[plane.wrapped(place.x - dx, place.y - dy)];
                all += weight;
              }
            }
            values(x, y) = sum / all;
          }
        }
      });
      made.planes.push_back(std::move(values));
    }
    map.layers.push_back(std::move(made));
  }
  return map;
}

}  // namespace

GuidedTexture synthesizeTexture(const Map& example, const Grid<float>& exampleGuide,
                                const Grid<float>& guide, const TextureOptions& options,
                                const Progress& progress) {
  const std::vector<Grid<float>>& planes = example.layers.front().planes;
  const int least = std::min(example.width(), example.height());
  if (least < options.patch + 1) {
    throw InputError("the example is smaller than a patch of " + std::to_string(options.patch) +
                     " pixels");
  }
  int levels = 1;
  for (int side = std::min({least, guide.width(), guide.height()});
       levels < options.levels && side / 2 >= 4 * options.patch; side /= 2)
    ++levels;
  // A step from one layer to the next weighs as much as a change of the texture by its spread.
  float spread = 0;
  for (const Grid<float>& plane : planes)
    spread += spreadOf(plane) / static_cast<float>(planes.size());
  const std::vector<float> planeWeights(planes.size(), 1 / std::max(spread, 1e-6f));
  const auto guideWeight = static_cast<float>(options.guide);

  struct Resolution {
    Grid<float> exampleGuide, guide;
    std::vector<Grid<float>> planes;
  };
  std::vector<Resolution> pyramid{{exampleGuide, guide, planes}};
  for (int l = 1; l < levels; ++l) {
    const Resolution& finer = pyramid.back();
    Resolution coarser{halved(finer.exampleGuide, true), halved(finer.guide, true), {}};
    for (const Grid<float>& plane : finer.planes) coarser.planes.push_back(halved(plane, true));
    pyramid.push_back(std::move(coarser));
  }
  const Random random(options.seed, stream::kTextureStart);
  PixelOrigins origins;
  Grid<float> costs;
  for (int l = levels - 1; l >= 0; --l) {
    const Resolution& at = pyramid[static_cast<std::size_t>(l)];
    const Features from = featuresOf(at.exampleGuide, at.planes, guideWeight, planeWeights);
    const std::vector<Grid<float>> nothing(planes.size(),
                                           Grid<float>(at.guide.width(), at.guide.height()));
    Level level(from, featuresOf(at.guide, nothing, guideWeight, planeWeights), options,
                random.fork(static_cast<std::uint64_t>(l)));
    if (origins.empty()) {
      level.startAtRandom();
    } else {
      level.startFrom(origins);
    }
    level.run(options.rounds, progress.part(std::pow(0.25, l + 1), std::pow(0.25, l)));
    origins = level.origins();
    costs = level.costs();
  }
  return {compose(example, origins, costs, options), std::move(origins)};
}

}  // namespace exemplar
