// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/error.h"
#include "core/text.h"
#include "core/text_scanner.h"
#include "mesh/across_formats.h"
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

/// Stands before a picture's number in the lines of a source; no line of a file has it.
constexpr char kPicture = '\x7f';

/// The picture of a map, what is left of the line after options such as `-s 1 1 1` or `-clamp on`,
/// and how it is looked up. `length` is that of the options.
MtlMap readMap(std::string_view line, std::size_t* length = nullptr) {
  MtlMap map;
  std::string_view file = line;
  const auto takeWord = [&] {
    const std::string_view word = file.substr(0, file.find_first_of(" \t"));
    file.remove_prefix(word.size());
    file.remove_prefix(std::min(file.find_first_not_of(" \t"), file.size()));
    return word;
  };
  std::array<double, 2> scale{1, 1}, offset{0, 0};
  while (file.starts_with('-')) {
    const std::string_view option = takeWord();
    const bool vector = option == "-s" || option == "-o" || option == "-t";
    // Scale, offset and turbulence have one to three numbers, the gain of -mm two, others one word.
    const int words = vector ? 3 : option == "-mm" ? 2 : 1;
    for (int n = 0; n < words; ++n) {
      const std::size_t digit = file.find_first_not_of("+-.");
      const bool isNumber = digit < file.size() && file[digit] >= '0' && file[digit] <= '9';
      if (vector && n > 0 && !isNumber) break;
      const std::optional<double> value = parseNumber(takeWord());
      if (n < 2 && value && std::isfinite(*value) && option == "-s") scale[n] = *value;
      if (n < 2 && value && std::isfinite(*value) && option == "-o") offset[n] = *value;
    }
  }
  if (length) *length = line.size() - file.size();
  // Here v runs up: v' = scale v + offset; in a transform it runs down.
  map.transform.scale = scale;
  map.transform.offset = {offset[0], 1 - offset[1] - scale[1]};
  // A comment follows a blank; within a name, '#' is a letter.
  file = file.substr(0, file.find(" #"));
  while (file.ends_with(' ')) file.remove_suffix(1);
  map.file = unquoted(file);
  return map;
}

bool isMap(const std::string& key) {
  return key.starts_with("map_") || key == "bump" || key == "norm" || key == "disp" ||
         key == "decal" || key == "refl";
}

/// A line without what would break the lines of a source.
std::string plainLine(std::string_view key, std::string_view rest) {
  std::string line(key);
  line += ' ';
  line += rest;
  for (char& c : line)
    if ((static_cast<unsigned char>(c) < ' ' && c != '\t') || c == kPicture) c = ' ';
  return line;
}

/// What a line that begins with `key`, in lower case, says about a material.
void readKey(TextScanner& in, const std::string& key, MtlMaterial& material, bool& hasRoughness) {
  Material& m = material.material;
  if (key == "kd") {
    Vec3f c = readColor(in, "the diffuse color", {0.8f, 0.8f, 0.8f});
    if (std::max({c.x, c.y, c.z}) > 2) c = c / 255.0f;
    m.baseColor = {c.x, c.y, c.z, m.baseColor[3]};
  } else if (key == "ke") {
    m.emission = material.light = readColor(in, "the emitted color", {});
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

/// Keeps a map, and its line.
void addMap(const std::string& key, std::string_view word, std::string_view rest,
            MtlMaterial& material) {
  std::size_t options = 0;
  MtlMap map = readMap(rest, &options);
  map.key = key;
  if (map.file.starts_with(kPicture)) {
    const auto number = parseNumber(map.file.substr(1));
    if (number && *number >= 0 && *number < 1e9) map.picture = static_cast<std::size_t>(*number);
  }
  if (key == "map_kd") {
    material.baseColorFile = map.file;
    material.material.baseColorTransform = map.transform;
  }
  material.lines += plainLine(word, rest.substr(0, options)) + kPicture +
                    std::to_string(material.maps.size()) + "\n";
  material.maps.push_back(std::move(map));
}

/// What a material's members say, where it did not come from a `.mtl`.
void appendMembers(std::string& out, const MtlEntry& entry) {
  const Material& m = entry.material;
  appendColor(out, "Kd", m.baseColor[0], m.baseColor[1], m.baseColor[2]);
  std::string maps;
  Vec3f light = m.emission;
  for (const auto& [key, picture, factor] : gltfMapsOfMtl(m)) {
    if (entry.pictureFiles.at(picture).empty()) continue;
    maps += std::string(key) + " " + entry.pictureFiles[picture] + "\n";
    if (factor) light = *factor;
  }
  if (light != Vec3f{}) appendColor(out, "Ke", light.x, light.y, light.z);
  appendKey(out, "d", m.baseColor[3]);
  const float smooth = 1 - m.roughness;
  appendKey(out, "Ns", 1000 * smooth * smooth);
  appendKey(out, "Pr", m.roughness);
  appendKey(out, "Pm", m.metallic);
  out += "illum 2\n";
  if (!entry.baseColorFile.empty()) {
    out += "map_Kd ";
    const UvTransform& t = m.baseColorTransform;
    if (!t.isIdentity() && t.rotation == 0) {
      for (const auto& [option, u, v] :
           {std::tuple("-s", t.scale[0], t.scale[1]),
            std::tuple("-o", t.offset[0], 1 - t.offset[1] - t.scale[1])}) {
        out += option;
        for (const double number : {u, v}) {
          out += ' ';
          appendNumber(out, number);
        }
        out += option[1] == 's' ? " 1 " : " 0 ";
      }
    }
    out += entry.baseColorFile + "\n";
  }
  out += maps;
}

/// Lines with what stands for each marked number in its place; those for which that is empty are
/// left out.
std::string replaced(std::string_view text, const std::vector<std::string>& byNumber) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    const std::size_t mark = line.find(kPicture);
    if (mark == std::string_view::npos) {
      out += line;
    } else {
      const auto number = parseNumber(line.substr(mark + 1));
      const std::string& by = byNumber.at(static_cast<std::size_t>(number.value_or(0)));
      if (by.empty()) continue;
      out += line.substr(0, mark);
      out += by;
    }
    out += '\n';
  }
  return out;
}

}  // namespace

