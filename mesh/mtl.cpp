// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mtl.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "mesh/mesh_formats.h"

namespace exemplar {
namespace {

double readFinite(TextScanner& in, const char* what) {
  const double value = in.number(what);
  if (!std::isfinite(static_cast<float>(value))) in.fail(std::string(what) + " is NaN or infinite");
  return value;
}

/// A color is one number for gray or three; `fallback` where it is a spectral curve or CIE XYZ,
/// which nobody writes.
Vec3f readColor(TextScanner& in, const char* what, const Vec3f& fallback) {
  const char first = in.peek();
  if (first == 's' || first == 'x') return fallback;
  const auto next = [&] { return static_cast<float>(readFinite(in, what)); };
  const float red = next();
  if (in.atLineEnd()) return {red, red, red};
  const float green = next();
  return {red, green, next()};
}

/// The file name of a map: what is left of the line after options such as `-s 1 1 1` or `-clamp
/// on`.
std::string readMapFile(TextScanner& in) {
  std::string_view file = in.rest();
  const auto dropWord = [&] {
    file.remove_prefix(std::min(file.find_first_of(" \t"), file.size()));
    file.remove_prefix(std::min(file.find_first_not_of(" \t"), file.size()));
  };
  while (file.starts_with('-')) {
    const std::string_view option = file.substr(0, file.find_first_of(" \t"));
    const bool vector = option == "-s" || option == "-o" || option == "-t";
    dropWord();
    // Scale, offset and turbulence have one to three numbers, the gain of -mm two, others one word.
    int words = vector ? 3 : option == "-mm" ? 2 : 1;
    for (bool first = true; words > 0; --words, first = false) {
      const std::size_t digit = file.find_first_not_of("+-.");
      const bool isNumber = digit < file.size() && file[digit] >= '0' && file[digit] <= '9';
      if (vector && !first && !isNumber) break;
      dropWord();
    }
  }
  // A comment follows a blank; within a name, '#' is a letter.
  file = file.substr(0, file.find(" #"));
  while (file.ends_with(' ')) file.remove_suffix(1);
  return std::string(unquoted(file));
}

/// What a line that begins with `key`, in lower case, says about a material.
void readKey(TextScanner& in, const std::string& key, MtlMaterial& material, bool& hasRoughness) {
  Material& m = material.material;
  if (key == "kd") {
    Vec3f c = readColor(in, "the diffuse color", {0.8f, 0.8f, 0.8f});
    if (std::max({c.x, c.y, c.z}) > 2) c = c / 255.0f;
    m.baseColor = {c.x, c.y, c.z, m.baseColor[3]};
  } else if (key == "ke") {
    m.emission = readColor(in, "the emitted color", {});
  } else if (key == "d") {
    if (in.peek() == '-') return;  // "-halo": opacity that depends on the view
    m.baseColor[3] = static_cast<float>(readFinite(in, "the opacity"));
  } else if (key == "tr") {
    m.baseColor[3] = 1 - static_cast<float>(readFinite(in, "the transparency"));
  } else if (key == "pr") {
    m.roughness = static_cast<float>(readFinite(in, "the roughness"));
    hasRoughness = true;
  } else if (key == "pm") {
    m.metallic = static_cast<float>(readFinite(in, "the metalness"));
  } else if (key == "ns") {
    const double exponent = std::clamp(readFinite(in, "the specular exponent"), 0.0, 1000.0);
    if (!hasRoughness) m.roughness = static_cast<float>(1 - std::sqrt(exponent / 1000));
  } else if (key == "map_kd") {
    material.baseColorFile = readMapFile(in);
  } else if (key.starts_with("map_") || key == "bump" || key == "norm" || key == "disp" ||
             key == "decal" || key == "refl") {
    material.otherMaps.push_back(key);
  }
}

void appendColor(std::string& out, const char* key, float r, float g, float b) {
  out += key;
  for (const float c : {r, g, b}) {
    out += ' ';
    appendNumber(out, c);
  }
  out += '\n';
}

void appendKey(std::string& out, const char* key, float value) {
  out += key;
  out += ' ';
  appendNumber(out, value);
  out += '\n';
}

}  // namespace

std::vector<MtlMaterial> parseMtl(std::string_view bytes, const std::string& name,
                                  Warnings* warnings) {
  std::vector<MtlMaterial> materials;
  TextScanner in(bytes, name, {.continued = true, .comments = true});
  bool hasRoughness = false;
  while (in.nextFilledLine()) {
    const std::string key = lowerCase(in.word());
    if (key == "newmtl") {
      materials.emplace_back().material.name = in.rest();
      hasRoughness = false;
      continue;
    }
    if (materials.empty()) continue;
    try {
      readKey(in, key, materials.back(), hasRoughness);
    } catch (const InputError& e) {
      warn(warnings, e.what() + std::string("; the line is left out"));
    }
  }
  for (MtlMaterial& m : materials) {
    const auto& maps = m.otherMaps;
    if (std::find(maps.begin(), maps.end(), "map_ke") != maps.end()) m.material.emission = {};
  }
  return materials;
}

std::string formatMtl(const std::vector<MtlMaterial>& materials) {
  std::string out;
  for (const auto& [m, file, otherMaps] : materials) {
    out += "newmtl " + m.name + "\n";
    appendColor(out, "Kd", m.baseColor[0], m.baseColor[1], m.baseColor[2]);
    if (m.emission != Vec3f{}) appendColor(out, "Ke", m.emission.x, m.emission.y, m.emission.z);
    appendKey(out, "d", m.baseColor[3]);
    const float smooth = 1 - m.roughness;
    appendKey(out, "Ns", 1000 * smooth * smooth);
    appendKey(out, "Pr", m.roughness);
    appendKey(out, "Pm", m.metallic);
    out += "illum 2\n";
    if (!file.empty()) out += "map_Kd " + file + "\n";
    out += '\n';
  }
  return out;
}

}  // namespace exemplar
