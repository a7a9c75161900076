// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

constexpr std::size_t kEdgeWords = kMostEdgeLabels / 64;

/// A number for a vertex that depends only on where it is.
std::uint64_t placeOf(const ExactPoint& p) {
  std::uint64_t h = static_cast<std::uint64_t>(p.d);
  for (int axis = 0; axis < 3; ++axis) {
    h ^= static_cast<std::uint64_t>(p.n[axis]);
    h *= 0x9E3779B97F4A7C15u;
    h ^= h >> 29;
  }
  return h;
}

}  // namespace

Figure backgroundAt(const Centrals& centrals, const std::optional<Ground>& ground,
                    const ExactPoint& point) {
  if (!ground) return {0, {kAir}};
  const int side = ExactPlane{{0, 0, 1}, ground->height}.side(point);
  if (side != 0) return {0, {side > 0 ? kAir : ground->substance}};
  const auto found = std::ranges::find(centrals.normals(), Vec3l{0, 0, 1});
  return {Families{1} << (found - centrals.normals().begin()), {ground->substance, kAir}};
}

Puzzle makePuzzle(const Arrangement& arrangement, const FigureSet& figures,
                  const std::optional<Ground>& ground, const Progress& progress) {
  std::vector<VertexClass> classes = classesOf(arrangement, figures, progress);
  int words = 1;
  for (const VertexClass& c : classes) words = std::max(words, c.words);
  Puzzle puzzle{arrangement, figures, std::move(classes), Domains(arrangement.vertices(), words),
                std::vector<int>(arrangement.vertices(), -1)};
  parallelFor(0, arrangement.vertices(), 1024, [&](std::size_t from, std::size_t to) {
    for (auto v = static_cast<std::uint32_t>(from); v < to; ++v) {
      if (!arrangement.inside(v)) continue;
      const VertexClass& c = puzzle.classOf(v);
      const std::uint32_t figure =
          figures.find(backgroundAt(arrangement.centrals(), ground, arrangement.point(v)));
      const int label = figure == FigureSet::kNone ? -1 : c.labelOf(figure);
      if (label < 0)
        throw InputError("the example has no bare piece of air or ground to go on with around it");
      puzzle.background[v] = label;
      for (std::size_t l = 0; l < c.labels(); ++l) insert(puzzle.domains[v], l);
      // Edges to the sides of the box look like the background.
      const std::span<const EdgeEnd> ends = arrangement.ends(v);
      for (std::size_t r = 0; r < ends.size(); ++r) {
        if (ends[r].vertex != EdgeEnd::kNone && arrangement.inside(ends[r].vertex)) continue;
        const VertexClass::Along& along = c.rays[r];
        const Word* allowed =
            along.labelsWith.data() + along.edgeOf[label] * static_cast<std::size_t>(c.words);
        for (int w = 0; w < c.words; ++w) puzzle.domains[v][w] &= allowed[w];
      }
    }
  });
  return puzzle;
}

void Search::enqueue(std::uint32_t v) {
  if (marks_.queued[v]) return;
  marks_.queued[v] = 1;
  queue_.push_back(v);
}

void Search::set(std::uint32_t v, const Word* labels) {
  const std::span<Word> domain = domains_[v];
  if (marks_.saved[v] != epoch_) {
    marks_.saved[v] = epoch_;
    trailVertices_.push_back(v);
    trailWords_.insert(trailWords_.end(), domain.begin(), domain.end());
  }
  const auto words = static_cast<std::size_t>(puzzle_.classOf(v).words);
  std::copy(labels, labels + words, domain.begin());
}

void Search::undo(std::size_t trail) {
  const std::size_t words = domains_.words();
  while (trailVertices_.size() > trail) {
    const std::uint32_t v = trailVertices_.back();
    trailVertices_.pop_back();
    const std::span<Word> domain = domains_[v];
    std::copy(trailWords_.end() - static_cast<std::ptrdiff_t>(words), trailWords_.end(),
              domain.begin());
    trailWords_.resize(trailWords_.size() - words);
    marks_.saved[v] = 0;
  }
}

