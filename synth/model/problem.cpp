// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/error.h"

namespace exemplar {
namespace {

std::string words(const Vec3i& v) {
  return std::to_string(v.x) + " x " + std::to_string(v.y) + " x " + std::to_string(v.z);
}

constexpr int kCellsBetweenChecks = 4096;  // whether the work was cancelled

CellOffset opposite(const CellOffset& o) { return {-o.x, -o.y, -o.z, -o.t}; }

/// A rule whose pairs hold under every symmetry of a group, as support tables; where the group
/// turns a rule's offset into one that has no rule, it gets one.
struct SymmetricRules {
  std::vector<CellOffset> offsets;
  std::vector<LabelSets> support;
};

SymmetricRules symmetricRules(const Adjacency& adjacency, const SymmetryGroup& group) {
  SymmetricRules rules;
  rules.support = supportTables(adjacency);
  for (const PairRule& r : adjacency.rules) rules.offsets.push_back(r.offset);
  if (group.elements() == 1) return rules;

  const auto find = [&](const CellOffset& o) {
    for (std::size_t r = 0; r < adjacency.rules.size(); ++r) {
      if (adjacency.rules[r].offset == o) return static_cast<int>(2 * r);
      if (adjacency.rules[r].offset == opposite(o)) return static_cast<int>(2 * r + 1);
    }
    return -1;
  };
  const auto turned = [&](int e, const CellOffset& o) {
    const Vec3i v = group.turned(e, {o.x, o.y, o.z});
    return CellOffset{v.x, v.y, v.z, o.t};
  };
  std::set<CellOffset> known(rules.offsets.begin(), rules.offsets.end());
  for (std::size_t r = 0; r < adjacency.rules.size(); ++r) {
    for (int e = 1; e < group.elements(); ++e) {
      const CellOffset o = turned(e, adjacency.rules[r].offset);
      if (known.contains(o) || known.contains(opposite(o))) continue;
      known.insert(o);
      rules.offsets.push_back(o);
    }
  }

  const int labels = adjacency.labelCount;
  const std::vector<LabelSets> given = std::move(rules.support);
  rules.support.clear();
  for (const CellOffset& o : rules.offsets) {
    LabelSets along(labels, labels), against(labels, labels);
    for (int b = 0; b < labels; ++b) {
      for (int c = 0; c < labels; ++c) {
        bool allowed = true;
        for (int e = 0; e < group.elements() && allowed; ++e) {
          const Label b2 = group.image(e, static_cast<Label>(b));
          const Label c2 = group.image(e, static_cast<Label>(c));
          const int table = find(turned(e, o));
          if (b2 == SymmetryGroup::kNoImage || c2 == SymmetryGroup::kNoImage) {
            allowed = false;
          } else if (table >= 0) {
            allowed = containsLabel(given[table][b2], c2);
          }
        }
        if (!allowed) continue;
        addLabel(along[b], c);
        addLabel(against[c], b);
      }
    }
    rules.support.push_back(std::move(along));
    rules.support.push_back(std::move(against));
  }
  return rules;
}

}  // namespace

ModelProblem::ModelProblem(const Adjacency& adjacency, const ModelOptions& options,
                           const Progress& progress)
    : adjacency_(&adjacency), options_(&options) {
  checkOptions();
  if (options.symmetry.any()) {
    symmetry_ = SymmetryGroup(options.symmetry, options.size, adjacency.labelCount);
  }
  buildCells(progress);
  buildNetwork(progress);
}

void ModelProblem::checkOptions() const {
  const ModelOptions& o = *options_;
  const Adjacency& a = *adjacency_;
  const auto label = [&](Label b, const std::string& where) {
    if (b >= a.labelCount) {
      throw InputError(where + ": names label " + std::to_string(b) + " and the example has " +
                       std::to_string(a.labelCount) + " labels, 0 to " +
                       std::to_string(a.labelCount - 1));
    }
  };
  if (o.size.x < 1 || o.size.y < 1 || o.size.z < 1) {
    throw InputError("`size` " + words(o.size) + ": each side must be 1 or more");
  }
  if (o.frames < 1)
    throw InputError("`frames` " + std::to_string(o.frames) + ": must be 1 or more");
  if (volume(o.size) > std::int64_t{1} << 30 || volume(o.size) * o.frames > std::int64_t{1} << 30) {
    throw InputError("`size` " + words(o.size) + ": too large; a result has at most 2^30 cells");
  }
  if (o.block.x < 2 || o.block.y < 2 || o.block.z < 2) {
    throw InputError("`block` " + words(o.block) + ": each side must be 2 or more");
  }
  if (o.rounds < 1 || o.rounds > 100)
    throw InputError("`rounds` " + std::to_string(o.rounds) + ": must be 1 to 100");
  if (o.budget < 1)
    throw InputError("`budget` " + std::to_string(o.budget) + ": must be 1 or more");
  if (!(o.moves >= 0) || o.moves > 1e6) throw InputError("`moves`: must be 0 to 1,000,000");
  if (!(o.copyPrice >= 0) || !std::isfinite(o.copyPrice))
    throw InputError("`copy-price`: must be 0 or more, and finite");
  if (o.patience < 0)
    throw InputError("`patience` " + std::to_string(o.patience) + ": must be 0 or more");

  for (const PairRule& r : a.rules) {
    if (!r.pairs.empty()) continue;
    const CellOffset& f = r.offset;
    const bool flat = (f.x == 0 || o.size.x == 1) && (f.y == 0 || o.size.y == 1) &&
                      (f.z == 0 || o.size.z == 1) && (f.t == 0 || o.frames == 1);
    if (!flat || (f.x == 0 && f.y == 0 && f.z == 0 && f.t == 0)) {
      const std::string axis = f.x ? "x" : f.y ? "y" : f.z ? "z" : "time";
      throw InputError("`size` " + words(o.size) + ": the example is one cell thick along " + axis +
                       ", so the result must be one cell thick there, too");
    }
  }
  const bool timed = std::any_of(a.rules.begin(), a.rules.end(),
                                 [](const PairRule& r) { return r.offset.t != 0; });
  if (o.frames > 1 && !timed) {
    throw InputError("`frames` " + std::to_string(o.frames) +
                     ": the example has no frames; several frames need an example of several");
  }

  for (std::size_t i = 0; i < o.pins.size(); ++i) {
    const PinnedCell& p = o.pins[i];
    const std::string name = "`pin` number " + std::to_string(i + 1);
    if (p.cell.x < 0 || p.cell.y < 0 || p.cell.z < 0 || p.cell.x >= o.size.x ||
        p.cell.y >= o.size.y || p.cell.z >= o.size.z || p.frame < 0 || p.frame >= o.frames) {
      throw InputError(name + ": cell (" + std::to_string(p.cell.x) + ", " +
                       std::to_string(p.cell.y) + ", " + std::to_string(p.cell.z) +
                       ") is outside the result of " + words(o.size) + " cells");
    }
    if (p.labels.empty()) throw InputError(name + ": allows no label; name one or more");
    for (const Label b : p.labels) label(b, name);
  }
  if (!o.mask.empty() && o.mask.size() != o.size) {
    throw InputError("`mask`: it is " + words(o.mask.size()) + " cells and the result is " +
                     words(o.size) + "; they must be the same size");
  }
  for (std::size_t i = 0; i < o.pins.size() && !o.mask.empty(); ++i) {
    if (o.mask[o.pins[i].cell] == 0) {
      throw InputError("`pin` number " + std::to_string(i + 1) +
                       ": its cell is in a hole of `mask`");
    }
  }
  if (!o.weights.empty() && static_cast<int>(o.weights.size()) != a.labelCount) {
    throw InputError("`weight`: there are " + std::to_string(o.weights.size()) + " weights and " +
                     std::to_string(a.labelCount) + " labels; give one weight for each label");
  }
  for (const double w : o.weights) {
    if (!(w >= 0) || !std::isfinite(w)) throw InputError("`weight`: must be 0 or more, and finite");
  }
  for (const WeightMap& m : o.weightMaps) {
    for (const Label b : m.labels) label(b, "`weight-map`");
    const Vec3i s = m.weight.size();
    if (s.x != o.size.x || s.y != o.size.y || (s.z != o.size.z && s.z != 1)) {
      throw InputError("`weight-map`: it is " + words(s) + " cells and the result is " +
                       words(o.size) + "; they must be the same size, or the map 1 high");
    }
    for (const float w : m.weight.values()) {
      if (!(w >= 0) || !std::isfinite(w)) {
        throw InputError("`weight-map`: must be 0 or more everywhere, and finite");
      }
    }
  }
  for (const SideRule& s : o.sides) {
    for (const Label b : s.labels) label(b, "`side`");
    if (s.kind == SideRule::Kind::Labels && s.labels.empty()) {
      throw InputError("`side`: allows no label; name one or more");
    }
  }
  for (const CountLimit& c : o.counts) {
    for (const Label b : c.labels) label(b, "`count`");
    if (c.least < 0 || (c.most && *c.most < c.least)) {
      throw InputError("`count`: at least " + std::to_string(c.least) + " and at most " +
                       (c.most ? std::to_string(*c.most) : "any number") +
                       " exclude each other; the least must be 0 or more and not above the most");
    }
  }
  for (const auto& set : o.connected) {
    for (const Label b : set) label(b, "`connect`");
  }
}

Vec3i ModelProblem::cellAt(std::int64_t position) const {
  const Vec3i& n = options_->size;
  std::int64_t p = position / options_->frames;
  const int k = static_cast<int>(p % n.z);
  p /= n.z;
  return {static_cast<int>(p / n.y), static_cast<int>(p % n.y), k};
}

std::vector<std::int32_t> ModelProblem::cellsIn(const CellBox& box, int first, int last) const {
  const ModelOptions& o = *options_;
  const auto indices = [](int begin, int end, int n, bool around) {
    std::vector<int> list;
    if (!around || end - begin >= n) {
      begin = around ? 0 : std::max(begin, 0);
      end = around ? n : std::min(end, n);
    }
    for (int i = begin; i < end; ++i) list.push_back(((i % n) + n) % n);
    std::sort(list.begin(), list.end());
    return list;
  };
  const auto xs = indices(box.begin.x, box.end.x, o.size.x, o.periodic.x);
  const auto ys = indices(box.begin.y, box.end.y, o.size.y, o.periodic.y);
  const auto zs = indices(box.begin.z, box.end.z, o.size.z, o.periodic.z);
  const auto ts = indices(first, last, o.frames, o.loop);
  std::vector<std::int32_t> cells;
  cells.reserve(xs.size() * ys.size() * zs.size() * ts.size());
  for (const int x : xs) {
    for (const int y : ys) {
      for (const int z : zs) {
        for (const int t : ts) {
          const int c = cell(position({x, y, z}, t));
          if (c >= 0) cells.push_back(c);
        }
      }
    }
  }
  // Images of one cell come several times, and in any order.
  if (!imageOf_.empty()) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }
  return cells;
}

