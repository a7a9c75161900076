#!/usr/bin/env bash
# Kills a thousand runs of the command (or as many as the first argument says) at random moments, with
# kill -9, and requires every file to be whole or absent, and nothing to be left beside them.
# Needs a build: cmake --build --preset release. CI runs a short form of it with the other tests.
set -euo pipefail
cd "$(dirname "$0")/.."
EXEMPLAR_KILLS="${1:-1000}" build/release/tests/apps/apps_test --gtest_filter='Kill.*'
