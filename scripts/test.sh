#!/usr/bin/env bash
# Installs what is needed, builds, and runs all tests. Safe to run twice, and quick the second time.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install.sh chromium # the report's page is tested in it
scripts/build.sh
echo "== running all tests"
ctest --preset release -j "$(nproc)"
