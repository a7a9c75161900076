// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/surface/coordinates.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "core/random.h"

namespace exemplar::surface {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kIterations = 20, kSpreadings = 15, kRelaxations = 30;
/// How far phases spread in one of these, in the shortest period.
constexpr double kSpread = 1.0 / 3;

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

double fraction(double t) { return t - std::floor(t); }
double wrapped(double t) { return t - std::round(t); }

/// What the field says about each edge, as both of its ends see it.
std::vector<Coordinates::Step> rawSteps(const Sheet& sheet, const DirectionField& field,
                                        const Mat2d& toLattice, double sample) {
  std::vector<Coordinates::Step> steps(sheet.edges.size());
  for (std::size_t e = 0; e < steps.size(); ++e) {
    const Sheet::Edge& edge = sheet.edges[e];
    const int turns = field.turns(edge);
    const double atA = edge.angleA - field.angle[edge.a];
    const double atB = edge.angleB + kPi - field.angle[edge.b] + 2 * kPi * turns / field.symmetry;
    const double half = edge.length / (sample * sheet.sizeOf(edge)) / 2;
    const Vec2d by{half * (std::cos(atA) + std::cos(atB)), half * (std::sin(atA) + std::sin(atB))};
    steps[e] = {toLattice * by, turns};
  }
  return steps;
}

/// The phases of some periods, found together: of node v numbers from v * 2 * families on, the
/// cosine and sine of each.
class StripeProblem {
 public:
  StripeProblem(const Sheet& sheet, const Coordinates& coordinates, int family, int families,
                double shortest)
      : sheet_(sheet),
        coordinates_(coordinates),
        family_(family),
        families_(families),
        shortest_(shortest) {}

  Vector solve(const Progress& progress) const {
    const Eigen::Index size = 2 * families_;
    const auto n = static_cast<Eigen::Index>(sheet_.positions.size()) * size;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t e = 0; e < sheet_.edges.size(); ++e) {
      const Sheet::Edge& edge = sheet_.edges[e];
      const Eigen::Index a = edge.a * size, b = edge.b * size;
      const Eigen::Matrix4d move = moveAlong(e);
      for (Eigen::Index r = 0; r < size; ++r) {
        entries.emplace_back(a + r, a + r, edge.weight);
        entries.emplace_back(b + r, b + r, edge.weight);
        for (Eigen::Index c = 0; c < size; ++c) {
          if (move(r, c) == 0) continue;
          if (b > a) {
            entries.emplace_back(b + r, a + c, -edge.weight * move(r, c));
          } else {
            entries.emplace_back(a + c, b + r, -edge.weight * move(r, c));
          }
        }
      }
    }
    Matrix matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Vector mass(n);
    for (Eigen::Index k = 0; k < n; ++k) mass[k] = sheet_.areas[static_cast<std::size_t>(k / size)];
    const double shift = 1e-3 * size / mass.sum();
    for (Eigen::Index k = 0; k < n; ++k) matrix.coeffRef(k, k) += shift * mass[k];
    progress.check();
    Eigen::SimplicialLDLT<Matrix> solver(matrix);
    const Random random(0, stream::kSurfaceStripes);
    Vector u(n);
    for (Eigen::Index k = 0; k < n; ++k)
      u[k] =
          random.uniform(-1, 1, static_cast<std::uint64_t>(k), static_cast<std::uint32_t>(family_));
    for (int i = 0; i < kIterations; ++i) {
      progress.check();
      u = solver.solve(Vector(mass.cwiseProduct(u)));
      u /= std::sqrt(u.cwiseAbs2().dot(mass));
    }
    // Such an eigenvector is nearly nothing where the field is hard to follow, and its phases there
    // are those of elsewhere, gone on. With a length of 1 at every node, spread over a part of a
    // period and made so again, rows begin and end where they must.
    const double spread = kSpread * shortest_;
    for (Eigen::Index k = 0; k < n; ++k) matrix.coeffRef(k, k) += mass[k] / (spread * spread);
    solver.factorize(matrix);
    for (int i = 0; i < kSpreadings; ++i) {
      progress.check();
      normalizeAll(u);
      u = solver.solve(Vector(mass.cwiseProduct(u)));
    }
    relax(u);
    return u;
  }

 private:
  /// From a node's numbers to those that its neighbor should have: phases go on along the edge, and
  /// are counted in the neighbor's direction.
  Eigen::Matrix4d moveAlong(std::size_t edge) const {
    const Coordinates::Step& step = coordinates_.steps[edge];
    Eigen::Matrix4d on = Eigen::Matrix4d::Zero();
    for (int f = 0; f < families_; ++f) {
      const double angle = 2 * kPi * (family_ + f == 0 ? step.by.x : step.by.y);
      const double c = std::cos(angle), s = std::sin(angle);
      on(2 * f, 2 * f) = on(2 * f + 1, 2 * f + 1) = c;
      on(2 * f, 2 * f + 1) = -s;
      on(2 * f + 1, 2 * f) = s;
    }
    const int symmetry = coordinates_.symmetry;
    const Mat2d back = coordinates_.turned((symmetry - step.turns) % symmetry);
    // A phase is one of the other end's, or the opposite of one: rows of +-1 and 0.
    const double rows[2][2] = {{back.xx, back.xy}, {back.yx, back.yy}};
    Eigen::Matrix4d turn = Eigen::Matrix4d::Zero();
    for (int f = 0; f < families_; ++f) {
      for (int g = 0; g < families_; ++g) {
        const double sign = std::round(rows[family_ + f][family_ + g]);
        if (sign == 0) continue;
        turn(2 * f, 2 * g) = 1;
        turn(2 * f + 1, 2 * g + 1) = sign;
      }
    }
    return turn * on;
  }

