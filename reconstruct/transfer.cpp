// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "reconstruct/transfer.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "reconstruct/adjacency.h"
#include "reconstruct/material_borders.h"
#include "reconstruct/material_pieces.h"
#include "reconstruct/pull.h"
#include "reconstruct/texture_charts.h"

namespace exemplar {
namespace {

constexpr std::size_t kGrain = 256;

// Materials by pieces; lengths in voxels.
constexpr double kFarthest = 0.75;  // what its source's surface does not come nearer has no source
constexpr double kFarthestOfCut = 0.25;  // the same where the box cuts solid: inside, all is far
constexpr double kKeep = 2.2;  // weight of a piece's own material, over the regions' width
constexpr double kNarrowest = 10, kWidest = 60;  // of the regions that are reckoned with
constexpr double kTrust = 0.1;  // that there is no border, where no source has a say

std::uint32_t findRoot(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

void join(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
  a = findRoot(parent, a);
  b = findRoot(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

/// All examples' triangles as one mesh, so that each attribute has one list: triangle t of example
/// e is `first[e]` + t.
struct Attributes {
  TriangleMesh joined;  // used for several examples only
  const TriangleMesh* mesh = nullptr;
  std::vector<std::uint32_t> first;

  explicit Attributes(std::span<const ExampleView> examples) {
    std::uint32_t count = 0;
    for (const ExampleView& example : examples) {
      first.push_back(count);
      count += static_cast<std::uint32_t>(example.mesh.triangles.size());
      if (examples.size() > 1) append(joined, example.mesh);
    }
    mesh = examples.size() > 1 ? &joined : &examples[0].mesh;
  }

  std::uint32_t triangle(const Match& match) const {
    return first[match.motion.example] + match.point.triangle;
  }
};

/// What is to be done, decided from what the examples have.
struct Plan {
  bool colors = false;       // vertex colours, or textures baked into them
  bool bake = false;         // textures into vertex colours
  bool coordinates = false;  // texture coordinates
  bool materials = false;
  bool oneMaterial = true;  // the same for all triangles
};

Plan makePlan(const TriangleMesh& example, TextureTransfer textures) {
  Plan plan;
  plan.materials = example.hasMaterials();
  for (const std::uint32_t m : example.triangleMaterials) {
    plan.oneMaterial = plan.oneMaterial && m == example.triangleMaterials.front();
  }
  const bool textured =
      example.hasUvs() && example.hasMaterials() &&
      std::any_of(example.triangleMaterials.begin(), example.triangleMaterials.end(),
                  [&](std::uint32_t m) { return example.materials[m].baseColorTexture; });
  plan.coordinates = textures == TextureTransfer::Coordinates
                         ? example.hasUvs()
                         : textures == TextureTransfer::Automatic && textured;
  plan.bake = textures == TextureTransfer::VertexColors && textured;
  plan.colors = example.hasColors() || plan.bake;
  return plan;
}

/// The best match of each triangle's middle.
struct TriangleSources {
  std::vector<OriginMotion> motion;
  std::vector<std::uint32_t> triangle;  // of the joined example
  std::vector<float> cost;              // voxels; infinity: no match, and no triangle
};

/// The heaviest match; by material, the heaviest of those of the material with most weight.
const Match& chooseMatch(const Matches& matches, const Attributes& attributes, bool byMaterial) {
  const Match* chosen = matches.begin();
  if (!byMaterial || matches.count < 2) return *chosen;
  const auto materialOf = [&](const Match& match) {
    return attributes.mesh->triangleMaterials[attributes.triangle(match)];
  };
  double most = -1;
  for (const Match& match : matches) {
    double weight = 0;
    for (const Match& other : matches) {
      if (materialOf(other) == materialOf(match)) weight += other.weight;
    }
    if (weight > most) {
      most = weight;
      chosen = &match;
    }
  }
  return *chosen;
}

Vec3d middleOf(const TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0;
}

/// Whether the triangle closes the surface where the field's box cuts solid.
bool isCut(const TriangleMesh& mesh, std::size_t t, const DistanceField& field) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double face : {-0.5, field.size()[axis] - 0.5}) {
      const auto inFace = [&](std::uint32_t v) {
        return std::abs(field.index(mesh.positions[v])[axis] - face) < 1e-6;
      };
      if (std::ranges::all_of(mesh.triangles[t], inFace)) return true;
    }
  }
  return false;
}

/// `anywhere`: matches from however far; else only what is near enough to be a source.
TriangleSources matchTriangles(const TriangleMesh& result, const DistanceField& field,
                               const OriginPullView& pull, const Attributes& attributes,
                               bool byMaterial, bool anywhere) {
  const std::size_t count = result.triangles.size();
  TriangleSources sources;
  sources.motion.resize(count);
  sources.triangle.resize(count);
  sources.cost.resize(count);
  parallelFor(0, count, kGrain, [&](std::size_t t0, std::size_t t1) {
    Matches matches;
    for (std::size_t t = t0; t < t1; ++t) {
      const double limit = anywhere                  ? OriginPullView::kAnywhere
                           : isCut(result, t, field) ? kFarthestOfCut
                                                     : kFarthest;
      pull.match(middleOf(result, t), normalized(areaNormal(result, t)), matches, limit);
      sources.triangle[t] = kNone;
      sources.cost[t] = std::numeric_limits<float>::infinity();
      if (matches.count == 0) continue;
      const Match& chosen = chooseMatch(matches, attributes, byMaterial);
      if (chosen.cost > limit) continue;
      sources.motion[t] = chosen.motion;
      sources.triangle[t] = attributes.triangle(chosen);
      sources.cost[t] = static_cast<float>(chosen.cost);
    }
  });
  return sources;
}

/// How wide, in voxels, what has one material is on the example: the square root of the area of a
/// connected region of one material, the middle one if regions count as much as they cover.
double regionWidth(const TriangleMesh& example, double voxelSize) {
  // Triangles may come with corners of their own: those in one place are joined.
  std::vector<std::uint32_t> order(example.positions.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto& at = example.positions;
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(at[a].x, at[a].y, at[a].z, a) < std::tie(at[b].x, at[b].y, at[b].z, b);
  });
  for (std::size_t n = 0; n < order.size(); ++n) {
    const bool same = n > 0 && at[order[n]] == at[order[n - 1]];
    place[order[n]] = same ? place[order[n - 1]] : order[n];
  }
  Triangles joined = example.triangles;
  for (auto& corners : joined) {
    for (std::uint32_t& v : corners) v = place[v];
  }
  const std::vector<std::uint32_t> mates = mateHalfedges(joined, place.size());
  std::vector<std::uint32_t> region(joined.size());
  std::iota(region.begin(), region.end(), 0u);
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (mates[h] == kNone || mates[h] < h) continue;
    const std::uint32_t t = h / 3, u = mates[h] / 3;
    if (example.triangleMaterials[t] == example.triangleMaterials[u]) join(region, t, u);
  }
  std::vector<double> areas(joined.size(), 0);
  double total = 0;
  for (std::uint32_t t = 0; t < joined.size(); ++t) {
    const double area = length(areaNormal(example, t)) / 2;
    areas[findRoot(region, t)] += area;
    total += area;
  }
  std::sort(areas.begin(), areas.end());
  double covered = 0;
  for (const double area : areas) {
    covered += area;
    if (covered >= total / 2) return std::sqrt(area) / voxelSize;
  }
  return 1;
}

