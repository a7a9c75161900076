// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

// In place of world_server.cpp where there is no cpp-httplib.

#include "apps/world_server.h"
#include "core/error.h"

namespace exemplar {

bool canServe() { return false; }

void serveWorld(const World&, const WorldServerOptions&,
                const std::function<void(const std::string&)>&, const Progress&) {
  throw InputError(
      "this program was built without cpp-httplib, and cannot serve; install libcpp-httplib-dev "
      "and "
      "build it again, or make tiles with world make");
}

}  // namespace exemplar
