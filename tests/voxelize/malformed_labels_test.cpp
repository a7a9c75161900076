// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Files that may hold anything: each is read or refused in one line, never more.

#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"
#include "core/random.h"
#include "tests/voxelize/label_samples.h"
#include "voxelize/label_file.h"

namespace exemplar {
namespace {

struct Sample {
  const char* name;
  std::string bytes;
  std::function<LabelGrid(std::string_view)> read;
  bool binary;
};

LabelGrid readText(std::string_view bytes) { return parseLabelText(bytes, "f.txt"); }
LabelGrid readVox(std::string_view bytes) { return parseVox(bytes, "f.vox"); }

std::vector<Sample> samples() {
  LabelGrid grid = randomGrid({3, 4, 2}, 6, 1);
  grid.name = "scene";
  grid.labels[2].objects = {"$a"};
  const std::string scene = voxFile(
      voxModel({3, 1, 1}, std::string("\0\0\0\1\1\0\0\2\2\0\0\2", 12)) +
      voxTransform(0, 1, "", "") + voxGroup(1, {2, 4}) + voxTransform(2, 3, "", "0 0 0") +
      voxShape(3, 0) + voxTransform(4, 5, "17", "5 0 2") + voxShape(5, 0) +
      voxChunk("LAYR", little(0) + little(1) + voxString("_hidden") + voxString("0") + little(-1)));
  return {{"text", formatLabelText(grid), readText, false},
          {"vox", formatVox(grid, "f"), readVox, true},
          {"vox with a scene", scene, readVox, true}};
}

/// False where the bytes are refused, as they should be: in one line that begins with the file's
/// name. Everything else is a failure of the test.
bool isRead(const Sample& sample, std::string_view bytes) {
  // A copy without room behind it: a sanitizer then sees each step beyond the end.
  const std::vector<char> exact(bytes.begin(), bytes.end());
  try {
    const LabelGrid grid = sample.read({exact.data(), exact.size()});
    validate(grid, "f.read");
    return true;
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << sample.name << ": " << message;
    EXPECT_TRUE(message.starts_with("f.")) << sample.name << ": " << message;
    EXPECT_FALSE(message.starts_with("f.read")) << sample.name << ": " << message;
    EXPECT_LT(message.size(), 300u) << sample.name << ": " << message;
  } catch (const std::exception& e) {
    ADD_FAILURE() << sample.name << " threw something else: " << e.what();
  }
  return false;
}

TEST(MalformedLabels, TheSamplesThemselvesAreRead) {
  for (const Sample& sample : samples()) EXPECT_TRUE(isRead(sample, sample.bytes)) << sample.name;
}

TEST(MalformedLabels, EveryPrefixIsReadOrRefused) {
  for (const Sample& sample : samples()) {
    int refused = 0;
    for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
      const bool read = isRead(sample, std::string_view(sample.bytes).substr(0, length));
      refused += !read;
      // Binary files say how long they are.
      EXPECT_FALSE(sample.binary && read) << sample.name << " at " << length;
    }
    EXPECT_GT(refused, 0) << sample.name;
  }
}

/// `bytes` with one to four changes: bits and bytes, digits, numbers that are known to hurt, pieces
/// cut out and doubled.
std::string mutated(std::string bytes, const Random& random, std::uint64_t trial) {
  std::uint32_t draw = 0;
  const auto below = [&](std::size_t n) {
    return random.below(static_cast<std::uint32_t>(n), trial, draw++);
  };
  for (std::uint32_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
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
        if (digit != std::string::npos) bytes[digit] = static_cast<char>('0' + below(10));
        break;
      case 3: {
        const char* numbers[] = {"-1", "4294967295", "65536", "1e9",
                                 "-0", "32767",      "1.5",   "99999999999999999999"};
        if (digit != std::string::npos) bytes.replace(digit, 1, numbers[below(8)]);
        break;
      }
      case 4: {
        const std::int64_t numbers[] = {-1, 0, 1, 255, 256, 0x7fffffff, 0x10000000, 1 << 20};
        if (at + 4 <= bytes.size()) bytes.replace(at, 4, little(numbers[below(8)]));
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

TEST(MalformedLabels, ThousandsOfDamagedFilesAreReadOrRefused) {
  constexpr std::uint64_t kTrials = 20000;
  std::uint32_t stream = 0;
  for (const Sample& sample : samples()) {
    const Random random(1, stream++);
    std::uint64_t read = 0;
    for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
      read += isRead(sample, mutated(sample.bytes, random, trial));
    }
    // Both happen, or the changes would be too mild or too wild to test anything.
    EXPECT_GT(read, kTrials / 200) << sample.name;
    EXPECT_LT(read, kTrials) << sample.name;
  }
}

}  // namespace
}  // namespace exemplar
