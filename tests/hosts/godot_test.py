# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Godot 3 imports a library of pieces, and docs/hosts/place_cells.gd puts them where the cells have
them: the result is the mesh that the command writes. Skipped, with a word, where Godot
or Xvfb is missing."""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np

COMMAND = os.environ["EXEMPLAR"]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

lacking = [name for name in ("godot3", "godot3-server", "xvfb-run") if not shutil.which(name)]
if lacking:
    print(f"SKIPPED: {', '.join(lacking)} is missing")
    sys.exit(77)


def sums_of(path):
    """Area, and area times the middle, over the triangles of a binary .stl, which has no axes of its
    own: z up."""
    with open(path, "rb") as file:
        data = file.read()
    count = struct.unpack_from("<I", data, 80)[0]
    rows = np.frombuffer(data, np.dtype([("n", "<3f4"), ("p", "<9f4"), ("a", "<u2")]), count, 84)
    points = rows["p"].reshape(-1, 3, 3).astype(float)
    area = np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1) / 2
    return np.array([area.sum(), *(area[:, None] * points.mean(1)).sum(0)])


def imported(folder, environment):
    """Has the editor import the library. It imports at once, and does not end by itself under a
    display that is none."""
    editor = subprocess.Popen(
        ["xvfb-run", "-a", "-s", "-screen 0 640x480x24", "godot3", "-e", "--path", folder,
         "--audio-driver", "Dummy"], env=environment, stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        end = time.monotonic() + 120
        while time.monotonic() < end:
            made = os.path.join(folder, ".import")
            if os.path.isdir(made) and any(name.endswith(".md5") for name in os.listdir(made)):
                return True
            time.sleep(0.2)
        return False
    finally:
        os.killpg(editor.pid, 15)
        editor.wait()


with tempfile.TemporaryDirectory() as folder:
    environment = dict(os.environ, HOME=folder, XDG_DATA_HOME=folder, XDG_CONFIG_HOME=folder,
                       XDG_CACHE_HOME=folder)
    project = os.path.join(folder, "project")
    os.mkdir(project)
    with open(os.path.join(project, "project.godot"), "w", encoding="utf-8") as file:
        file.write('config_version=4\n[application]\nconfig/name="cells"\n')
    subprocess.run([COMMAND, "synth", "castle", "--size", "12,10,7", "--seed", "2", "-o", "cells.json",
                    "--pieces", "pieces.glb", "-o", os.path.join(folder, "whole.stl"), "-q"],
                   cwd=project, check=True)
    shutil.copy(os.path.join(ROOT, "docs", "hosts", "place_cells.gd"), project)
    assert imported(project, environment), "Godot has imported nothing within two minutes"
    done = subprocess.run(["godot3-server", "--path", project, "-s", "place_cells.gd"],
                          env=environment, capture_output=True, text=True, timeout=120, check=False)
    said = re.search(r"placed (\d+) \[(.*)\]", done.stdout)
    assert said, done.stdout + done.stderr
    with open(os.path.join(project, "cells.json"), encoding="utf-8") as file:
        cells = np.array(json.load(file)["cells"])
    assert int(said[1]) == (cells >= 0).sum(), said[0]
    there, whole = np.array([float(v) for v in said[2].split(",")]), sums_of(os.path.join(folder, "whole.stl"))
    print(f"{said[1]} pieces; area and its moments {there}, of the mesh {whole}")
    assert np.allclose(there, whole, rtol=1e-3), "the pieces do not stand as the mesh does"
