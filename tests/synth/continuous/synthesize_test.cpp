// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/synthesize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_health.h"
#include "synth/continuous/blocks.h"
#include "synth/continuous/exact_search.h"
#include "synth/continuous/snap.h"
#include "tests/synth/continuous/fixtures.h"

namespace exemplar::continuous {
namespace {

std::vector<Material> looksOf(const Solids& solids) {
  std::vector<Material> looks(solids.substances.size());
  for (std::size_t s = 0; s < looks.size(); ++s) looks[s].name = solids.substances[s];
  return looks;
}

Vec3i sizeFor(const std::string& name) {
  const Solids solids = solidsOf(name);
  const PlaneLattice lattice = latticeOf(solids);
  const Vec3i own = sizeInSpacings(lattice, solids);
  return {std::max(8, own.x), std::max(8, own.y), own.z + 2};
}

ContinuousResult make(const std::string& name, ContinuousOptions options) {
  const Solids solids = solidsOf(name);
  if (options.size == Vec3i{1, 1, 1}) options.size = sizeFor(name);
  if (options.learning == 8) options.learning = 2;
  return synthesizeSolids(solids, looksOf(solids), options);
}

/// The faces of a model as text that is equal where the models are.
std::string written(const PolygonModel& model) {
  std::string text;
  for (const Polygon& p : model.polygons) {
    text += std::to_string(p.below) + ">" + std::to_string(p.above);
    for (const auto& loop : p.loops) {
      text += "(";
      for (const std::uint32_t c : loop) {
        const ExactPoint& q = model.points[c];
        for (int axis = 0; axis < 3; ++axis) text += std::to_string(q.n[axis]) + ",";
        text += "/" + std::to_string(q.d) + " ";
      }
      text += ")";
    }
    text += "\n";
  }
  return text;
}

/// Figures of a mesh file that are none of the example's, at points strictly within the box of a
/// result. Only the extraction of figures is shared with what made the mesh.
std::vector<std::string> strangeFigures(const std::filesystem::path& file, const Solids& example,
                                        const Vec3i& size) {
  const PlaneLattice lattice = latticeOf(example);
  const PlaneSets planes = planesIn(lattice, windowOf(lattice, size));
  const Centrals centrals(planes.normals);
  const FigureSet known = extractFigures(example, centrals);
  SnapReport report;
  const Solids read = snapMesh(readMesh(file, {.up = UpAxis::Z}), {.unit = 1}, &report);
  EXPECT_LT(report.moved, 1e-4);
  const std::vector<ExactPlane> own = planesOf(read);
  for (const ExactPlane& plane : own) {
    if (std::ranges::find(planes.normals, plane.normal) == planes.normals.end())
      return {"a face of a new direction"};
  }
  // The same names for substances.
  std::vector<Substance> names(read.substances.size());
  for (std::size_t s = 0; s < names.size(); ++s) {
    const auto found = std::ranges::find(example.substances, read.substances[s]);
    if (found == example.substances.end()) return {"a new substance " + read.substances[s]};
    names[s] = static_cast<Substance>(found - example.substances.begin());
  }
  std::vector<std::string> strange;
  int judged = 0;
  for (const ExactPoint& p : candidatePoints(read)) {
    const Vec3d q = p.approximately() + read.origin;
    bool within = true;
    for (int axis = 0; axis < 3; ++axis) {
      within = within && q[axis] > static_cast<double>(planes.window.low[axis]) + 1e-6 &&
               q[axis] < static_cast<double>(planes.window.high[axis]) - 1e-6;
    }
    if (!within) continue;
    std::optional<Figure> figure = figureAt(read, centrals, own, p);
    if (!figure) continue;
    ++judged;
    for (Substance& s : figure->substances) s = names[s];
    if (known.find(*figure) == FigureSet::kNone) strange.push_back(readable(centrals, *figure));
  }
  EXPECT_GT(judged, 0);
  return strange;
}

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("continuous_" + name);
}

TEST(SynthesizeSolids, EveryFigureOfTheMeshReadBackIsTheExamples) {
  for (const Fixture& f : fixtures()) {
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
      ContinuousOptions options;
      options.seed = seed;
      options.density = 2;
      const ContinuousResult result = make(f.name, options);
      ASSERT_EQ(result.outcome, Outcome::Complete) << f.name;
      const TriangleMesh mesh = triangulate(result.model, Faces::Shells);
      if (mesh.triangles.size() < 20) continue;  // the ground and nothing on it
      const std::filesystem::path obj = scratch(std::string(f.name) + ".obj");
      writeMesh(obj, mesh, {.up = UpAxis::Z});
      EXPECT_EQ(strangeFigures(obj, solidsOf(f.name), sizeFor(f.name)), std::vector<std::string>{})
          << f.name << ", seed " << seed;
    }
  }
}

