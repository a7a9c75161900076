// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/direction_field.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"

namespace exemplar::surface {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kIterations = 25;

using Complex = std::complex<double>;
using Matrix = Eigen::SparseMatrix<Complex>;
using Vector = Eigen::VectorXcd;

double wrapped(double angle) { return angle - 2 * kPi * std::round(angle / (2 * kPi)); }

/// The nodes and edges of each connected part, nodes with their number in it.
struct Parts {
  std::vector<std::vector<std::uint32_t>> nodes, edges;
  std::vector<std::uint32_t> number;

  explicit Parts(const Sheet& sheet)
      : nodes(sheet.components), edges(sheet.components), number(sheet.positions.size()) {
    for (std::uint32_t v = 0; v < sheet.positions.size(); ++v) {
      std::vector<std::uint32_t>& of = nodes[sheet.component[v]];
      number[v] = static_cast<std::uint32_t>(of.size());
      of.push_back(v);
    }
    for (std::uint32_t e = 0; e < sheet.edges.size(); ++e)
      edges[sheet.component[sheet.edges[e].a]].push_back(e);
  }
};

/// The lower half of a part's connection Laplacian, for directions to the power of `symmetry`.
Matrix connectionLaplacian(const Sheet& sheet, const Parts& parts, std::uint32_t part,
                           int symmetry) {
  const auto n = static_cast<Eigen::Index>(parts.nodes[part].size());
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(3 * parts.edges[part].size());
  for (const std::uint32_t e : parts.edges[part]) {
    const Sheet::Edge& edge = sheet.edges[e];
    const auto a = static_cast<Eigen::Index>(parts.number[edge.a]);
    const auto b = static_cast<Eigen::Index>(parts.number[edge.b]);
    const Complex turn = std::polar(edge.weight, symmetry * edge.transport());
    entries.emplace_back(a, a, edge.weight);
    entries.emplace_back(b, b, edge.weight);
    if (b > a) {
      entries.emplace_back(b, a, -turn);
    } else {
      entries.emplace_back(a, b, -std::conj(turn));
    }
  }
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void addDiagonal(Matrix& matrix, Eigen::Index row, double value) {
  matrix.coeffRef(row, row) += value;
}

/// The eigenvector of the smallest eigenvalue against the nodes' areas.
Vector smallest(const Sheet& sheet, const std::vector<std::uint32_t>& nodes, Matrix& matrix,
                const Progress& progress) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::VectorXd mass(n);
  for (Eigen::Index k = 0; k < n; ++k) mass[k] = sheet.areas[nodes[static_cast<std::size_t>(k)]];
  // The smallest eigenvalue is about the curvature over the area: a small part of that keeps the
  // matrix definite where the field is parallel.
  const double shift = 1e-3 / mass.sum();
  for (Eigen::Index k = 0; k < n; ++k) addDiagonal(matrix, k, shift * mass[k]);
  Eigen::SimplicialLDLT<Matrix> solver(matrix);
  const Random random(0, stream::kSurfaceField);
  Vector u(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto cell = static_cast<std::uint64_t>(nodes[static_cast<std::size_t>(k)]);
    u[k] = {random.uniform(-1, 1, cell, 0), random.uniform(-1, 1, cell, 1)};
  }
  for (int i = 0; i < kIterations; ++i) {
    progress.check();
    u = solver.solve(Vector(mass.cwiseProduct(u)));
    u /= std::sqrt(u.cwiseAbs2().dot(mass));
  }
  return u;
}

Vector guided(const Sheet& sheet, const std::vector<std::uint32_t>& nodes, int symmetry,
              const Guidance& guidance, Matrix& matrix) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Vector wanted(n);
  double total = 0;
  const double pull = 1 / (guidance.reach * guidance.reach);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::uint32_t v = nodes[static_cast<std::size_t>(k)];
    // What keeps the matrix definite where nothing is wanted is far too weak to be seen.
    const double weight = sheet.areas[v] * pull * guidance.confidence[v];
    addDiagonal(matrix, k, weight + 1e-9 * sheet.areas[v] * pull);
    wanted[k] = std::polar(weight, symmetry * guidance.angle[v]);
    total += weight;
  }
  if (total == 0) return {};
  Eigen::SimplicialLDLT<Matrix> solver(matrix);
  return solver.solve(wanted);
}

