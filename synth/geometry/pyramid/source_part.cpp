// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/pyramid/source_part.h"

#include <algorithm>

#include "core/cells.h"

namespace exemplar {

DistanceField turnedField(const DistanceField& field, int turns) {
  if (turns == 0) return field;
  DistanceField result;
  result.voxelSize = field.voxelSize;
  result.origin = field.origin;
  result.truncation = field.truncation;
  result.values = turnedGrid(field.values, turns);
  return result;
}

SourceSheet::SourceSheet(const std::vector<SourcePart>& parts) : field(parts.front().field) {
  Vec3i size{-1, 0, 0};
  bool masked = parts.size() > 1;
  for (const SourcePart& part : parts) {
    first.push_back(size.x + 1);
    size = max(size, part.field.size());
    size.x = first.back() + part.field.size().x;
    masked = masked || !part.usable.empty();
  }
  if (!masked) return;
  // Solid, so that pieces which a part's sides cut are seen to continue.
  const float solid = -(field.truncation > 0 ? field.truncation : 1e3f);
  field.values = Array3D<float>(size, solid);
  usable = Array3D<std::uint8_t>(size);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const SourcePart& part = parts[n];
    parallelForEachCell(part.field.size(), [&](const Vec3i& p) {
      const Vec3i cell = p + Vec3i{first[n], 0, 0};
      field.values[cell] = part.field.values[p];
      usable[cell] = part.usable.empty() || part.usable[p];
    });
  }
}

Origin SourceSheet::toExample(const std::vector<SourcePart>& parts, const Origin& origin) const {
  std::size_t part = 0;
  while (part + 1 < parts.size() && origin.i >= first[part + 1]) ++part;
  const Vec3i cell = origin.cell() - Vec3i{first[part], 0, 0};
  return Origin(parts[part].unturned(cell), parts[part].example, parts[part].turns);
}

}  // namespace exemplar
