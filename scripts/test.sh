#!/usr/bin/env bash
# Installs, builds and runs all tests. Safe to run twice, and quick the second time.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install.sh
echo "== building (build/release; the first time takes some minutes)"
cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build --preset release
echo "== running all tests"
ctest --preset release -j "$(nproc)"
