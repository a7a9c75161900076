#!/usr/bin/env bash
# Installs what is needed, builds, and runs all tests. Safe to run twice, and quick the second time.
set -euo pipefail
cd "$(dirname "$0")/.."

# The report's page is tested in a browser, the add-on in Blender, under a display that is none; the
# documentation as a site.
scripts/install.sh chromium blender xvfb xauth libgl1-mesa-dri python3-numpy \
  python3-dev pybind11-dev python3-openvdb mkdocs mkdocs-material python3-distributed reuse
scripts/build.sh
echo "== running all tests"
ctest --preset release -j "$(nproc)"
