// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/terminal.h"

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "core/json_text.h"
#include "core/platform.h"
#include "engine/result.h"
#include "engine/words.h"

namespace exemplar {
namespace {

using Json = nlohmann::ordered_json;

/// Progress is shown at most this often.
constexpr std::chrono::milliseconds kShowEvery{100};

std::atomic<bool> interruptedFlag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

void onInterrupt(int) {
  interruptedFlag.store(true);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace

Terminal::Terminal(ProgressStyle style, bool quiet)
    : style_(style),
      quiet_(quiet),
      progress_([this](std::string_view stage, double fraction) { show(stage, fraction); },
                &interruptedFlag) {
  if (style_ == ProgressStyle::Auto && platform::isTerminal(stderr)) style_ = ProgressStyle::Line;
  if (quiet_ && style_ != ProgressStyle::Json) style_ = ProgressStyle::None;
  interruptedFlag.store(false);
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  event(jsonText(
      Json{{"event", "start"}, {"version", EXEMPLAR_VERSION}, {"protocol", kProgressProtocol}}));
}

Terminal::~Terminal() {
  wipe();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void Terminal::event(const std::string& json) {
  if (style_ != ProgressStyle::Json) return;
  std::fprintf(stderr, "%s\n", json.c_str());
  std::fflush(stderr);
}

void Terminal::show(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  meter_.report(stage, fraction);
  if (style_ == ProgressStyle::None) return;
  if (style_ == ProgressStyle::Auto) {
    const std::string name(stage);
    if (stages_.insert(name).second) std::fprintf(stderr, "  %s ...\n", name.c_str());
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - shown_ < kShowEvery) return;
  shown_ = now;
  const ProgressState state = meter_.state();
  if (style_ == ProgressStyle::Json) {
    Json json{{"event", "progress"}, {"stage", state.stage}, {"fraction", state.fraction}};
    if (state.secondsLeft) json["seconds_left"] = *state.secondsLeft;
    event(jsonText(json));
    return;
  }
  char percent[16];
  std::snprintf(percent, sizeof percent, "%3.0f %%  ", 100 * state.fraction);
  std::string line = percent + state.stage;
  if (state.secondsLeft)
    line += ", about " + readableSeconds(std::ceil(*state.secondsLeft)) + " left";
  const std::size_t width = line.size();
  if (width < width_) line.append(width_ - width, ' ');
  width_ = width;
  std::fprintf(stderr, "\r%s", line.c_str());
  std::fflush(stderr);
}

void Terminal::wipe() {
  const std::lock_guard lock(mutex_);
  if (width_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(width_), "");
  width_ = 0;
}

void Terminal::say(std::string_view label, const std::string& text) {
  wipe();
  if (quiet_) return;
  std::printf("%-10.*s %s\n", static_cast<int>(label.size()), label.data(),
              spelledAsOptions(text).c_str());
  std::fflush(stdout);
}

void Terminal::print(const std::string& text) {
  wipe();
  std::fputs(text.c_str(), stdout);
}

void Terminal::warn(const std::string& text) {
  wipe();
  warnings_.push_back(spelledAsOptions(text));
  if (style_ == ProgressStyle::Json) {
    event(jsonText(Json{{"event", "warning"}, {"text", warnings_.back()}}));
  } else {
    std::fprintf(stderr, "warning: %s\n", warnings_.back().c_str());
  }
}

void Terminal::wrote(std::string_view label, const std::filesystem::path& path,
                     const std::string& text) {
  noteFile(path, label);
  say(label, text);
}

void Terminal::noteFile(const std::filesystem::path& path, std::string_view kind) {
  written_.push_back(path.string());
  event(jsonText(Json{{"event", "file"}, {"kind", std::string(kind)}, {"path", path.string()}}));
}

void Terminal::done() { event(jsonText(Json{{"event", "done"}})); }

void Terminal::fail(const std::string& text, int status, const Conflict* conflict) {
  wipe();
  const std::string line = spelledAsOptions(text.substr(0, text.find('\n')));
  if (style_ == ProgressStyle::Json) {
    Json json{{"event", "error"}, {"status", status}, {"text", line}};
    if (conflict != nullptr) {
      json["pins"] = conflict->pins;
      json["sides"] = conflict->sides;
    }
    event(jsonText(json));
  } else {
    std::fprintf(stderr, "exemplar: %s\n", line.c_str());
  }
}

std::string Terminal::interruption() const {
  if (written_.empty()) return "interrupted; no file was written";
  return "interrupted; written before: " + joined(written_, "and");
}

}  // namespace exemplar
