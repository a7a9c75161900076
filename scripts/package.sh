#!/usr/bin/env bash
# Makes the packages in build/package: exemplar, libexemplar-dev and python3-exemplar as .deb, and a
# portable .tar.xz that needs nothing but glibc. With --check, lintian reads them, and a bare Debian
# root made by debootstrap installs, runs and purges them (as root; needs the network).
#
#   scripts/package.sh [--check]
set -euo pipefail
cd "$(dirname "$0")/.."
check=${1:-}
build=build/package
mkdir -p $build

scripts/install.sh help2man file python3-dev pybind11-dev patchelf
echo "== building for packages in $build"
cmake -S . -B $build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DEXEMPLAR_TESTS=OFF \
  -DEXEMPLAR_WERROR=ON \
  -DEXEMPLAR_PACKAGING=ON -DEXEMPLAR_PYTHON=ON -DCMAKE_CXX_COMPILER_LAUNCHER=ccache >$build.log 2>&1 || {
  cat $build.log >&2
  exit 1
}
cmake --build $build

echo "== .deb"
rm -f $build/*.deb
(cd $build && cpack -G DEB >cpack.log 2>&1) || {
  cat $build/cpack.log >&2
  exit 1
}
ls -l $build/*.deb

version=$(sed -n 's/^project(exemplar VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
name=exemplar-$version-linux-$(uname -m)
echo "== portable $name.tar.xz"
rm -rf "$build/$name" && mkdir -p "$build/$name/lib"
DESTDIR="$PWD/$build/$name/root" cmake --install $build --component command >/dev/null
mv "$build/$name"/root/usr/* "$build/$name/" && rm -r "$build/$name/root"
# What a system has anyway, whatever its version, stays the system's.
ldd "$build/$name/bin/exemplar" | awk '/=> \//{print $3}' |
  grep -vE '/(libc|libm|libdl|librt|libpthread|libgcc_s|libstdc\+\+|ld-linux[^/]*)\.so' |
  xargs -I{} cp -L {} "$build/$name/lib/"
cp -r $build/package/third_party "$build/$name/share/doc/exemplar/"
strip "$build/$name/bin/exemplar"
patchelf --set-rpath '$ORIGIN/../lib' "$build/$name/bin/exemplar"
for library in "$build/$name"/lib/*.so*; do patchelf --set-rpath '$ORIGIN' "$library"; done
tar -C $build -cJf "$build/$name.tar.xz" "$name"
ls -l "$build/$name.tar.xz"

[ "$check" = --check ] || exit 0
scripts/install.sh lintian debootstrap
echo "== lintian"
lintian --fail-on error $build/*.deb

root=$(mktemp -d)
trap 'umount "$root/proc" 2>/dev/null; rm -rf --one-file-system "$root"' EXIT
inside() { chroot "$root" "$@"; }
echo "== a bare Debian root"
debootstrap --variant=minbase bookworm "$root" >$build/debootstrap.log
# Where the loader, and the command, learn where a program is.
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
trial=opt/trial  # what is made there, in that root
mkdir "$root/$trial"
echo "== the portable archive there"
odd="opt/a folder äöü"
mkdir "$root/$odd"
tar -C "$root/$odd" -xJf "$build/$name.tar.xz"
inside env LD_LIBRARY_PATH= "/$odd/$name/bin/exemplar" synth balls -o "/$trial/portable.glb" --quiet
test -s "$root/$trial/portable.glb"
echo "== the packages there"
cp $build/*.deb "$root/$trial/"
inside sh -c "apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends /$trial/*.deb" >$build/apt.log 2>&1
inside exemplar synth balls -o "/$trial/packaged.glb" --quiet
cmp "$root/$trial/portable.glb" "$root/$trial/packaged.glb"
inside python3 -c 'import exemplar; print("python3-exemplar", exemplar.__version__)'
for page in exemplar exemplar-{synth,sdf,mesh,render,measure,scene,voxelize,info,compare,engines,completion,world}; do
  test -s "$root/usr/share/man/man1/$page.1.gz"
done
# What names the bundled scenes was made where they are.
for named in bash-completion/completions/exemplar zsh/vendor-completions/_exemplar fish/vendor_completions.d/exemplar.fish; do
  grep -q chainmail "$root/usr/share/$named"
done
zgrep -q chainmail "$root/usr/share/man/man1/exemplar-scene.1.gz"
test "$(inside exemplar --version | head -1)" = "exemplar $version"
for package in exemplar libexemplar-dev python3-exemplar; do
  test "$(inside dpkg-query -W -f='${Version}' $package)" = "$version"
done
inside sh -c 'DEBIAN_FRONTEND=noninteractive apt-get purge -y -qq exemplar libexemplar-dev python3-exemplar' >>$build/apt.log 2>&1
left=$(inside find / -xdev -ipath '*exemplar*' -not -path '/proc/*' -not -path '/opt/*')
test -z "$left" || { echo "left behind: $left" >&2; exit 1; }
echo "== installed, run and purged without a trace"
