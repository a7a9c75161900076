#!/usr/bin/env bash
# Installs what is needed and builds the release preset in build/release: build.sh [TARGET]...
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install.sh
if ! log=$(cmake --preset release 2>&1); then
  echo "$log" >&2
  exit 1
fi
echo "== building in build/release (some minutes the first time)"
cmake --build --preset release --target "${@:-all}"
