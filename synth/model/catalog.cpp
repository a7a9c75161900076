// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/catalog.h"

#include <algorithm>
#include <cassert>

namespace exemplar {

Catalog::Catalog(const LabelNetwork& network)
    : network_(&network), words_(network.words()), supported_(words_) {
  for (const LabelSets& table : network.support) tables_.push_back(table.data());
  restart();
}

void Catalog::restart() {
  const std::size_t cells = static_cast<std::size_t>(network_->cells);
  domains_.assign((cells + 1) * words_, 0);
  queue_.resize(std::max<std::size_t>(queue_.size(), 1024));
  ringMask_ = queue_.size() - 1;
  head_ = waiting_ = 0;
  queuedFrom_.assign(cells, kIdle);
  savedAt_.assign(cells, 0);
  lastStamp_ = 0;
  commit();
  reasonWords_ = 0;
  steps_ = 0;
}

bool Catalog::empty(int cell) const {
  const auto set = domain(cell);
  return std::all_of(set.begin(), set.end(), [](LabelWord w) { return w == 0; });
}

bool Catalog::decided(int cell) const {
  int words = 0;
  for (const LabelWord w : domain(cell)) {
    if (w == 0) continue;
    if ((w & (w - 1)) != 0 || words != 0) return false;
    ++words;
  }
  return words == 1;
}

int Catalog::firstLabel(int cell) const {
  const auto set = domain(cell);
  std::size_t w = 0;
  while (set[w] == 0) ++w;
  return static_cast<int>(w * 64 + std::countr_zero(set[w]));
}

/// Mostly few of many cells wait.
void Catalog::growQueue() {
  std::vector<std::int32_t> larger(2 * queue_.size());
  for (std::size_t i = 0; i < waiting_; ++i) larger[i] = queue_[(head_ + i) & ringMask_];
  queue_ = std::move(larger);
  ringMask_ = queue_.size() - 1;
  head_ = 0;
}

void Catalog::push(int cell, std::uint8_t from) {
  std::uint8_t& queued = queuedFrom_[cell];
  if (queued == kIdle) {
    queued = from;
    if (waiting_ == queue_.size()) growQueue();
    queue_[(head_ + waiting_++) & ringMask_] = cell;
  } else if (queued != from) {
    queued = kNoSlot;
  }
}

void Catalog::save(int cell) {
  if (marks_.empty() || savedAt_[cell] == marks_.back().stamp) return;
  trail_.push_back({cell, savedAt_[cell]});
  const auto set = domain(cell);
  trailWords_.insert(trailWords_.end(), set.begin(), set.end());
  if (reasonWords_ > 0) {
    const auto why = reason(cell);
    trailReasons_.insert(trailReasons_.end(), why.begin(), why.end());
  }
  savedAt_[cell] = marks_.back().stamp;
}

void Catalog::setDomain(int cell, std::span<const LabelWord> labels) {
  save(cell);
  std::copy(labels.begin(), labels.end(),
            domains_.begin() + static_cast<std::ptrdiff_t>(cell) * words_);
}

bool Catalog::propagateAll(const Progress& progress) {
  for (int c = 0; c < network_->cells; ++c) push(c, kNoSlot);
  for (int c = 0; c < network_->cells; ++c) {
    if (!empty(c)) continue;
    contradiction_ = contradictionFrom_ = c;
    forgetQueue();
    return false;
  }
  all_ = true;
  remembered_.resize(kRemembered * rememberedWords(), 0);
  const bool sound = propagate(progress);
  all_ = false;
  return sound;
}

const LabelWord* Catalog::rememberedSupport(const LabelWord* set) {
  LabelWord hash = 0;
  for (int w = 0; w < words_; ++w) {
    hash = (hash ^ set[w]) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  LabelWord* known = remembered_.data() + hash % kRemembered * rememberedWords();
  LabelWord* support = known + words_;
  // The empty set, which no cell holds here, marks a place that is not taken.
  if (std::equal(set, set + words_, known)) return support;
  std::copy(set, set + words_, known);
  std::fill_n(support, static_cast<std::size_t>(words_) * network_->slots, 0);
  forEachLabel({set, static_cast<std::size_t>(words_)}, [&](int b) {
    for (int s = 0; s < network_->slots; ++s) {
      const LabelWord* row = tables_[s] + static_cast<std::size_t>(b) * words_;
      for (int w = 0; w < words_; ++w) support[s * words_ + w] |= row[w];
    }
  });
  return support;
}

bool Catalog::holdsOnly(int cell, const LabelWord* set) const {
  const auto there = domain(cell);
  for (int w = 0; w < words_; ++w) {
    if ((there[w] & ~set[w]) != 0) return false;
  }
  return true;
}

bool Catalog::restrict(int cell, std::span<const LabelWord> labels) {
  LabelWord* set = domains_.data() + static_cast<std::size_t>(cell) * words_;
  LabelWord lost = 0, left = 0;
  for (int w = 0; w < words_; ++w) {
    lost |= set[w] & ~labels[w];
    left |= set[w] & labels[w];
  }
  if (lost != 0) {
    save(cell);
    for (int w = 0; w < words_; ++w) set[w] &= labels[w];
    push(cell, kNoSlot);
  }
  if (left == 0) {
    contradiction_ = contradictionFrom_ = cell;
    forgetQueue();
  }
  return left != 0;
}

bool Catalog::assign(int cell, int label) {
  std::fill(supported_.begin(), supported_.end(), 0);
  addLabel(supported_, label);
  return restrict(cell, supported_);
}

bool Catalog::remove(int cell, int label) {
  std::fill(supported_.begin(), supported_.end(), ~LabelWord{0});
  supported_[label / 64] &= ~(LabelWord{1} << (label % 64));
  return restrict(cell, supported_);
}

void Catalog::forgetQueue() {
  for (; waiting_ > 0; --waiting_, ++head_) queuedFrom_[queue_[head_ & ringMask_]] = kIdle;
}

bool Catalog::propagate(const Progress& progress) {
  bool sound;
  switch (words_) {
    case 1:
      sound = run<1>(progress);
      break;
    case 2:
      sound = run<2>(progress);
      break;
    case 3:
      sound = run<3>(progress);
      break;
    case 4:
      sound = run<4>(progress);
      break;
    default:
      sound = run<0>(progress);
      break;
  }
  if (!sound) forgetQueue();
  return sound;
}

/// Restricts a neighbor to the union of the support rows of `set`. The union is built row by row
/// and left as soon as it covers what the neighbor holds, which is the usual case.
template <int W>
inline bool Catalog::update(int cell, int from, const LabelWord* set, const LabelWord* table,
                            int slot) {
  const int words = W > 0 ? W : words_;
  LabelWord* there = domains_.data() + static_cast<std::size_t>(cell) * words;
  LabelWord fixed[W > 0 ? W : 1];
  LabelWord* missing = W > 0 ? fixed : supported_.data();
  for (int w = 0; w < words; ++w) missing[w] = there[w];
  for (int v = 0; v < words; ++v) {
    for (LabelWord rest = set[v]; rest; rest &= rest - 1) {
      const LabelWord* row =
          table + static_cast<std::size_t>(v * 64 + std::countr_zero(rest)) * words;
      LabelWord any = 0;
      for (int w = 0; w < words; ++w) any |= missing[w] &= ~row[w];
      if (any == 0) return true;
    }
  }
  save(cell);
  LabelWord left = 0;
  for (int w = 0; w < words; ++w) left |= there[w] &= ~missing[w];
  if (reasonWords_ > 0) {
    const auto mine = reason(cell);
    const auto theirs = reason(from);
    for (int w = 0; w < reasonWords_; ++w) mine[w] |= theirs[w];
  }
  if (left == 0) {
    contradiction_ = cell;
    contradictionFrom_ = from;
    return false;
  }
  push(cell,
       cell == from || slot >= network_->slots ? kNoSlot : static_cast<std::uint8_t>(slot ^ 1));
  return true;
}

namespace {

/// A mask of steps between two looks at whether to stop: a step scans words by the thousand where
/// labels are many.
constexpr std::int64_t stepsBetweenChecks(int words) { return words > 64 ? 0xF : 0x3FFF; }

}  // namespace

template <int W>
bool Catalog::run(const Progress& progress) {
  const int words = W > 0 ? W : words_;
  const int slots = network_->slots;
  std::vector<LabelWord> set(words);  // where their number is not known before
  while (waiting_ > 0) {
    const int cell = queue_[head_ & ringMask_];
    ++head_, --waiting_;
    const std::uint8_t skip = queuedFrom_[cell];
    queuedFrom_[cell] = kIdle;
    if ((++steps_ & stepsBetweenChecks(words)) == 0) progress.check();
    const LabelWord* source = domains_.data() + static_cast<std::size_t>(cell) * words;
    LabelWord fixed[W > 0 ? W : 1];
    LabelWord* mine = W > 0 ? fixed : set.data();
    for (int w = 0; w < words; ++w) mine[w] = source[w];
    const std::int32_t* near = network_->neighbor.data() + static_cast<std::size_t>(cell) * slots;
    const LabelWord* supported = all_ ? rememberedSupport(mine) : nullptr;
    for (int s = 0; s < slots; ++s) {
      if (s == skip || (all_ && holdsOnly(near[s], supported + s * words))) continue;
      if (!update<W>(near[s], cell, mine, tables_[s], s)) return false;
    }
    for (const LabelNetwork::Link& l : network_->linksOf(cell)) {
      if (!update<W>(l.cell, cell, mine, tables_[l.relation], l.relation)) return false;
    }
  }
  return true;
}

int Catalog::mark() {
  marks_.push_back({trail_.size(), ++lastStamp_});
  return static_cast<int>(marks_.size()) - 1;
}

void Catalog::undoTo(int mark) {
  assert(waiting_ == 0);
  const std::size_t begin = marks_[mark].trail;
  for (std::size_t i = trail_.size(); i-- > begin;) {
    const Saved& s = trail_[i];
    std::copy_n(trailWords_.begin() + static_cast<std::ptrdiff_t>(i) * words_, words_,
                domains_.begin() + static_cast<std::ptrdiff_t>(s.cell) * words_);
    savedAt_[s.cell] = s.stampBefore;
    std::copy_n(trailReasons_.begin() + static_cast<std::ptrdiff_t>(i) * reasonWords_, reasonWords_,
                reasons_.begin() + static_cast<std::ptrdiff_t>(s.cell) * reasonWords_);
  }
  trail_.resize(begin);
  trailWords_.resize(begin * words_);
  trailReasons_.resize(begin * reasonWords_);
  marks_.resize(mark);
}

void Catalog::commit() {
  trail_.clear();
  trailWords_.clear();
  trailReasons_.clear();
  marks_.clear();
}

void Catalog::keepReasons(int decisions) {
  assert(marks_.empty());
  reasonWords_ = (decisions + 63) / 64;
  reasons_.assign(static_cast<std::size_t>(network_->cells) * reasonWords_, 0);
}

}  // namespace exemplar
