#!/usr/bin/env bash
# Makes docs/gallery: for each bundled scene the example beside a result, at one scale, and the figures of
# the run in out/gallery. gallery.sh [SCENE]... (all of them by default). Some minutes.
set -euo pipefail
cd "$(dirname "$0")/.."

exemplar=${EXEMPLAR:-build/release/apps/exemplar}
[ -x "$exemplar" ] || scripts/build.sh exemplar
mkdir -p out/gallery docs/gallery
scenes=("$@")
[ ${#scenes[@]} -gt 0 ] || scenes=(chainmail terrain grass metal grid balls fibers
  castle city canyon cluster paths gears forest library)
for scene in "${scenes[@]}"; do
  echo "== $scene"
  engine=(--engine "${ENGINE:-auto}")
  "$exemplar" synth "scenes/$scene.toml" -o "out/gallery/$scene.glb" --stats "out/gallery/$scene.json" "${engine[@]}"
  "$exemplar" render "scenes/$scene.toml" "out/gallery/$scene.glb" -o "docs/gallery/$scene.png" --size 640x480 --samples 48
done

# The report of a comparison, as a browser shows it.
if [ $# -eq 0 ] && command -v chromium >/dev/null; then
  echo "== report"
  "$exemplar" compare scenes/chainmail.toml --resolution 48 --seeds 2 -o out/gallery/report
  node scripts/report_picture.mjs out/gallery/report/report.html docs/gallery/report.png '#origins'
fi
