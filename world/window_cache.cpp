// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "world/window_cache.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"

namespace exemplar {
namespace {

constexpr char kMagic[8] = {'e', 'x', 'w', 'i', 'n', 'd', '0', '1'};

/// What a file begins with; the window's bytes follow.
struct Header {
  char magic[8];
  std::uint64_t world, phase;
  std::int64_t x, y;
  std::uint64_t length, hash;
};

Header headerOf(std::uint64_t world, const WindowKey& key, std::string_view bytes) {
  Header header{{},
                world,
                static_cast<std::uint64_t>(key.phase),
                key.window.x,
                key.window.y,
                bytes.size(),
                contentHash(bytes)};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  return header;
}

}  // namespace

WindowCache::WindowCache(std::uint64_t world, WindowCacheOptions options)
    : world_(world), options_(std::move(options)) {}

std::filesystem::path WindowCache::fileOf(const WindowKey& key) const {
  // Folders of at most 4,096 windows.
  const auto part = [](std::int64_t n) { return std::to_string(floorDivide(n, 64)); };
  return options_.folder / std::to_string(key.phase) /
         (part(key.window.x) + "_" + part(key.window.y)) /
         (std::to_string(key.window.x) + "_" + std::to_string(key.window.y) + ".window");
}

WindowCache::Bytes WindowCache::find(const WindowKey& key) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = where_.find(key);
    if (found != where_.end()) {
      entries_.splice(entries_.begin(), entries_, found->second);
      return found->second->bytes;
    }
  }
  if (options_.folder.empty()) return nullptr;
  Bytes bytes = read(key);
  return bytes ? remember(key, std::move(bytes)) : nullptr;
}

WindowCache::Bytes WindowCache::put(const WindowKey& key, std::string bytes) {
  if (!options_.folder.empty()) {
    const Header header = headerOf(world_, key, bytes);
    try {
      const std::filesystem::path path = fileOf(key);
      std::filesystem::create_directories(path.parent_path());
      writeFile(path, std::string(reinterpret_cast<const char*>(&header), sizeof header) + bytes);
    } catch (const std::exception&) {
      // Who needs it makes it again.
    }
  }
  return remember(key, std::make_shared<const std::string>(std::move(bytes)));
}

WindowCache::Bytes WindowCache::remember(const WindowKey& key, Bytes bytes) {
  const std::lock_guard lock(mutex_);
  const auto found = where_.find(key);
  if (found != where_.end()) return found->second->bytes;
  held_ += bytes->size();
  entries_.push_front({key, bytes});
  where_[key] = entries_.begin();
  while (held_ > options_.capacity && entries_.size() > 1) {
    held_ -= entries_.back().bytes->size();
    where_.erase(entries_.back().key);
    entries_.pop_back();
  }
  return bytes;
}

WindowCache::Bytes WindowCache::read(const WindowKey& key) const {
  std::ifstream file(fileOf(key), std::ios::binary);
  if (!file) return nullptr;
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  if (all.size() < sizeof(Header)) return nullptr;
  std::string bytes = all.substr(sizeof(Header));
  const Header header = headerOf(world_, key, bytes);
  if (std::memcmp(&header, all.data(), sizeof header) != 0) return nullptr;
  return std::make_shared<const std::string>(std::move(bytes));
}

}  // namespace exemplar
