#!/usr/bin/env bash
# Installs what is needed, builds, and runs all tests. Safe to run twice, and quick the second time.
set -euo pipefail
cd "$(dirname "$0")/.."

# The report's page is tested in a browser, the add-on in Blender, under a display that is none; the
# documentation as a site; the Python module with what it converts to, its notebooks and wheel; completions
# in their shells; cells and pieces in Godot.
scripts/install.sh chromium blender xvfb xauth libgl1-mesa-dri python3-numpy mkdocs mkdocs-material reuse \
  python3-dev pybind11-dev python3-openvdb python3-distributed python3-meshio python3-xarray python3-open3d \
  mypy python3-nbclient python3-ipykernel python3-matplotlib python3-scipy python3-pip python3-venv patchelf \
  godot3 godot3-server zsh fish
scripts/build.sh
echo "== running all tests"
ctest --preset release -j "$(nproc)"
