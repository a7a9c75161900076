// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// What kinds of pictures there are, by their first bytes.

#include "core/text.h"
#include "mesh/mesh_formats.h"

namespace exemplar {
namespace {

struct PictureKind {
  const char* mimeType;
  const char* ending;
  std::string_view magic;
  std::size_t at = 0;
};

using namespace std::string_view_literals;

constexpr PictureKind kKinds[] = {
    {"image/png", ".png", "\x89PNG\r\n\x1a\n"},
    {"image/jpeg", ".jpg", "\xff\xd8\xff"},
    {"image/webp", ".webp", "WEBP", 8},
    {"image/ktx2", ".ktx2", "\xabKTX 20\xbb\r\n\x1a\n"},
    {"image/vnd-ms.dds", ".dds", "DDS "},
    {"image/avif", ".avif", "ftypavif", 4},
    {"image/bmp", ".bmp", "BM"},
    {"image/gif", ".gif", "GIF8"},
    {"image/tiff", ".tif", "II*\0"sv},
    {"image/tiff", ".tif", "MM\0*"sv},
    {"image/x-exr", ".exr", "v/1\x01"},
    {"image/vnd.radiance", ".hdr", "#?"},
    {"image/vnd.adobe.photoshop", ".psd", "8BPS"},
};
constexpr const char* kTga = "image/x-tga";

}  // namespace

std::string imageMimeType(std::string_view bytes) {
  for (const PictureKind& kind : {kKinds[0], kKinds[1]})
    if (bytes.starts_with(kind.magic)) return kind.mimeType;
  return "";
}

std::string pictureMimeType(std::string_view bytes, std::string_view name) {
  for (const PictureKind& kind : kKinds)
    if (bytes.size() > kind.at && bytes.substr(kind.at).starts_with(kind.magic))
      return kind.mimeType;
  return lowerCase(name).ends_with(".tga") ? kTga : "";
}

std::string pictureEnding(std::string_view mimeType) {
  for (const PictureKind& kind : kKinds)
    if (mimeType == kind.mimeType) return kind.ending;
  return mimeType == kTga ? ".tga" : "";
}

}  // namespace exemplar
