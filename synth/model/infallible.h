// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "core/vec.h"
#include "voxelize/adjacency.h"

namespace exemplar {

/// Whether the sufficient condition of the thesis' statement 3.11 holds, over all three axes: any
/// labels that can precede a new cell along each axis, and agree with each other pair by pair,
/// leave it a label. Then plain propagation never fails in column order, whatever the size, with
/// free sides. (As printed the statement names T_x four times; two of them are T_y.) O(labels³).
bool meetsStatement311(const Adjacency& adjacency);

/// The outcome of Algorithm 3.6 for regions of one size.
struct InfallibleProof {
  enum class Verdict {
    Proved,     ///< plain propagation cannot fail in column order with free sides
    NotProved,  ///< a cell of some region may be left without labels; larger regions may prove it
    TooMany,    ///< more than `mostRegions` to look at
  };
  Verdict verdict = Verdict::NotProved;
  Vec3i region;              ///< cells, the new one included
  std::int64_t regions = 0;  ///< looked at
};

/// The automated proof of the thesis' section 3.3.7: lists every way in which the cells labeled
/// before a new one can occur in a region of `region` cells around it (the one before it along each
/// axis, and as many after it as fit), each label being one that its own region left possible, and
/// finds out whether the new cell always keeps a label. Regions cut off by the grid's sides count
/// too. Components of `region` are 2 or more; 1 along an axis along which the example is flat.
InfallibleProof proveInfallible(const Adjacency& adjacency, const Vec3i& region,
                                std::int64_t mostRegions = 1'000'000,
                                const Progress& progress = {});

/// A summary of an example's rules.
struct RuleSummary {
  int labels = 0;               ///< that occur
  std::vector<double> density;  ///< of each rule: pairs allowed, of all ordered pairs of labels
  bool statement311 = false;
  InfallibleProof proof;  ///< by statement 3.11, else of the smallest region that proves it
  bool infallible() const {
    return statement311 || proof.verdict == InfallibleProof::Verdict::Proved;
  }
};

/// Tries regions of 2 x 2 x 2 cells, then longer ones along y and z.
RuleSummary summarizeRules(const Adjacency& adjacency, std::int64_t mostRegions = 200'000,
                           const Progress& progress = {});

}  // namespace exemplar