/// Materials by pieces: what was copied in one motion and has one material keeps together, and
/// where pieces meet, the material changes only where at least one side has such a border itself.
/// Triangles that have no source (where a box cuts solid) take what is beside them.
///
/// `sources` come from matches within `kFarthest`; `own` is each triangle's material as copied.
std::vector<std::uint32_t> materialsByPieces(const TriangleMesh& result,
                                             const std::vector<std::uint32_t>& mates,
                                             const OriginPullView& pull,
                                             const Attributes& attributes, double voxelSize,
                                             double width, const TriangleSources& sources,
                                             const std::vector<std::uint32_t>& own) {
  const auto count = static_cast<std::uint32_t>(result.triangles.size());
  const auto eachSide = [&](const auto& body) {  // between triangles that have a source
    for (std::uint32_t h = 0; h < mates.size(); ++h) {
      if (mates[h] == kNone || mates[h] < h) continue;
      const std::uint32_t t = h / 3, u = mates[h] / 3;
      if (own[t] != kNone && own[u] != kNone) body(h, t, u);
    }
  };
  const auto sameMotion = [&](std::uint32_t t, std::uint32_t u) {
    return sources.motion[t] == sources.motion[u];
  };
  std::vector<std::uint32_t> piece(count);
  std::iota(piece.begin(), piece.end(), 0u);
  std::vector<std::uint32_t> between;  // halfedges between pieces
  eachSide([&](std::uint32_t, std::uint32_t t, std::uint32_t u) {
    if (own[t] == own[u] && sameMotion(t, u)) join(piece, t, u);
  });
  eachSide([&](std::uint32_t h, std::uint32_t t, std::uint32_t u) {
    if (findRoot(piece, t) != findRoot(piece, u)) between.push_back(h);
  });
  std::vector<MaterialPiece> pieces;
  std::vector<std::uint32_t> number(count, kNone);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (own[t] == kNone) continue;
    const std::uint32_t root = findRoot(piece, t);  // the lowest triangle: numbered first
    if (root == t) {
      number[t] = static_cast<std::uint32_t>(pieces.size());
      pieces.push_back({own[t], 0});
    }
    number[t] = number[root];
    // Giving half of a round region another material must pay where the border round it goes.
    pieces[number[t]].weight += kKeep / std::clamp(width, kNarrowest, kWidest) *
                                length(areaNormal(result, t)) / 2 / (voxelSize * voxelSize);
  }
  std::vector<MaterialJoint> joints(between.size());
  parallelFor(0, between.size(), kGrain, [&](std::size_t n0, std::size_t n1) {
    for (std::size_t n = n0; n < n1; ++n) {
      const std::uint32_t h = between[n], t = h / 3, u = mates[h] / 3;
      const double side = length(result.positions[toVertex(result.triangles, h)] -
                                 result.positions[fromVertex(result.triangles, h)]) /
                          voxelSize;
      MaterialJoint& joint = joints[n] = {number[t], number[u], side, 0};
      if (sameMotion(t, u)) continue;  // the example's own border
      double smooth = kTrust, sum = kTrust;
      const auto ask = [&](std::uint32_t from, std::uint32_t to) {
        const auto match = pull.matchUnder(sources.motion[from], middleOf(result, to),
                                           normalized(areaNormal(result, to)), {}, 0, kFarthest);
        if (!match) return;  // no surface there: nothing to say
        const double trust = std::exp(-match->cost * match->cost);
        sum += trust;
        const std::uint32_t there = attributes.triangle(*match);
        if (attributes.mesh->triangleMaterials[there] == own[from]) smooth += trust;
      };
      ask(t, u);
      ask(u, t);
      joint.cost = side * smooth / sum;
    }
  });
  const std::vector<std::uint32_t> settled = settleMaterials(pieces, joints);
  std::vector<std::uint32_t> materials(count, kNone), front, next;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (number[t] == kNone) continue;
    materials[t] = settled[number[t]];
    front.push_back(t);
  }
  // Ring by ring into what has no source.
  while (!front.empty()) {
    next.clear();
    for (const std::uint32_t t : front) {
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t h = mates[3 * t + c];
        if (h == kNone || materials[h / 3] != kNone) continue;
        materials[h / 3] = materials[t];
        next.push_back(h / 3);
      }
    }
    front.swap(next);
  }
  return materials;
}

