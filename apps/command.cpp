// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/command.h"

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "apps/terminal.h"
#include "apps/words.h"
#include "core/error.h"
#include "core/file.h"

namespace exemplar {

void addCommonOptions(CLI::App& command, CommonOptions& options) {
  command
      .add_option("--threads", options.threads, "cores to use; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->default_str("all");
  command.add_flag("-q,--quiet", options.quiet, "no progress, no summary");
}

void addUpOption(CLI::App& command, MeshFileOptions& options) {
  command
      .add_option("--up", options.up,
                  "which axis is up in mesh files: y, z, or auto (y for .obj and .glb, else z)")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, UpAxis>{
              {"auto", UpAxis::Default}, {"y", UpAxis::Y}, {"z", UpAxis::Z}},
          CLI::ignore_case))
      ->option_text("auto|y|z");
}

void addHeightMapOptions(CLI::App& command, std::optional<double>& cellSize,
                         std::optional<double>& heightScale) {
  command
      .add_option("--cell-size", cellSize,
                  "distance of a height map's points, where the file does not say")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--height-scale", heightScale, "height of one step of a height map's integers")
      ->check(CLI::PositiveNumber);
}

void addExampleOptions(CLI::App& command, ExampleOptions& options) {
  command
      .add_option("--resolution", options.resolution,
                  "samples along the example's longest side (64; a volume keeps its own)")
      ->check(CLI::Range(4, 4096));
  command
      .add_option("--padding", options.padding,
                  "voxels of air around a mesh (4; 0 where the example goes on past its box)")
      ->check(CLI::Range(0, 1024));
  command.add_option("--scene-seed", options.sceneSeed,
                     "another sample of a scene's own random process");
  addHeightMapOptions(command, options.cellSize, options.heightScale);
  addUpOption(command, options.mesh);
}

void addPictureOptions(CLI::App& command, PictureOptions& options) {
  command
      .add_option("--view", options.view,
                  "iso, front, back, left, right, top, bottom, or AZIMUTH,ELEVATION in degrees")
      ->capture_default_str();
  command.add_option("--size", options.size, "the picture's WIDTHxHEIGHT in pixels")
      ->capture_default_str();
  command.add_option("--samples", options.samples, "rays a pixel")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
}

RenderOptions renderOptions(const PictureOptions& options) {
  RenderOptions render;
  render.view = viewFromName(options.view);
  render.samples = options.samples;
  char end = 0;
  if (std::sscanf(options.size.c_str(), "%dx%d%c", &render.width, &render.height, &end) != 2 ||
      render.width < 1 || render.height < 1 || render.width > 16384 || render.height > 16384) {
    throw InputError("--size " + options.size + ": expected WIDTHxHEIGHT, each 1 to 16384");
  }
  return render;
}

Vec3d parseTriple(const std::string& text, const std::string& option) {
  const std::string what = option + " " + text;
  const std::size_t count = split(text, ',').size();
  if (count != 1 && count != 3)
    throw InputError(what + ": expected one number or three, as in 2,2,1");
  const std::vector<double> numbers = parseNumbers(text, count, what);
  for (const double number : numbers)
    if (!(number > 0)) throw InputError(what + ": expected numbers above 0");
  return count == 1 ? Vec3d{numbers[0], numbers[0], numbers[0]}
                    : Vec3d{numbers[0], numbers[1], numbers[2]};
}

Vec3i scaledSize(const Vec3i& size, const Vec3d& scale, const std::string& unit) {
  Vec3i scaled;
  for (int axis = 0; axis < 3; ++axis) {
    const double n = std::round(size[axis] * scale[axis]);
    if (!(n >= 1 && n <= 32767)) {
      throw InputError("--scale: the result would be " + std::to_string(n) + " " + unit +
                       " long; expected 1 to 32767");
    }
    scaled[axis] = static_cast<int>(n);
  }
  return scaled;
}

void requireOutput(const std::filesystem::path& path, const std::string& endings) {
  const std::string ending = lowerExtension(path);
  if (ending.empty() || (" " + endings + " ").find(" " + ending + " ") == std::string::npos) {
    throw InputError(path.string() + ": cannot write this kind of file; use one of " + endings);
  }
  const OutputFile probe(path);
}

std::string readableSize(const Vec3i& size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z) +
         " samples";
}

std::string readableHealth(const MeshHealth& health) {
  std::string text = withThousands(health.triangles) + " triangles, ";
  text += health.closed() ? "closed" : "open (" + withThousands(health.boundaryEdges) + " edges)";
  text += health.manifold()
              ? ", manifold"
              : ", not manifold (" +
                    withThousands(health.nonManifoldEdges + health.nonManifoldVertices) +
                    " places)";
  text += health.oriented() ? ", consistently oriented"
                            : ", not consistently oriented (" +
                                  withThousands(health.misorientedEdges) + " edges)";
  return text;
}

struct ThreadLimit::Control {
  explicit Control(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads) : control_(threads > 0 ? new Control(threads) : nullptr) {}
ThreadLimit::~ThreadLimit() { delete control_; }

}  // namespace exemplar
