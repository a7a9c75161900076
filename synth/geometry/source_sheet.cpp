// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/geometry/source_sheet.h"

#include <algorithm>

namespace exemplar {

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
  // Solid, so that pieces which the parts' sides cut are seen to go on.
  const float solid = -(field.truncation > 0 ? field.truncation : 1e3f);
  field.values = Array3D<float>(size, solid);
  usable = Array3D<std::uint8_t>(size);
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Array3D<float>& values = parts[n].field.values;
    for (std::size_t s = 0; s < values.count(); ++s) {
      const Vec3i cell = values.ijk(s) + Vec3i{first[n], 0, 0};
      field.values[cell] = values.values()[s];
      usable[cell] = parts[n].usable.empty() || parts[n].usable.values()[s];
    }
  }
}

Origin SourceSheet::toExample(const std::vector<SourcePart>& parts, const Origin& origin) const {
  std::size_t part = 0;
  while (part + 1 < parts.size() && origin.i >= first[part + 1]) ++part;
  const Vec3i cell = origin.cell() - Vec3i{first[part], 0, 0};
  return Origin(parts[part].unturned(cell), parts[part].example, parts[part].turns);
}

}  // namespace exemplar