TEST(SynthesizeSolids, AMeshThatIsNotOfTheExampleIsFoundOut) {
  // The judge, judged: an L-block is none of a cube's results.
  const Solids block = solidsOf("l-block");
  const PolygonModel model = polygonsOf(block, looksOf(block));
  const std::filesystem::path file = scratch("judged.obj");
  writeMesh(file, triangulate(model, Faces::Shells), {.up = UpAxis::Z});
  EXPECT_FALSE(strangeFigures(file, solidsOf("cube"), {9, 9, 9}).empty());
  EXPECT_TRUE(strangeFigures(file, block, {9, 9, 9}).empty());
}

TEST(SynthesizeSolids, SurfacesAreClosedAndHaveTheVolumeOfTheirCells) {
  for (const Fixture& f : fixtures()) {
    const ContinuousResult result = make(f.name, {.seed = 3, .density = 2});
    ASSERT_EQ(result.outcome, Outcome::Complete) << f.name;
    const MeshHealth seen = meshHealth(triangulate(result.model)),
                     shells = meshHealth(triangulate(result.model, Faces::Shells));
    for (const MeshHealth& health : {seen, shells}) {
      EXPECT_TRUE(health.closed()) << f.name;
      EXPECT_TRUE(health.oriented()) << f.name;
      EXPECT_EQ(health.degenerateTriangles, 0) << f.name;
    }
    // All solids together, or one after the other.
    EXPECT_NEAR(seen.signedVolume, shells.signedVolume, 1e-6 * (1 + seen.signedVolume)) << f.name;
    if (std::string(f.name) == "cube") {
      EXPECT_TRUE(seen.manifold());
    }
  }
}

TEST(SynthesizeSolids, SeedsGiveDifferentResultsAndThreadsTheSame) {
  for (const Fixture& f : fixtures()) {
    std::set<std::string> results;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const ContinuousResult result = make(f.name, {.seed = seed, .density = 2});
      ASSERT_EQ(result.outcome, Outcome::Complete) << f.name << ", seed " << seed;
      results.insert(written(result.model));
    }
    EXPECT_GE(results.size(), 9u) << f.name;
  }
  for (const bool blocks : {false, true}) {
    std::string one, eight;
    const ContinuousOptions options{.seed = 5, .density = 2, .block = 6, .blocksOnly = blocks};
    tbb::task_arena(1).execute([&] { one = written(make("cross-gabled", options).model); });
    tbb::task_arena(8).execute([&] { eight = written(make("cross-gabled", options).model); });
    EXPECT_EQ(one, eight);
    EXPECT_FALSE(one.empty());
  }
}

TEST(SynthesizeSolids, BlocksKeepTheExamplesFigures) {
  for (const char* name : {"pentagon", "cross-gabled", "tetrahedron"}) {
    const ContinuousResult result =
        make(name, {.seed = 1, .density = 3, .block = 6, .blocksOnly = true});
    ASSERT_EQ(result.outcome, Outcome::Complete) << name;
    EXPECT_FALSE(result.statistics.whole);
    EXPECT_GT(result.statistics.blocksKept, 0);
    const std::filesystem::path file = scratch(std::string(name) + "_blocks.obj");
    writeMesh(file, triangulate(result.model, Faces::Shells), {.up = UpAxis::Z});
    EXPECT_EQ(strangeFigures(file, solidsOf(name), sizeFor(name)), std::vector<std::string>{})
        << name;
  }
}

