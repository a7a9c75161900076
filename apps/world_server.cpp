// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "apps/world_server.h"

#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "apps/world_page.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json_text.h"
#include "engine/json.h"
#include "engine/words.h"
#include "engine/world_tiles.h"

namespace exemplar {
namespace {

namespace fs = std::filesystem;

/// Connections that are answered at once; each takes a thread, and little else.
constexpr std::size_t kConnections = 32;
constexpr int kSecondsToRead = 5, kSecondsToWrite = 20, kSecondsIdle = 2;
constexpr std::size_t kLongestBody = 1024, kRequestsOfConnection = 1000;

struct Wanted {
  PlanePoint tile;
  std::string ending;  // ".glb", ".r16.json"
};

/// "/tiles/0/I/J.glb": nothing else names a file.
std::optional<Wanted> wantedTile(std::string_view path) {
  constexpr std::string_view kBegin = "/tiles/0/";
  if (!path.starts_with(kBegin)) return std::nullopt;
  path.remove_prefix(kBegin.size());
  const auto number = [&](std::int64_t& n) {
    // As it is written: no plus, no further zeros.
    const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), n);
    if (error != std::errc{} || n < -kMostTiles || n >= kMostTiles) return false;
    const auto length = static_cast<std::size_t>(end - path.data());
    if (path.substr(0, length) != std::to_string(n)) return false;
    path.remove_prefix(length);
    return true;
  };
  Wanted wanted;
  if (!number(wanted.tile.x) || !path.starts_with('/')) return std::nullopt;
  path.remove_prefix(1);
  if (!number(wanted.tile.y) || !path.starts_with('.')) return std::nullopt;
  if (path.size() > 12 ||
      path.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789.") != path.npos)
    return std::nullopt;
  wanted.ending = path;
  return wanted;
}

const char* contentType(const std::string& ending) {
  if (ending == ".glb") return "model/gltf-binary";
  if (ending == ".gltf") return "model/gltf+json";
  if (ending == ".png") return "image/png";
  if (ending.ends_with(".json")) return "application/json";
  return "application/octet-stream";
}

class WorldServer {
 public:
  WorldServer(const World& world, const WorldServerOptions& options)
      : world_(world), options_(options), endings_(split(tileEndings(world), ' ')) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kConnections); };
    server_.set_read_timeout(kSecondsToRead);
    server_.set_write_timeout(kSecondsToWrite);
    server_.set_keep_alive_timeout(kSecondsIdle);
    server_.set_keep_alive_max_count(kRequestsOfConnection);
    server_.set_payload_max_length(kLongestBody);
    // All requests are answered here, by what their path spells; no folder is mounted.
    server_.set_pre_routing_handler(
        [this](const httplib::Request& request, httplib::Response& response) {
          answer(request, response);
          return httplib::Server::HandlerResponse::Handled;
        });
  }

  void run(const std::function<void(const std::string&)>& listening, const Progress& progress) {
    const int port = options_.port == 0 ? server_.bind_to_any_port(options_.host)
                     : server_.bind_to_port(options_.host, options_.port) ? options_.port
                                                                          : -1;
    if (port <= 0)
      throw InputError("cannot listen at " + options_.host + ":" + std::to_string(options_.port) +
                       "; is the port in use? choose another `port`");
    Listening thread(*this);
    listening("http://" + options_.host + ":" + std::to_string(port) + "/");
    while (!progress.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.check();
  }

 private:
  /// Listens while it lives. What is being made then hears that it should stop.
  class Listening {
   public:
    explicit Listening(WorldServer& server) : server_(server) {
      thread_ = std::thread([this] {
        server_.server_.listen_after_bind();
        ended_ = true;
      });
      // A server that does not run yet cannot be stopped.
      while (!server_.server_.is_running() && !ended_)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ~Listening() {
      server_.stopping_ = true;
      server_.server_.stop();
      thread_.join();
    }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

   private:
    WorldServer& server_;
    std::thread thread_;
    std::atomic<bool> ended_{false};
  };

  static void say(httplib::Response& response, int status, const std::string& text) {
    response.status = status;
    if (status == 503) response.set_header("Retry-After", "1");
    response.set_content(text + "\n", "text/plain");
  }

  /// Pages of other names that lead here (DNS rebinding) are not answered.
  bool isOwnName(const std::string& host) const {
    if (options_.host != "127.0.0.1" && options_.host != "localhost" && options_.host != "::1")
      return true;
    std::string_view name = host;
    if (!name.starts_with('[')) name = name.substr(0, name.rfind(':'));
    return name == "127.0.0.1" || name == "localhost" || name == "[::1]" ||
           name.starts_with("[::1]:");
  }

  void answer(const httplib::Request& request, httplib::Response& response) {
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header(
        "Content-Security-Policy",
        "default-src 'self'; script-src 'unsafe-inline'; style-src 'unsafe-inline'");
    if (request.method != "GET" && request.method != "HEAD") return say(response, 405, "only GET");
    if (!isOwnName(request.get_header_value("Host"))) return say(response, 403, "another name");
    try {
      if (request.path == "/") return response.set_content(worldPage(), "text/html");
      if (request.path == "/world.json") return response.set_content(about(), "application/json");
      if (request.path == "/tileset.json")
        return sendFile(world_.folder() / "tileset.json", ".json", response);
      if (const std::optional<Wanted> wanted = wantedTile(request.path))
        return sendTile(*wanted, response);
      say(response, 404, "nothing is there");
    } catch (const Cancelled&) {
      say(response, 503, "it is ending");
    } catch (const std::exception& e) {
      say(response, 500, e.what());
    }
  }

  std::string about() const {
    const Example& example = world_.examples().front();
    const bool heights = example.form() == Form::Heights;
    const Vec3d size = world_.tileSize();
    double low = 0, high = 0;
    if (heights) {
      const std::optional<HeightRange> range = rangeOf(example.heights().heights);
      low = range->low;
      high = range->high;
    } else {
      low = example.labels().origin.z;
      high = low + size.z;
    }
    return jsonText(Json{{"example", world_.file().example},
                         {"engine", world_.file().engine},
                         {"seed", world_.file().seed},
                         {"heights", heights},
                         {"format", heights ? "r16" : "glb"},
                         {"cells", world_.file().tile},
                         {"size", {size.x, size.y}},
                         {"range", {low, high}}},
                    1);
  }

  static void sendFile(const fs::path& path, const std::string& ending,
                       httplib::Response& response) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return say(response, 404, "nothing is there");
    response.set_content(readFile(path), contentType(ending));
  }

  void sendTile(const Wanted& wanted, httplib::Response& response) {
    std::string own = wanted.ending;
    const bool beside = own.ends_with(".json");
    if (beside) own.resize(own.size() - 5);
    if (std::ranges::find(endings_, own) == endings_.end())
      return say(response, 404, "tiles are not written to " + wanted.ending);
    const fs::path path = world_.tilePath(wanted.tile, own);
    std::error_code error;
    if (!fs::is_regular_file(path, error) && !make(wanted.tile, path, response)) return;
    sendFile(world_.tilePath(wanted.tile, wanted.ending), wanted.ending, response);
  }

  /// Makes a tile's file; says why not.
  bool make(const PlanePoint& tile, const fs::path& path, httplib::Response& response) {
    struct Waiting {
      std::atomic<int>& count;
      int before = count++;
      ~Waiting() { --count; }
    };
    const Waiting waiting{waiting_};
    if (waiting.before > options_.waiting) {
      say(response, 503, "too many tiles are asked for at once");
      return false;
    }
    const std::lock_guard lock(making_);
    std::error_code error;
    if (fs::is_regular_file(path, error)) return true;
    if (made_ >= options_.most) {
      say(response, 503, withThousands(made_) + " tiles were made, as many as may be");
      return false;
    }
    const Progress hearing({}, &stopping_);
    const Result result = world_.tile(tile, hearing);
    fs::create_directories(path.parent_path(), error);
    writeTile(world_, tile, result, path, hearing);
    ++made_;
    return true;
  }

  const World& world_;
  WorldServerOptions options_;
  std::vector<std::string> endings_;
  httplib::Server server_;
  std::atomic<bool> stopping_{false};
  std::atomic<int> waiting_{0};
  std::mutex making_;
  std::int64_t made_ = 0;
};

}  // namespace

bool canServe() { return true; }

void serveWorld(const World& world, const WorldServerOptions& options,
                const std::function<void(const std::string&)>& listening,
                const Progress& progress) {
  world.requireSameBytes(progress.part(0, 0.5));
  WorldServer(world, options).run(listening, progress);
}

}  // namespace exemplar
