// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/vdb_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include "core/cells.h"
#include "core/file.h"
#include "sdf/resample.h"
#include "tests/sdf/cancellation.h"
#include "tests/sdf/shapes.h"

namespace exemplar {
namespace {

using test::inputError;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

DistanceField torusField(double truncation, const Vec3i& size = {40, 36, 20}) {
  return test::sampled(test::torus({1, 2, 3}, 0.7, 0.25), size, 0.06, {-0.15, 0.95, 2.4},
                       truncation);
}

// Grids written by OpenVDB alone, as other programs write them.
void writeGrid(const std::filesystem::path& path, const openvdb::GridBase::Ptr& grid) {
  openvdb::io::File(path.string()).write(openvdb::GridPtrVec{grid});
}

void expectSame(const DistanceField& a, const DistanceField& b) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_DOUBLE_EQ(a.voxelSize, b.voxelSize);
  EXPECT_NEAR(length(a.origin - b.origin), 0, 1e-12);
  EXPECT_EQ(a.truncation, b.truncation);
  EXPECT_EQ(a.values, b.values);
}

TEST(VdbFile, ComesBackToTheLastBit) {
  const TemporaryFolder folder;
  for (const double truncation : {0.18, 0.06, 0.5, kInfinity}) {
    const DistanceField field = torusField(truncation);
    writeVdb(folder / "field.vdb", field);
    expectSame(readVdb(folder / "field.vdb"), field);
  }
}

TEST(VdbFile, RecordsTheAxesAlongWhichAFieldIsPeriodic) {
  const TemporaryFolder folder;
  for (const Axes& recorded : {Axes{true, false, true}, Axes::none()}) {
    writeVdb(folder / "field.vdb", torusField(0.18), {.wraps = recorded});
    Axes wraps = Axes::every();
    expectSame(readVdb(folder / "field.vdb", {}, &wraps), torusField(0.18));
    EXPECT_EQ(wraps, recorded);
  }
}

TEST(VdbFile, KeepsFieldsWithoutASurfaceAndOfASingleSample) {
  const TemporaryFolder folder;
  for (const float value : {0.5f, -0.5f, 0.1f, 0.0f}) {
    const DistanceField field{Array3D<float>({3, 1, 2}, value), 0.25, {1, 1, 1}, 0.5f};
    writeVdb(folder / "field.vdb", field);
    // Without an active voxel, too: the box is written down.
    expectSame(readVdb(folder / "field.vdb"), field);
  }
  const auto empty = openvdb::FloatGrid::create(1);
  writeGrid(folder / "empty.vdb", empty);
  EXPECT_THAT(inputError([&] { readVdb(folder / "empty.vdb"); }), HasSubstr("no active voxels"));
  EXPECT_THAT(inputError([&] { writeVdb(folder / "none.vdb", DistanceField{}); }),
              HasSubstr("no samples"));
}

TEST(VdbFile, SaysThatItIsALevelSet) {
  const TemporaryFolder folder;
  writeVdb(folder / "field.vdb", torusField(0.18));
  openvdb::io::File file((folder / "field.vdb").string());
  file.open(false);
  const auto grids = file.getGrids();
  ASSERT_EQ(grids->size(), 1u);
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(grids->front());
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->getName(), "surface");
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_FLOAT_EQ(grid->background(), 0.18f);
  EXPECT_DOUBLE_EQ(grid->voxelSize()[0], 0.06);
  // Samples outside the band are background, and those inside the solid have its sign.
  const DistanceField field = torusField(0.18);
  std::uint64_t active = 0;
  for (const float v : field.values.values()) active += std::abs(v) < field.truncation;
  EXPECT_EQ(grid->activeVoxelCount(), active);
  EXPECT_LT(grid->tree().getValue({31, 17, 10}), 0);
  // World positions are those of the field.
  const openvdb::Vec3d at = grid->indexToWorld(openvdb::Coord(3, 4, 5));
  EXPECT_NEAR(length(field.position({3, 4, 5}) - Vec3d{at[0], at[1], at[2]}), 0, 1e-12);
}