/// Taubin's matrix at a node: the mean of d d^T over directions d, each by the curvature along it.
class CurvatureTensor {
 public:
  CurvatureTensor() = default;
  CurvatureTensor(const Sheet& sheet, std::uint32_t v) {
    const Vec3d& normal = sheet.nodeNormals[v];
    const auto links = sheet.links(v);
    for (const Sheet::Link& link : links) {
      const Vec3d step = sheet.positions[link.node] - sheet.positions[v];
      const Vec3d inPlane = step - normal * dot(step, normal);
      const double square = dot(inPlane, inPlane);
      if (square == 0) continue;
      const double curvature = dot(sheet.nodeNormals[link.node] - normal, inPlane) / square;
      const Vec3d weighed = inPlane * (curvature / (square * static_cast<double>(links.size())));
      for (int axis = 0; axis < 3; ++axis) rows_[axis] += inPlane * weighed[axis];
    }
  }
  void add(const CurvatureTensor& other) {
    for (int axis = 0; axis < 3; ++axis) rows_[axis] += other.rows_[axis];
  }
  CurvatureTensor times(double factor) const {
    CurvatureTensor result = *this;
    for (Vec3d& row : result.rows_) row = row * factor;
    return result;
  }
  double along(const Vec3d& a, const Vec3d& b) const {
    return a.x * dot(rows_[0], b) + a.y * dot(rows_[1], b) + a.z * dot(rows_[2], b);
  }

 private:
  std::array<Vec3d, 3> rows_{};
};

/// Indices from how the field turns around each triangle beside what the surface does.
void findSingularities(const Sheet& sheet, DirectionField& field) {
  const int n = field.symmetry;
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    double transported = 0, turned = 0;
    for (int c = 0; c < 3; ++c) {
      const Sheet::Edge& edge = sheet.edges[sheet.sides[t][c]];
      const double sign = edge.a == sheet.triangles[t][c] ? 1 : -1;
      transported += sign * edge.transport();
      turned += sign * wrapped(n * (field.angle[edge.b] - field.angle[edge.a] - edge.transport()));
    }
    const double index = (turned + n * wrapped(transported)) / (2 * kPi);
    const double whole = std::round(index);
    field.residual = std::max(field.residual, std::abs(index - whole));
    if (whole != 0) field.singularities.push_back({t, static_cast<int>(whole)});
  }
}

}  // namespace

int DirectionField::turns(const Sheet::Edge& edge) const {
  const double off = angle[edge.b] - angle[edge.a] - edge.transport();
  const int turn = static_cast<int>(std::lround(symmetry * off / (2 * kPi)));
  return ((turn % symmetry) + symmetry) % symmetry;
}

DirectionField smoothestField(const Sheet& sheet, int symmetry, const Guidance* guidance,
                              const Progress& progress) {
  if (symmetry < 1 || symmetry > 6) throw InputError("`turns` must be 1, 2, 4 or 6");
  DirectionField field;
  field.symmetry = symmetry;
  field.angle.assign(sheet.positions.size(), 0);
  const Parts parts(sheet);
  progress.report("finding directions on the surface", 0);
  parallelFor(0, sheet.components, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const std::vector<std::uint32_t>& nodes = parts.nodes[p];
      Matrix matrix = connectionLaplacian(sheet, parts, static_cast<std::uint32_t>(p), symmetry);
      Vector u;
      if (guidance) u = guided(sheet, nodes, symmetry, *guidance, matrix);
      if (u.size() == 0) u = smallest(sheet, nodes, matrix, progress);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        field.angle[nodes[k]] = std::arg(u[static_cast<Eigen::Index>(k)]) / symmetry;
    }
  });
  findSingularities(sheet, field);
  progress.report("finding directions on the surface", 1);
  return field;
}

