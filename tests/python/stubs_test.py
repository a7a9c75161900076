# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""mypy's stubtest compares the stubs with the module, and finds what is planted. Skipped, with a
word, where mypy is not installed."""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import exemplar

if importlib.util.find_spec("mypy") is None:
    print("SKIPPED: mypy is missing (python3-mypy)")
    sys.exit(77)

SETTINGS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "pyproject.toml")
PACKAGE = os.path.dirname(exemplar.__file__)
# `_core` has no stubs: what it holds is seen through the package. `__signature__` of `synthesize`
# lists what its `**settings` stands for. Classes of pybind11 have a metaclass of its own, and those
# that are not made by hand take anything to say so; what converts is a function of `interop`, whose
# first argument is named after what it takes.
ALLOWED = "\n".join((
    r"exemplar\._core", r"exemplar\.interop.*", r"exemplar\.synthesize",
    r"exemplar\.(BlockIndex|Field|Heights|LabelGrid|Mesh|Pieces)", r"exemplar\.Pieces\.__init__",
    r"exemplar\.(Field|Heights|LabelGrid|Mesh)\.to_(meshio|open3d|openvdb|pyvista|trimesh|xarray)"))


def complaints(package):
    """What stubtest says of a package, by the folder that it is in."""
    with tempfile.TemporaryDirectory() as folder:
        allowed = os.path.join(folder, "allowed")
        with open(allowed, "w", encoding="utf-8") as file:
            file.write(ALLOWED)
        environment = dict(os.environ, PYTHONPATH=package, MYPYPATH=package)
        done = subprocess.run(
            [sys.executable, "-m", "mypy.stubtest", "--concise", "--ignore-missing-stub",
             "--ignore-unused-allowlist", "--allowlist", allowed, "--mypy-config-file", SETTINGS,
             "exemplar"], cwd=folder, env=environment, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr


class Stubs(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = held.name
        shutil.copytree(PACKAGE, os.path.join(held.name, "exemplar"))

    def test_differ_from_the_module_only_where_that_is_planted(self):
        # Once: mypy takes most of its time to read what numpy has.
        stub = os.path.join(self.folder, "exemplar", "__init__.pyi")
        with open(stub, encoding="utf-8") as file:
            text = file.read()
        with open(stub, "w", encoding="utf-8") as file:
            file.write(text.replace("def read_mesh(path: _Path, *, up:", "def read_mesh(path: _Path, *, upp:")
                       .replace("    def report(", "    def reported("))
        status, text = complaints(self.folder)
        self.assertNotEqual(status, 0)
        named = {line.split()[0] for line in text.splitlines() if line.startswith("exemplar.")}
        self.assertEqual(named, {"exemplar.read_mesh", "exemplar.Result.reported"}, text)


if __name__ == "__main__":
    unittest.main()
