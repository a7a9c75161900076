# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT
"""Makes the sdist and the wheel of the Python module (PEP 517), with Python's own library alone.

pip and `python3 -m build` call build_sdist and build_wheel; the build of CMake calls

    build_backend.py PACKAGE FOLDER

which packs the package that was built in PACKAGE as a wheel in FOLDER. A wheel holds the libraries
that Python's own do not bring, in exemplar.libs, and the bundled scenes. $EXEMPLAR_PACKAGE names a
package that was built, for build_wheel to pack in place of building one."""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
NAME = "exemplar"
# What every Linux has, in its own version.
OF_THE_SYSTEM = re.compile(r"/(libc|libm|libdl|librt|libpthread|libgcc_s|libstdc\+\+|ld-linux[^/]*)\.so")


def version():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"project\(exemplar VERSION ([0-9.]+)", file.read())[1]


def metadata():
    with open(os.path.join(ROOT, "docs", "python.md"), encoding="utf-8") as file:
        text = file.read()
    return (f"Metadata-Version: 2.1\nName: {NAME}\nVersion: {version()}\n"
            "Summary: Give it one example; get as much more of it as you want\nLicense: MIT\n"
            "Requires-Python: >=3.9\nRequires-Dist: numpy\n"
            f"Description-Content-Type: text/markdown\n\n{text}")


def _output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def _bundle(folder):
    """Puts the libraries that the module is linked with beside it."""
    core = next(os.path.join(folder, NAME, name) for name in os.listdir(os.path.join(folder, NAME))
                if name.startswith("_core.") and name.endswith(".so"))
    libraries = os.path.join(folder, NAME + ".libs")
    os.makedirs(libraries)
    for path in re.findall(r"=> (/\S+)", _output("ldd", core)):
        if not OF_THE_SYSTEM.search(path):
            shutil.copy(os.path.realpath(path), os.path.join(libraries, os.path.basename(path)))
    found = [os.path.join(libraries, name) for name in os.listdir(libraries)]
    _output("strip", "--strip-unneeded", core)
    _output("patchelf", "--set-rpath", "$ORIGIN/../" + NAME + ".libs", core)
    if found:
        _output("patchelf", "--set-rpath", "$ORIGIN", *found)
    return [core] + found


def _oldest_glibc(files):
    """The version of glibc that the files need, as (2, 34)."""
    needed = re.findall(r"GLIBC_(\d+)\.(\d+)", _output("readelf", "--version-info", "--wide", *files))
    return max((int(a), int(b)) for a, b in needed)


def pack(package, folder, level=6):
    """Packs a package that was built as a wheel in a folder; its name. level: of compression, 0
    to 9."""
    with tempfile.TemporaryDirectory() as stage:
        shutil.copytree(package, os.path.join(stage, NAME),
                        ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copytree(os.path.join(ROOT, "scenes"), os.path.join(stage, NAME, "scenes"),
                        ignore=lambda _, names: [n for n in names if not n.endswith(".toml")])
        glibc = "{}_{}".format(*_oldest_glibc(_bundle(stage)))
        python = "cp{}{}".format(*sys.version_info[:2])
        machine = sysconfig.get_platform().rsplit("-", 1)[1]
        tag = f"{python}-{python}-manylinux_{glibc}_{machine}"
        about = os.path.join(stage, f"{NAME}-{version()}.dist-info")
        os.makedirs(about)
        shutil.copy(os.path.join(ROOT, "LICENSE"), about)
        for name, text in (("METADATA", metadata()), (
                "WHEEL", f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {tag}\n")):
            with open(os.path.join(about, name), "w", encoding="utf-8") as file:
                file.write(text)
        wheel = f"{NAME}-{version()}-{tag}.whl"
        _zip(stage, os.path.relpath(about, stage), os.path.join(folder, wheel), level)
    return wheel


def _zip(stage, about, path, level):
    """All files of a folder, with the list of their hashes."""
    record = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=level) as archive:
        for folder, folders, names in os.walk(stage):
            folders.sort()
            for name in sorted(names):
                file = os.path.join(folder, name)
                place = os.path.relpath(file, stage)
                with open(file, "rb") as opened:
                    data = opened.read()
                digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                record.append(f"{place},sha256={digest},{len(data)}\n")
                archive.writestr(_entry(place), data, compresslevel=level)
        record.append(f"{about}/RECORD,,\n")
        archive.writestr(_entry(f"{about}/RECORD"), "".join(record))


def _entry(place):
    entry = zipfile.ZipInfo(place, (2026, 1, 1, 0, 0, 0))
    entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
    return entry


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    built = os.environ.get("EXEMPLAR_PACKAGE")
    if built:
        return pack(built, wheel_directory, level=1)
    build = os.path.join(ROOT, "build", "wheel")
    subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DEXEMPLAR_TESTS=OFF", "-DEXEMPLAR_PYTHON=ON",
                    f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "exemplar_python",
                    "exemplar_python_package"], check=True)
    return pack(os.path.join(build, "python", NAME), wheel_directory)


def build_sdist(sdist_directory, config_settings=None):
    """The files that git knows, or all of a folder that came as an sdist."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], capture_output=True, text=True,
                            check=False)
    if listed.returncode == 0 and listed.stdout:
        files = listed.stdout.rstrip("\0").split("\0")
    else:
        files = [os.path.relpath(os.path.join(folder, name), ROOT)
                 for folder, _, names in os.walk(ROOT) for name in names]
        files = [f for f in files if not f.startswith(("build/", "PKG-INFO"))]
    base = f"{NAME}-{version()}"
    # What fuzzing has found is a large part of the files, and no part of the module.
    files = [f for f in files if not f.startswith("tests/fuzz/corpus/")]
    with tarfile.open(os.path.join(sdist_directory, base + ".tar.gz"), "w:gz",
                      format=tarfile.PAX_FORMAT) as archive, tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "PKG-INFO"), "w", encoding="utf-8") as file:
            file.write(metadata())
        archive.add(os.path.join(folder, "PKG-INFO"), base + "/PKG-INFO")
        for name in sorted(files):
            archive.add(os.path.join(ROOT, name), f"{base}/{name}", recursive=False)
    return base + ".tar.gz"


if __name__ == "__main__":
    os.makedirs(sys.argv[2], exist_ok=True)
    print(os.path.join(sys.argv[2], pack(*sys.argv[1:3])))
