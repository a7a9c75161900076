// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/terminal.h"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace exemplar {
namespace {

std::atomic<bool> interruptedFlag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

void onInterrupt(int) {
  interruptedFlag.store(true);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

double secondsSince(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

}  // namespace

Terminal::Terminal(bool quiet)
    : quiet_(quiet),
      interactive_(isatty(STDERR_FILENO) != 0),
      progress_([this](std::string_view stage, double fraction) { show(stage, fraction); },
                &interruptedFlag) {
  interruptedFlag.store(false);
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
}

Terminal::~Terminal() {
  wipe();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void Terminal::step(std::string_view stage) {
  stopIfInterrupted();
  show(stage, 0);
}

void Terminal::stopIfInterrupted() const {
  if (progress_.cancelled()) throw Interrupted();
}

void Terminal::show(std::string_view stage, double fraction) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const bool begins = stage != stage_;
  if (begins) {
    stage_ = stage;
    began_ = std::chrono::steady_clock::now();
  }
  if (!interactive_) {
    if (begins) std::fprintf(stderr, "  %s ...\n", stage_.c_str());
    return;
  }
  if (!begins && secondsSince(shown_) < 0.1) return;
  shown_ = std::chrono::steady_clock::now();
  std::string line = "  " + stage_;
  const double elapsed = secondsSince(began_);
  if (fraction > 0) {
    char percent[16];
    std::snprintf(percent, sizeof percent, "  %3.0f %%", 100 * fraction);
    line += percent;
    if (elapsed > 1 && fraction > 0.02) {
      line +=
          "  about " + readableSeconds(std::ceil(elapsed * (1 - fraction) / fraction)) + " left";
    }
  } else {
    line += " ...";
  }
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
  stage_.clear();
}

void Terminal::say(std::string_view label, const std::string& text) {
  wipe();
  if (quiet_) return;
  std::printf("%-9.*s %s\n", static_cast<int>(label.size()), label.data(), text.c_str());
  std::fflush(stdout);
}

std::string withThousands(long long n) {
  std::string digits = std::to_string(n < 0 ? -n : n);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) digits.insert(at, ",");
  return n < 0 ? "-" + digits : digits;
}

std::string readableSeconds(double seconds) {
  char text[32];
  if (seconds < 10) {
    std::snprintf(text, sizeof text, seconds == std::floor(seconds) ? "%.0f s" : "%.2f s", seconds);
  } else if (seconds < 120) {
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  } else {
    std::snprintf(text, sizeof text, "%d min %d s", static_cast<int>(seconds) / 60,
                  static_cast<int>(seconds) % 60);
  }
  return text;
}

std::string readableBytes(double bytes) {
  char text[32];
  if (bytes < 1e6) {
    std::snprintf(text, sizeof text, "%.0f KB", bytes / 1e3);
  } else {
    std::snprintf(text, sizeof text, bytes < 1e9 ? "%.0f MB" : "%.1f GB",
                  bytes / (bytes < 1e9 ? 1e6 : 1e9));
  }
  return text;
}

}  // namespace exemplar