TEST(VdbFile, IsListedByVdbPrint) {
  if (std::system("command -v vdb_print > /dev/null") != 0)
    GTEST_SKIP() << "vdb_print is not installed";
  const TemporaryFolder folder;
  writeVdb(folder / "field.vdb", torusField(0.18));
  const std::string command = "vdb_print -l " + (folder / "field.vdb").string() + " > " +
                              (folder / "out.txt").string() + " 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string text = readFile(folder / "out.txt");
  EXPECT_THAT(text, HasSubstr("surface"));
  EXPECT_THAT(text, HasSubstr("level set"));
  EXPECT_THAT(text, HasSubstr("0.06"));
}

TEST(VdbFile, TheSameFieldGivesTheSameBytes) {
  const TemporaryFolder folder;
  writeVdb(folder / "a.vdb", torusField(0.18));
  writeVdb(folder / "b.vdb", torusField(0.18));
  writeVdb(folder / "c.vdb", torusField(0.12));
  EXPECT_EQ(readFile(folder / "a.vdb"), readFile(folder / "b.vdb"));
  // The id that is made from the content distinguishes different ones.
  EXPECT_NE(readFile(folder / "a.vdb").substr(21, 36), readFile(folder / "c.vdb").substr(21, 36));
}

TEST(VdbFile, ReadsLevelSetsOfOtherPrograms) {
  const TemporaryFolder folder;
  const auto sphere =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, {5, 6, 7}, 0.1f, 3.0f);
  sphere->setName("density of nothing");
  writeGrid(folder / "sphere.vdb", sphere);
  const DistanceField field = readVdb(folder / "sphere.vdb");
  EXPECT_FLOAT_EQ(field.truncation, 0.3f);
  EXPECT_NEAR(field.voxelSize, 0.1, 1e-8);
  // createLevelSetSphere is exact.
  EXPECT_LT(test::worstError(field, test::sphere({5, 6, 7}, 1)), 1e-4);
}

TEST(VdbFile, ReadsHalfFloatsAndDoubles) {
  const TemporaryFolder folder;
  const auto half = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, {0, 0, 0}, 0.1f);
  half->setSaveFloatAsHalf(true);
  writeGrid(folder / "half.vdb", half);
  // Halves of 0.3 have steps of 2.4e-4, 0.0024 voxels.
  EXPECT_LT(test::worstError(readVdb(folder / "half.vdb"), test::sphere({}, 1)), 0.003);

  const auto doubles =
      openvdb::tools::createLevelSetSphere<openvdb::DoubleGrid>(1.0f, {0, 0, 0}, 0.1f);
  writeGrid(folder / "double.vdb", doubles);
  EXPECT_LT(test::worstError(readVdb(folder / "double.vdb"), test::sphere({}, 1)), 1e-4);
}

TEST(VdbFile, ReadsFogVolumesByTheirHalf) {
  const TemporaryFolder folder;
  // Density 1 inside, falling to 0 over 3 voxels below the surface: 0.5 is 1.5 voxels deep.
  const auto fog =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, {0.02f, 0, 0}, 0.05f, 3.0f);
  openvdb::tools::sdfToFogVolume(*fog);
  for (const bool unknownClass : {false, true}) {
    if (unknownClass) fog->setGridClass(openvdb::GRID_UNKNOWN);
    writeGrid(folder / "fog.vdb", fog);
    const DistanceField field = readVdb(folder / "fog.vdb");
    EXPECT_FLOAT_EQ(field.truncation, 0.15f);
    EXPECT_LT(test::worstError(field, test::sphere({0.02, 0, 0}, 1 - 1.5 * 0.05)), 0.1);
  }
}

