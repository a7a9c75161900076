// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "definitions.h"

#include <limits>

#include "core/cells.h"
#include "core/error.h"
#include "search/block_pyramid.h"
#include "search/block_sum.h"

namespace exemplar {

template <class Sample>
double blockDistance(const Array3D<Sample>& source, const Vec3i& position,
                     const BlockQuery<Sample>& query) {
  const BlockSum<Sample> rows(query, source.size());
  return rows.distance(rows.sum(source.data() + source.index(position),
                                std::numeric_limits<SquaredSum<Sample>>::max()));
}

template double blockDistance(const Array3D<std::uint8_t>&, const Vec3i&,
                              const BlockQuery<std::uint8_t>&);
template double blockDistance(const Array3D<float>&, const Vec3i&, const BlockQuery<float>&);

std::vector<Array3D<double>> blockPyramid(const Array3D<double>& block) {
  const int side = block.size().x;
  if (block.size() != Vec3i{side, side, side})
    throw InputError("a block pyramid needs a cube of samples");
  std::vector<Array3D<double>> levels(static_cast<std::size_t>(blockLevels(side)) + 1);
  levels.back() = block;
  for (std::size_t l = levels.size() - 1; l > 0; --l) {
    const int half = levels[l].size().x / 2;
    Array3D<double> coarse({half, half, half});
    for (int k = 0; k < half; ++k)
      for (int j = 0; j < half; ++j)
        for (int i = 0; i < half; ++i) {
          double sum = 0;
          for (int c = 0; c < 8; ++c)
            sum += levels[l](2 * i + (c & 1), 2 * j + (c >> 1 & 1), 2 * k + (c >> 2));
          coarse(i, j, k) = sum / 8;
        }
    levels[l - 1] = std::move(coarse);
  }
  return levels;
}

double levelDistance(const Array3D<double>& a, const Array3D<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.count(); ++i) {
    const double d = a.data()[i] - b.data()[i];
    sum += d * d;
  }
  return sum / static_cast<double>(a.count());
}

}  // namespace exemplar