TEST(SynthesizeSolids, AllFiguresOccurOverTenSeeds) {
  for (const char* name : {"cube", "gabled", "tetrahedron", "pyramid"}) {
    const Solids solids = solidsOf(name);
    const PlaneLattice lattice = latticeOf(solids);
    const PlaneSets planes = planesIn(lattice, windowOf(lattice, sizeFor(name)));
    const Centrals centrals(planes.normals);
    const FigureSet known = extractFigures(solids, centrals);
    FigureSet seen;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const ContinuousResult result = make(name, {.seed = seed, .density = 3});
      for (const Polygon& p : result.model.polygons) {
        for (std::size_t i = 0; i < centrals.normals().size(); ++i)
          if (centrals.normals()[i] == p.plane.normal)
            seen.add({Families{1} << i, {p.below, p.above}});
      }
    }
    // Every face of the example, on the right side.
    for (const Figure& figure : known.all()) {
      if (__builtin_popcount(figure.support) == 1) {
        EXPECT_NE(seen.find(figure), FigureSet::kNone) << name << " " << readable(centrals, figure);
      }
    }
  }
}

TEST(SynthesizeSolids, WhatIsPlacedIsThere) {
  ContinuousOptions options;
  options.size = {8, 8, 4};
  options.placed = {{{3, 3, 0}, {1}}, {{5, 3, 0}, {0}}, {{5, 5, 2}, {1}}};
  const ContinuousResult result = make("cube", options);
  ASSERT_EQ(result.outcome, Outcome::Complete) << result.why;
  // Spacing 2 from 0 on. A ray upward from a cell's center crosses an odd number of faces where it
  // is inside.
  const TriangleMesh mesh = triangulate(result.model);
  const auto inside = [&](const Vec3d& p) {
    int crossings = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3d a = mesh.positions[t[0]] - p, b = mesh.positions[t[1]] - p,
                  c = mesh.positions[t[2]] - p;
      const auto side = [](const Vec3d& u, const Vec3d& v) { return u.x * v.y - u.y * v.x; };
      const double ab = side(a, b), bc = side(b, c), ca = side(c, a);
      const bool over = (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
      if (over && std::max({a.z, b.z, c.z}) > 0) ++crossings;
    }
    return crossings % 2 == 1;
  };
  EXPECT_TRUE(inside({7.013, 7.007, 1.01}));
  EXPECT_FALSE(inside({11.013, 7.007, 1.01}));
  EXPECT_TRUE(inside({11.013, 11.007, 5.01}));
}

TEST(SynthesizeSolids, DemandsThatExcludeEachOtherAreNamed) {
  // Nothing of a cube with one spacing in all directions is two spacings long.
  ContinuousOptions options;
  options.size = {8, 8, 4};
  options.thin = {{1, {1, 0, 0}}, {1, {0, 1, 0}}, {1, {0, 0, 1}}};
  options.placed = {{{1, 1, 1}, {0}}, {{3, 3, 1}, {1}}, {{4, 3, 1}, {1}}, {{6, 6, 1}, {1}}};
  const ContinuousResult result = make("cube", options);
  EXPECT_EQ(result.outcome, Outcome::Impossible);
  EXPECT_EQ(result.conflict, (std::vector<int>{1, 2}));
}

TEST(SynthesizeSolids, ThinSolidsAreOneSpacingThick) {
  ContinuousOptions options;
  options.size = {10, 10, 6};
  options.density = 3;
  options.thin = {{1, {1, 0, 0}}, {1, {0, 1, 0}}, {1, {0, 0, 1}}};
  const ContinuousResult result = make("cube", options);
  ASSERT_EQ(result.outcome, Outcome::Complete);
  const TriangleMesh mesh = triangulate(result.model);
  const MeshHealth health = meshHealth(mesh);
  // Cubes of side 2 and nothing else.
  ASSERT_GT(health.components, 0);
  EXPECT_EQ(health.triangles, 12 * health.components);
  EXPECT_NEAR(health.signedVolume, 8.0 * static_cast<double>(health.components), 1e-9);
}

TEST(SynthesizeSolids, IsAboutAsFullAsTheExample) {
  for (const char* name : {"gabled", "pyramid"}) {
    Shares sum{};
    Shares wanted{};
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      ContinuousOptions options;
      options.seed = seed;
      options.size = {16, 16, 5};
      options.learning = 12;
      const ContinuousResult result = make(name, options);
      wanted = result.statistics.exampleShares;
      for (int c = 0; c < kFigureClasses; ++c) sum[c] += result.statistics.shares[c] / 5;
    }
    // Corners, edges and all that is solid; what there is hardly any of varies more.
    for (int c = 0; c < kFigureClasses; ++c) {
      if (wanted[c] < 0.03) continue;
      EXPECT_LT(sum[c], 2.2 * wanted[c]) << name << " " << c;
      EXPECT_GT(sum[c], wanted[c] / 2.2) << name << " " << c;
    }
  }
}

