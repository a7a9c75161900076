// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <deque>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh_formats.h"

namespace exemplar {

/// An array of vectors in a glTF document, checked: every byte that it names is there.
struct GltfAccessor {
  std::string place;  ///< what errors call it: "accessors[3]"
  std::uint64_t count = 0;
  int componentType = 0;  ///< GL_BYTE (5120) .. GL_FLOAT (5126)
  int components = 0;     ///< 1 for SCALAR .. 4 for VEC4, 16 for MAT4
  bool normalized = false;

  /// The first vector's bytes, `stride` from one vector to the next; null where all are zero.
  const char* data = nullptr;
  std::uint64_t stride = 0;

  /// Vectors that replace others: `sparseCount` indices, and tightly packed values.
  std::uint64_t sparseCount = 0;
  int sparseIndexType = 0;
  const char* sparseIndices = nullptr;
  const char* sparseValues = nullptr;
};

/// A glTF 2.0 file, binary or plain JSON, and its buffers, read with suspicion: every index,
/// offset, count and type is checked before it is used, and what is wrong is an `InputError` that
/// names it
/// ("FILE: accessors[3].count should be ..."). The bytes and the source must outlive the document.
class GltfDocument {
 public:
  using Json = nlohmann::json;

  /// Takes the container apart where there is one, and parses the JSON. Refuses extensions that a
  /// reader must know to make sense of the file, and that this one does not.
  GltfDocument(std::string_view bytes, const MeshSource& source);

  const Json& root() const { return root_; }

  /// How many elements one of the top-level arrays has; 0 where it is missing.
  std::uint64_t count(const char* array) const;
  /// The element of a top-level array, an object. `place` is who asks.
  const Json& element(const char* array, std::uint64_t index, const std::string& place) const;

  /// A member that is a whole number from 0 to 2^53; nothing where it is missing.
  std::optional<std::uint64_t> index(const Json& object, const char* key,
                                     const std::string& place) const;
  double number(const Json& object, const char* key, double fallback,
                const std::string& place) const;
  std::string text(const Json& object, const char* key, const std::string& place) const;
  /// A member that is an array of `size` finite numbers; false, with `to` as it was, where missing.
  bool numbers(const Json& object, const char* key, std::size_t size, double* to,
               const std::string& place) const;
  /// A member that is an object, or null where it is missing.
  const Json* object(const Json& object, const char* key, const std::string& place) const;
  /// What an object says under an extension's name; null where it does not have it.
  const Json* extension(const Json& object, const char* name, const std::string& place) const;
  /// A member that is an array, or null where it is missing.
  const Json* array(const Json& object, const char* key, const std::string& place) const;

  GltfAccessor accessor(std::uint64_t index, const std::string& place);
  /// All components of all vectors, integers scaled to -1..1 or 0..1 where `normalized`.
  std::vector<double> readNumbers(const GltfAccessor& accessor) const;
  /// An array of indices (unsigned scalars).
  std::vector<std::uint32_t> readIndices(const GltfAccessor& accessor) const;
  /// The bytes of an image, embedded or beside the file; nothing where that file is missing.
  std::optional<std::string> image(std::uint64_t index, const std::string& place);

  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view bufferView(std::uint64_t index, const std::string& place, std::uint64_t* stride);
  std::string_view buffer(std::uint64_t index, const std::string& place);
  std::optional<std::string> readUri(const std::string& uri, const std::string& place) const;
  void refuseExtensions() const;
  /// The JSON in a binary container, whose binary chunk becomes `binary_`.
  std::string_view unpack(std::string_view glb);

  const MeshSource& source_;
  std::uint64_t fileBytes_ = 0;
  std::string_view binary_;
  Json root_;
  std::vector<std::optional<std::string_view>> buffers_;
  std::deque<std::string> loaded_;  // what buffers_ looks at where it is not binary_
};

}  // namespace exemplar
