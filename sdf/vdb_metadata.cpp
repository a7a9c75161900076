// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/vdb_metadata.h"

#include <cstdint>
#include <cstring>

namespace exemplar {
namespace {

// A .vdb file begins with 8 bytes of magic number, the file's version, the library's two, one byte
// for "says where grids end" and an id; before version 222 a byte for "compressed" stands between
// these two, which each grid says of itself since.
constexpr std::size_t kVersion = 8, kId = 21, kIdLength = 36;
constexpr std::uint32_t kFirstVersion = 220, kOwnCompression = 222;
// A grid has at least the sizes of three names and three positions.
constexpr std::size_t kLeastGrid = 3 * sizeof(std::uint32_t) + 3 * sizeof(std::int64_t);

/// Goes through a file; every step says whether it stayed within.
class Walk {
 public:
  explicit Walk(std::string_view bytes) : bytes_(bytes) {}

  bool goTo(std::uint64_t position) {
    at_ = position;
    return at_ <= bytes_.size();
  }
  bool skip(std::uint64_t count) { return count <= bytes_.size() - at_ && goTo(at_ + count); }
  template <class Number>
  bool read(Number& number) {
    const std::uint64_t from = at_;
    if (!skip(sizeof number)) return false;
    std::memcpy(&number, bytes_.data() + from, sizeof number);
    return true;
  }
  /// A size and so many bytes.
  bool skipSized() {
    std::uint32_t size = 0;
    return read(size) && skip(size);
  }
  /// A count, and so many names, each with its type and value.
  bool skipMetadata() {
    std::uint32_t count = 0;
    if (!read(count)) return false;
    for (; count > 0; --count) {
      if (!skipSized() || !skipSized() || !skipSized()) return false;
    }
    return true;
  }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

bool saysCompressionOfGrids(std::string_view bytes) {
  std::uint32_t version = 0;
  Walk walk(bytes);
  return walk.goTo(kVersion) && walk.read(version) && version >= kOwnCompression;
}

}  // namespace

bool hasSoundMetadata(std::string_view bytes) {
  Walk walk(bytes);
  std::uint32_t version = 0, grids = 0;
  return walk.goTo(kVersion) && walk.read(version) && version >= kFirstVersion &&
         walk.goTo(kId + (saysCompressionOfGrids(bytes) ? 0 : 1) + kIdLength) &&
         walk.skipMetadata() && walk.read(grids);
}

bool hasSoundGridMetadata(std::string_view bytes, std::size_t at) {
  Walk walk(bytes);
  // Name, type, name of the grid whose values it shares; where it, its values and its end are.
  std::uint32_t compression = 0;
  return walk.goTo(at) && walk.skipSized() && walk.skipSized() && walk.skipSized() &&
         walk.skip(3 * sizeof(std::int64_t)) &&
         (!saysCompressionOfGrids(bytes) || walk.read(compression)) && walk.skipMetadata();
}

bool canHoldGrids(std::string_view bytes, std::int64_t count) {
  return count >= 0 && static_cast<std::uint64_t>(count) <= bytes.size() / kLeastGrid;
}

}  // namespace exemplar
