// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/solid_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "core/loop_progress.h"
#include "core/parallel.h"
#include "sdf/triangle_overlap.h"

namespace exemplar {
namespace {

// The longest edge of a piece at the samples, in voxels, and how much longer it may be for each
// voxel that it is away from them.
constexpr double kPiece = 0.4;
constexpr double kPiecePerVoxel = 0.25;
// How far from a triangle its two sides are looked at, in voxels.
constexpr double kSide = 1e-3;
constexpr std::size_t kGrain = 256;
constexpr double kPortion = 512;  // triangles and pieces that are sorted together

double longestEdge(const Corners& t) {
  return std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
}

struct Extent {
  Vec3d low, high;
};

Extent extentOf(const Corners& t) {
  return {min(min(t[0], t[1]), t[2]), max(max(t[0], t[1]), t[2])};
}

// The triangles that overlap each triangle, as one list and where each triangle's part begins.
struct Overlaps {
  std::vector<std::uint32_t> first;   // n + 1
  std::vector<std::uint32_t> others;  // ascending for each triangle

  std::span<const std::uint32_t> of(std::uint32_t t) const {
    return {others.data() + first[t], others.data() + first[t + 1]};
  }
};

// Work on each triangle that makes any number of results, joined in the triangles' order.
template <class T, class Work>
std::vector<T> gather(std::size_t count, const Progress& progress, const Work& work) {
  LoopProgress done(progress, "finding the surface", count);
  const std::size_t pieces = (count + kGrain - 1) / kGrain;
  std::vector<std::vector<T>> parts(pieces);
  parallelFor(0, pieces, 1, [&](std::size_t p0, std::size_t p1) {
    for (std::size_t p = p0; p < p1; ++p)
      for (std::size_t t = p * kGrain; t < std::min(count, (p + 1) * kGrain); ++t) {
        work(static_cast<std::uint32_t>(t), parts[p]);
        done.advance();
      }
  });
  std::vector<T> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Overlaps findOverlaps(const TriangleSoup& soup, const TriangleTree& tree,
                      const Progress& progress) {
  const auto sharedCorners = [&](std::uint32_t a, std::uint32_t b) {
    int shared = 0;
    for (const std::uint32_t p : soup.triangles[a])
      for (const std::uint32_t q : soup.triangles[b]) shared += p == q;
    return shared;
  };
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  const auto pairs =
      gather<Pair>(soup.triangles.size(), progress, [&](std::uint32_t t, std::vector<Pair>& out) {
        const Corners& corners = tree.triangle(t);
        const Extent box = extentOf(corners);
        tree.visitBox(box.low, box.high, [&](std::uint32_t u) {
          if (u <= t) return;
          const int shared = sharedCorners(t, u);
          const Corners& other = tree.triangle(u);
          if (shared == 0 ? trianglesMeet(corners, other)
                          : shared == 1 && trianglesOverlap(corners, other)) {
            out.push_back({t, u});
          }
        });
      });
  Overlaps result;
  result.first.assign(soup.triangles.size() + 1, 0);
  for (const auto& [t, u] : pairs) {
    ++result.first[t + 1];
    ++result.first[u + 1];
  }
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.others.resize(pairs.size() * 2);
  auto next = result.first;
  for (const auto& [t, u] : pairs) {
    result.others[next[t]++] = u;
    result.others[next[u]++] = t;
  }
  return result;
}

Vec3d middleOf(const Corners& t) { return (t[0] + t[1] + t[2]) / 3.0; }

std::array<Vec3d, 3> nearCorners(const Corners& t) {
  const Vec3d m = middleOf(t) * 0.1;
  return {t[0] * 0.9 + m, t[1] * 0.9 + m, t[2] * 0.9 + m};
}

// From a triangle to where one of its sides is looked at: nearer for small ones, so that the place
// stays beside the triangle.
Vec3d stepFrom(const Corners& t) {
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  const double doubleArea = length(normal);
  if (!(doubleArea > 0)) return {};
  return normal * (std::clamp(0.05 * std::sqrt(doubleArea), 1e-6, kSide) / doubleArea);
}

// Asks for places on triangles whether the solid is on one side only. Places that follow each other
// and are close together are asked together, which costs little more than one.
class Looks {
 public:
  explicit Looks(const SolidTest& solid) : solid_(solid) {}

  void add(const Vec3d& place, const Vec3d& step) {
    Box3d wider = box_;
    wider.add(place);
    const Vec3d side = wider.size();
    if (count_ == points_.size() || (count_ > 0 && dot(side, side) > kTogether * kTogether)) {
      ask();
      wider = {};
      wider.add(place);
    }
    box_ = wider;
    points_[count_++] = place + step;
    points_[count_++] = place - step;
  }
  // The answers in the order of the places, since `clear`.
  const std::vector<std::uint8_t>& answers() {
    ask();
    return answers_;
  }
  void clear() { answers_.clear(); }

 private:
  static constexpr double kTogether = 6;  // voxels

  void ask() {
    std::array<std::uint8_t, 64> in;
    solid_.inside({points_.data(), count_}, {in.data(), count_});
    for (std::size_t p = 0; p < count_; p += 2) answers_.push_back(in[p] != in[p + 1]);
    count_ = 0;
  }

  const SolidTest& solid_;
  std::array<Vec3d, 64> points_;
  std::size_t count_ = 0;
  Box3d box_;
  std::vector<std::uint8_t> answers_;
};

// How far the box of a triangle is from the samples, in voxels.
struct Window {
  Vec3d last;
  double reach;

  double away(const Corners& t) const {
    const Extent e = extentOf(t);
    return length(max(max(e.low - last, -e.high), Vec3d{}));
  }
  bool outOfReach(const Corners& t) const { return away(t) > reach; }
};

// About how many pieces, besides itself, a triangle is cut into along what crosses it where the
// longest edge of a piece at the samples is `edge`.
double piecesOf(const Corners& t, std::size_t crossings, const Window& window, double edge) {
  const double longest = longestEdge(t);
  if (crossings == 0 || longest <= edge || window.outOfReach(t)) return 0;
  // No more of it than can be near the samples.
  const double l = std::min(longest, length(window.last) + 2 * std::min(window.reach, 1e6));
  const double area = std::min(length(cross(t[1] - t[0], t[2] - t[0])) / 2, l * l);
  return std::min(area / (0.24 * edge * edge), 4 * l / edge * static_cast<double>(crossings));
}

// Decides which triangles, or pieces of them, bound the solid.
class Sorter {
 public:
  Sorter(const SolidTest& solid, const TriangleTree& tree, const Overlaps& overlaps,
         const Window& window, bool closed, double piece, const Progress& progress)
      : progress_(progress),
        looks_(solid),
        tree_(tree),
        overlaps_(overlaps),
        window_(window),
        closed_(closed),
        piece_(piece) {}

  // Appends the pieces of each triangle that bound the solid, and where each triangle's end.
  void sort(std::span<const std::uint32_t> triangles, std::vector<Corners>& out,
            std::vector<std::size_t>& ends) {
    parts_.clear();
    crossing_.clear();
    for (const std::uint32_t t : triangles) {
      const auto others = overlaps_.of(t);
      parts_.push_back({tree_.triangle(t), crossing_.size(), others.size()});
      crossing_.insert(crossing_.end(), others.begin(), others.end());
    }
    // All parts of one size at a time, so that many can be asked together.
    for (std::size_t begin = 0, end = parts_.size(); begin < end;) {
      decide(begin, end);
      begin = std::exchange(end, split(begin, end));
    }
    for (std::size_t root = 0; root < triangles.size(); ++root) {
      append(parts_[root], out);
      ends.push_back(out.size());
    }
  }

 private:
  struct Part {
    Corners corners;
    std::size_t firstCrossing, crossings;  // in crossing_: what may cross it
    std::size_t children = 0;              // the first of four; 0: none
    bool whole = false;                    // one answer holds for all of it
    bool bounds = false;                   // at its middle
  };

  // Answers for the parts from `begin` to `end`; those left not `whole` have to be cut.
  void decide(std::size_t begin, std::size_t end) {
    looks_.clear();
    asked_.clear();
    for (std::size_t p = begin; p < end; ++p) {
      progress_.check();
      Part& part = parts_[p];
      const double distance = window_.away(part.corners);
      if (distance > window_.reach) {
        part.whole = true;
        continue;
      }
      looks_.add(middleOf(part.corners), stepFrom(part.corners));
      asked_.push_back(p);
      part.whole = longestEdge(part.corners) <= piece_ + kPiecePerVoxel * distance;
      if (part.whole) continue;
      const std::size_t first = crossing_.size();
      for (std::size_t c = 0; c < part.crossings; ++c) {
        const std::uint32_t u = crossing_[part.firstCrossing + c];
        if (trianglesMeet(part.corners, tree_.triangle(u))) crossing_.push_back(u);
      }
      part.firstCrossing = first;
      part.crossings = crossing_.size() - first;
      part.whole = closed_ && part.crossings == 0;
    }
    const auto& middles = looks_.answers();
    for (std::size_t a = 0; a < asked_.size(); ++a) parts_[asked_[a]].bounds = middles[a] != 0;
    if (closed_) return;
    // Beside an opening the winding number changes along a triangle.
    looks_.clear();
    asked_.clear();
    for (std::size_t p = begin; p < end; ++p) {
      const Part& part = parts_[p];
      if (part.whole || part.crossings > 0) continue;
      progress_.check();
      const Vec3d step = stepFrom(part.corners);
      for (const Vec3d& place : nearCorners(part.corners)) looks_.add(place, step);
      asked_.push_back(p);
    }
    const auto& corners = looks_.answers();
    for (std::size_t a = 0; a < asked_.size(); ++a) {
      Part& part = parts_[asked_[a]];
      const auto same = [&](std::size_t corner) {
        return (corners[3 * a + corner] != 0) == part.bounds;
      };
      part.whole = same(0) && same(1) && same(2);
    }
  }

  // Cuts the parts from `begin` to `end` that are not whole into four each, at the end of the list,
  // and returns where that ends.
  std::size_t split(std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      if (parts_[p].whole) continue;
      parts_[p].children = parts_.size();
      const Part part = parts_[p];
      const Corners& t = part.corners;
      const Vec3d ab = (t[0] + t[1]) * 0.5, bc = (t[1] + t[2]) * 0.5, ca = (t[2] + t[0]) * 0.5;
      for (const Corners& quarter : {Corners{t[0], ab, ca}, Corners{ab, t[1], bc},
                                     Corners{ca, bc, t[2]}, Corners{ab, bc, ca}})
        parts_.push_back({quarter, part.firstCrossing, part.crossings});
    }
    return parts_.size();
  }

  void append(const Part& part, std::vector<Corners>& out) const {
    if (part.children > 0) {
      for (std::size_t c = 0; c < 4; ++c) append(parts_[part.children + c], out);
    } else if (part.bounds) {
      out.push_back(part.corners);
    }
  }

  Progress progress_;
  Looks looks_;
  const TriangleTree& tree_;
  const Overlaps& overlaps_;
  Window window_;
  bool closed_;
  double piece_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> crossing_;
  std::vector<std::size_t> asked_;
};

// The longest edge of pieces at the samples: so long that cutting stays affordable where triangles
// cross everywhere.
double pieceFor(const TriangleTree& tree, const Overlaps& overlaps, const Window& window,
                double samples) {
  const double affordable =
      std::max(32768.0, samples / 4) + 4.0 * static_cast<double>(tree.count());
  double piece = kPiece;
  const auto pieces = [&] {
    return parallelSum<double>(0, tree.count(), kGrain, [&](std::size_t b, std::size_t e) {
      double sum = 0;
      for (std::size_t t = b; t < e; ++t)
        sum += piecesOf(tree.triangle(static_cast<std::uint32_t>(t)),
                        overlaps.of(static_cast<std::uint32_t>(t)).size(), window, piece);
      return sum;
    });
  };
  while (pieces() > affordable) piece *= 1.25;
  return piece;
}

// A name for each triangle's part: triangles connected across edges without any crossing between
// have the solid on the same sides. `kNone` for those that overlap others.
std::vector<std::uint32_t> partsOf(const TriangleSoup& soup, const Overlaps& overlaps) {
  constexpr std::uint32_t kNone = TriangleSoup::kNone;
  std::vector<std::uint32_t> part(soup.triangles.size(), kNone), open;
  for (std::uint32_t seed = 0; seed < part.size(); ++seed) {
    if (part[seed] != kNone || !overlaps.of(seed).empty()) continue;
    part[seed] = seed;
    open.assign(1, seed);
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (const std::uint32_t u : soup.neighbors[t])
        if (u != kNone && part[u] == kNone && overlaps.of(u).empty()) {
          part[u] = seed;
          open.push_back(u);
        }
    }
  }
  return part;
}

}  // namespace