TEST(VdbFile, PicksTheFirstGridOfFloats) {
  const TemporaryFolder folder;
  const auto vectors = openvdb::Vec3SGrid::create();
  vectors->setName("velocity");
  const auto sphere =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, {0, 0, 0}, 0.2f);
  openvdb::io::File((folder / "two.vdb").string()).write(openvdb::GridPtrVec{vectors, sphere});
  EXPECT_LT(test::worstError(readVdb(folder / "two.vdb"), test::sphere({}, 1)), 1e-4);
  writeGrid(folder / "none.vdb", vectors);
  EXPECT_THAT(inputError([&] { readVdb(folder / "none.vdb"); }),
              testing::AllOf(HasSubstr("no grid of floats"), HasSubstr("velocity")));
}

TEST(VdbFile, PrefersALevelSetAndReadsTheGridThatIsNamed) {
  const TemporaryFolder folder;
  const auto ball = [](float radius, const char* name) {
    const auto grid =
        openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(radius, {0, 0, 0}, 0.1f);
    grid->setName(name);
    return grid;
  };
  const auto heat = ball(0.5f, "temperature"), density = ball(0.8f, "density"),
             surface = ball(1.0f, "surface");
  openvdb::tools::sdfToFogVolume(*heat);
  openvdb::tools::sdfToFogVolume(*density);
  const auto path = folder / "three.vdb";
  openvdb::io::File(path.string()).write(openvdb::GridPtrVec{heat, density, surface});
  Warnings warnings;
  EXPECT_LT(test::worstError(readVdb(path, {.warnings = &warnings}), test::sphere({}, 1)), 1e-4);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], testing::AllOf(testing::StartsWith(path.string() + ": "),
                                          HasSubstr("grid \"surface\" (float) is read"),
                                          HasSubstr("out: \"temperature\" (float), \"density\""),
                                          HasSubstr("`grid`"), Not(HasSubstr("\n"))));
  // By name, without a word; the fog's 0.5 is 1.5 voxels deep.
  warnings.clear();
  const DistanceField hot = readVdb(path, {.grid = "temperature", .warnings = &warnings});
  EXPECT_LT(test::worstError(hot, test::sphere({}, 0.5 - 0.15)), 0.2);
  EXPECT_TRUE(warnings.empty());
  EXPECT_THAT(inputError([&] { readVdb(path, {.grid = "smoke"}); }),
              testing::AllOf(HasSubstr("named \"smoke\""), HasSubstr("\"surface\" (float)")));
  // Without a level set, a density is what a person sees.
  openvdb::io::File(path.string()).write(openvdb::GridPtrVec{heat, density});
  EXPECT_LT(test::worstError(readVdb(path), test::sphere({}, 0.8 - 0.15)), 0.2);
  // One grid alone is no news.
  openvdb::io::File(path.string()).write(openvdb::GridPtrVec{surface});
  readVdb(path, {.warnings = &warnings});
  EXPECT_TRUE(warnings.empty());
}

TEST(VdbFile, KeepsVoxelsOfAnySize) {
  const TemporaryFolder folder;
  for (const double scale : {1e-12, 1e-7, 1e-4, 1e6, 1e9}) {
    DistanceField field = torusField(0.18);
    field.voxelSize *= scale;
    field.origin = field.origin * scale + Vec3d{1, 1, 1} * (20 * scale);
    field.truncation *= static_cast<float>(scale);
    for (float& v : field.values.values()) v *= static_cast<float>(scale);
    writeVdb(folder / "field.vdb", field);
    const DistanceField read = readVdb(folder / "field.vdb");
    ASSERT_EQ(read.size(), field.size()) << scale;
    EXPECT_NEAR(read.voxelSize / field.voxelSize, 1, 1e-9) << scale;
    EXPECT_NEAR(length(read.origin - field.origin) / field.voxelSize, 0, 1e-6) << scale;
    EXPECT_NEAR(read.truncation / field.truncation, 1, 1e-6) << scale;
    // Rounding to floats, twice.
    for (std::size_t s = 0; s < field.values.count(); ++s)
      ASSERT_NEAR(read.values.values()[s] / field.truncation,
                  field.values.values()[s] / field.truncation, 1e-6)
          << scale;
    writeOriginsVdb(folder / "origins.vdb", Origins(field.size()), field);
  }
}

