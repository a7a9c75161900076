// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "mesh/mesh_file.h"

#include <algorithm>
#include <charconv>
#include <memory>
#include <unordered_map>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "mesh/across_formats.h"
#include "mesh/color.h"
#include "mesh/face_outlines.h"
#include "mesh/mesh_formats.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

enum class Format { None, Obj, Ply, Stl, Off, Glb, Gltf };

Format formatOf(const fs::path& path) {
  const std::string ending = lowerExtension(path);
  if (ending == ".obj") return Format::Obj;
  if (ending == ".ply") return Format::Ply;
  if (ending == ".stl") return Format::Stl;
  if (ending == ".off") return Format::Off;
  if (ending == ".glb") return Format::Glb;
  if (ending == ".gltf") return Format::Gltf;
  return Format::None;
}

bool isYUp(Format format, UpAxis up) {
  if (up != UpAxis::Default) return up == UpAxis::Y;
  return format == Format::Obj || format == Format::Glb || format == Format::Gltf;
}

[[noreturn]] void failAtEnding(const fs::path& path) {
  throw InputError(path.string() +
                   ": not a mesh file's ending; use .obj, .ply, .stl, .off, .glb or .gltf");
}

/// The regular file at a path; where none is, one whose name differs only by capitals, which make
/// no difference where many of these files are written.
std::optional<fs::path> findFile(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return path;
  const std::string wanted = lowerCase(path.filename().string());
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (lowerCase(entry->path().filename().string()) != wanted) continue;
    if (entry->is_regular_file(error)) return entry->path();
  }
  return std::nullopt;
}

/// The file called `name` in a file, as seen from the folder of that file; files that were written
/// on another machine often name a folder that is not here, so the name alone is tried after that.
std::optional<std::string> readSibling(const fs::path& folder, std::string name,
                                       std::vector<fs::path>* read) {
  for (char& c : name) {
    if (c == '\\') c = '/';
  }
  if (name.find('\0') != std::string::npos) return std::nullopt;
  const fs::path path(name);
  for (const fs::path& candidate : {path, path.filename()}) {
    if (candidate.empty() || candidate.is_absolute()) continue;
    const std::optional<fs::path> found = findFile(folder / candidate);
    std::error_code error;
    if (!found || fs::file_size(*found, error) == 0 || error) continue;
    if (read) read->push_back(*found);
    return readFile(*found);
  }
  return std::nullopt;
}

template <class T>
void appendAny(std::string& text, T value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  text.append(buffer, end);
}

}  // namespace

bool isMeshFile(const fs::path& path) { return formatOf(path) != Format::None; }

TriangleMesh readMesh(const fs::path& path, const MeshFileOptions& options,
                      const Progress& progress) {
  if (formatOf(path) == Format::None) failAtEnding(path);
  const std::string bytes = readFile(path, progress.part(0, 0.1));
  MeshFileOptions beside = options;
  if (!beside.folder) beside.folder = path.parent_path();
  return readMesh(bytes, path.string(), beside, progress.part(0.1, 1));
}

TriangleMesh readMesh(std::string_view bytes, const std::string& name,
                      const MeshFileOptions& options, const Progress& progress) {
  const Format format = formatOf(name);
  if (format == Format::None) failAtEnding(name);
  MeshSource source{.name = name, .warnings = options.warnings, .progress = progress};
  if (options.folder) {
    source.sibling = [folder = *options.folder, read = options.beside](const std::string& file) {
      return readSibling(folder, file, read);
    };
  }
  TriangleMesh mesh = format == Format::Obj   ? parseObj(bytes, source)
                      : format == Format::Ply ? parsePly(bytes, source)
                      : format == Format::Stl ? parseStl(bytes, source)
                      : format == Format::Off ? parseOff(bytes, source)
                                              : parseGltf(bytes, source);
  if (isYUp(format, options.up)) {
    for (Vec3d& p : mesh.positions) p = fromFileAxes(p, true);
  }
  validate(mesh, name);
  return mesh;
}

void writeMesh(const fs::path& path, const TriangleMesh& mesh, const MeshFileOptions& options,
               const Progress& progress) {
  writePolygons(path, mesh, {}, options, progress);
}