/// Materials for every triangle, kept together by pieces. `sources` come from matches within
/// `kFarthest`.
void transferPieces(TriangleMesh& result, const OriginPullView& pull, const Attributes& attributes,
                    std::span<const ExampleView> examples, double voxelSize,
                    const TransferOptions& options, const TriangleSources& sources) {
  const TriangleMesh& example = *attributes.mesh;
  const std::size_t count = result.triangles.size();
  const std::vector<std::uint32_t> mates = mateHalfedges(result.triangles, result.positions.size());
  std::vector<std::uint32_t> own(count, kNone);
  for (std::size_t t = 0; t < count; ++t) {
    if (sources.triangle[t] != kNone) own[t] = example.triangleMaterials[sources.triangle[t]];
  }
  result.triangleMaterials =
      materialsByPieces(result, mates, pull, attributes, voxelSize,
                        regionWidth(example, examples[0].field.voxelSize), sources, own);
  // What lies far from every source: the nearest, however far.
  parallelFor(0, count, kGrain, [&](std::size_t t0, std::size_t t1) {
    Matches matches;
    for (std::size_t t = t0; t < t1; ++t) {
      if (result.triangleMaterials[t] != kNone) continue;
      pull.match(middleOf(result, t), normalized(areaNormal(result, t)), matches);
      const Match& chosen = chooseMatch(matches, attributes, true);
      result.triangleMaterials[t] = example.triangleMaterials[attributes.triangle(chosen)];
    }
  });
  if (options.cutBorders) {
    // A border is where the triangle's own motion says so; the example's material there stands for
    // what triangles around that came with it have now.
    const VertexCorners corners = vertexCorners(result.triangles, result.positions.size());
    const Triangles triangles = result.triangles;
    const std::vector<std::uint32_t> settled = result.triangleMaterials;
    cutMaterialBorders(result, [&](const Vec3d& point, const Vec3d& normal, std::uint32_t t) {
      if (own[t] == kNone) return settled[t];
      const auto match = pull.matchUnder(sources.motion[t], point, normal, {}, 0, kFarthest);
      if (!match) return settled[t];
      const std::uint32_t material = example.triangleMaterials[attributes.triangle(*match)];
      if (material == own[t]) return settled[t];
      for (const std::uint32_t v : triangles[t]) {
        for (const std::uint32_t corner : corners.at(v)) {
          const std::uint32_t u = corner / 3;
          if (own[u] == material && sources.motion[u] == sources.motion[t]) return settled[u];
        }
      }
      return settled[t];
    });
  }
  cleanMaterialBorders(result, options.materialRounds);
}

