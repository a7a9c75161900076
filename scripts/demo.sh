#!/usr/bin/env bash
# Installs what is needed, builds, and synthesizes the bundled chainmail to out/chainmail.glb with its
# picture out/chainmail.png. Safe to run twice, and quick the second time.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/build.sh exemplar
mkdir -p out
echo "== synthesizing: scenes/chainmail.toml -> out/chainmail.glb, out/chainmail.png"
build/release/apps/exemplar synth scenes/chainmail.toml \
  -o out/chainmail.glb --preview out/chainmail.png
