// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/ply_rows.h"

#include <utility>

#include "core/text.h"

namespace exemplar::ply {
namespace {

Type typeOf(std::string_view word, TextScanner& in) {
  constexpr std::string_view kNames[] = {"char", "uchar", "short", "ushort",
                                         "int",  "uint",  "float", "double"};
  constexpr std::string_view kSizedNames[] = {"int8",  "uint8",  "int16",   "uint16",
                                              "int32", "uint32", "float32", "float64"};
  for (int i = 0; i < 8; ++i) {
    if (word == kNames[i] || word == kSizedNames[i]) return static_cast<Type>(i);
  }
  in.fail("'" + TextScanner::shown(word) + "' is not a PLY type");
}

}  // namespace

Header readHeader(TextScanner& in) {
  Header header;
  if (!in.nextLine() || in.rest() != "ply") in.fail("not a PLY file: it should begin with 'ply'");
  bool hasFormat = false;
  while (in.nextLine()) {
    const std::string_view key = in.word();
    if (key == "end_header") {
      if (!hasFormat) in.fail("the header has no 'format' line");
      return header;
    }
    if (key == "format") {
      const std::string_view encoding = in.word();
      if (encoding == "ascii") {
        header.encoding = Encoding::Ascii;
      } else if (encoding == "binary_little_endian") {
        header.encoding = Encoding::Little;
      } else if (encoding == "binary_big_endian") {
        header.encoding = Encoding::Big;
      } else {
        in.fail(
            "'" + TextScanner::shown(encoding) +
            "' is not a PLY format; it should be ascii, binary_little_endian or binary_big_endian");
      }
      hasFormat = true;
    } else if (key == "element") {
      Element& element = header.elements.emplace_back();
      element.name = in.word();
      const std::int64_t count = in.integer("an element's count");
      if (count < 0) in.fail("an element's count should not be negative");
      element.count = static_cast<std::uint64_t>(count);
    } else if (key == "property") {
      if (header.elements.empty()) in.fail("a property comes before the first element");
      Property property;
      std::string_view type = in.word();
      if (type == "list") {
        property.isList = true;
        property.countType = typeOf(in.word(), in);
        if (property.countType >= Type::Float) in.fail("a list's count should be a whole number");
        type = in.word();
      }
      property.type = typeOf(type, in);
      property.name = in.word();
      if (property.name.empty()) in.fail("a property has no name");
      header.elements.back().properties.push_back(std::move(property));
    } else if (key == "comment") {
      const std::string_view kind = in.word();
      // "comment material 3 NAME": how `formatPly` keeps the names of materials.
      if (lowerCase(kind) == "texturefile") {
        header.textureFiles.emplace_back(unquoted(in.rest()));
      } else if (kind == "material" && in.peek() >= '0' && in.peek() <= '9') {
        const std::int64_t index = in.integerPrefix("a material's index");
        if (index >= 0) header.materialNames[static_cast<std::size_t>(index)] = in.rest();
      }
    }
  }
  in.fail("the header has no 'end_header' line");
}

}  // namespace exemplar::ply
