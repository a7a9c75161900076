// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// Searches in which what is built hangs together.

#include <algorithm>

#include "synth/continuous/search.h"

namespace exemplar::continuous {
namespace {

/// How often a place for a seed is drawn before what is undecided is gone through.
constexpr int kSeedDraws = 64;
/// Choices between two reports.
constexpr int kReport = 64;
/// Where a result has closed too early, or cannot be closed, it is opened again: how many of the
/// last choices that may undo at first, how many times as many where that was in vain, and which
/// share of what should grow is enough.
constexpr std::size_t kFirstWindow = 4, kWiden = 4;
/// How often a result that has closed too early is opened again, and how often without more growth.
constexpr int kReopenings = 200, kMostInVain = 24;
/// Failures without more that is built than before after which more is undone than one choice.
constexpr std::int64_t kStuck = 12;
constexpr double kFullyGrown = 0.9;

}  // namespace

Growth growthOf(const Puzzle& puzzle, std::optional<Substance> ground) {
  const auto built = [&](Substance s) { return s != kAir && s != ground; };
  Growth growth;
  growth.builtAt.resize(puzzle.classes.size());
  growth.builtAlong.resize(puzzle.classes.size());
  for (std::size_t k = 0; k < puzzle.classes.size(); ++k) {
    const VertexClass& c = puzzle.classes[k];
    if (c.labels() == 0) continue;
    growth.builtAlong[k].resize(c.central->rays.size());
    for (std::size_t l = 0; l < c.labels(); ++l) {
      growth.builtAt[k].push_back(std::ranges::any_of(c.cells(l), built));
      for (std::size_t r = 0; r < c.central->rays.size(); ++r) {
        growth.builtAlong[k][r].push_back(
            std::ranges::any_of(c.central->rays[r].around,
                                [&](std::uint32_t cell) { return built(c.cells(l)[cell]); }));
      }
    }
  }
  return growth;
}

/// One `Search::grow`: which vertex is decided next, and what it becomes.
class Grower {
 public:
  Grower(Search& search, const Growth& growth, const Random& random)
      : search_(search),
        growth_(growth),
        random_(random),
        start_(search.trailVertices_.size()),
        marks_(search.puzzle_.arrangement.vertices()) {}

  Found run(std::int64_t budget, const Progress& progress) {
    failuresAllowed_ = search_.counts_.failures + budget;
    for (const std::uint32_t v : search_.vertices_) see(v);
    while (true) {
      progress.check();
      if (search_.counts_.choices % kReport == 0)
        progress.report("growing", std::min(1.0, builtShare() / std::max(1e-9, growth_.share)));
      std::optional<Choice> choice;
      if (!hasGrown()) choice = onFrontier();
      if (!choice) choice = seed();
      if (!choice && reopen()) continue;
      if (!choice) choice = closing();
      if (!choice) {
        leaveEmpty();
        return Found::All;
      }
      choice->trail = search_.trailVertices_.size();
      choice->seeds = seeds_;
      if (search_.assign(*choice)) {
        follow(choice->trail);
        continue;
      }
      if (const std::optional<Found> end = takeBack()) return *end;
    }
  }

 private:
  using Choice = Search::Choice;