TEST(SynthesizeSolids, NothingHangsInTheAirUnlessTheExampleDoes) {
  // A deck on legs: legs may end below a deck, and decks may be without any.
  const char* text = R"(
kind = "solids"
ground = { height = 0, substance = "sea" }
[[part]]
substance = "leg"
box = [1, 1, 0, 2, 2, 2]
[[part]]
substance = "deck"
box = [0, 0, 2, 3, 3, 3]
)";
  const SolidScene scene = readSolidScene(text, "deck");
  ContinuousOptions options;
  options.size = {12, 12, 6};
  options.learning = 2;
  options.density = 2;
  std::int64_t removed = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    options.seed = seed;
    options.floating.reset();
    const ContinuousResult grounded = synthesizeSolids(scene.solids, scene.looks, options);
    ASSERT_EQ(grounded.outcome, Outcome::Complete);
    EXPECT_EQ(meshHealth(triangulate(grounded.model)).components, 1) << seed;
    EXPECT_TRUE(meshHealth(triangulate(grounded.model)).closed());
    removed += grounded.statistics.floating;
    options.floating = true;
    EXPECT_EQ(synthesizeSolids(scene.solids, scene.looks, options).statistics.floating, 0);
  }
  EXPECT_GT(removed, 0);
}

TEST(SynthesizeSolids, CancellationIsThrown) {
  std::atomic<bool> cancel = true;
  const Solids solids = solidsOf("cube");
  EXPECT_THROW(
      synthesizeSolids(solids, looksOf(solids), {.size = {4, 4, 4}}, Progress({}, &cancel)),
      Cancelled);
}

/// A small puzzle: its planes, figures and domains.
struct Small {
  Solids solids;
  PlaneLattice lattice;
  PlaneSets planes;
  Centrals centrals;
  FigureSet figures;
  Arrangement arrangement;
  Puzzle puzzle;
  std::vector<std::uint32_t> vertices;