TEST(VdbFile, RefusesVoxelsThatAreNoCubes) {
  const TemporaryFolder folder;
  const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, {0, 0, 0}, 0.2f);
  const auto refuse = [&](const openvdb::math::Transform::Ptr& transform) {
    grid->setTransform(transform);
    writeGrid(folder / "grid.vdb", grid);
    EXPECT_THAT(inputError([&] { readVdb(folder / "grid.vdb"); }), HasSubstr("cubes"));
  };
  using openvdb::math::Transform;
  auto transform = Transform::createLinearTransform(0.2);
  transform->preScale({1, 1, 2});
  refuse(transform);
  transform = Transform::createLinearTransform(0.2);
  transform->postRotate(0.3, openvdb::math::Z_AXIS);
  refuse(transform);
  transform = Transform::createLinearTransform(0.2);
  transform->postScale({-1, -1, 1});
  refuse(transform);
  refuse(Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 10));
}

TEST(VdbFile, RefusesActiveBoxesThatDoNotFitInMemory) {
  const TemporaryFolder folder;
  const auto grid = openvdb::FloatGrid::create(1);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  for (const int far : {100000, 2147483000}) {
    accessor.setValue({-far, -far, -far}, -0.5f);
    accessor.setValue({far, far, far}, 0.5f);
    writeGrid(folder / "huge.vdb", grid);
    const std::string error = inputError([&] { readVdb(folder / "huge.vdb"); });
    EXPECT_THAT(error, HasSubstr("huge.vdb"));
    EXPECT_THAT(error, HasSubstr("available"));
  }
}

TEST(VdbFile, RefusesValuesThatAreNoNumbers) {
  const TemporaryFolder folder;
  const auto grid = openvdb::FloatGrid::create(1);
  for (const float value : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    grid->tree().setValue({0, 0, 0}, value);
    writeGrid(folder / "nan.vdb", grid);
    EXPECT_THAT(inputError([&] { readVdb(folder / "nan.vdb"); }), HasSubstr("NaN"));
  }
}

TEST(VdbFile, RefusesFilesThatEndEarlyAtAnyByte) {
  const TemporaryFolder folder;
  writeVdb(folder / "whole.vdb", torusField(0.12, {14, 13, 12}));
  const std::string whole = readFile(folder / "whole.vdb");
  for (std::size_t n = 1; n < whole.size(); n += n < 300 ? 1 : 59) {
    test::writeBytes(folder / "part.vdb", whole.substr(0, n));
    const std::string error = inputError([&] { readVdb(folder / "part.vdb"); });
    ASSERT_THAT(error, HasSubstr("part.vdb")) << n << " of " << whole.size();
    ASSERT_THAT(error, Not(HasSubstr("\n")));
  }
}

TEST(VdbFile, DamagedBytesAreReadOrRefusedButNothingElse) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "OpenVDB asks for as much memory as a damaged size says; the sanitizer's own "
                  "operator new ends the program where the standard's throws";
#endif
  const TemporaryFolder folder;
  writeVdb(folder / "whole.vdb", torusField(0.12, {14, 13, 12}));
  const std::string whole = readFile(folder / "whole.vdb");
  const Random random(5);
  int refused = 0;
  // Few: a damaged box may ask for gigabytes, and is given them where there are.
  for (int trial = 0; trial < 60; ++trial) {
    std::string bytes = whole;
    for (std::uint32_t c = 0; c <= random.below(3, trial, 0); ++c) {
      bytes[random.below(static_cast<std::uint32_t>(bytes.size()), trial, 2 * c + 1)] =
          static_cast<char>(random.below(256, trial, 2 * c + 2));
    }
    test::writeBytes(folder / "damaged.vdb", bytes);
    refused += !inputError([&] {
                  const DistanceField field = readVdb(folder / "damaged.vdb");
                  for (const float v : field.values.values()) ASSERT_TRUE(std::isfinite(v));
                }).empty();
  }
  EXPECT_GT(refused, 10);
}

