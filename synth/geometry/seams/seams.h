// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "core/array3d.h"
#include "core/origin.h"
#include "core/progress.h"

namespace exemplar {

struct SeamOptions {
  int passes = 2;          ///< over all pieces, >= 0
  int reach = 5;           ///< how far a piece may grow in one move, samples, >= 1
  double fidelity = 0.02;  ///< weight of staying near `target`, per squared unit; >= 0
  double length = 0.02;    ///< cost of a seam's face in itself; >= 0: shorter seams, larger pieces
  double slope = 1;        ///< weight of slopes that differ across a face; >= 0
  double truncation = 8;   ///< values count up to here, on either side of 0, slopes beyond; > 0
  /// Squares what the two sides of a face differ by, so that many small steps cost less than a few
  /// that show.
  bool squared = false;
  int smallest = 8;  ///< pieces of fewer samples do not grow (but may be taken), >= 1
  /// Samples of the result that keep their origins, where not 0: of its size, or none.
  const Array3D<std::uint8_t>* fixed = nullptr;
  /// Samples of the example that may be copied, where not 0: of its size, or none for all.
  const Array3D<std::uint8_t>* usable = nullptr;
  /// Samples of the result that take nothing solid, where not 0: of its size, or none.
  const Array3D<std::uint8_t>* air = nullptr;
};

/// Moves the seams between copied pieces to where both sides agree best.
///
/// A *piece* is a connected region of one offset into the example. A seam's face between
/// neighbors x (of offset a) and y (of offset b) costs |E(x + a) - E(x + b)| + |E(y + a) - E(y +
/// b)| (Kwatra et al., "Graphcut textures: image and video synthesis using graph cuts", SIGGRAPH
/// 2003, doi:10.1145/882262.882264, equation 1, without its division), so that where both sides are
/// air, or both solid, a seam is nearly free. Added is `slope` times |(E(x + a) - E(y + a)) - (E(x
/// + b) - E(y + b))|, by how much the two sides disagree about the slope across the face: a step
/// between them can be evened out later, a kink cannot. Each piece in turn, the largest first,
/// takes what lowers the sum: a subset of its surroundings, by a minimum cut (the expansion move of
/// Boykov, Veksler, Zabih: "Fast approximate energy minimization via graph cuts", IEEE TPAMI
/// 23(11), 2001, section 5). It is the best subset, for a face's cost is a metric of offsets; but
/// not where it is squared: then the cut counts a face that it would have to take more for than the
/// triangle inequality allows as cheaper than it is (Rother et al., "Digital tapestry", CVPR 2005).
/// The sum never rises, either way.
///
/// `example` holds what is copied, `target` what the result should be near to; `origins`, of the
/// size of `target` (example 0, no turns), is improved in place. Pieces that do not touch move in
/// parallel; the same bytes at any number of threads. About O(samples near seams x reach). Throws
/// `Cancelled`, with origins still sound.
void refineSeams(const Array3D<float>& example, const Array3D<float>& target, Origins& origins,
                 const SeamOptions& options = {}, const Progress& progress = {});

/// Moves whole pieces, the largest first: each to the offset within `reach` samples of its own
/// along each axis for which its faces cost least, so that what both sides show lines up. A piece
/// whose source would leave the example stays. Returns how many moved. The faces' sum never rises.
/// O(samples + seam faces x (2 reach + 1)³). The same bytes at any number of threads. Throws
/// `Cancelled`, with origins still sound.
int alignPieces(const Array3D<float>& example, Origins& origins, int reach = 1,
                const SeamOptions& options = {}, const Progress& progress = {});

/// The sum that `refineSeams` lowers, in millionths of a unit: over all faces and samples.
std::int64_t seamCost(const Array3D<float>& example, const Array3D<float>& target,
                      const Origins& origins, const SeamOptions& options = {});

}  // namespace exemplar
