// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/random.h"
#include "synth/continuous/arrangement.h"
#include "synth/continuous/figures.h"
#include "synth/continuous/labels.h"

/// Finding a label for every vertex.
namespace exemplar::continuous {

/// A set of labels for each vertex: `words` each, of which a class uses its own number.
class Domains {
 public:
  Domains(std::size_t vertices, int words)
      : words_(static_cast<std::size_t>(words)), bits_(vertices * words_) {}
  std::span<Word> operator[](std::size_t v) { return {bits_.data() + v * words_, words_}; }
  std::span<const Word> operator[](std::size_t v) const {
    return {bits_.data() + v * words_, words_};
  }
  std::size_t words() const { return words_; }
  bool operator==(const Domains&) const = default;

 private:
  std::size_t words_;
  std::vector<Word> bits_;
};

/// What is looked for: a label for each inner vertex of an arrangement, such that both ends of
/// every edge agree about it, and edges that end on the box's sides look like the background.
struct Puzzle {
  const Arrangement& arrangement;
  const FigureSet& figures;
  std::vector<VertexClass> classes;  ///< by kind
  Domains domains;                   ///< the labels that each inner vertex may have
  std::vector<int> background;       ///< of each inner vertex, the background's label; else -1

  const VertexClass& classOf(std::uint32_t v) const { return classes[arrangement.kind(v)]; }
};

/// The background at a point: air, or the ground below its height.
Figure backgroundAt(const Centrals& centrals, const std::optional<Ground>& ground,
                    const ExactPoint& point);

/// Throws `InputError` where the example lacks what the background needs, and `Cancelled`.
Puzzle makePuzzle(const Arrangement& arrangement, const FigureSet& figures,
                  const std::optional<Ground>& ground, const Progress& progress = {});

/// How likely what is built is at each vertex, beside the weights of figures.
struct Guide {
  std::vector<float>
      lift;  ///< of each vertex: log2 of the factor of a figure that is built all around
  std::vector<float> built;  ///< of each figure: the share of its cells that are built
};

/// Results whose built parts hang together: what is grown from seeds (thesis, section 4.6.2).
struct Growth {
  int seeds = 1;     ///< at most
  double share = 1;  ///< of the vertices that are built, from which on nothing more grows, 0..1
  /// Of the labels of each class: whether something is built there, and along each ray.
  std::vector<std::vector<std::uint8_t>> builtAt;
  std::vector<std::vector<std::vector<std::uint8_t>>> builtAlong;
};
/// What is built: all substances but air and the ground's.
Growth growthOf(const Puzzle& puzzle, std::optional<Substance> ground);

/// How a search ended.
enum class Found {
  All,      ///< every vertex has one label
  Nothing,  ///< there is no solution
  Spent,    ///< more choices failed than the budget allows
};

struct SearchCounts {
  std::int64_t choices = 0, failures = 0;
};

/// A search by choices and propagation, within sets of vertices that are free; all others keep what
/// they have. Several searches may run at once where no edge joins their vertices.
///
/// Domains are kept arc consistent: along every edge, each label of one end agrees with one of the
/// other's. Since a label determines its edge labels, that takes set operations only, and no
/// matrix of pairs; and since the edge labels that each vertex leaves are kept, a change costs one
/// look at each of its edges but for those along which something goes. Where a choice fails it is
/// undone, its label removed, and the search goes on from there (chronological backtracking), which
/// the papers leave out.
class Search {
 public:
  /// What searches on the same domains share.
  struct Marks {
    explicit Marks(const Puzzle& puzzle);
    std::vector<std::uint32_t> region, saved;
    std::vector<std::uint8_t> queued;
    /// Of each vertex in turn, from `firstEdge` on, the edge labels that its domain leaves
    /// (`EdgeRows`); those of a vertex in the queue are of before.
    std::vector<std::size_t> firstEdge;
    std::vector<Word> edges;
  };

  /// `weights` of figures, >= 0, say how likely they are chosen.
  Search(const Puzzle& puzzle, std::span<const double> weights, Domains& domains, Marks& marks);

  /// Makes the domains of `vertices` (ascending) arc consistent, with each other and with what is
  /// around them; false where one becomes empty. `region` is a number above 0 that no other search
  /// on the marks has used.
  bool begin(std::span<const std::uint32_t> vertices, std::uint32_t region);
  /// Makes the domains what they were after `begin`, which takes what they have changed since. Only
  /// where nothing else has changed them.
  void again();
  /// After `begin` or `again`: gives each of the vertices one label, in their order. After `Spent`
  /// and `Nothing` the domains are what they were after `begin`. Throws `Cancelled`.
  Found run(const Random& random, std::int64_t budget, const Progress& progress = {});
  /// The same in an order in which what is built grows from seeds: a vertex at random among those
  /// next to what is built, until nothing can grow; then all else stays as empty as it can.
  Found grow(const Growth& growth, const Random& random, std::int64_t budget,
             const Progress& progress = {});
  void setGuide(const Guide* guide) { guide_ = guide; }
  /// Backtracking off: the first failure ends the search, as in the papers.
  void setBacktracking(bool on) { backtracks_ = on; }
  const SearchCounts& counts() const { return counts_; }

 private:
  friend class Grower;
  struct Choice {
    std::size_t place;  // in vertices_
    std::size_t label;
    std::size_t trail;
    std::uint32_t vertex;
    int seeds = 0;  // in growth: with this choice
  };

  const EdgeRows& rowsOf(std::uint32_t v) const { return puzzle_.classOf(v).edgeRows; }
  void rowOf(std::uint32_t v, Word* row) const;
  Word* edgesOf(std::uint32_t v) { return marks_.edges.data() + marks_.firstEdge[v]; }
  bool narrow(std::uint32_t v, std::uint32_t ray, const Word* edges);
  bool tellAlong(std::uint32_t v, std::uint32_t ray);
  bool propagate();
  bool restrictByBorder(std::uint32_t v);
  void set(std::uint32_t v, const Word* labels);
  void undo(std::size_t trail);
  void enqueue(std::uint32_t v);
  std::size_t choose(std::uint32_t v, const Random& random);
  double weight(std::uint32_t v, std::uint32_t figure) const;
  bool assign(const Choice& choice);
  void takeBackTo(std::size_t choices);
  std::optional<Found> backtrack(std::int64_t failuresAllowed, std::size_t start);

  const Puzzle& puzzle_;
  std::span<const double> weights_;
  Domains& domains_;
  Marks& marks_;
  std::span<const std::uint32_t> vertices_;
  std::uint32_t region_ = 0, epoch_ = 0;
  std::size_t begun_ = 0;  // of the trail
  std::vector<std::uint32_t> queue_;
  std::vector<Choice> choices_;
  std::vector<std::uint32_t> trailVertices_;
  std::vector<Word> trailWords_;
  std::vector<Word> kept_, row_;                  // scratch: a domain, a row of edges
  std::vector<std::uint32_t> changed_;            // scratch: rays
  std::vector<std::uint32_t>* undone_ = nullptr;  // where given, takes the vertices that `undo` has
  const Guide* guide_ = nullptr;
  bool backtracks_ = true;
  SearchCounts counts_;
};

}  // namespace exemplar::continuous