/// OpenVDB takes as much memory as a damaged size says before it reads.
TEST(VdbFile, RefusesSizesOfMetadataBeyondTheFile) {
  const TemporaryFolder folder;
  const auto grid = [](const char* name) {
    const auto made = openvdb::FloatGrid::create(1.0f);
    made->setName(name);
    made->tree().setValue({1, 2, 3}, -1);
    return made;
  };
  openvdb::io::File((folder / "whole.vdb").string())
      .write(openvdb::GridPtrVec{grid("first"), grid("second")});
  std::string whole = readFile(folder / "whole.vdb");
  constexpr std::size_t kSaysWhereGridsEnd = 20;
  int tried = 0;
  for (const char says : {'\1', '\0'}) {
    whole[kSaysWhereGridsEnd] = says;
    for (const std::string_view type : {"string", "int64", "vec3i"}) {
      for (std::size_t at = whole.find(type); at != whole.npos; at = whole.find(type, at + 1)) {
        std::string bytes = whole;
        bytes.replace(at + type.size(), 4, "\xf0\xff\xff\xff");
        test::writeBytes(folder / "damaged.vdb", bytes);
        EXPECT_THAT(inputError([&] { readVdb(folder / "damaged.vdb"); }),
                    HasSubstr("its metadata goes beyond it"));
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 16);
  std::string old = whole;
  old[8] = 0;  // the file's version, which lays out what follows
  test::writeBytes(folder / "old.vdb", old);
  EXPECT_THAT(inputError([&] { readVdb(folder / "old.vdb"); }),
              HasSubstr("its metadata goes beyond it"));
}

TEST(VdbFile, RefusesWhatIsNoVdbFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(inputError([&] { readVdb(folder / "missing.vdb"); }), HasSubstr("no such file"));
  writeFile(folder / "empty.vdb", "");
  EXPECT_THAT(inputError([&] { readVdb(folder / "empty.vdb"); }), HasSubstr("empty"));
  writeFile(folder / "text.vdb",
            "this is no volume, whatever its name says; it is a text, and a long one at that");
  EXPECT_THAT(inputError([&] { readVdb(folder / "text.vdb"); }), HasSubstr("text.vdb"));
  EXPECT_THAT(inputError([&] { writeVdb(folder / "no/such/folder.vdb", torusField(0.18)); }),
              HasSubstr("cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "no"));
}

TEST(VdbFile, OriginsComeBackWhole) {
  const TemporaryFolder folder;
  const DistanceField field = torusField(0.18, {9, 17, 5});
  Origins origins(field.size());
  const Random random(3);
  for (std::size_t s = 0; s < origins.count(); ++s)
    origins.values()[s] = Origin(
        {static_cast<int>(random.below(32768, s, 0)), static_cast<int>(random.below(32768, s, 1)),
         static_cast<int>(random.below(32768, s, 2))},
        static_cast<int>(random.below(256, s, 3)), static_cast<int>(random.below(4, s, 4)));
  writeOriginsVdb(folder / "origins.vdb", origins, field);
  EXPECT_EQ(readOriginsVdb(folder / "origins.vdb"), origins);
  // Constant origins collapse to tiles; the box is still all there.
  origins = Origins({40, 40, 40}, Origin({1, 2, 3}, 4, 1));
  writeOriginsVdb(folder / "origins.vdb", origins, field);
  EXPECT_EQ(readOriginsVdb(folder / "origins.vdb"), origins);
}

TEST(VdbFile, RefusesOriginsThatAreNone) {
  const TemporaryFolder folder;
  writeVdb(folder / "field.vdb", torusField(0.18));
  EXPECT_THAT(inputError([&] { readOriginsVdb(folder / "field.vdb"); }), HasSubstr("origin"));
  const auto cells = openvdb::Vec3IGrid::create(openvdb::Vec3i(0));
  const auto sources = openvdb::Int32Grid::create(0);
  cells->setName("origin");
  sources->setName("source");
  const auto write = [&] {
    openvdb::io::File((folder / "bad.vdb").string()).write(openvdb::GridPtrVec{cells, sources});
  };
  cells->tree().setValue({0, 0, 0}, openvdb::Vec3i(40000, 0, 0));
  sources->tree().setValue({0, 0, 0}, 1);
  write();
  EXPECT_THAT(inputError([&] { readOriginsVdb(folder / "bad.vdb"); }), HasSubstr("out of range"));
  cells->tree().setValue({0, 0, 0}, openvdb::Vec3i(4, 0, 0));
  sources->tree().setValue({5, 0, 0}, 1);
  write();
  EXPECT_THAT(inputError([&] { readOriginsVdb(folder / "bad.vdb"); }), HasSubstr("differ"));
}

TEST(VdbFile, StandsInFilesWhoseYAxisIsUp) {
  const TemporaryFolder folder;
  const DistanceField field = torusField(0.18, {20, 16, 9});
  const auto whereIn = [&](const char* name, const Vec3d& ijk) {
    openvdb::io::File file((folder / name).string());
    file.open();
    const openvdb::Vec3d p =
        file.readGrid("surface")->transform().indexToWorld(openvdb::Vec3d(ijk.x, ijk.y, ijk.z));
    return Vec3d{p[0], p[1], p[2]};
  };
  writeVdb(folder / "y.vdb", field, {.yUp = true});
  const Turn turn(0.4, {1, 2, 3});
  writeVdb(folder / "turned.vdb", field, {.turn = turn, .yUp = true});
  for (const Vec3d& ijk : {Vec3d{0, 0, 0}, Vec3d{7, 3, 5}}) {
    const Vec3d straight = field.position(ijk), turned = turn(straight);
    EXPECT_LT(length(whereIn("y.vdb", ijk) - Vec3d{straight.x, straight.z, -straight.y}), 1e-9);
    EXPECT_LT(length(whereIn("turned.vdb", ijk) - Vec3d{turned.x, turned.z, -turned.y}), 1e-9);
  }
  // The file says it, whether or not it is asked for.
  for (const bool said : {false, true}) {
    const DistanceField read = readVdb(folder / "y.vdb", {.yUp = said});
    EXPECT_EQ(read.values, field.values);
    EXPECT_LT(length(read.origin - field.origin), 1e-9);
    Turn found;
    const DistanceField back = readVdb(folder / "turned.vdb", {.turn = &found, .yUp = said});
    EXPECT_EQ(back.values, field.values);
    EXPECT_LT(length(found(back.position({7, 3, 5})) - turn(field.position({7, 3, 5}))), 1e-6);
  }
}

TEST(VdbFile, OfAProgramWhoseYAxisIsUpIsStoodUp) {
  const TemporaryFolder folder;
  // Samples whose index j is height, as such programs make them: no turned transform, and nothing
  // says it.
  const DistanceField lying = torusField(0.18, {20, 9, 16});
  writeVdb(folder / "theirs.vdb", lying);
  const DistanceField stood = readVdb(folder / "theirs.vdb", {.yUp = true});
  ASSERT_EQ(stood.size(), (Vec3i{20, 16, 9}));
  forEachCell(lying.size(), [&](const Vec3i& p) {
    const Vec3d at = lying.position(cast<double>(p)), up{at.x, -at.z, at.y};
    EXPECT_NEAR(sampleTrilinear(stood, up), lying.values[p], 1e-5);
  });
  EXPECT_EQ(readVdb(folder / "theirs.vdb").values, lying.values);
}

TEST(VdbFile, KeepsHowAFieldLiesTurned) {
  const TemporaryFolder folder;
  const DistanceField field = torusField(0.18);
  const Turn turn(0.7, {448262, 5411932, 30});
  writeVdb(folder / "turned.vdb", field, {.turn = turn});
  Turn found;
  const DistanceField read = readVdb(folder / "turned.vdb", {.turn = &found});
  EXPECT_EQ(read.values, field.values);
  EXPECT_NEAR(read.voxelSize / field.voxelSize, 1, 1e-9);
  for (const Vec3d& ijk : {Vec3d{0, 0, 0}, Vec3d{7, 3, 5}, Vec3d{20, 1, 9}}) {
    // Coordinates of millions are exact to 1e-9.
    EXPECT_LT(length(found(read.position(ijk)) - turn(field.position(ijk))), 1e-7);
  }
  // Other programs see it there, too.
  openvdb::io::File file((folder / "turned.vdb").string());
  file.open();
  const auto grid = file.readGrid("surface");
  const openvdb::Vec3d corner = grid->transform().indexToWorld(openvdb::Vec3d(7, 3, 5));
  const Vec3d expected = turn(field.position({7, 3, 5}));
  EXPECT_LT((corner - openvdb::Vec3d(expected.x, expected.y, expected.z)).length(), 1e-7);
  // Who does not ask gets no field that lies elsewhere.
  EXPECT_THAT(inputError([&] { readVdb(folder / "turned.vdb"); }), HasSubstr("no axis-aligned"));
  writeVdb(folder / "straight.vdb", field);
  found = turn;
  readVdb(folder / "straight.vdb", {.turn = &found});
  EXPECT_TRUE(found.none());
}

TEST(VdbFile, OriginsKnowHowLargeTheResultWasAskedToBe) {
  const TemporaryFolder folder;
  const DistanceField field = torusField(0.18);
  const Origins origins(field.size(), Origin(Vec3i{1, 2, 3}));
  writeOriginsVdb(folder / "a.vdb", origins, field, {.scale = Vec3d{3, 1, 1.5}});
  EXPECT_EQ(readOriginsScale(folder / "a.vdb"), (Vec3d{3, 1, 1.5}));
  writeOriginsVdb(folder / "b.vdb", origins, field);
  EXPECT_FALSE(readOriginsScale(folder / "b.vdb"));
}

TEST(VdbFile, ReportsItsProgressAndStopsWhereItIsCancelled) {
  const TemporaryFolder folder;
  const DistanceField field = torusField(0.18);
  const std::filesystem::path path = folder / "field.vdb", origins = folder / "origins.vdb";
  expectReportsAndStops([&](const Progress& p) { writeVdb(path, field, {}, p); }, 4);
  expectReportsAndStops([&](const Progress& p) { readVdb(path, {}, nullptr, p); }, 4);
  const Origins from(field.size(), Origin(Vec3i{1, 2, 3}));
  expectReportsAndStops([&](const Progress& p) { writeOriginsVdb(origins, from, field, {}, p); },
                        4);
  expectReportsAndStops([&](const Progress& p) { readOriginsVdb(origins, p); }, 4);
}

TEST(VdbFile, ACancelledWriteLeavesWhatWasThere) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "field.vdb";
  writeVdb(path, torusField(0.18));
  const std::string before = readFile(path);
  for (std::size_t reports = 0; reports < 4; ++reports) {
    EXPECT_TRUE(stopsAfter(
        reports, [&](const Progress& p) { writeVdb(path, torusField(0.15), {}, p); }));
    EXPECT_EQ(readFile(path), before);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}), 1);
}

}  // namespace
}  // namespace exemplar