  Small(const std::string& name, const Vec3i& size) : Small(solidsOf(name), size) {}
  Small(Solids example, const Vec3i& size)
      : solids(std::move(example)),
        lattice(latticeOf(solids)),
        planes(planesIn(lattice, windowOf(lattice, size))),
        centrals(planes.normals),
        figures(extractFigures(solids, centrals)),
        arrangement(planes, centrals, 100'000),
        puzzle(makePuzzle(arrangement, figures, solids.ground)) {
    for (std::uint32_t v = 0; v < arrangement.vertices(); ++v)
      if (arrangement.inside(v)) vertices.push_back(v);
  }
};

/// Counts all solutions by trying everything, and notes which labels they use.
std::int64_t countSolutions(const Small& small, std::size_t at, std::vector<std::size_t>& labels,
                            std::vector<std::set<std::size_t>>& used) {
  if (at == small.vertices.size()) {
    for (std::size_t n = 0; n < at; ++n) used[n].insert(labels[n]);
    return 1;
  }
  const std::uint32_t v = small.vertices[at];
  const VertexClass& c = small.puzzle.classOf(v);
  std::int64_t count = 0;
  forEach(small.puzzle.domains[v], [&](std::size_t l) {
    const std::span<const EdgeEnd> ends = small.arrangement.ends(v);
    for (std::size_t r = 0; r < ends.size(); ++r) {
      if (ends[r].vertex >= v || !small.arrangement.inside(ends[r].vertex)) continue;
      const auto n = static_cast<std::size_t>(
          std::ranges::lower_bound(small.vertices, ends[r].vertex) - small.vertices.begin());
      const VertexClass::Along& there = small.puzzle.classOf(ends[r].vertex).rays[ends[r].ray];
      if (there.edgeOf[labels[n]] != c.rays[r].edgeOf[l]) return;
    }
    labels[at] = l;
    count += countSolutions(small, at + 1, labels, used);
  });
  return count;
}

TEST(Search, PropagationKeepsEverySolution) {
  for (const auto& [name, size] :
       std::vector<std::pair<std::string, Vec3i>>{{"cube", {1, 1, 1}}, {"cube", {2, 1, 1}}}) {
    const Small small(name, size);
    ASSERT_LE(small.vertices.size(), 14u);
    std::vector<std::size_t> labels(small.vertices.size());
    std::vector<std::set<std::size_t>> used(small.vertices.size());
    const std::int64_t solutions = countSolutions(small, 0, labels, used);
    EXPECT_GE(solutions, 2) << name;
    Domains domains = small.puzzle.domains;
    Search::Marks marks(small.puzzle);
    const std::vector<double> weights(small.figures.size(), 1);
    Search search(small.puzzle, weights, domains, marks);
    ASSERT_TRUE(search.begin(small.vertices, 1));
    for (std::size_t n = 0; n < used.size(); ++n)
      for (const std::size_t l : used[n]) EXPECT_TRUE(contains(domains[small.vertices[n]], l));
    // And at the fixed point every label agrees with one at the other end of each edge.
    for (const std::uint32_t v : small.vertices) {
      const std::span<const EdgeEnd> ends = small.arrangement.ends(v);
      forEach(domains[v], [&](std::size_t l) {
        for (std::size_t r = 0; r < ends.size(); ++r) {
          const std::uint32_t w = ends[r].vertex;
          if (!small.arrangement.inside(w)) continue;
          bool agrees = false;
          forEach(domains[w], [&](std::size_t m) {
            agrees = agrees || small.puzzle.classOf(w).rays[ends[r].ray].edgeOf[m] ==
                                   small.puzzle.classOf(v).rays[r].edgeOf[l];
          });
          EXPECT_TRUE(agrees);
        }
      });
    }
    // All solutions are found by blocking none: a search with any seed finds one of them.
    EXPECT_EQ(search.run(Random(1), 100), Found::All);
  }
}

/// Nothing is chosen twice in the same place: where one label is far likelier than all others and
/// leads to a contradiction, the search goes on with another one, and ends with a result.
TEST(Search, RemovesLabelsThatFailed) {
  const std::string path = std::string(EXEMPLAR_SOURCE_DIR) + "/scenes/pentagons.toml";
  const Small small(readSolidScene(readFile(path), path).solids, {8, 8, 6});
  std::int64_t failures = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Random random(seed);
    std::vector<double> weights;
    for (std::size_t f = 0; f < small.figures.size(); ++f)
      weights.push_back(std::pow(10.0, random.below(13, f)));
    Domains domains = small.puzzle.domains;
    Search::Marks marks(small.puzzle);
    Search search(small.puzzle, weights, domains, marks);
    ASSERT_TRUE(search.begin(small.vertices, 1));
    EXPECT_EQ(search.run(random, 1000), Found::All) << seed;
    failures += search.counts().failures;
  }
  EXPECT_GT(failures, 5);
}

/// Attempts begin from the same domains, whatever the last one has left.
TEST(Search, BeginsAgainWhereItBegan) {
  const Small small("pyramid", {3, 3, 2});
  Domains domains = small.puzzle.domains;
  Search::Marks marks(small.puzzle);
  const std::vector<double> weights(small.figures.size(), 1);
  Search search(small.puzzle, weights, domains, marks);
  ASSERT_TRUE(search.begin(small.vertices, 1));
  const Domains begun = domains;
  const std::vector<Word> edges = marks.edges;
  const Growth growth = growthOf(small.puzzle, std::nullopt);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Found found =
        seed % 2 ? search.run(Random(seed), 1000) : search.grow(growth, Random(seed), 1000);
    ASSERT_EQ(found, Found::All) << seed;
    EXPECT_NE(domains, begun);
    search.again();
    EXPECT_EQ(domains, begun);
    EXPECT_EQ(marks.edges, edges);
  }
}

TEST(Labels, AreTakenOutOfSetsThatAreVectors) {
  std::vector<Word> set(2);
  for (const std::size_t label : {0u, 5u, 70u, 127u}) insert(set, label);
  takeOut(set, 70);
  takeOut(set, 0);
  ASSERT_EQ(set.size(), 2u);
  EXPECT_EQ(count(set), 2);
  EXPECT_TRUE(contains(set, 5) && contains(set, 127));
  EXPECT_FALSE(hasOne(set));
  takeOut(set, 5);
  EXPECT_TRUE(hasOne(set));
  EXPECT_EQ(lowest(set), 127u);
}