BoundingSurface boundingTriangles(const TriangleSoup& soup, const TriangleTree& tree,
                                  const SolidTest& solid, const Vec3i& size, double reach,
                                  const Progress& progress) {
  const Progress sorting = progress.part(0.5, 1);
  const Overlaps overlaps = findOverlaps(soup, tree, progress.part(0, 0.5));
  const Window window{cast<double>(size - Vec3i{1, 1, 1}), reach};
  const std::size_t count = soup.triangles.size();
  const double piece =
      pieceFor(tree, overlaps, window, static_cast<double>(size.x) * size.y * size.z);

  // Of a closed soup, one look at each part, at its largest triangle, where the look is surest.
  std::vector<std::uint32_t> part(count, TriangleSoup::kNone), largest;
  std::vector<std::uint8_t> bounds;
  if (soup.closed) {
    part = partsOf(soup, overlaps);
    largest.assign(count, TriangleSoup::kNone);
    bounds.resize(count);
    const auto area = [&](std::uint32_t t) {
      const Corners& c = tree.triangle(t);
      return length(cross(c[1] - c[0], c[2] - c[0]));
    };
    for (std::uint32_t t = 0; t < count; ++t) {
      if (part[t] == TriangleSoup::kNone) continue;
      std::uint32_t& best = largest[part[t]];
      if (best == TriangleSoup::kNone || area(t) > area(best)) best = t;
    }
    Looks looks(solid);
    std::vector<std::uint32_t> asked;
    for (const std::uint32_t t : tree.order()) {
      sorting.check();
      if (part[t] == TriangleSoup::kNone || largest[part[t]] != t) continue;
      looks.add(middleOf(tree.triangle(t)), stepFrom(tree.triangle(t)));
      asked.push_back(part[t]);
    }
    for (std::size_t a = 0; a < asked.size(); ++a) bounds[asked[a]] = looks.answers()[a];
  }

  // The other triangles, neighbors together, in portions of about equal work.
  std::vector<std::uint32_t> sorted;
  std::vector<std::size_t> portions{0};
  double work = 0;
  for (const std::uint32_t t : tree.order()) {
    if (part[t] != TriangleSoup::kNone || window.outOfReach(tree.triangle(t))) continue;
    sorted.push_back(t);
    work += 1 + piecesOf(tree.triangle(t), overlaps.of(t).size(), window, piece);
    if (work < kPortion) continue;
    portions.push_back(sorted.size());
    work = 0;
  }
  portions.push_back(sorted.size());
  struct Result {
    std::vector<Corners> triangles;
    std::vector<std::size_t> ends;
  };
  std::vector<Result> results(portions.size() - 1);
  LoopProgress done(sorting, "finding the surface", sorted.size());
  parallelFor(0, results.size(), 1, [&](std::size_t r0, std::size_t r1) {
    Sorter sorter(solid, tree, overlaps, window, soup.closed, piece, sorting);
    for (std::size_t r = r0; r < r1; ++r) {
      const std::span<const std::uint32_t> portion(sorted.data() + portions[r],
                                                   portions[r + 1] - portions[r]);
      sorter.sort(portion, results[r].triangles, results[r].ends);
      done.advance(portion.size());
    }
  });

  // In the order of the triangles.
  std::vector<std::span<const Corners>> pieces(count);
  for (std::size_t r = 0; r < results.size(); ++r) {
    std::size_t begin = 0;
    for (std::size_t s = portions[r]; s < portions[r + 1]; ++s) {
      const std::size_t end = results[r].ends[s - portions[r]];
      pieces[sorted[s]] =
          std::span<const Corners>(results[r].triangles).subspan(begin, end - begin);
      begin = end;
    }
  }
  BoundingSurface surface;
  surface.fine = piece <= kPiece;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (part[t] == TriangleSoup::kNone) {
      surface.triangles.insert(surface.triangles.end(), pieces[t].begin(), pieces[t].end());
    } else if (bounds[part[t]] && !window.outOfReach(tree.triangle(t))) {
      surface.triangles.push_back(tree.triangle(t));
    }
  }
  return surface;
}

}  // namespace exemplar
