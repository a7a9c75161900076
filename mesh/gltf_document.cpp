// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/gltf_document.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/base64.h"
#include "core/error.h"
#include "core/text.h"
#include "core/text_scanner.h"

namespace exemplar {
namespace {

using Json = GltfDocument::Json;

constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
              kUnsignedInt = 5125, kFloat = 5126;

template <class T>
T littleAt(const char* bytes) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

std::uint64_t bytesOf(int componentType) {
  switch (componentType) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    default:
      return 4;
  }
}

/// Calls `body` with a value of the C++ type that a component type denotes.
template <class Body>
void withType(int componentType, const Body& body) {
  switch (componentType) {
    case kByte:
      return body(std::int8_t{});
    case kUnsignedByte:
      return body(std::uint8_t{});
    case kShort:
      return body(std::int16_t{});
    case kUnsignedShort:
      return body(std::uint16_t{});
    case kUnsignedInt:
      return body(std::uint32_t{});
    case kFloat:
      return body(float{});
  }
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// A URI's text with its %XX escapes undone.
std::string unescaped(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 &&
        hexDigit(uri[i + 2]) >= 0) {
      text += static_cast<char>(16 * hexDigit(uri[i + 1]) + hexDigit(uri[i + 2]));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// Whether the reader honors an extension, or it changes nothing that a mesh holds.
bool isHonored(std::string_view extension) {
  for (const char* known :
       {"KHR_mesh_quantization", "KHR_texture_transform", "KHR_node_visibility",
        "EXT_mesh_gpu_instancing", "KHR_materials_emissive_strength",
        "KHR_materials_pbrSpecularGlossiness", "KHR_lights_punctual", "KHR_xmp_json_ld", "KHR_xmp",
        "KHR_animation_pointer", "EXT_lights_image_based", "EXT_lights_ies", "KHR_audio_emitter",
        "EXT_structural_metadata", "EXT_mesh_features", "MSFT_lod", "KHR_physics_rigid_bodies",
        "KHR_implicit_shapes"}) {
    if (extension == known) return true;
  }
  return false;
}

/// Whether an extension changes only how surfaces look: without it the shape is right.
bool isLookOnly(std::string_view extension) {
  if (extension.find("_materials_") != std::string_view::npos) return true;
  return extension.find("_texture_") != std::string_view::npos;
}

}  // namespace

std::string_view GltfDocument::unpack(std::string_view glb) {
  if (glb.size() < 12) fail("the file is truncated: it ends in its header");
  const std::uint32_t version = littleAt<std::uint32_t>(glb.data() + 4);
  if (version != 2) fail("glTF version " + std::to_string(version) + "; save it as version 2.0");
  const std::uint32_t length = littleAt<std::uint32_t>(glb.data() + 8);
  if (length > glb.size()) {
    fail("the file is truncated: its header promises " + std::to_string(length) +
         " bytes and it has " + std::to_string(glb.size()));
  }
  glb = glb.substr(0, length);
  std::optional<std::string_view> json;
  bool hasBinary = false;
  for (std::size_t at = 12; at < glb.size();) {
    if (glb.size() - at < 8) fail("the file is truncated: it ends in a chunk's header");
    const std::uint32_t chunkBytes = littleAt<std::uint32_t>(glb.data() + at);
    const std::uint32_t type = littleAt<std::uint32_t>(glb.data() + at + 4);
    at += 8;
    if (chunkBytes > glb.size() - at) {
      fail("the file is truncated: a chunk promises " + std::to_string(chunkBytes) + " bytes and " +
           std::to_string(glb.size() - at) + " are left");
    }
    const std::string_view chunk = glb.substr(at, chunkBytes);
    at += chunkBytes;
    if (!json) {
      if (type != kJsonChunk) fail("the first chunk should be JSON");
      json = chunk;
    } else if (type == kBinaryChunk && !hasBinary) {
      binary_ = chunk;
      hasBinary = true;
    }
  }
  if (!json) fail("the file has no JSON chunk");
  return *json;
}

GltfDocument::GltfDocument(std::string_view bytes, const MeshSource& source)
    : source_(source), fileBytes_(bytes.size()) {
  std::string decoded;
  std::string_view json;
  if (bytes.size() >= 4 && littleAt<std::uint32_t>(bytes.data()) == kMagic) {
    json = unpack(bytes);
  } else {
    json = asUtf8(bytes, decoded);
    const std::size_t first = json.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || json[first] != '{') {
      fail("not a glTF file: it should begin with 'glTF' (binary) or with '{' (JSON)");
    }
  }
  try {
    root_ = Json::parse(json.begin(), json.end());
  } catch (const Json::parse_error& e) {
    fail("its JSON cannot be read: malformed at byte " + std::to_string(e.byte) + " of " +
         std::to_string(json.size()));
  } catch (const Json::exception&) {
    fail("its JSON cannot be read");
  }
  if (!root_.is_object()) fail("its JSON should be an object");
  for (const char* key : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers",
                          "materials", "textures", "images", "samplers", "skins"}) {
    if (root_.contains(key) && !root_[key].is_array())
      fail(std::string(key) + " should be an array");
  }
  refuseExtensions();
  buffers_.resize(count("buffers"));
}