std::vector<std::int32_t> ModelProblem::cellsAround(int cell, int reach) const {
  const std::int64_t at = positionOf_[cell];
  const Vec3i p = cellAt(at);
  const int frame = frameAt(at);
  const CellBox box{p, p + Vec3i{1, 1, 1}};
  return cellsIn(box.grown(reach), frame - reach, frame + reach + 1);
}

std::int64_t ModelProblem::offsetPosition(std::int64_t from, const CellOffset& offset) const {
  const ModelOptions& o = *options_;
  const Vec3i p = cellAt(from);
  int q[4] = {p.x + offset.x, p.y + offset.y, p.z + offset.z, frameAt(from) + offset.t};
  const int n[4] = {o.size.x, o.size.y, o.size.z, o.frames};
  const bool around[4] = {o.periodic.x, o.periodic.y, o.periodic.z, o.loop};
  for (int a = 0; a < 4; ++a) {
    if (q[a] >= 0 && q[a] < n[a]) continue;
    if (!around[a]) return -1;
    q[a] = ((q[a] % n[a]) + n[a]) % n[a];
  }
  return position({q[0], q[1], q[2]}, q[3]);
}

void ModelProblem::buildCells(const Progress& progress) {
  const ModelOptions& o = *options_;
  const std::int64_t count = positions();
  const auto hole = [&](std::int64_t at) { return !o.mask.empty() && o.mask[cellAt(at)] == 0; };
  cellOf_.assign(count, -1);
  const bool symmetric = o.symmetry.any();
  if (symmetric) imageOf_.assign(count, 0);

  const Vec3i part{o.size.x / o.symmetry.copies.x, o.size.y / o.symmetry.copies.y,
                   o.size.z / o.symmetry.copies.z};
  const auto images = [&](std::int64_t at, const auto& visit) {
    const Vec3i p = cellAt(at);
    for (int e = 0; e < symmetry_.elements(); ++e) {
      const Vec3i q = symmetry_.moved(e, p);
      for (int a = 0; a < o.symmetry.copies.x; ++a) {
        for (int b = 0; b < o.symmetry.copies.y; ++b) {
          for (int c = 0; c < o.symmetry.copies.z; ++c) {
            visit(position({(q.x + a * part.x) % o.size.x, (q.y + b * part.y) % o.size.y,
                            (q.z + c * part.z) % o.size.z},
                           frameAt(at)),
                  e);
          }
        }
      }
    }
  };

  const int labels = adjacency_->labelCount;
  std::vector<std::pair<std::int64_t, int>> orbit;
  std::vector<LabelWord> allowed;
  std::vector<LabelWord> unary;
  for (std::int64_t at = 0; at < count; ++at) {
    if (at % kCellsBetweenChecks == 0) progress.check();
    if (cellOf_[at] >= 0 || hole(at)) continue;
    const int cell = static_cast<int>(positionOf_.size());
    positionOf_.push_back(static_cast<std::int32_t>(at));
    cellOf_[at] = cell;
    if (!symmetric) continue;

    // The first element that takes the cell to an image determines its label; those that take
    // the cell to itself, or twice to one image, must agree on it.
    allowed.assign(wordsForLabels(labels), ~LabelWord{0});
    orbit.clear();
    images(at, [&](std::int64_t there, int e) {
      if (hole(there)) {
        throw InputError(
            "`mask`: it is less symmetric than the result; make it symmetric, or ask for "
            "less symmetry");
      }
      int first = -1;
      for (const auto& [q, f] : orbit) {
        if (q == there) first = f;
      }
      if (first < 0) {
        orbit.emplace_back(there, e);
        cellOf_[there] = cell;
        imageOf_[there] = static_cast<std::uint8_t>(e);
      }
      for (int b = 0; b < labels; ++b) {
        const Label image = symmetry_.image(e, static_cast<Label>(b));
        if (image == SymmetryGroup::kNoImage ||
            (first >= 0 && image != symmetry_.image(first, static_cast<Label>(b)))) {
          allowed[b / 64] &= ~(LabelWord{1} << (b % 64));
        }
      }
    });
    unary.insert(unary.end(), allowed.begin(), allowed.end());
  }
  if (positionOf_.empty()) throw InputError("`mask`: it leaves no cell; every cell is a hole");
  if (!symmetric) return;
  unary_ = LabelSets(labels, positionOf_.size());
  std::copy(unary.begin(), unary.end(), unary_.data());
}