void Search::edgesOf(std::uint32_t v, std::uint32_t ray, Word* edges) const {
  const VertexClass& c = puzzle_.classOf(v);
  const VertexClass::Along& along = c.rays[ray];
  const Word* domain = domains_[v].data();
  const Word* mask = along.labelsWith.data();
  for (int w = 0; w <= (along.edges - 1) / 64; ++w) edges[w] = 0;
  if (c.words == 1) {
    const Word d = domain[0];
    for (int e = 0; e < along.edges; ++e)
      edges[e / 64] |= static_cast<Word>((mask[e] & d) != 0) << (e % 64);
    return;
  }
  for (int e = 0; e < along.edges; ++e, mask += c.words) {
    Word any = 0;
    for (int w = 0; w < c.words; ++w) any |= mask[w] & domain[w];
    edges[e / 64] |= static_cast<Word>(any != 0) << (e % 64);
  }
}

bool Search::narrow(std::uint32_t v, std::uint32_t ray, const Word* edges) {
  const VertexClass& c = puzzle_.classOf(v);
  const VertexClass::Along& along = c.rays[ray];
  const std::span<Word> domain = domains_[v];
  const auto words = static_cast<std::size_t>(c.words);
  std::array<Word, 64> keptHere;
  std::vector<Word> keptLong;
  Word* kept = keptHere.data();
  if (words > keptHere.size()) {
    keptLong.resize(words);
    kept = keptLong.data();
  }
  std::fill(kept, kept + words, 0);
  for (int e = 0; e < along.edges; e += 64) {
    for (Word rest = edges[e / 64]; rest != 0; rest &= rest - 1) {
      const Word* mask =
          along.labelsWith.data() + static_cast<std::size_t>(e + std::countr_zero(rest)) * words;
      for (std::size_t w = 0; w < words; ++w) kept[w] |= mask[w];
    }
  }
  Word changed = 0, left = 0;
  for (std::size_t w = 0; w < words; ++w) {
    kept[w] &= domain[w];
    changed |= kept[w] ^ domain[w];
    left |= kept[w];
  }
  if (changed == 0) return true;
  set(v, kept);
  if (left == 0) return false;
  enqueue(v);
  return true;
}

bool Search::propagate() {
  std::array<Word, kEdgeWords> edges;
  bool consistent = true;
  // First in, first out: what is near is settled before what follows from it.
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::uint32_t v = queue_[head];
    marks_.queued[v] = 0;
    if (!consistent) continue;
    const std::span<const EdgeEnd> ends = puzzle_.arrangement.ends(v);
    for (std::uint32_t r = 0; r < ends.size() && consistent; ++r) {
      const EdgeEnd& end = ends[r];
      if (end.vertex == EdgeEnd::kNone || marks_.region[end.vertex] != region_) continue;
      edgesOf(v, r, edges.data());
      consistent = narrow(end.vertex, end.ray, edges.data());
    }
  }
  queue_.clear();
  return consistent;
}

bool Search::restrictByBorder(std::uint32_t v) {
  std::array<Word, kEdgeWords> edges;
  const std::span<const EdgeEnd> ends = puzzle_.arrangement.ends(v);
  for (std::uint32_t r = 0; r < ends.size(); ++r) {
    const std::uint32_t w = ends[r].vertex;
    if (w == EdgeEnd::kNone || !puzzle_.arrangement.inside(w) || marks_.region[w] == region_)
      continue;
    edgesOf(w, ends[r].ray, edges.data());
    if (!narrow(v, r, edges.data())) return false;
  }
  return true;
}

