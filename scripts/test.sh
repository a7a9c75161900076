#!/usr/bin/env bash
# Installs what is needed, builds, and runs all tests. Safe to run twice, and quick the second time.
set -euo pipefail
cd "$(dirname "$0")/.."

# What is built with; what only tests need is installed while the build runs.
scripts/install.sh python3-dev python3-numpy pybind11-dev
# The report's page is tested in a browser, the add-on in Blender, under a display that is none; the
# documentation as a site; the Python module with what it converts to, its notebooks and wheel; completions
# in their shells; cells and pieces in Godot.
scripts/install.sh chromium blender xvfb xauth libgl1-mesa-dri mkdocs mkdocs-material reuse \
  python3-openvdb python3-distributed python3-meshio python3-xarray python3-open3d \
  mypy python3-nbclient python3-ipykernel python3-matplotlib python3-scipy python3-pip python3-venv patchelf \
  godot3 godot3-server zsh fish &
packages=$!
trap 'wait "$packages" || true' EXIT
scripts/build.sh
wait "$packages"
cmake --preset release >/dev/null # finds the tools of tests that came meanwhile
echo "== running all tests"
ctest --preset release -j "$(nproc)"