void writePolygons(const fs::path& path, const TriangleMesh& mesh,
                   std::span<const std::uint32_t> faces, const MeshFileOptions& options,
                   const Progress& progress) {
  const Format format = formatOf(path);
  if (format == Format::None) failAtEnding(path);
  validate(mesh, path.string());
  const bool yUp = isYUp(format, options.up);
  if (const std::vector<std::string> lost = lostIn(lowerExtension(path), mesh); !lost.empty()) {
    std::string names;
    for (const std::string& name : lost) names += (names.empty() ? "" : ", ") + name;
    warn(options.warnings, path.string() + ": left out, as this format cannot hold it: " + names);
  }
  const Progress formatting = progress.part(0, 0.8), writing = progress.part(0.8, 1);
  OutputFile out(path);
  constexpr double kVisible = 1e-5;
  if (format == Format::Stl && floatRounding(mesh) > kVisible) {
    warn(options.warnings,
         path.string() +
             ": coordinates are so far from the origin that this format's floats "
             "move them by more than 1e-5 of the mesh's size; write .obj, .ply or "
             ".glb to keep them");
  }
  if (format != Format::Obj) {
    out.write(format == Format::Ply   ? formatPly(mesh, yUp, options.normals, formatting, faces)
              : format == Format::Stl ? formatStl(mesh, yUp, formatting)
              : format == Format::Off ? formatOff(mesh, yUp, formatting, faces)
              : format == Format::Glb ? formatGlb(mesh, yUp, options.normals, formatting)
                                      : formatGltf(mesh, yUp, options.normals, formatting),
              writing);
    out.commit();
    return;
  }
  const ObjFiles files =
      formatObj(mesh, path.stem().string(), yUp, options.normals, formatting, faces);
  out.write(files.obj, writing);
  // All are written before the first is put in its place, and the .obj comes last: when it is
  // there, so is what it names.
  std::vector<std::unique_ptr<OutputFile>> siblings;
  for (const NamedBytes& file : files.siblings) {
    siblings.push_back(std::make_unique<OutputFile>(path.parent_path() / file.name));
    siblings.back()->write(file.bytes, writing.part(1, 1));
  }
  for (const auto& file : siblings) file->commit();
  out.commit();
}

double floatRounding(const TriangleMesh& mesh) {
  const Box3d box = boundingBox(mesh);
  const Vec3d size = box.size();
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  const double side = std::max({size.x, size.y, size.z});
  return side > 0 ? largest * 0x1p-24 / side : 0;
}

const char* coordinateProblem(const Vec3d& p) {
  if (!isFinite(p)) return "has a NaN or infinite coordinate";
  if (!(std::abs(p.x) < 1e15 && std::abs(p.y) < 1e15 && std::abs(p.z) < 1e15)) {
    return "has a coordinate of 1e15 or more";
  }
  return nullptr;
}

void setFaceColors(TriangleMesh& mesh, const std::vector<std::array<std::uint8_t, 4>>& colors) {
  std::unordered_map<std::uint32_t, std::uint32_t> materialOf;
  mesh.triangleMaterials.clear();
  mesh.triangleMaterials.reserve(colors.size());
  for (const auto& c : colors) {
    const std::uint32_t key = (std::uint32_t{c[0]} << 24) | (std::uint32_t{c[1]} << 16) |
                              (std::uint32_t{c[2]} << 8) | c[3];
    const auto [found, added] =
        materialOf.try_emplace(key, static_cast<std::uint32_t>(mesh.materials.size()));
    if (added) {
      constexpr char kDigits[] = "0123456789abcdef";
      Material material{.name = "color_", .baseColor = fromRgba8(c)};
      for (const std::uint8_t sample : c) {
        material.name += kDigits[sample / 16];
        material.name += kDigits[sample % 16];
      }
      mesh.materials.push_back(std::move(material));
    }
    mesh.triangleMaterials.push_back(found->second);
  }
}

std::array<std::uint8_t, 4> toRgba8(const std::array<float, 4>& c) {
  const float alpha = std::min(std::max(c[3], 0.0f), 1.0f);
  return {linearToSrgb8(c[0]), linearToSrgb8(c[1]), linearToSrgb8(c[2]),
          static_cast<std::uint8_t>(std::lround(alpha * 255))};
}

std::array<float, 4> fromRgba8(const std::array<std::uint8_t, 4>& c) {
  return {srgb8ToLinear(c[0]), srgb8ToLinear(c[1]), srgb8ToLinear(c[2]),
          static_cast<float>(c[3]) / 255};
}

void appendNumber(std::string& text, double value) { appendAny(text, value); }
void appendNumber(std::string& text, float value) { appendAny(text, value); }
void appendNumber(std::string& text, std::uint32_t value) { appendAny(text, value); }

}  // namespace exemplar