Guidance along(const Sheet& sheet, const Vec3d& direction, double reach) {
  Guidance guidance;
  guidance.reach = reach;
  const Vec3d wanted = normalized(direction);
  for (std::uint32_t v = 0; v < sheet.positions.size(); ++v) {
    const Vec3d& n = sheet.nodeNormals[v];
    const Vec3d inPlane = wanted - n * dot(wanted, n);
    guidance.angle.push_back(sheet.angleOf(v, inPlane));
    guidance.confidence.push_back(length(inPlane));
  }
  return guidance;
}

Guidance alongLeastCurvature(const Sheet& sheet, double reach) {
  const std::size_t n = sheet.positions.size();
  std::vector<CurvatureTensor> tensors(n), next(n);
  const auto forNodes = [&](const auto& work) {
    parallelFor(0, n, 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) work(static_cast<std::uint32_t>(v));
    });
  };
  forNodes([&](std::uint32_t v) { tensors[v] = CurvatureTensor(sheet, v); });
  // Bumps and dents, as of a scan, take each other away.
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    forNodes([&](std::uint32_t v) {
      CurvatureTensor sum = tensors[v];
      for (const Sheet::Link& link : sheet.links(v)) sum.add(tensors[link.node]);
      next[v] = sum.times(1.0 / static_cast<double>(sheet.links(v).size() + 1));
    });
    tensors.swap(next);
  }
  Guidance guidance{std::vector<double>(n, 0), std::vector<double>(n, 0), reach};
  forNodes([&](std::uint32_t v) {
    const Vec3d x = sheet.axes[v], y = cross(sheet.nodeNormals[v], x);
    const double xx = tensors[v].along(x, x), xy = tensors[v].along(x, y),
                 yy = tensors[v].along(y, y);
    const double mean = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
    // The eigenvalues are 3/8 of one principal curvature and 1/8 of the other.
    const double most = 3 * (mean + half) - (mean - half);
    const double least = 3 * (mean - half) - (mean + half);
    const double larger = std::max(std::abs(most), std::abs(least));
    if (larger == 0) return;
    const double ofMost = std::atan2(xy, (xx - yy) / 2) / 2;
    const double angle = std::abs(most) < std::abs(least) ? ofMost : ofMost + kPi / 2;
    const Vec3d direction = x * std::cos(angle) + y * std::sin(angle);
    guidance.angle[v] = sheet.angleOf(v, direction.z < 0 ? direction * -1.0 : direction);
    guidance.confidence[v] =
        std::abs(std::abs(most) - std::abs(least)) / larger * std::min(1.0, larger * reach);
  });
  return guidance;
}

Guidance alongStrokes(const Sheet& sheet, const std::vector<std::vector<Vec3d>>& strokes,
                      double width, double reach) {
  Guidance guidance;
  guidance.reach = reach;
  guidance.angle.assign(sheet.positions.size(), 0);
  guidance.confidence.assign(sheet.positions.size(), 0);
  parallelFor(0, sheet.positions.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double nearest = width;
      Vec3d direction{};
      for (const std::vector<Vec3d>& stroke : strokes) {
        for (std::size_t k = 0; k + 1 < stroke.size(); ++k) {
          const Vec3d step = stroke[k + 1] - stroke[k], off = sheet.positions[v] - stroke[k];
          const double square = dot(step, step);
          if (square == 0) continue;
          const double distance =
              length(off - step * std::clamp(dot(off, step) / square, 0.0, 1.0));
          if (distance >= nearest) continue;
          nearest = distance;
          direction = step;
        }
      }
      if (direction == Vec3d{}) continue;
      guidance.angle[v] = sheet.angleOf(static_cast<std::uint32_t>(v), direction);
      guidance.confidence[v] = 1;
    }
  });
  return guidance;
}

}  // namespace exemplar::surface