  void normalize(Vector& u, Eigen::Index at) const {
    for (Eigen::Index f = at; f < at + 2 * families_; f += 2) {
      const double r = std::hypot(u[f], u[f + 1]);
      if (r == 0) {
        u[f] = 1;
      } else {
        u[f] /= r;
        u[f + 1] /= r;
      }
    }
  }
  void normalizeAll(Vector& u) const {
    for (Eigen::Index at = 0; at < u.size(); at += 2 * families_) normalize(u, at);
  }

  /// Phases of length 1, each moved to the mean of what its neighbors say, in turn.
  void relax(Vector& u) const {
    const auto size = static_cast<Eigen::Index>(2 * families_);
    std::vector<Eigen::Matrix4d> moves(sheet_.edges.size());
    parallelFor(0, moves.size(), 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t e = begin; e < end; ++e) moves[e] = moveAlong(e);
    });
    const auto nodes = static_cast<std::uint32_t>(sheet_.positions.size());
    normalizeAll(u);
    for (int round = 0; round < kRelaxations; ++round) {
      for (std::uint32_t v = 0; v < nodes; ++v) {
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (const Sheet::Link& link : sheet_.links(v)) {
          Eigen::Vector4d there = Eigen::Vector4d::Zero();
          for (Eigen::Index r = 0; r < size; ++r) there[r] = u[link.node * size + r];
          const Eigen::Matrix4d& move = moves[link.edge];
          const double weight = sheet_.edges[link.edge].weight;
          if (link.forward) {
            sum += weight * (move.transpose() * there);
          } else {
            sum += weight * (move * there);
          }
        }
        for (Eigen::Index r = 0; r < size; ++r) u[v * size + r] = sum[r];
        normalize(u, v * size);
      }
    }
  }

  const Sheet& sheet_;
  const Coordinates& coordinates_;
  int family_, families_;
  double shortest_;  // of the periods, world units
};

void findPhases(const Sheet& sheet, Coordinates& c, double sample, const Progress& progress) {
  const int periods = c.lattice.periods;
  const bool together = c.symmetry == 4;
  const int problems = together ? 1 : periods, families = together ? 2 : 1;
  const double first = length(c.lattice.first), second = length(c.lattice.second);
  const double shortest = sample * (periods > 1 ? std::min(first, second) : first);
  std::vector<Vector> solutions(static_cast<std::size_t>(problems));
  parallelFor(0, solutions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      solutions[p] =
          StripeProblem(sheet, c, static_cast<int>(p), families, shortest).solve(progress);
  });
  c.phases.resize(sheet.positions.size());
  for (std::size_t v = 0; v < c.phases.size(); ++v) {
    for (int k = 0; k < periods; ++k) {
      const Vector& u = solutions[together ? 0 : static_cast<std::size_t>(k)];
      const Eigen::Index at = static_cast<Eigen::Index>(v) * 2 * families + (together ? 2 * k : 0);
      (k == 0 ? c.phases[v].x : c.phases[v].y) = fraction(std::atan2(u[at + 1], u[at]) / (2 * kPi));
    }
  }
  // What an edge adds is what the field says, and what then is missing to the phase beyond it.
  for (std::size_t e = 0; e < c.steps.size(); ++e) {
    const Sheet::Edge& edge = sheet.edges[e];
    Coordinates::Step& step = c.steps[e];
    const Vec2d there = c.turned(step.turns) * c.phases[edge.b];
    const Vec2d missing = there - c.phases[edge.a] - step.by;
    step.by.x += wrapped(missing.x);
    if (periods > 1) step.by.y += wrapped(missing.y);
  }
}

void findDislocations(const Sheet& sheet, Coordinates& c) {
  for (std::uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    Vec2d sum{};
    int turns = 0;
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t e = sheet.sides[t][corner];
      const bool forward = sheet.edges[e].a == sheet.triangles[t][corner];
      const Coordinates::Step step = c.along({0, e, forward});
      sum += c.turned(turns) * step.by;
      turns = (turns + step.turns) % c.symmetry;
    }
    const bool open = std::abs(sum.x) > 0.5 || (c.lattice.periods > 1 && std::abs(sum.y) > 0.5);
    if (turns == 0 && open) c.dislocations.push_back(t);
  }
}

}  // namespace

void Coordinates::setTurns() {
  turns_.clear();
  const Mat2d basis = lattice.basis();
  for (int k = 0; k < symmetry; ++k)
    turns_.push_back(basis.inverse() * rotation(k, symmetry) * basis);
}

Coordinates::Step Coordinates::along(const Sheet::Link& link) const {
  const Step& step = steps[link.edge];
  if (link.forward) return step;
  const int back = (symmetry - step.turns) % symmetry;
  return {-(turned(back) * step.by), back};
}

Coordinates integrate(const Sheet& sheet, const DirectionField& field, const Lattice& lattice,
                      double sample, const Progress& progress) {
  Coordinates c;
  c.symmetry = field.symmetry;
  c.lattice = lattice;
  c.setTurns();
  c.singular.assign(sheet.triangles.size(), 0);
  for (const Singularity& s : field.singularities) c.singular[s.triangle] = 1;
  c.steps = rawSteps(sheet, field, lattice.basis().inverse(), sample);
  if (lattice.periods > 0) {
    progress.report("laying the example's periods out", 0);
    findPhases(sheet, c, sample, progress);
    findDislocations(sheet, c);
  }
  progress.report("laying the example's periods out", 1);
  return c;
}

}  // namespace exemplar::surface