bool Search::begin(std::span<const std::uint32_t> vertices, std::uint32_t region) {
  vertices_ = vertices;
  region_ = region;
  ++epoch_;
  trailVertices_.clear();
  trailWords_.clear();
  choices_.clear();
  queue_.clear();
  for (const std::uint32_t v : vertices_) {
    marks_.region[v] = region_;
    marks_.saved[v] = 0;
    marks_.queued[v] = 0;
  }
  bool consistent = true;
  for (const std::uint32_t v : vertices_) {
    consistent = consistent && restrictByBorder(v);
    if (consistent && count(domains_[v]) == 0) consistent = false;
    enqueue(v);
  }
  if (!consistent) {
    for (const std::uint32_t v : queue_) marks_.queued[v] = 0;
    queue_.clear();
    return false;
  }
  return propagate();
}

double Search::weight(std::uint32_t v, std::uint32_t figure) const {
  const double w = weights_[figure];
  return guide_ ? w * std::exp2(static_cast<double>(guide_->lift[v] * guide_->built[figure])) : w;
}

std::size_t Search::choose(std::uint32_t v, const Random& random) {
  const VertexClass& c = puzzle_.classOf(v);
  const std::span<const Word> domain = domains_[v];
  double sum = 0;
  forEach(domain, [&](std::size_t l) { sum += weight(v, c.figures[l]); });
  const double uniform = random.uniform(placeOf(puzzle_.arrangement.point(v)),
                                        static_cast<std::uint32_t>(counts_.failures));
  double rest = uniform * sum;
  std::size_t last = 0;
  bool decided = false;
  forEach(domain, [&](std::size_t l) {
    if (decided) return;
    if (sum <= 0) {  // nothing has a weight: the first one
      last = l;
      decided = true;
      return;
    }
    const double w = weight(v, c.figures[l]);
    if (w <= 0) return;
    last = l;
    rest -= w;
    decided = rest < 0;
  });
  return last;
}

/// Makes a choice and follows what it implies; false where that fails.
bool Search::assign(const Choice& choice) {
  choices_.push_back(choice);
  ++counts_.choices;
  ++epoch_;
  std::vector<Word> labels(domains_.words());
  insert(labels, choice.label);
  set(choice.vertex, labels.data());
  enqueue(choice.vertex);
  return propagate();
}

/// After a choice that failed: undoes it and removes its label, and so on while that fails, too.
/// The last of `choices_` that is left is the one before. Returns how the search ends, if it does.
std::optional<Found> Search::backtrack(std::int64_t failuresAllowed, std::size_t start) {
  std::vector<Word> labels(domains_.words());
  while (true) {
    ++counts_.failures;
    if (choices_.empty()) {
      undo(start);
      return Found::Nothing;
    }
    if (!backtracks_ || counts_.failures > failuresAllowed) {
      undo(start);
      choices_.clear();
      return Found::Spent;
    }
    const Choice last = choices_.back();
    choices_.pop_back();
    undo(last.trail);
    ++epoch_;
    const std::span<const Word> domain = domains_[last.vertex];
    std::ranges::copy(domain, labels.begin());
    erase(labels, last.label);
    set(last.vertex, labels.data());
    if (count(domains_[last.vertex]) == 0) continue;
    enqueue(last.vertex);
    if (propagate()) return std::nullopt;
  }
}

Found Search::run(const Random& random, std::int64_t budget, const Progress& progress) {
  const std::size_t start = trailVertices_.size();
  std::size_t place = 0, reported = 0;
  const std::int64_t failuresAllowed = counts_.failures + budget;
  while (true) {
    while (place < vertices_.size() && count(domains_[vertices_[place]]) == 1) ++place;
    if (place == vertices_.size()) return Found::All;
    if (place >= reported) {
      progress.report("choosing labels",
                      static_cast<double>(place) / static_cast<double>(vertices_.size()));
      reported = place + 256;
    } else {
      progress.check();
    }
    const std::uint32_t v = vertices_[place];
    if (assign({place, choose(v, random), trailVertices_.size(), v})) continue;
    // Vertices before the choice that is undone are decided.
    if (const std::optional<Found> end = backtrack(failuresAllowed, start)) return *end;
    place = choices_.empty() ? 0 : choices_.back().place;
  }
}

}  // namespace exemplar::continuous
