#!/usr/bin/env bash
# Builds the documentation as a site in build/site, with the C++ reference in build/site/cpp.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install.sh mkdocs mkdocs-material doxygen
echo "== the site"
mkdocs build --strict --quiet
echo "== the C++ reference"
doxygen docs/Doxyfile
echo "== build/site/index.html"
