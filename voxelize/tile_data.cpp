// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "voxelize/tile_data.h"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/base64.h"
#include "core/error.h"

namespace exemplar {
namespace {

using Encoding = TiledMap::Encoding;

std::vector<std::uint32_t> decodeCsv(std::string_view text, std::size_t count,
                                     const std::string& what) {
  std::vector<std::uint32_t> tiles;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto skip = [&] {
    while (at != end && (*at == ',' || *at == ' ' || *at == '\t' || *at == '\n' || *at == '\r'))
      ++at;
  };
  for (skip(); at != end; skip()) {
    std::uint32_t tile = 0;
    const auto [next, error] = std::from_chars(at, end, tile);
    if (error != std::errc{})
      throw InputError(what + ": '" + std::string(at, std::min(end, at + 12)) +
                       "' is not the number of a tile");
    tiles.push_back(tile);
    if (tiles.size() > count) break;
    at = next;
  }
  return tiles;
}

/// Inflates zlib or gzip to at most one byte more than wanted.
std::string inflated(const std::string& bytes, std::size_t wanted, const std::string& what) {
  constexpr std::size_t kMostInflated = 1032;  // bytes of a byte
  std::string out(std::min(wanted, kMostInflated * bytes.size() + 64) + 1, '\0');
  z_stream stream{};
  constexpr int kEither = 15 + 32;  // the widest window, zlib or gzip
  if (inflateInit2(&stream, kEither) != Z_OK) throw InputError(what + ": cannot be decompressed");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int status = inflate(&stream, Z_FINISH);
  const std::size_t length = out.size() - stream.avail_out;
  inflateEnd(&stream);
  if (status != Z_STREAM_END && length < out.size())
    throw InputError(what + ": its compressed tiles are damaged");
  out.resize(length);
  return out;
}

std::string deflated(const std::string& bytes, bool gzip) {
  z_stream stream{};
  constexpr int kWindow = 15, kGzip = 16, kMemory = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kWindow + (gzip ? kGzip : 0),
                   kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw InputError("tiles cannot be compressed");
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

std::string littleEndian(std::span<const std::uint32_t> tiles) {
  std::string bytes;
  bytes.reserve(4 * tiles.size());
  for (const std::uint32_t tile : tiles)
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(tile >> shift & 0xFF);
  return bytes;
}

}  // namespace

std::vector<std::uint32_t> decodeTiles(std::string_view text, Encoding encoding, std::size_t count,
                                       const std::string& what) {
  std::vector<std::uint32_t> tiles;
  std::size_t found = 0;
  if (encoding == Encoding::Csv) {
    tiles = decodeCsv(text, count, what);
    found = tiles.size();
  } else {
    std::optional<std::string> bytes = decodeBase64(text);
    if (!bytes) throw InputError(what + ": its tiles are not base64");
    if (encoding != Encoding::Base64) bytes = inflated(*bytes, 4 * count, what);
    found = bytes->size() / 4 + (bytes->size() % 4 != 0);
    for (std::size_t i = 0; i + 4 <= bytes->size(); i += 4) {
      std::uint32_t tile = 0;
      for (std::size_t k = 0; k < 4; ++k)
        tile |= static_cast<std::uint32_t>(static_cast<unsigned char>((*bytes)[i + k])) << 8 * k;
      tiles.push_back(tile);
    }
  }
  if (found != count)
    throw InputError(what + ": has " + (found > count ? "more than " : "") +
                     std::to_string(found > count ? count : found) + " tiles, not the " +
                     std::to_string(count) + " that its size says");
  return tiles;
}

std::string encodeTiles(std::span<const std::uint32_t> tiles, Encoding encoding, int width) {
  std::string text = "\n";
  if (encoding == Encoding::Elements) {
    for (const std::uint32_t tile : tiles)
      text += tile == 0 ? "   <tile/>\n" : "   <tile gid=\"" + std::to_string(tile) + "\"/>\n";
    return text + "  ";
  }
  if (encoding == Encoding::Csv) {
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      text += std::to_string(tiles[i]);
      if (i + 1 < tiles.size()) text += ',';
      if ((i + 1) % static_cast<std::size_t>(width) == 0) text += '\n';
    }
    return text;
  }
  std::string bytes = littleEndian(tiles);
  if (encoding != Encoding::Base64) bytes = deflated(bytes, encoding == Encoding::Gzip);
  return text + "   " + encodeBase64(bytes) + "\n  ";
}

}  // namespace exemplar