void GltfDocument::refuseExtensions() const {
  const Json* required = array(root_, "extensionsRequired", "the file");
  if (!required) return;
  for (const Json& extension : *required) {
    if (!extension.is_string()) fail("extensionsRequired should hold names");
    const std::string& wanted = extension.get_ref<const std::string&>();
    if (isHonored(wanted)) continue;
    if (isLookOnly(wanted)) {
      source_.warn("the extension " + TextScanner::shown(wanted) +
                   " is not read; surfaces may look different");
      continue;
    }
    fail("the file needs the glTF extension " + TextScanner::shown(wanted) +
         ", which is not supported; save it without (no mesh compression)");
  }
}

void GltfDocument::fail(const std::string& message) const {
  throw InputError(source_.name + ": " + message);
}

std::uint64_t GltfDocument::count(const char* array) const {
  const auto found = root_.find(array);
  return found == root_.end() ? 0 : found->size();
}

const Json& GltfDocument::element(const char* array, std::uint64_t index,
                                  const std::string& place) const {
  if (index >= count(array)) {
    fail(place + " names " + array + "[" + std::to_string(index) + "], and there are " +
         std::to_string(count(array)));
  }
  const Json& found = root_.find(array)->at(index);
  if (!found.is_object())
    fail(std::string(array) + "[" + std::to_string(index) + "] should be an object");
  return found;
}

std::optional<std::uint64_t> GltfDocument::index(const Json& object, const char* key,
                                                 const std::string& place) const {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  if (found->is_number()) {
    const double value = found->get<double>();
    if (value >= 0 && value <= 0x1p53 && value == std::floor(value)) {
      return static_cast<std::uint64_t>(value);
    }
  }
  fail(place + "." + key + " should be a whole number, 0 or more");
}

double GltfDocument::number(const Json& object, const char* key, double fallback,
                            const std::string& place) const {
  const auto found = object.find(key);
  if (found == object.end()) return fallback;
  if (!found->is_number() || !std::isfinite(found->get<double>())) {
    fail(place + "." + key + " should be a finite number");
  }
  return found->get<double>();
}

std::string GltfDocument::text(const Json& object, const char* key,
                               const std::string& place) const {
  const auto found = object.find(key);
  if (found == object.end()) return "";
  if (!found->is_string()) fail(place + "." + key + " should be text");
  return found->get<std::string>();
}

bool GltfDocument::numbers(const Json& object, const char* key, std::size_t size, double* to,
                           const std::string& place) const {
  const auto found = object.find(key);
  if (found == object.end()) return false;
  const auto isNumber = [](const Json& j) {
    return j.is_number() && std::isfinite(j.get<double>());
  };
  if (!found->is_array() || found->size() != size ||
      !std::all_of(found->begin(), found->end(), isNumber)) {
    fail(place + "." + key + " should be " + std::to_string(size) + " finite numbers");
  }
  for (std::size_t i = 0; i < size; ++i) to[i] = (*found)[i].get<double>();
  return true;
}

const Json* GltfDocument::object(const Json& object, const char* key,
                                 const std::string& place) const {
  const auto found = object.find(key);
  if (found == object.end()) return nullptr;
  if (!found->is_object()) fail(place + "." + key + " should be an object");
  return &*found;
}

const Json* GltfDocument::extension(const Json& object, const char* name,
                                    const std::string& place) const {
  const Json* extensions = this->object(object, "extensions", place);
  return extensions ? this->object(*extensions, name, place) : nullptr;
}

const Json* GltfDocument::array(const Json& object, const char* key,
                                const std::string& place) const {
  const auto found = object.find(key);
  if (found == object.end()) return nullptr;
  if (!found->is_array()) fail(place + "." + key + " should be an array");
  return &*found;
}

std::optional<std::string> GltfDocument::readUri(const std::string& uri,
                                                 const std::string& place) const {
  if (!uri.starts_with("data:")) return source_.siblingBytes(unescaped(uri));
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
    fail(place + ".uri should be base64 data or a file's name");
  }
  std::optional<std::string> bytes = decodeBase64(std::string_view(uri).substr(comma + 1));
  if (!bytes) fail(place + ".uri is not valid base64");
  return bytes;
}

