// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/origin_map.h"
#include "synth/surface/band.h"
#include "synth/surface/foot.h"
#include "synth/surface/sheet.h"

namespace exemplar::surface {

/// Where points around a sheet came from: its parts are placements.
class SurfaceOrigins final : public OriginMap {
 public:
  struct Scale {
    double sample = 1;  ///< length of one on the surface where the example's size is 1
    double height = 1;  ///< of the example, of its own
    double zero = 0;    ///< where the surface is along the example's z, samples
    double limit = 1;   ///< how far from the sheet there is anything, world units
  };
  SurfaceOrigins(std::shared_ptr<const Sheet> sheet, std::shared_ptr<const FootFinder> feet,
                 std::shared_ptr<const SheetContent> content, const Scale& scale)
      : sheet_(std::move(sheet)),
        feet_(std::move(feet)),
        content_(std::move(content)),
        scale_(scale) {}

  void candidates(const Vec3d& position, std::vector<Candidate>& out) const override;
  std::optional<Place> place(std::uint32_t part, const Vec3d& position) const override;

 private:
  std::optional<Foot> footOf(const Vec3d& position) const;

  std::shared_ptr<const Sheet> sheet_;
  std::shared_ptr<const FootFinder> feet_;
  std::shared_ptr<const SheetContent> content_;
  Scale scale_;
};

}  // namespace exemplar::surface
