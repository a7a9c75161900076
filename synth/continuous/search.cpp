// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/continuous/search.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"

namespace exemplar::continuous {
namespace {

/// In `Marks::saved`: while changes are undone, whether a vertex has none left.
constexpr std::uint32_t kUndone = 0xFFFFFFFFu;

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

Search::Marks::Marks(const Puzzle& puzzle)
    : region(puzzle.arrangement.vertices()), saved(region.size()), queued(region.size()) {
  firstEdge.reserve(region.size() + 1);
  firstEdge.push_back(0);
  for (std::uint32_t v = 0; v < region.size(); ++v)
    firstEdge.push_back(firstEdge.back() + puzzle.classOf(v).edgeRows.words());
  edges.resize(firstEdge.back());
}

Search::Search(const Puzzle& puzzle, std::span<const double> weights, Domains& domains,
               Marks& marks)
    : puzzle_(puzzle), weights_(weights), domains_(domains), marks_(marks), kept_(domains.words()) {
  std::size_t widest = 0;
  for (const VertexClass& c : puzzle.classes) widest = std::max(widest, c.edgeRows.words());
  row_.resize(widest);
}

void Search::rowOf(std::uint32_t v, Word* row) const {
  const std::span<const Word> domain = domains_[v];
  const VertexClass& c = puzzle_.classOf(v);
  c.edgeRows.of(domain.first(static_cast<std::size_t>(c.words)), row);
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
  for (std::size_t n = trailVertices_.size(); n-- > trail;) {
    const std::uint32_t v = trailVertices_[n];
    std::copy_n(trailWords_.data() + n * words, words, domains_[v].begin());
    marks_.saved[v] = kUndone;
  }
  // A vertex may have several records; it needs one row.
  for (std::size_t n = trail; n < trailVertices_.size(); ++n) {
    const std::uint32_t v = trailVertices_[n];
    if (marks_.saved[v] != kUndone) continue;
    marks_.saved[v] = 0;
    rowOf(v, edgesOf(v));
    if (undone_) undone_->push_back(v);
  }
  trailVertices_.resize(trail);
  trailWords_.resize(trail * words);
}

/// Takes the labels of `v` that have an edge label outside of `edges` along a ray; `edges` are
/// words of edge labels, as in the row of `v`. False where none is left.
bool Search::narrow(std::uint32_t v, std::uint32_t ray, const Word* edges) {
  const VertexClass& c = puzzle_.classOf(v);
  const auto words = static_cast<std::size_t>(c.words);
  const EdgeRows& rows = c.edgeRows;
  const Word* own = edgesOf(v) + rows.start(ray);
  const std::uint32_t edgeWords = rows.start(ray + 1) - rows.start(ray);
  const Word* labelsWith = c.rays[ray].labelsWith.data();
  const std::span<Word> domain = domains_[v];
  bool narrows = false;
  for (std::uint32_t e = 0; e < edgeWords; ++e) {
    for (Word gone = own[e] & ~edges[e]; gone != 0; gone &= gone - 1) {
      const Word* mask =
          labelsWith + (e * 64 + static_cast<std::size_t>(std::countr_zero(gone))) * words;
      if (!narrows) std::copy_n(domain.begin(), words, kept_.begin());
      narrows = true;
      for (std::size_t w = 0; w < words; ++w) kept_[w] &= ~mask[w];
    }
  }
  if (!narrows) return true;
  Word changed = 0, left = 0;
  for (std::size_t w = 0; w < words; ++w) {
    changed |= kept_[w] ^ domain[w];
    left |= kept_[w];
  }
  if (changed == 0) return true;
  set(v, kept_.data());
  if (left == 0) return false;
  enqueue(v);
  return true;
}

/// Has the other end of an edge follow what this one leaves along it.
bool Search::tellAlong(std::uint32_t v, std::uint32_t ray) {
  const EdgeEnd& end = puzzle_.arrangement.ends(v)[ray];
  if (end.vertex == EdgeEnd::kNone || marks_.region[end.vertex] != region_) return true;
  return narrow(end.vertex, end.ray, edgesOf(v) + rowsOf(v).start(ray));
}

bool Search::propagate() {
  bool consistent = true;
  // First in, first out: what is near is settled before what follows from it.
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const std::uint32_t v = queue_[head];
    marks_.queued[v] = 0;
    if (!consistent) continue;
    const EdgeRows& rows = rowsOf(v);
    const auto rays = static_cast<std::uint32_t>(puzzle_.arrangement.ends(v).size());
    rowOf(v, row_.data());
    Word* edges = edgesOf(v);
    changed_.clear();
    for (std::uint32_t r = 0; r < rays; ++r) {
      Word change = 0;
      for (std::uint32_t w = rows.start(r); w < rows.start(r + 1); ++w)
        change |= row_[w] ^ edges[w];
      if (change != 0) changed_.push_back(r);
    }
    std::copy_n(row_.data(), rows.words(), edges);
    for (const std::uint32_t r : changed_)
      if (consistent) consistent = tellAlong(v, r);
  }
  queue_.clear();
  return consistent;
}

bool Search::restrictByBorder(std::uint32_t v) {
  const std::span<const EdgeEnd> ends = puzzle_.arrangement.ends(v);
  for (std::uint32_t r = 0; r < ends.size(); ++r) {
    const std::uint32_t w = ends[r].vertex;
    if (w == EdgeEnd::kNone || !puzzle_.arrangement.inside(w) || marks_.region[w] == region_)
      continue;
    rowOf(w, row_.data());
    if (!narrow(v, r, row_.data() + rowsOf(w).start(ends[r].ray))) return false;
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
  // Most vertices of a class have the same domain as the last one of it, and so the same row.
  std::vector<std::uint32_t> lastOf(puzzle_.classes.size(), EdgeEnd::kNone);
  for (const std::uint32_t v : vertices_) {
    marks_.region[v] = region_;
    marks_.saved[v] = 0;
    marks_.queued[v] = 0;
    std::uint32_t& last = lastOf[puzzle_.arrangement.kind(v)];
    if (last != EdgeEnd::kNone && std::ranges::equal(domains_[v], domains_[last]))
      std::copy_n(edgesOf(last), rowsOf(v).words(), edgesOf(v));
    else
      rowOf(v, edgesOf(v));
    last = v;
  }
  bool consistent = true;
  for (const std::uint32_t v : vertices_) {
    consistent = consistent && restrictByBorder(v) && count(domains_[v]) > 0;
    const auto rays = static_cast<std::uint32_t>(puzzle_.arrangement.ends(v).size());
    for (std::uint32_t r = 0; r < rays && consistent; ++r) consistent = tellAlong(v, r);
  }
  if (!consistent) {
    for (const std::uint32_t v : queue_) marks_.queued[v] = 0;
    queue_.clear();
    return false;
  }
  consistent = propagate();
  begun_ = trailVertices_.size();
  return consistent;
}

void Search::again() {
  undo(begun_);
  choices_.clear();
  ++epoch_;
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
  std::ranges::fill(kept_, 0);
  insert(kept_, choice.label);
  set(choice.vertex, kept_.data());
  enqueue(choice.vertex);
  return propagate();
}

/// After a choice that failed: undoes it and removes its label, and so on while that fails, too.
/// The last of `choices_` that is left is the one before. Returns how the search ends, if it does.
std::optional<Found> Search::backtrack(std::int64_t failuresAllowed, std::size_t start) {
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
    std::ranges::copy(domains_[last.vertex], kept_.begin());
    takeOut(kept_, last.label);
    set(last.vertex, kept_.data());
    if (count(domains_[last.vertex]) == 0) continue;
    enqueue(last.vertex);
    if (propagate()) return std::nullopt;
  }
}

/// Takes back all but the first choices, which is a failure of the last ones.
void Search::takeBackTo(std::size_t choices) {
  if (choices >= choices_.size()) return;
  ++counts_.failures;
  undo(choices_[choices].trail);
  choices_.resize(choices);
}

Found Search::run(const Random& random, std::int64_t budget, const Progress& progress) {
  const std::size_t start = trailVertices_.size();
  std::size_t place = 0, reported = 0;
  const std::int64_t failuresAllowed = counts_.failures + budget;
  while (true) {
    while (place < vertices_.size() && hasOne(domains_[vertices_[place]])) ++place;
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