std::string_view GltfDocument::buffer(std::uint64_t index, const std::string& from) {
  const Json& json = element("buffers", index, from);
  std::optional<std::string_view>& bytes = buffers_[index];
  if (bytes) return *bytes;
  const std::string place = "buffers[" + std::to_string(index) + "]";
  const std::optional<std::uint64_t> length = this->index(json, "byteLength", place);
  if (!length) fail(place + ".byteLength is missing");
  const std::string uri = text(json, "uri", place);
  std::string_view whole = binary_;
  if (!uri.empty()) {
    std::optional<std::string> read = readUri(uri, place);
    if (!read) fail(place + ": no such file beside this one: " + TextScanner::shown(uri));
    whole = loaded_.emplace_back(std::move(*read));
  } else if (index != 0) {
    fail(place + ".uri is missing; only the first buffer is in the binary chunk");
  }
  if (*length > whole.size()) {
    fail(place + ".byteLength is " + std::to_string(*length) + " and " +
         std::to_string(whole.size()) + " bytes are there");
  }
  bytes = whole.substr(0, *length);
  return *bytes;
}

std::string_view GltfDocument::bufferView(std::uint64_t index, const std::string& from,
                                          std::uint64_t* stride) {
  const Json& json = element("bufferViews", index, from);
  const std::string place = "bufferViews[" + std::to_string(index) + "]";
  const std::optional<std::uint64_t> bufferIndex = this->index(json, "buffer", place);
  if (!bufferIndex) fail(place + ".buffer is missing");
  const std::string_view whole = buffer(*bufferIndex, place);
  const std::uint64_t offset = this->index(json, "byteOffset", place).value_or(0);
  const std::optional<std::uint64_t> length = this->index(json, "byteLength", place);
  if (!length) fail(place + ".byteLength is missing");
  if (offset > whole.size() || *length > whole.size() - offset) {
    fail(place + " reaches from byte " + std::to_string(offset) + " over " +
         std::to_string(*length) + " bytes, and its buffer has " + std::to_string(whole.size()));
  }
  *stride = this->index(json, "byteStride", place).value_or(0);
  if (*stride > 252) fail(place + ".byteStride should be at most 252");
  return whole.substr(offset, *length);
}

GltfAccessor GltfDocument::accessor(std::uint64_t index, const std::string& from) {
  const Json& json = element("accessors", index, from);
  GltfAccessor a;
  a.place = "accessors[" + std::to_string(index) + "]";
  const auto readType = [&](const Json& object, const std::string& place) {
    const std::uint64_t type = this->index(object, "componentType", place).value_or(0);
    if (type < kByte || type > kFloat || type == 5124) {
      fail(place + ".componentType should be 5120, 5121, 5122, 5123, 5125 or 5126");
    }
    return static_cast<int>(type);
  };
  a.componentType = readType(json, a.place);
  const std::optional<std::uint64_t> count = this->index(json, "count", a.place);
  if (!count || *count == 0) fail(a.place + ".count should be 1 or more");
  a.count = *count;
  const std::string type = text(json, "type", a.place);
  a.components = type == "SCALAR" ? 1
                 : type == "VEC2" ? 2
                 : type == "VEC3" ? 3
                 : type == "VEC4" ? 4
                 : type == "MAT4" ? 16
                                  : 0;
  if (a.components == 0) fail(a.place + ".type should be SCALAR, VEC2, VEC3, VEC4 or MAT4 here");
  // Columns of smaller components would be padded; no use of matrices allows them.
  if (a.components == 16 && a.componentType != kFloat) fail(a.place + " should hold floats");
  const auto normalized = json.find("normalized");
  if (normalized != json.end()) {
    if (!normalized->is_boolean()) fail(a.place + ".normalized should be true or false");
    a.normalized = normalized->get<bool>();
  }

  /// The first of `count` vectors of `size` bytes in a view; fails unless all of them are in it.
  const auto locate = [&](const Json& object, const std::string& place, std::uint64_t size,
                          std::uint64_t vectors, std::uint64_t* strideOut) {
    std::uint64_t stride = 0;
    const std::string_view view =
        bufferView(*this->index(object, "bufferView", place), place, &stride);
    if (stride == 0 || !strideOut) stride = size;
    if (stride < size) {
      fail(place + " has vectors of " + std::to_string(size) + " bytes, " + std::to_string(stride) +
           " bytes apart");
    }
    const std::uint64_t offset = this->index(object, "byteOffset", place).value_or(0);
    // Each product and sum stays far below 2^64: sizes are below 2^9, counts are compared first.
    if (offset > view.size() || size > view.size() - offset ||
        vectors - 1 > (view.size() - offset - size) / stride) {
      fail(place + " needs " + std::to_string(vectors) + " elements from byte " +
           std::to_string(offset) + " of a view of " + std::to_string(view.size()) + " bytes");
    }
    if (strideOut) *strideOut = stride;
    return view.data() + offset;
  };
  const std::uint64_t vectorBytes = bytesOf(a.componentType) * a.components;
  if (json.contains("bufferView")) {
    a.data = locate(json, a.place, vectorBytes, a.count, &a.stride);
  } else if (a.count > fileBytes_) {
    fail(a.place + " has no bufferView and more elements than the file has bytes");
  }
  if (const Json* sparse = object(json, "sparse", a.place)) {
    const std::string place = a.place + ".sparse";
    a.sparseCount = this->index(*sparse, "count", place).value_or(0);
    if (a.sparseCount == 0 || a.sparseCount > a.count) {
      fail(place + ".count should be 1 to " + std::to_string(a.count));
    }
    const Json* indices = object(*sparse, "indices", place);
    const Json* values = object(*sparse, "values", place);
    if (!indices || !values || !indices->contains("bufferView") ||
        !values->contains("bufferView")) {
      fail(place + " should have indices and values, each with a bufferView");
    }
    a.sparseIndexType = readType(*indices, place + ".indices");
    if (a.sparseIndexType != kUnsignedByte && a.sparseIndexType != kUnsignedShort &&
        a.sparseIndexType != kUnsignedInt) {
      fail(place + ".indices.componentType should be 5121, 5123 or 5125");
    }
    a.sparseIndices =
        locate(*indices, place + ".indices", bytesOf(a.sparseIndexType), a.sparseCount, nullptr);
    a.sparseValues = locate(*values, place + ".values", vectorBytes, a.sparseCount, nullptr);
  }
  return a;
}