TEST(ExactSearch, AgreesWithTheSearch) {
  Small small("pyramid", {3, 3, 2});
  Domains domains = small.puzzle.domains;
  Search::Marks marks(small.puzzle);
  const std::vector<double> weights(small.figures.size(), 1);
  Search search(small.puzzle, weights, domains, marks);
  ASSERT_TRUE(search.begin(small.vertices, 1));
  ExactSearch exact(small.puzzle, domains, small.vertices);
  // Everything but the background somewhere.
  const std::uint32_t v = small.vertices[small.vertices.size() / 2];
  std::vector<Word> other(domains[v].begin(), domains[v].end());
  takeOut(other, static_cast<std::size_t>(small.puzzle.background[v]));
  const int demand = exact.newDemand();
  exact.addToDemand(demand, v, other);
  const int demands[] = {demand};
  ASSERT_EQ(exact.solve(demands, 100'000), Outcome::Complete);
  Domains solved = domains;
  exact.take(solved);
  for (const std::uint32_t u : small.vertices) {
    ASSERT_EQ(count(solved[u]), 1);
    const std::span<const EdgeEnd> ends = small.arrangement.ends(u);
    for (std::size_t r = 0; r < ends.size(); ++r) {
      const std::uint32_t w = ends[r].vertex;
      if (!small.arrangement.inside(w)) continue;
      std::size_t here = 0, there = 0;
      forEach(solved[u], [&](std::size_t l) { here = l; });
      forEach(solved[w], [&](std::size_t l) { there = l; });
      EXPECT_EQ(small.puzzle.classOf(u).rays[r].edgeOf[here],
                small.puzzle.classOf(w).rays[ends[r].ray].edgeOf[there]);
    }
  }
  // The same label and any other one at a vertex exclude each other.
  std::vector<Word> none(other.size());
  const int second = exact.newDemand();
  exact.addToDemand(second, v, none);
  const int both[] = {demand, second};
  EXPECT_EQ(exact.solve(both, 100'000), Outcome::Impossible);
  EXPECT_TRUE(exact.used(second));
}

TEST(SnapMesh, FindsTheGridAndTheFiguresOfAMesh) {
  for (const Fixture& f : fixtures()) {
    const Solids solids = solidsOf(f.name);
    if (solids.ground) continue;
    TriangleMesh mesh = triangulate(polygonsOf(solids, looksOf(solids)));
    // Somewhere else, and half as large.
    for (Vec3d& p : mesh.positions) p = p * 0.5 + Vec3d{3.25, -1.5, 7.125};
    SnapReport report;
    const Solids snapped = snapMesh(mesh, {}, &report);
    EXPECT_LT(report.moved, 1e-9) << f.name;
    EXPECT_EQ(report.shells, 1) << f.name;
    const Centrals centrals(normalsOf(planesOf(snapped)));
    EXPECT_EQ(extractFigures(snapped, centrals).all(),
              extractFigures(solids, Centrals(normalsOf(planesOf(solids)))).all())
        << f.name;
  }
}

TEST(SnapMesh, SaysWhatIsWrong) {
  const Solids solids = solidsOf("l-block");
  const TriangleMesh good = triangulate(polygonsOf(solids, looksOf(solids)));
  const auto message = [](const TriangleMesh& mesh, const SnapOptions& options) -> std::string {
    try {
      snapMesh(mesh, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using testing::HasSubstr;
  EXPECT_EQ(message(good, {}), "");
  TriangleMesh open = good;
  open.triangles.pop_back();
  open.triangleMaterials.pop_back();
  EXPECT_THAT(message(open, {}), HasSubstr("not closed"));
  TriangleMesh bent = good;
  bent.positions[0] += Vec3d{0.13, 0.07, 0.11};
  EXPECT_NE(message(bent, {}), "");
  EXPECT_THAT(message(good, {.unit = 0.7}), HasSubstr("`unit`"));
  TriangleMesh inward = good;
  for (auto& t : inward.triangles) std::swap(t[1], t[2]);
  Warnings warnings;
  snapMesh(inward, {.warnings = &warnings});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("point inward"));
  EXPECT_THAT(message(TriangleMesh{}, {}), HasSubstr("no faces"));
}

}  // namespace
}  // namespace exemplar::continuous