/// Materials for every triangle, with borders where the example has them. `sources` follow: a piece
/// of a cut triangle comes from where its triangle did, but from a triangle of its material.
void transferMaterials(TriangleMesh& result, const OriginPullView& pull,
                       const Attributes& attributes, std::span<const ExampleView> examples,
                       const TransferOptions& options, TriangleSources& sources) {
  const TriangleMesh& example = *attributes.mesh;
  result.triangleMaterials.resize(result.triangles.size());
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    result.triangleMaterials[t] = example.triangleMaterials[sources.triangle[t]];
  }
  std::vector<std::uint32_t> parent;
  if (options.cutBorders) {
    parent = cutMaterialBorders(result, [&](const Vec3d& point, const Vec3d& normal,
                                            std::uint32_t) {
      Matches matches;
      pull.match(point, normal, matches);
      return example.triangleMaterials[attributes.triangle(chooseMatch(matches, attributes, true))];
    });
  } else {
    parent.resize(result.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
  }
  cleanMaterialBorders(result, options.materialRounds);
  const TriangleSources whole = sources;
  sources.motion.resize(parent.size());
  sources.triangle.resize(parent.size());
  sources.cost.resize(parent.size());
  parallelFor(0, parent.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
    for (std::size_t t = t0; t < t1; ++t) {
      const std::uint32_t from = parent[t];
      const OriginMotion& motion = whole.motion[from];
      sources.motion[t] = motion;
      sources.triangle[t] = whole.triangle[from];
      sources.cost[t] = whole.cost[from];
      if (result.triangleMaterials[t] == example.triangleMaterials[whole.triangle[from]]) continue;
      const std::span<const std::uint32_t> materials(
          example.triangleMaterials.data() + attributes.first[motion.example],
          examples[motion.example].mesh.triangles.size());
      const auto match =
          pull.matchUnder(motion, middleOf(result, t), normalized(areaNormal(result, t)), materials,
                          result.triangleMaterials[t]);
      if (match) {
        sources.triangle[t] = attributes.triangle(*match);
        sources.cost[t] = static_cast<float>(match->cost);
      } else {
        result.triangleMaterials[t] = example.triangleMaterials[whole.triangle[from]];
      }
    }
  });
}