std::vector<double> GltfDocument::readNumbers(const GltfAccessor& a) const {
  std::vector<double> numbers(a.count * a.components, 0.0);
  withType(a.componentType, [&](auto sample) {
    using T = decltype(sample);
    double scale = 1;
    if constexpr (std::is_integral_v<T>) {
      if (a.normalized) scale = static_cast<double>(std::numeric_limits<T>::max());
    }
    const auto read = [&](const char* from, double* to) {
      for (int c = 0; c < a.components; ++c) {
        const double value = static_cast<double>(littleAt<T>(from + c * sizeof(T)));
        // -128 means -1, as -127 does.
        to[c] = scale == 1 ? value : std::max(value / scale, -1.0);
      }
    };
    if (a.data) {
      for (std::uint64_t i = 0; i < a.count; ++i)
        read(a.data + i * a.stride, &numbers[i * a.components]);
    }
    for (std::uint64_t i = 0; i < a.sparseCount; ++i) {
      std::uint64_t target = 0;
      withType(a.sparseIndexType, [&](auto index) {
        target = static_cast<std::uint64_t>(
            littleAt<decltype(index)>(a.sparseIndices + i * sizeof(index)));
      });
      if (target >= a.count) {
        fail(a.place + ".sparse names element " + std::to_string(target) + " of " +
             std::to_string(a.count));
      }
      read(a.sparseValues + i * a.components * sizeof(T), &numbers[target * a.components]);
    }
  });
  return numbers;
}

std::vector<std::uint32_t> GltfDocument::readIndices(const GltfAccessor& a) const {
  if (a.components != 1 || (a.componentType != kUnsignedByte && a.componentType != kUnsignedShort &&
                            a.componentType != kUnsignedInt)) {
    fail(a.place + " should hold unsigned scalars: it is used as indices");
  }
  // Whole numbers below 2^32 are exact as double; sparse indices take the same way.
  GltfAccessor plain = a;
  plain.normalized = false;
  const std::vector<double> numbers = readNumbers(plain);
  std::vector<std::uint32_t> indices;
  indices.reserve(numbers.size());
  for (const double n : numbers) indices.push_back(static_cast<std::uint32_t>(n));
  return indices;
}

std::optional<std::string> GltfDocument::image(std::uint64_t index, const std::string& from) {
  const Json& json = element("images", index, from);
  const std::string place = "images[" + std::to_string(index) + "]";
  if (const std::optional<std::uint64_t> view = this->index(json, "bufferView", place)) {
    std::uint64_t stride = 0;
    return std::string(bufferView(*view, place, &stride));
  }
  const std::string uri = text(json, "uri", place);
  if (uri.empty()) fail(place + " should have a bufferView or a uri");
  return readUri(uri, place);
}

}  // namespace exemplar
