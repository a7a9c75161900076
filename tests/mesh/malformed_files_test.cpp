// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mesh_formats.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "core/error.h"
#include "core/random.h"
#include "mesh/across_formats.h"
#include "mesh/image.h"
#include "mesh/mtl.h"
#include "mesh_samples.h"

namespace exemplar {
namespace {

/// Small files of every format, each with most of what its parser knows.
struct Sample {
  const char* name;
  std::string bytes;
  std::function<void(std::string_view)> read;
};

Sample meshSample(const char* name, const std::string& ending, std::string bytes) {
  return {name, std::move(bytes), [ending](std::string_view b) {
            // What was read can be written, as it came and as the other kind's.
            const TriangleMesh mesh = parse(ending, b);
            for (const char* to : {".glb", ".obj"}) {
              format(to, mesh);
              lostIn(to, mesh);
            }
          }};
}

std::vector<Sample> samples() {
  TriangleMesh full = fullMesh();
  full.textures[0].name = "t.png";
  const std::string obj =
      "mtllib m.mtl\nv 0 0 0 0.5 0.5 1\nv 1e0 0 0\nv 1.25 1 -0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n"
      "usemtl a\nf 1/1 2/2/1 3//1\nf 1 2 3 \\\n 4\nusemtl b\nf -4 -3 -1\n";
  const std::string asciiPly =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n"
      "0.5 0.1 0 9 9 9\n4 0 1 2 3\n3 0 1 2\n";
  const std::string asciiStl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 "
      "0\nendloop\n"
      "endfacet\nendsolid a\n";
  const std::string off =
      "STCOFF\n4 2 0\n0 0 0 1 0 0 1 0 0\n1 0 0 0 1 0 1 1 0\n1 1 0 0 0 1 1 1 1\n0.2 0.1 0 0 0 0 1 0 "
      "1\n"
      "4 0 1 2 3\n3 0 1 2 255 0 0\n";
  const std::string mtl =
      "newmtl a\nKd 0.5 0.25 0.125\nKe 1\nd 0.5\nTr 0.5\nNs 10\nPr 0.5\nPm 1\nmap_Kd -s 1 2 -mm 0 "
      "1 t.png\n";
  return {
      meshSample("obj", ".obj", obj),
      meshSample("written obj", ".obj", format(".obj", full)),
      meshSample("ascii ply", ".ply", asciiPly),
      meshSample("binary ply", ".ply", format(".ply", full)),
      meshSample("ascii stl", ".stl", asciiStl),
      meshSample("binary stl", ".stl", format(".stl", full)),
      meshSample("off", ".off", off),
      meshSample("glb", ".glb", format(".glb", full)),
      meshSample("rich glb", ".glb", richGlb()),
      meshSample("glb of materials", ".glb", squareGlb(kRichMaterial, "\"name\":\"plain\"")),
      {"mtl", mtl, [](std::string_view b) { parseMtl(b, "f.mtl"); }},
      {"png", tinyPng(), [](std::string_view b) { decodeImage(b, "f.png"); }},
      {"jpeg", tinyJpeg(), [](std::string_view b) { decodeImage(b, "f.jpg"); }},
  };
}

/// Reads bytes that may be anything: false where they are refused, as they should be, in one line
/// that begins with the file's name. Everything else is a failure of the test.
bool isRead(const Sample& sample, std::string_view bytes) {
  // A copy without room behind it: a sanitizer then sees each step beyond the end.
  const std::vector<char> exact(bytes.begin(), bytes.end());
  try {
    sample.read({exact.data(), exact.size()});
    return true;
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << sample.name << ": " << message;
    EXPECT_TRUE(message.starts_with("f.")) << sample.name << ": " << message;
    EXPECT_LT(message.size(), 300u) << sample.name << ": " << message;
  } catch (const std::exception& e) {
    ADD_FAILURE() << sample.name << " threw something else: " << e.what();
  }
  return false;
}

TEST(MalformedFiles, TheSamplesThemselvesAreRead) {
  for (const Sample& sample : samples()) EXPECT_TRUE(isRead(sample, sample.bytes)) << sample.name;
}

TEST(MalformedFiles, EveryPrefixIsReadOrRefused) {
  for (const Sample& sample : samples()) {
    int refused = 0;
    for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
      refused += !isRead(sample, std::string_view(sample.bytes).substr(0, length));
    }
    // A material library costs at most its bad lines.
    if (std::string_view(sample.name) == "mtl") {
      EXPECT_EQ(refused, 0);
    } else {
      EXPECT_GT(refused, 0) << sample.name;
    }
  }
}

TEST(MalformedFiles, APrefixOfABinaryFileIsRefused) {
  // Binary files say how long they are, so that no part of them passes for the whole.
  for (const Sample& sample : samples()) {
    const std::string name = sample.name;
    if (name != "binary stl" && name != "binary ply" && name.find("glb") == std::string::npos &&
        name != "png") {
      continue;
    }
    for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
      EXPECT_FALSE(isRead(sample, std::string_view(sample.bytes).substr(0, length)))
          << name << " at " << length << " of " << sample.bytes.size();
    }
  }
}

/// `bytes` with one to four changes: bits and bytes, digits, numbers that are known to hurt, pieces
/// cut out and doubled.
std::string mutated(std::string bytes, const Random& random, std::uint64_t trial) {
  std::uint32_t draw = 0;
  const auto below = [&](std::size_t n) {
    return random.below(static_cast<std::uint32_t>(n), trial, draw++);
  };
  const std::uint32_t changes = 1 + below(4);
  for (std::uint32_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size());
    const std::size_t digit = bytes.find_first_of("0123456789", at);
    switch (below(7)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 2:
      case 3:
        if (digit != std::string::npos) bytes[digit] = static_cast<char>('0' + below(10));
        break;
      case 4: {
        const char* numbers[] = {"-1",  "4294967295", "4294967296",           "1e308",
                                 "nan", "-0",         "99999999999999999999", "9007199254740993",
                                 "1.5", "16777216"};
        if (digit != std::string::npos) bytes.replace(digit, 1, numbers[below(10)]);
        break;
      }
      case 5:
        bytes.erase(at, 1 + below(16));
        break;
      case 6:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(32)));
        break;
    }
  }
  return bytes;
}

TEST(MalformedFiles, ThousandsOfDamagedFilesAreReadOrRefused) {
  constexpr std::uint64_t kTrials = 4000;
  std::uint32_t stream = 0;
  for (const Sample& sample : samples()) {
    const Random random(1, stream++);
    std::uint64_t read = 0;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
      read += isRead(sample, mutated(sample.bytes, random, trial));
    }
    // Both happen, or the changes would be too mild or too wild to test anything.
    EXPECT_GT(read, kTrials / 200) << sample.name;
    if (std::string_view(sample.name) == "mtl") {
      EXPECT_EQ(read, kTrials) << "bad lines are left out";
    } else {
      EXPECT_LT(read, kTrials) << sample.name;
    }
  }
}

}  // namespace
}  // namespace exemplar
