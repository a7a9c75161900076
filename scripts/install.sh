#!/usr/bin/env bash
# Installs what exemplar is built from, from Debian's packages; does nothing when all is there.
# install.sh [PACKAGE]...: further ones too.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache
  libtbb-dev libopenvdb-dev libboost-iostreams-dev libembree-dev libopenmesh-dev libhwy-dev libmeshoptimizer-dev libtinygltf-dev libeigen3-dev libpng-dev libjpeg-dev libtiff-dev libopenexr-dev
  libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libcadical-dev libxxhash-dev libcpp-httplib-dev pkg-config
  libgtest-dev libgmock-dev libbenchmark-dev libfftw3-dev zlib1g-dev
  "$@"
)
# What bundles the report's page; from wherever they come.
command -v node >/dev/null && command -v npm >/dev/null || packages+=(nodejs npm)
missing=()
for p in "${packages[@]}"; do
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$p" 2>/dev/null || true)" = installed ] || missing+=("$p")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "== packages: all ${#packages[@]} are installed"
  exit 0
fi
echo "== packages: installing ${missing[*]}"
sudo=""
[ "$(id -u)" -eq 0 ] || sudo="sudo"
$sudo apt-get update -qq
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