void ModelProblem::buildNetwork(const Progress& progress) {
  SymmetricRules rules = symmetricRules(*adjacency_, symmetry_);
  network_.labels = adjacency_->labelCount;
  network_.cells = static_cast<int>(positionOf_.size());
  network_.slots = 2 * static_cast<int>(rules.offsets.size());
  network_.support = std::move(rules.support);
  offsets_ = std::move(rules.offsets);
  network_.neighbor.assign(static_cast<std::size_t>(network_.cells) * network_.slots,
                           network_.cells);

  std::map<std::pair<int, int>, int> relations;  // of a slot and an element
  std::vector<std::vector<LabelNetwork::Link>> links(imageOf_.empty() ? 0 : network_.cells);
  for (int c = 0; c < network_.cells; ++c) {
    if (c % kCellsBetweenChecks == 0) progress.check();
    for (int s = 0; s < network_.slots; ++s) {
      const CellOffset& o = offsets_[s / 2];
      const std::int64_t there = offsetPosition(positionOf_[c], s % 2 ? opposite(o) : o);
      if (there < 0 || cellOf_[there] < 0) continue;
      const int far = cellOf_[there];
      const int e = imageOf_.empty() ? 0 : imageOf_[there];
      if (e == 0) {
        network_.neighbor[static_cast<std::size_t>(c) * network_.slots + s] = far;
        continue;
      }
      const auto [known, fresh] =
          relations.try_emplace({s, e}, static_cast<int>(network_.support.size()));
      if (fresh) {
        LabelSets near(network_.labels, network_.labels), back(network_.labels, network_.labels);
        for (int b = 0; b < network_.labels; ++b) {
          for (int l = 0; l < network_.labels; ++l) {
            const Label shown = symmetry_.image(e, static_cast<Label>(l));
            if (shown == SymmetryGroup::kNoImage || !containsLabel(network_.support[s][b], shown)) {
              continue;
            }
            addLabel(near[b], l);
            addLabel(back[l], b);
          }
        }
        network_.support.push_back(std::move(near));
        network_.support.push_back(std::move(back));
      }
      links[c].push_back({far, known->second});
      links[far].push_back({c, known->second + 1});
    }
  }
  if (relations.empty()) return;
  network_.linkBegin.push_back(0);
  for (const auto& list : links) {
    network_.links.insert(network_.links.end(), list.begin(), list.end());
    network_.linkBegin.push_back(static_cast<std::int32_t>(network_.links.size()));
  }
}