  bool isDecided(std::uint32_t v) const { return hasOne(search_.domains_[v]); }
  std::size_t labelOf(std::uint32_t v) const { return lowest(search_.domains_[v]); }
  bool isBuilt(std::uint32_t v) const {
    return isDecided(v) && growth_.builtAt[arrangement().kind(v)][labelOf(v)];
  }
  double builtShare() const {
    return static_cast<double>(built_) /
           static_cast<double>(std::max<std::size_t>(1, search_.vertices_.size()));
  }
  bool hasGrown() const { return builtShare() >= growth_.share; }
  bool mayBeEmpty(std::uint32_t v) const {
    const int background = search_.puzzle_.background[v];
    return background >= 0 && contains(search_.domains_[v], static_cast<std::size_t>(background));
  }
  /// Whether a vertex is undecided and next to something built.
  bool isNext(std::uint32_t v) const {
    if (search_.marks_.region[v] != search_.region_ || isDecided(v)) return false;
    const Arrangement& a = arrangement();
    return std::ranges::any_of(a.ends(v), [&](const EdgeEnd& end) {
      return end.vertex != EdgeEnd::kNone && a.inside(end.vertex) && isDecided(end.vertex) &&
             growth_.builtAlong[a.kind(end.vertex)][end.ray][labelOf(end.vertex)];
    });
  }
  void addNeighbors(std::uint32_t v) {
    for (const EdgeEnd& end : arrangement().ends(v)) {
      if (end.vertex != EdgeEnd::kNone && arrangement().inside(end.vertex)) add(end.vertex);
    }
  }
  void add(std::uint32_t v) {
    if (marks_[v] & kOnFrontier) return;
    marks_[v] |= kOnFrontier;
    frontier_.push_back(v);
  }
  /// Notes what a vertex has become: built, or to be decided though it cannot be empty.
  void see(std::uint32_t v) {
    const bool built = isBuilt(v);
    if (built != ((marks_[v] & kBuilt) != 0)) {
      marks_[v] ^= kBuilt;
      built_ += built ? 1 : -1;
    }
    if (built) addNeighbors(v);
    if ((marks_[v] & kOpen) == 0 && !isDecided(v) && !mayBeEmpty(v)) {
      marks_[v] |= kOpen;
      open_.push_back(v);
    }
  }
  /// Takes back choices by `undo`; what that frees comes back to the frontier.
  template <class Undo>
  auto takingBack(Undo&& undo) {
    undone_.clear();
    search_.undone_ = &undone_;
    const auto result = undo();
    search_.undone_ = nullptr;
    for (const std::uint32_t v : undone_) {
      see(v);
      add(v);
    }
    seeds_ = search_.choices_.empty() ? 0 : search_.choices_.back().seeds;
    return result;
  }
  /// Sees to all that has changed.
  void follow(std::size_t trail) {
    for (std::size_t n = trail; n < search_.trailVertices_.size(); ++n)
      see(search_.trailVertices_[n]);
  }

  /// The label with the least of anything built, the background's where it may be.
  std::size_t emptiest(std::uint32_t v) const {
    const std::span<const Word> domain = search_.domains_[v];
    if (mayBeEmpty(v)) return static_cast<std::size_t>(search_.puzzle_.background[v]);
    std::size_t best = 0;
    std::ptrdiff_t least = -1;
    forEach(domain, [&](std::size_t l) {
      const std::span<const Substance> cells = search_.puzzle_.classOf(v).cells(l);
      const std::ptrdiff_t some =
          static_cast<std::ptrdiff_t>(cells.size()) - std::ranges::count(cells, kAir);
      if (least >= 0 && some >= least) return;
      least = some;
      best = l;
    });
    return best;
  }

  /// A vertex at random next to what is built.
  std::optional<Choice> onFrontier() {
    while (!frontier_.empty()) {
      const std::uint32_t n =
          random_.below(static_cast<std::uint32_t>(frontier_.size()), draw_++, 1);
      const std::uint32_t v = frontier_[n];
      frontier_[n] = frontier_.back();
      frontier_.pop_back();
      marks_[v] &= static_cast<std::uint8_t>(~kOnFrontier);
      if (!isNext(v)) continue;
      return Choice{0, search_.choose(v, random_), 0, v};
    }
    return std::nullopt;
  }

  /// Something built at an undecided vertex, where groups are missing.
  std::optional<Choice> seed() {
    while (seeds_ < growth_.seeds && !hasGrown()) {
      ++seeds_;
      for (int n = 0; n < kSeedDraws; ++n) {
        const auto size = static_cast<std::uint32_t>(search_.vertices_.size());
        const std::uint32_t v = search_.vertices_[random_.below(size, draw_++, 2)];
        if (isDecided(v)) continue;
        std::vector<std::size_t> labels;
        forEach(search_.domains_[v], [&](std::size_t l) {
          const std::uint32_t figure = search_.puzzle_.classOf(v).figures[l];
          if (growth_.builtAt[arrangement().kind(v)][l] && search_.weight(v, figure) > 0)
            labels.push_back(l);
        });
        if (labels.empty()) continue;
        const auto many = static_cast<std::uint32_t>(labels.size());
        return Choice{0, labels[random_.below(many, draw_++, 3)], 0, v};
      }
    }
    return std::nullopt;
  }

