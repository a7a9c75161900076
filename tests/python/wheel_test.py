# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""The sdist and the wheel, made by pip without a network, installed into an empty environment and
used there: wheel_test.py PACKAGE, the package that the build has made. Skipped, with a word, where
pip, venv or patchelf is missing."""

import importlib.util
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

PACKAGE = sys.argv[1]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
OFFLINE = ["--no-index", "--no-deps", "--no-build-isolation", "--disable-pip-version-check", "-q"]

lacking = [name for name in ("pip", "venv", "ensurepip") if importlib.util.find_spec(name) is None]
lacking += [name for name in ("patchelf", "readelf", "strip") if not shutil.which(name)]
if lacking:
    print(f"SKIPPED: {', '.join(lacking)} is missing (python3-pip, python3-venv, patchelf, binutils)")
    sys.exit(77)

USE = """
import os, sys
import exemplar
assert exemplar.__file__.startswith(sys.prefix), exemplar.__file__
example = exemplar.scene("balls", resolution=16)
made = exemplar.synthesize(example, scale=(2, 1, 1), seed=1)
made.mesh().write("more.glb")
print(exemplar.__version__, len(made.mesh().faces), "chainmail" in exemplar.scenes())
with open("/proc/self/maps") as maps:
    loaded = {line.split()[-1] for line in maps if "libopenvdb" in line or "libtbb.so" in line}
assert loaded and all("exemplar.libs" in path for path in loaded), loaded
"""


class Wheel(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory(prefix="ä b ")
        self.addCleanup(held.cleanup)
        self.folder = held.name

    def run_quietly(self, *line, **more):
        # Nothing of what surrounds the test: no module of the build, no index, no user's settings.
        environment = {key: value for key, value in os.environ.items()
                       if not key.startswith(("PYTHON", "PIP_", "EXEMPLAR", "LD_"))}
        environment.update(HOME=self.folder, PIP_NO_INDEX="1", PYTHONDONTWRITEBYTECODE="1", **more)
        done = subprocess.run(line, cwd=self.folder, env=environment, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_is_installed_offline_and_used(self):
        self.run_quietly(sys.executable, "-m", "pip", "wheel", *OFFLINE, "-w", self.folder, ROOT,
                         EXEMPLAR_PACKAGE=PACKAGE)
        wheel, = [name for name in os.listdir(self.folder) if name.endswith(".whl")]
        self.assertRegex(wheel, r"^exemplar-\d+\.\d+\.\d+-cp\d+-cp\d+-manylinux_2_\d+_\w+\.whl$")
        with zipfile.ZipFile(os.path.join(self.folder, wheel)) as archive:
            names = archive.namelist()
        for part in ("exemplar/__init__.pyi", "exemplar/py.typed", "exemplar/scenes/chainmail.toml"):
            self.assertIn(part, names)
        place = os.path.join(self.folder, "environment")
        # NumPy is Debian's: there is no index to have another from.
        self.run_quietly(sys.executable, "-m", "venv", "--system-site-packages", place)
        python = os.path.join(place, "bin", "python3")
        self.run_quietly(python, "-m", "pip", "install", *OFFLINE, os.path.join(self.folder, wheel))
        said = self.run_quietly(python, "-I", "-c", USE).split()
        self.assertEqual(said[0], wheel.split("-")[1])
        self.assertGreater(int(said[1]), 100)
        self.assertEqual(said[2], "True")
        self.assertTrue(os.path.getsize(os.path.join(self.folder, "more.glb")) > 1000)
        self.run_quietly(python, "-m", "pip", "uninstall", "-y", "-q", "exemplar")
        left = [os.path.join(at, name) for at, _, files in os.walk(place) for name in files
                if "exemplar" in os.path.join(os.path.relpath(at, place), name)]
        self.assertEqual(left, [])

    def test_sdist_has_what_is_needed_to_build(self):
        sys.path.insert(0, os.path.join(ROOT, "python"))
        self.addCleanup(sys.path.remove, os.path.join(ROOT, "python"))
        import build_backend
        name = build_backend.build_sdist(self.folder)
        with tarfile.open(os.path.join(self.folder, name)) as archive:
            names = archive.getnames()
            archive.extractall(self.folder)
        base = name.removesuffix(".tar.gz")
        for part in ("PKG-INFO", "pyproject.toml", "CMakeLists.txt", "python/module.cpp",
                     "core/platform.h", "scenes/chainmail.toml", "web/package-lock.json", "LICENSE"):
            self.assertIn(f"{base}/{part}", names)
        # It is a source of wheels itself: of the package that is there already, here.
        self.run_quietly(sys.executable, "-m", "pip", "wheel", *OFFLINE, "-w", self.folder,
                         os.path.join(self.folder, base), EXEMPLAR_PACKAGE=PACKAGE)
        self.assertEqual(len([n for n in os.listdir(self.folder) if n.endswith(".whl")]), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
