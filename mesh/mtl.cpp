// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mtl.h"

#include <algorithm>

#include "core/text_scanner.h"
#include "mesh/mesh_formats.h"

namespace exemplar {
namespace {

/// A color is one number for gray or three; `fallback` where it is a spectral curve or CIE XYZ,
/// which nobody writes.
Vec3f readColor(TextScanner& in, const char* what, const Vec3f& fallback) {
  const char first = in.peek();
  if (first == 's' || first == 'x') return fallback;
  const float red = static_cast<float>(in.number(what));
  if (in.atLineEnd()) return {red, red, red};
  const float green = static_cast<float>(in.number(what));
  return {red, green, static_cast<float>(in.number(what))};
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
  return std::string(file);
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

std::vector<MtlMaterial> parseMtl(std::string_view bytes, const std::string& name) {
  std::vector<MtlMaterial> materials;
  TextScanner in(bytes, name, {.continued = true, .comments = true});
  bool hasRoughness = false;
  while (in.nextFilledLine()) {
    const std::string_view key = in.word();
    if (key == "newmtl") {
      materials.emplace_back().material.name = in.rest();
      hasRoughness = false;
      continue;
    }
    if (materials.empty()) continue;
    Material& m = materials.back().material;
    if (key == "Kd") {
      const Vec3f c = readColor(in, "the diffuse color", {0.8f, 0.8f, 0.8f});
      m.baseColor = {c.x, c.y, c.z, m.baseColor[3]};
    } else if (key == "Ke") {
      m.emission = readColor(in, "the emitted color", {});
    } else if (key == "d") {
      if (in.peek() == '-') continue;  // "-halo": opacity that depends on the view
      m.baseColor[3] = static_cast<float>(in.number("the opacity"));
    } else if (key == "Tr") {
      m.baseColor[3] = 1 - static_cast<float>(in.number("the transparency"));
    } else if (key == "Pr") {
      m.roughness = static_cast<float>(in.number("the roughness"));
      hasRoughness = true;
    } else if (key == "Pm") {
      m.metallic = static_cast<float>(in.number("the metalness"));
    } else if (key == "Ns") {
      const double exponent = std::clamp(in.number("the specular exponent"), 0.0, 1000.0);
      if (!hasRoughness) m.roughness = static_cast<float>(1 - std::sqrt(exponent / 1000));
    } else if (key == "map_Kd") {
      materials.back().baseColorFile = readMapFile(in);
    }
  }
  return materials;
}

std::string formatMtl(const std::vector<MtlMaterial>& materials) {
  std::string out;
  for (const auto& [m, file] : materials) {
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