  /// Undoes some of the last choices where nothing can grow any more and too little has grown.
  bool reopen() {
    if (closing_ || builtShare() >= kFullyGrown * growth_.share) return false;
    inVain_ = built_ > mostBuilt_ ? 0 : inVain_ + 1;
    if (inVain_ > kMostInVain || ++reopened_ > kReopenings) return false;
    return open(search_.choices_.size());
  }
  /// Undoes some choices before the one of a number: more and more of them until more has grown.
  bool open(std::size_t before) {
    if (search_.counts_.failures >= failuresAllowed_ || before < 2) return false;
    stuck_ = 0;
    if (built_ > mostBuilt_) window_ = kFirstWindow;
    mostBuilt_ = std::max(mostBuilt_, built_);
    const std::size_t most = std::min(window_, before - 1);
    window_ = most < window_ ? kFirstWindow : kWiden * window_;
    const std::size_t some = 1 + random_.below(static_cast<std::uint32_t>(most), draw_++, 4);
    takingBack([&] {
      search_.takeBackTo(before - some);
      return true;
    });
    closing_ = false;
    return true;
  }

  /// An undecided vertex that cannot be empty, as empty as it can be.
  std::optional<Choice> closing() {
    if (!closing_) beforeClosing_ = search_.choices_.size();
    closing_ = true;
    while (!open_.empty()) {
      const std::uint32_t v = open_.back();
      if (isDecided(v) || mayBeEmpty(v)) {
        open_.pop_back();
        marks_[v] &= static_cast<std::uint8_t>(~kOpen);
        continue;
      }
      return Choice{0, emptiest(v), 0, v};
    }
    return std::nullopt;
  }

  /// Gives all that is undecided the background's label. Each may have it, so it agrees with what
  /// is decided around it; and with each other's, since the background is a result.
  void leaveEmpty() {
    ++search_.epoch_;
    std::vector<Word>& only = search_.kept_;
    for (const std::uint32_t v : search_.vertices_) {
      if (isDecided(v)) continue;
      std::ranges::fill(only, 0);
      insert(only, static_cast<std::size_t>(search_.puzzle_.background[v]));
      search_.set(v, only.data());
    }
  }

  /// Undoes a choice that failed.
  std::optional<Found> takeBack() {
    if (const std::optional<Found> end =
            takingBack([&] { return search_.backtrack(failuresAllowed_, start_); }))
      return end;
    follow(search_.choices_.empty() ? start_ : search_.choices_.back().trail);
    closing_ = closing_ && search_.choices_.size() >= beforeClosing_;
    if (built_ > mostBuilt_) {
      mostBuilt_ = built_;
      window_ = kFirstWindow;
      stuck_ = 0;
    } else if (++stuck_ >= kStuck) {
      open(closing_ ? beforeClosing_ : search_.choices_.size());
    }
    return std::nullopt;
  }

  const Arrangement& arrangement() const { return search_.puzzle_.arrangement; }

  Search& search_;
  const Growth& growth_;
  const Random& random_;
  std::size_t start_;  // of the trail
  // Of vertices: whether they are in `frontier_`, in `open_`, and counted as built.
  static constexpr std::uint8_t kOnFrontier = 1, kOpen = 2, kBuilt = 4;
  std::vector<std::uint8_t> marks_;
  std::vector<std::uint32_t> frontier_;  // next to something built, or were that before
  std::vector<std::uint32_t> open_;      // cannot be empty, or could not before
  std::vector<std::uint32_t> undone_;    // scratch
  std::uint64_t draw_ = 0;
  int seeds_ = 0;
  std::int64_t failuresAllowed_ = 0;
  std::int64_t built_ = 0;             // vertices
  std::int64_t mostBuilt_ = 0;         // when something was taken back
  int reopened_ = 0, inVain_ = 0;      // times that it was opened, and the last that were no use
  std::int64_t stuck_ = 0;             // failures since then
  std::size_t window_ = kFirstWindow;  // choices of which some are undone when it is opened next
  bool closing_ = false;               // nothing grows any more
  std::size_t beforeClosing_ = 0;      // choices
};

Found Search::grow(const Growth& growth, const Random& random, std::int64_t budget,
                   const Progress& progress) {
  return Grower(*this, growth, random).run(budget, progress);
}

}  // namespace exemplar::continuous
