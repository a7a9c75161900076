// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "world/window_lattice.h"

namespace exemplar {

/// Which window's bytes.
struct WindowKey {
  int phase = 0;
  PlanePoint window;
  auto operator<=>(const WindowKey&) const = default;
};

struct WindowCacheOptions {
  std::size_t capacity = std::size_t{512} << 20;  ///< bytes in memory
  std::filesystem::path folder;  ///< a file for each window, too; empty: in memory alone
};

/// Windows that have been made: in memory the last ones used, and, where there is a folder, one
/// small file each for whoever shares it. What is not there is made again, the same bytes, so that
/// nothing is ever locked: processes and machines may share a folder, files may be deleted at any
/// time. A file that is cut short, or of another world (`world`, a hash of all that decides bytes),
/// or damaged (XXH3 of its content), counts as not there; one that cannot be written is left out.
/// Thread-safe.
class WindowCache {
 public:
  using Bytes = std::shared_ptr<const std::string>;

  explicit WindowCache(std::uint64_t world, WindowCacheOptions options = {});

  /// Null where it is not there.
  Bytes find(const WindowKey& key);
  Bytes put(const WindowKey& key, std::string bytes);

  /// Where a window's file is.
  std::filesystem::path fileOf(const WindowKey& key) const;

 private:
  struct Entry {
    WindowKey key;
    Bytes bytes;
  };
  Bytes remember(const WindowKey& key, Bytes bytes);
  Bytes read(const WindowKey& key) const;

  std::uint64_t world_;
  WindowCacheOptions options_;
  std::mutex mutex_;
  std::list<Entry> entries_;  // the last one used first
  std::map<WindowKey, std::list<Entry>::iterator> where_;
  std::size_t held_ = 0;  // bytes
};

}  // namespace exemplar