std::vector<MtlMaterial> parseMtl(std::string_view bytes, const std::string& name,
                                  Warnings* warnings) {
  std::vector<MtlMaterial> materials;
  TextScanner in(bytes, name, {.continued = true, .comments = true});
  bool hasRoughness = false;
  while (in.nextFilledLine()) {
    const std::string_view word = in.word();
    const std::string key = lowerCase(word);
    if (key == "newmtl") {
      materials.emplace_back().material.name = in.rest();
      hasRoughness = false;
      continue;
    }
    if (materials.empty()) continue;
    MtlMaterial& material = materials.back();
    if (isMap(key)) {
      addMap(key, word, in.rest(), material);
      continue;
    }
    const std::int64_t line = in.line();
    const std::string rest(in.peekRest());
    try {
      readKey(in, key, material, hasRoughness);
      // A line that goes on in the next one is kept as far as it was read.
      const bool continued = in.line() != line || rest.ends_with('\\');
      if (!continued) material.lines += plainLine(word, rest) + "\n";
    } catch (const InputError& e) {
      warn(warnings, e.what() + std::string("; the line is left out"));
    }
  }
  for (MtlMaterial& m : materials) {
    const auto hasLight = [](const MtlMap& map) { return map.key == "map_ke"; };
    if (std::ranges::any_of(m.maps, hasLight)) m.material.emission = {};
  }
  return materials;
}

std::string plainMtlLines(const Material& material) {
  MtlEntry entry{material, {}, ""};
  entry.material.source = nullptr;
  if (material.baseColorTexture) entry.baseColorFile = std::string(1, kPicture) + "0";
  std::string lines;
  appendMembers(lines, entry);
  return lines;
}

std::string withPictureNumbers(const std::string& lines, const std::vector<std::string>& maps) {
  std::vector<std::string> marked(maps);
  for (std::string& number : marked)
    if (!number.empty()) number = kPicture + number;
  return replaced(lines, marked);
}

MtlMaterial parseMtlSource(const MaterialSource& source) {
  std::vector<MtlMaterial> read = parseMtl("newmtl m\n" + source.text, "material");
  return std::move(read.at(0));
}

std::string formatMtl(const std::vector<MtlEntry>& materials) {
  std::string out;
  for (const MtlEntry& entry : materials) {
    const auto& source = entry.material.source;
    out += "newmtl " + entry.material.name + "\n";
    if (source && source->format == MaterialSource::Format::Mtl) {
      out += replaced(source->text, entry.pictureFiles);
    } else {
      appendMembers(out, entry);
    }
    out += '\n';
  }
  return out;
}

}  // namespace exemplar