void transferColors(TriangleMesh& result, const std::vector<Vec3d>& normals,
                    const OriginPullView& pull, const Attributes& attributes, bool bake) {
  std::optional<SurfaceColor> surfaceColor;
  if (bake) surfaceColor.emplace(*attributes.mesh);
  result.colors.assign(result.positions.size(), {1, 1, 1, 1});
  parallelFor(0, result.positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    Matches matches;
    for (std::size_t v = v0; v < v1; ++v) {
      pull.match(result.positions[v], normals[v], matches);
      std::array<double, 4> sum{};
      for (const Match& match : matches) {
        const std::uint32_t t = attributes.triangle(match);
        const std::array<float, 4> color =
            bake ? surfaceColor->at(t, match.point.weights)
                 : vertexColor(*attributes.mesh, t, match.point.weights);
        for (int k = 0; k < 4; ++k) sum[k] += match.weight * color[k];
      }
      for (int k = 0; k < 4; ++k) {
        result.colors[v][k] = static_cast<float>(std::clamp(sum[k], 0.0, 1.0));
      }
    }
  });
}

/// Triangles that stand alone among neighbours from elsewhere join them where that fits as well:
/// each joint between copied parts is a jump in the texture, so joints should be short.
void joinNeighbours(const TriangleMesh& result, const std::vector<Vec3d>& triangleNormals,
                    const std::vector<std::uint32_t>& mates, const OriginPullView& pull,
                    const Attributes& attributes, TriangleSources& sources) {
  constexpr int kRounds = 4;
  constexpr float kAllowance = 0.3f;  // voxels
  for (int round = 0; round < kRounds; ++round) {
    TriangleSources next = sources;
    parallelFor(0, result.triangles.size(), kGrain, [&](std::size_t t0, std::size_t t1) {
      for (std::size_t t = t0; t < t1; ++t) {
        for (int c = 0; c < 3; ++c) {
          const std::uint32_t g = mates[3 * t + c], h = mates[3 * t + (c + 1) % 3];
          if (g == kNone || h == kNone) continue;
          const OriginMotion& there = sources.motion[g / 3];
          if (!(there == sources.motion[h / 3]) || there == sources.motion[t]) continue;
          const auto match = pull.matchUnder(there, middleOf(result, t), triangleNormals[t]);
          if (!match || match->cost > sources.cost[t] + kAllowance) continue;
          const std::uint32_t triangle = attributes.triangle(*match);
          if (attributes.mesh->hasMaterials() &&
              attributes.mesh->triangleMaterials[triangle] !=
                  attributes.mesh->triangleMaterials[sources.triangle[t]]) {
            continue;
          }
          next.motion[t] = there;
          next.triangle[t] = triangle;
          next.cost[t] = static_cast<float>(match->cost);
          break;
        }
      }
    });
    sources = std::move(next);
  }
}

/// Each corner's texture coordinates, looked up where the triangle's motion takes it but inside the
/// chart of the triangle's middle.
void transferCoordinates(TriangleMesh& result, const std::vector<Vec3d>& normals,
                         const OriginPullView& pull, const Attributes& attributes,
                         std::span<const ExampleView> examples, const TriangleSources& sources) {
  const TriangleMesh& example = *attributes.mesh;
  const std::vector<std::uint32_t> charts = textureCharts(example);
  const VertexCorners corners = vertexCorners(result.triangles, result.positions.size());
  result.uvs.assign(result.triangles.size(), {});
  parallelFor(0, result.positions.size(), kGrain, [&](std::size_t v0, std::size_t v1) {
    struct Known {
      OriginMotion motion;
      std::uint32_t chart;
      Vec2f uv;
    };
    std::vector<Known> known;
    for (std::size_t v = v0; v < v1; ++v) {
      known.clear();
      for (const std::uint32_t corner : corners.at(v)) {
        const std::uint32_t t = corner / 3, chart = charts[sources.triangle[t]];
        const OriginMotion& motion = sources.motion[t];
        auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) {
          return k.chart == chart && k.motion == motion;
        });
        if (found == known.end()) {
          const std::span<const std::uint32_t> groups(
              charts.data() + attributes.first[motion.example],
              examples[motion.example].mesh.triangles.size());
          const auto match =
              pull.matchUnder(motion, result.positions[v], normals[v], groups, chart);
          const Vec2f uv =
              match ? textureCoordinates(example, attributes.triangle(*match), match->point.weights)
                    : Vec2f{};
          found = known.insert(known.end(), {motion, chart, uv});
        }
        result.uvs[t][corner % 3] = found->uv;
      }
    }
  });
}