ModelDemands ModelProblem::demands() const {
  ModelDemands all;
  all.pins.assign(options_->pins.size(), true);
  return all;
}

LabelSets ModelProblem::domains(const ModelDemands& demands, const Progress& progress) const {
  const ModelOptions& o = *options_;
  const int labels = network_.labels, words = network_.words();
  LabelSets all(labels, 1);
  for (int b = 0; b < labels; ++b) {
    const bool occurs = adjacency_->frequency[b] > 0 && (o.weights.empty() || o.weights[b] > 0);
    if (occurs) addLabel(all[0], b);
  }
  LabelSets domains(labels, network_.cells);
  for (int c = 0; c < network_.cells; ++c) {
    if (c % kCellsBetweenChecks == 0) progress.check();
    for (int w = 0; w < words; ++w) {
      domains[c][w] = all[0][w] & (unary_.rows() ? unary_[c][w] : ~LabelWord{0});
    }
  }
  // What a set of labels at a position, seen through the symmetry, leaves of the cell's labels.
  const auto restrict = [&](std::int64_t at, std::span<const LabelWord> allowed) {
    const int c = cellOf_[at];
    if (c < 0) return;
    const int e = imageOf_.empty() ? 0 : imageOf_[at];
    for (int w = 0; w < words && e == 0; ++w) domains[c][w] &= allowed[w];
    for (int b = 0; b < labels && e != 0; ++b) {
      const Label shown = symmetry_.image(e, static_cast<Label>(b));
      if (shown == SymmetryGroup::kNoImage || !containsLabel(allowed, shown)) {
        domains[c][b / 64] &= ~(LabelWord{1} << (b % 64));
      }
    }
  };

  LabelSets allowed(labels, 1);
  const auto allow = [&](const std::vector<Label>& list) {
    std::fill_n(allowed.data(), words, LabelWord{0});
    for (const Label b : list) addLabel(allowed[0], b);
  };
  for (int s = 0; s < 6; ++s) {
    const int axis = s / 2;
    const SideRule& rule = o.sides[s];
    if (!demands.sides[s] || o.periodic[axis] || !rule.excludes()) continue;
    allow(rule.kind == SideRule::Kind::Example ? adjacency_->sides[s] : rule.labels);
    const int fixed = s % 2 ? o.size[axis] - 1 : 0;
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    Vec3i p;
    p[axis] = fixed;
    for (p[u] = 0; p[u] < o.size[u]; ++p[u]) {
      for (p[v] = 0; p[v] < o.size[v]; ++p[v]) {
        for (int t = 0; t < o.frames; ++t) restrict(position(p, t), allowed[0]);
      }
    }
  }
  for (std::size_t i = 0; i < o.pins.size(); ++i) {
    if (!demands.pins[i]) continue;
    allow(o.pins[i].labels);
    restrict(position(o.pins[i].cell, o.pins[i].frame), allowed[0]);
  }
  for (const WeightMap& m : o.weightMaps) {
    for (std::int64_t at = 0; at < positions(); ++at) {
      if (at % kCellsBetweenChecks == 0) progress.check();
      const Vec3i p = cellAt(at);
      if (m.weight(p.x, p.y, m.weight.size().z == 1 ? 0 : p.z) > 0) continue;
      std::fill_n(allowed.data(), words, ~LabelWord{0});
      for (const Label b : m.labels) allowed[0][b / 64] &= ~(LabelWord{1} << (b % 64));
      restrict(at, allowed[0]);
    }
  }
  return domains;
}

double ModelProblem::weight(int cell, int label) const {
  const ModelOptions& o = *options_;
  double w = o.weights.empty() ? 1 : o.weights[label];
  for (const WeightMap& m : o.weightMaps) {
    if (std::find(m.labels.begin(), m.labels.end(), label) == m.labels.end()) continue;
    const Vec3i p = cellAt(positionOf_[cell]);
    w *= m.weight(p.x, p.y, m.weight.size().z == 1 ? 0 : p.z);
  }
  return w;
}

}  // namespace exemplar
