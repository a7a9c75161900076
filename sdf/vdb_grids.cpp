// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "sdf/vdb_grids.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "sdf/openvdb_ready.h"
#include "sdf/vdb_metadata.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

// Where the unique id is in a .vdb file (its header: 8 bytes of magic number, three 4-byte
// versions, 1 byte for "has offsets") and how long it is.
constexpr std::size_t kIdBegin = 21, kIdLength = 36;

constexpr const char* kBoxMin = "exemplar_box_min";
constexpr const char* kBoxMax = "exemplar_box_max";

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

std::uint64_t hash(std::string_view bytes, std::uint64_t h) {
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return h;
}

// A stream over bytes that are already in memory, without a second copy of them. It gives all of
// what is asked for or nothing: OpenVDB takes the sizes of some blocks from the file and checks
// them only after reading, so that a damaged size would write past the end of a buffer.
class BytesBuffer : public std::streambuf {
 public:
  explicit BytesBuffer(std::string& bytes) {
    setg(bytes.data(), bytes.data(), bytes.data() + bytes.size());
  }

 protected:
  std::streamsize xsgetn(char* to, std::streamsize count) override {
    if (count < 0 || count > egptr() - gptr()) return 0;
    std::memcpy(to, gptr(), static_cast<std::size_t>(count));
    setg(eback(), gptr() + count, egptr());
    return count;
  }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const off_type base = from == std::ios_base::beg   ? 0
                          : from == std::ios_base::cur ? gptr() - eback()
                                                       : egptr() - eback();
    const off_type to = base + offset;
    if (to < 0 || to > egptr() - eback()) return pos_type(off_type(-1));
    setg(eback(), eback() + to, egptr());
    return pos_type(to);
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }
};

/// Writes what a file of the grids holds to memory: OpenVDB's own file does not say when a disk is
/// full.
class ArchiveInMemory : public openvdb::io::Archive {
 public:
  static std::string bytesOf(const openvdb::GridCPtrVec& grids) {
    std::ostringstream out;
    out.exceptions(std::ios::badbit | std::ios::failbit);
    ArchiveInMemory().write(out, grids, /*seekable=*/true);
    return std::move(out).str();
  }
};

/// Reads all grids of a file in memory, as `openvdb::io::Stream` does, looking at the sizes of each
/// grid's names and metadata before OpenVDB takes memory for them.
class GridsInMemory : public openvdb::io::Archive {
 public:
  static openvdb::GridPtrVec of(std::string& bytes) { return GridsInMemory().readAll(bytes); }

 private:
  openvdb::GridPtrVec readAll(std::string& bytes) {
    if (!hasSoundMetadata(bytes)) throw std::runtime_error(kBeyond);
    BytesBuffer buffer(bytes);
    std::istream in(&buffer);
    // OpenVDB does not look at the stream's state; with this, a read beyond the end throws.
    in.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    readHeader(in);
    auto state = openvdb::SharedPtr<openvdb::io::StreamMetadata>(new openvdb::io::StreamMetadata);
    openvdb::io::setStreamMetadataPtr(in, state, /*transfer=*/false);
    setFormatVersion(in);
    setLibraryVersion(in);
    setDataCompression(in);
    openvdb::MetaMap().readMeta(in);
    const std::int64_t count = readGridCount(in);
    if (!canHoldGrids(bytes, count)) throw std::runtime_error("it has too few bytes for its grids");

    openvdb::GridPtrVec grids;
    std::vector<openvdb::io::GridDescriptor> descriptors;
    NamedGridMap byName;
    for (std::int64_t i = 0; i < count; ++i) {
      if (!hasSoundGridMetadata(bytes, static_cast<std::size_t>(in.tellg())))
        throw std::runtime_error(kBeyond);
      openvdb::io::GridDescriptor& descriptor = descriptors.emplace_back();
      const openvdb::GridBase::Ptr grid = descriptor.read(in);
      readGrid(grid, descriptor, in);
      grids.push_back(grid);
      byName[descriptor.uniqueName()] = grid;
    }
    for (const openvdb::io::GridDescriptor& descriptor : descriptors)
      connectInstance(descriptor, byName);
    return grids;
  }

  static constexpr const char* kBeyond = "its metadata goes beyond it";
};

}  // namespace

void openvdbReady() { openvdb::initialize(); }

void writeVdbGrids(const fs::path& path, const openvdb::GridCPtrVec& grids,
                   const Progress& progress) {
  progress.report("writing the volume", 0);
  std::string bytes;
  try {
    bytes = ArchiveInMemory::bytesOf(grids);
  } catch (const std::exception& error) {
    fail(path, std::string("cannot be written: ") + error.what());
  }
  progress.report("writing the volume", 0.5);
  if (bytes.size() < kIdBegin + kIdLength)
    fail(path, "cannot be written: there may be too little memory");
  bytes.replace(kIdBegin, kIdLength, kIdLength, '0');
  const std::uint64_t a = hash(bytes, 0xcbf29ce484222325u), b = hash(bytes, a);
  char id[kIdLength + 1];
  std::snprintf(id, sizeof id, "%08x-%04x-4%03x-8%03x-%012llx", static_cast<unsigned>(a >> 32),
                static_cast<unsigned>(a >> 16 & 0xffff), static_cast<unsigned>(a & 0xfff),
                static_cast<unsigned>(b >> 48 & 0xfff),
                static_cast<unsigned long long>(b & 0xffffffffffff));
  bytes.replace(kIdBegin, kIdLength, id, kIdLength);
  progress.report("writing the volume", 0.8);
  writeFile(path, bytes, progress.part(0.8, 1));
}

void withVdbGrids(const fs::path& path,
                  const std::function<void(const openvdb::GridPtrVec&)>& use) {
  openvdbReady();
  std::string bytes = readFile(path);
  try {
    use(GridsInMemory::of(bytes));
  } catch (const InputError&) {
    throw;
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    fail(path, std::string("not a whole OpenVDB file (") + error.what() + ")");
  }
}

openvdb::math::CoordBBox statedBox(const openvdb::GridBase& grid,
                                   const std::filesystem::path& path) {
  using openvdb::Coord, openvdb::CoordBBox;
  CoordBBox box = grid.evalActiveVoxelBoundingBox();
  const auto low = grid.getMetadata<openvdb::Vec3IMetadata>(kBoxMin);
  const auto high = grid.getMetadata<openvdb::Vec3IMetadata>(kBoxMax);
  if (low && high) {
    const CoordBBox stated{Coord(low->value()), Coord(high->value())};
    if (!stated.empty() && (box.empty() || stated.isInside(box))) box = stated;
  }
  if (box.empty()) fail(path, "the grid \"" + grid.getName() + "\" has no active voxels");
  return box;
}

void stateBox(openvdb::GridBase& grid, const Vec3i& size) {
  grid.insertMeta(kBoxMin, openvdb::Vec3IMetadata({0, 0, 0}));
  grid.insertMeta(kBoxMax, openvdb::Vec3IMetadata({size.x - 1, size.y - 1, size.z - 1}));
}

}  // namespace exemplar