void check(const TransferOptions& options, std::span<const ExampleView> examples) {
  if (examples.empty()) throw InputError("no example is given to take materials from");
  for (const ExampleView& example : examples) validate(example.mesh, "example");
  if (options.materialRounds < 0 || options.materialRounds > 100) {
    throw InputError("material rounds: " + std::to_string(options.materialRounds) +
                     " is out of range; 0 to 100 is right");
  }
}

}  // namespace

void transferAppearance(TriangleMesh& result, const DistanceField& field, const Origins& origins,
                        std::span<const ExampleView> examples, const TransferOptions& options,
                        const Progress& progress) {
  check(options, examples);
  const Attributes attributes(examples);
  const TriangleMesh& example = *attributes.mesh;
  const Plan plan = makePlan(example, options.textures);
  result.colors.clear();
  result.uvs.clear();
  result.triangleMaterials.clear();
  result.materials = plan.materials ? example.materials : std::vector<Material>{};
  result.textures = plan.coordinates ? example.textures : std::vector<Texture>{};
  if (!plan.coordinates) {
    for (Material& material : result.materials) material.baseColorTexture.reset();
  }
  if (!plan.colors && !plan.coordinates && !plan.materials) return;

  const OriginPullView pull(field, origins, examples, options.blend);
  TriangleSources sources;
  const bool manyMaterials = plan.materials && !plan.oneMaterial;
  if (plan.coordinates || manyMaterials) {
    progress.report("taking materials from the example", 0);
    sources = matchTriangles(result, field, pull, attributes, manyMaterials, plan.coordinates);
  }
  if (manyMaterials && plan.coordinates) {
    transferMaterials(result, pull, attributes, examples, options, sources);
  } else if (manyMaterials) {
    transferPieces(result, pull, attributes, examples, field.voxelSize, options, sources);
  } else if (plan.materials) {
    result.triangleMaterials.assign(result.triangles.size(), example.triangleMaterials.front());
  }

  std::vector<Vec3d> normals =
      vertexNormals(result, vertexCorners(result.triangles, result.positions.size()));
  for (Vec3d& n : normals) n = normalized(n);
  if (plan.coordinates) {
    progress.report("taking texture coordinates from the example", 0.4);
    std::vector<Vec3d> triangleNormals(result.triangles.size());
    for (std::size_t t = 0; t < triangleNormals.size(); ++t) {
      triangleNormals[t] = normalized(areaNormal(result, t));
    }
    joinNeighbours(result, triangleNormals,
                   mateHalfedges(result.triangles, result.positions.size()), pull, attributes,
                   sources);
    transferCoordinates(result, normals, pull, attributes, examples, sources);
  }
  if (plan.colors) {
    progress.report("taking colours from the example", 0.7);
    transferColors(result, normals, pull, attributes, plan.bake);
    if (plan.bake) {
      // The materials' own colours are in the vertices' now.
      for (Material& material : result.materials) material.baseColor = {1, 1, 1, 1};
    }
  }
  progress.report("appearance taken from the example", 1);
}

void transferAppearance(TriangleMesh& result, const DistanceField& field, const Origins& origins,
                        const TriangleMesh& example, const DistanceField& exampleField,
                        const TransferOptions& options, const Progress& progress) {
  const ExampleView view{example, exampleField};
  transferAppearance(result, field, origins, std::span(&view, 1), options, progress);
}

}  // namespace exemplar
