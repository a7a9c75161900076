// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "engine/example.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "core/file.h"
#include "mesh/mesh_file.h"
#include "tests/engine/examples.h"
#include "tests/temporary_files.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

fs::path scene(const std::string& name) {
  return fs::path(EXEMPLAR_SOURCE_DIR) / "scenes" / (name + ".toml");
}

TEST(Source, IsAScenesNameWhereAFolderIsCalledSo) {
  const test::TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder / "");
  fs::create_directory("castle");
  setenv("EXEMPLAR_SCENES", EXEMPLAR_SOURCE_DIR "/scenes", 1);
  const fs::path scene = Source("castle").path();
  test::writeBytes("balls", "no scene");
  const fs::path file = Source("balls").path();
  fs::current_path(before);
  EXPECT_EQ(scene, "castle.toml");
  EXPECT_EQ(file, "balls");
}

TEST(ReadExample, AMeshIsTheSameFromAFileFromBytesAndFromMemory) {
  const fs::path path = fs::path(testing::TempDir()) / "exemplar_boxes.ply";
  writeMesh(path, boxes());
  const ReadOptions options{.resolution = 24};
  const Example file = readExample(path, options);
  const Example bytes = readExample(Source::ofBytes(readFile(path), "boxes.ply"), options);
  const Example memory = readExample(Source::of(boxes()), options);
  fs::remove(path);
  EXPECT_EQ(file.kind, SourceKind::Mesh);
  EXPECT_EQ(file.form(), Form::Field);
  EXPECT_EQ(bytes.field().values, file.field().values);
  EXPECT_EQ(memory.field().values, file.field().values);
  EXPECT_TRUE(memory.mesh);
}

TEST(ReadExample, FieldsLabelsAndHeightsInMemoryAreTakenAsTheyAre) {
  const Example field = readExample(Source::of(bumps()));
  EXPECT_EQ(field.kind, SourceKind::Volume);
  EXPECT_EQ(field.field().values, bumps().values);
  const Example labels = readExample(Source::of(rings()));
  EXPECT_EQ(labels.form(), Form::Labels);
  EXPECT_EQ(labels.labels().cells, rings().cells);
  HeightMap map{Grid<float>(16, 12, 3.0f), 2, true};
  map.heights[17] = 9;
  const Example heights = readExample(Source::of(map), {.resolution = 16});
  EXPECT_EQ(heights.kind, SourceKind::HeightMap);
  EXPECT_EQ(heights.field().size().x, 16);
}

TEST(ReadExample, TheFormFollowsFromTheKindAndCanBeChosen) {
  EXPECT_EQ(readExample(scene("chainmail"), {.resolution = 16}).form(), Form::Field);
  EXPECT_EQ(readExample(scene("castle")).form(), Form::Labels);
  const Example blocks =
      readExample(Source::of(bumps()), {.form = Form::Labels, .blocks = {.block = {8, 8, 12}}});
  ASSERT_TRUE(std::holds_alternative<LabeledField>(blocks.content));
  EXPECT_EQ(blocks.labels().size(), (Vec3i{3, 3, 1}));
  const Example pieces =
      readExample(Source::of(boxes()), {.form = Form::Labels, .cell = Vec3d{1, 1, 1}});
  EXPECT_TRUE(std::holds_alternative<ModelPieces>(pieces.content));
  EXPECT_THAT([] { readExample(Source::of(rings()), {.form = Form::Field}); },
              ThrowsMessage<InputError>(HasSubstr("a grid of labels, where distances are needed")));
}

TEST(ReadExample, WhatIsNoExampleIsNamed) {
  EXPECT_THAT([] { readExample("thing.xyz"); },
              ThrowsMessage<InputError>(HasSubstr("thing.xyz: not a kind of example; use .obj")));
  EXPECT_THAT([] { readExample("none.obj"); },
              ThrowsMessage<InputError>(HasSubstr("none.obj: no such file")));
}

TEST(ReadExample, StopsWhenCancelled) {
  std::atomic<bool> cancel = true;
  EXPECT_THROW(readExample(Source::of(boxes()), {}, Progress({}, &cancel)), Cancelled);
}

TEST(ReadExamples, FieldsShareVoxelsAndLabelsShareNumbers) {
  const Source sources[] = {Source::of(boxes()), Source::of(makeBox({{0, 0, 0}, {1, 2, 1}}))};
  const std::vector<Example> meshes = readExamples(sources, {.resolution = 24});
  EXPECT_EQ(meshes[1].field().voxelSize, meshes[0].field().voxelSize);

  // The same looks, numbered otherwise.
  LabelGrid other = rings();
  std::swap(other.labels[1], other.labels[3]);
  for (Label& label : other.cells.values()) label = label == 1 ? 3 : label == 3 ? 1 : label;
  const Source grids[] = {Source::of(rings()), Source::of(other)};
  const std::vector<Example> labels = readExamples(grids);
  EXPECT_EQ(labels[1].labels().cells, labels[0].labels().cells);
  EXPECT_EQ(labels[1].labels().labelCount(), 9);

  const Source mixed[] = {Source::of(rings()), Source::of(bumps())};
  EXPECT_THAT([&] { readExamples(mixed); },
              ThrowsMessage<InputError>(HasSubstr("are of different kinds")));
}

TEST(Refined, SamplesMeshesMoreFinelyInTheirBoxes) {
  const Example coarse = readExample(Source::of(boxes()), {.resolution = 16});
  const std::vector<Example> fine = refined({&coarse, 1}, 3);
  EXPECT_EQ(fine[0].field().size(), coarse.field().size() * 3);
  const Example volume = readExample(Source::of(bumps()));
  EXPECT_THAT(
      [&] {
        refined({&volume, 1}, 2);
      },
      ThrowsMessage<InputError>(HasSubstr("no finer samples")));
}

}  // namespace
}  // namespace exemplar
