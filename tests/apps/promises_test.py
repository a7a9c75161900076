# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""What the command promises of a run, looked at from outside: one wall, as many triangles as asked
for, progress that never falls, memory that is its own."""

import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

COMMAND = os.environ["EXEMPLAR"]
# Runs of which the progress is read; 1000 before a release.
RUNS = int(os.environ.get("EXEMPLAR_RUNS", "24"))


def bricks():
    """A wall of bricks in mortar, 6 long, as (vertices, quads)."""
    vertices, quads = [], []

    def box(low, high):
        at = len(vertices)
        vertices.extend([(low, high)[n >> axis & 1][axis] for axis in range(3)] for n in range(8))
        quads.extend([at + n for n in quad] for quad in (
            (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)))
    box((0, 0.1, 0), (6, 0.9, 3))
    for row in range(3):
        for column in range(7):
            x = column - 0.5 * (row % 2)
            ends = max(x + 0.08, 0), min(x + 0.92, 6)
            if ends[1] - ends[0] > 0.2:
                box((ends[0], 0, row + 0.08), (ends[1], 1, row + 0.92))
    return vertices, quads


def read_stl(path):
    """Vertices and triangles of a binary .stl: corners at one place are one vertex."""
    with open(path, "rb") as file:
        data = file.read()
    count = np.frombuffer(data, "<u4", 1, 80)[0]
    rows = np.frombuffer(data, np.dtype([("n", "<3f4"), ("p", "<9f4"), ("a", "<u2")]), count, 84)
    points, number = np.unique(rows["p"].reshape(-1, 3), axis=0, return_inverse=True)
    return points.astype(float), number.reshape(-1, 3)


def components(count, faces):
    parent = list(range(count))

    def root(v):
        while parent[v] != v:
            parent[v] = parent[parent[v]]
            v = parent[v]
        return v
    for a, b, c in faces:
        parent[root(a)] = root(b)
        parent[root(b)] = root(c)
    return len({root(v) for v in np.unique(faces)})


def edges_paired(faces):
    """Whether each directed edge is there once, and its other direction, too."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    code = edges[:, 0] * (faces.max() + 1) + edges[:, 1]
    back = edges[:, 1] * (faces.max() + 1) + edges[:, 0]
    return len(np.unique(code)) == len(code) and (np.sort(code) == np.sort(back)).all()


def distances_to(points, corners):
    """From each point to the nearest of some triangles (m x 3 x 3), brute force (Ericson 2005,
    section 5.1.5)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    best = np.full(len(points), np.inf)
    for n, p in enumerate(points):
        near = np.abs(a - p).max(1) < 3 * np.abs(corners - a[:, None]).max() + np.abs(a - p).max(1).min()
        A, B, C = a[near], b[near], c[near]
        ab, ac, ap = B - A, C - A, p - A
        d1, d2 = (ab * ap).sum(1), (ac * ap).sum(1)
        uu, vv, uv = (ab * ab).sum(1), (ac * ac).sum(1), (ab * ac).sum(1)
        det = np.maximum(uu * vv - uv * uv, 1e-30)
        u, v = (vv * d1 - uv * d2) / det, (uu * d2 - uv * d1) / det
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        found = np.where(inside, np.linalg.norm(A + u[:, None] * ab + v[:, None] * ac - p, axis=1), np.inf)
        for start, end in ((A, B), (B, C), (C, A)):
            along = end - start
            t = np.clip(((p - start) * along).sum(1) / np.maximum((along * along).sum(1), 1e-30), 0, 1)
            found = np.minimum(found, np.linalg.norm(start + t[:, None] * along - p, axis=1))
        best[n] = found.min()
    return best


class Promises(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = held.name
        vertices, quads = bricks()
        with open(self.path("wall.obj"), "w", encoding="ascii") as file:
            file.writelines(f"v {x} {z} {-y}\n" for x, y, z in vertices)
            file.writelines("f " + " ".join(str(v + 1) for v in quad) + "\n" for quad in quads)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_command(self, *words, path=None):
        """Runs the command; path: the folders in which it finds programs."""
        environment = dict(os.environ, PATH=path) if path else None
        return subprocess.run([COMMAND, *words], cwd=self.folder, capture_output=True, text=True,
                              check=False, env=environment)

    def synth(self, *words):
        done = self.run_command("synth", "wall.obj", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_a_wall_three_times_as_long_is_one_wall(self):
        done = self.synth("--scale", "3,1,1", "-o", "longer.stl")
        points, faces = read_stl(self.path("longer.stl"))
        self.assertEqual(components(len(points), faces), 1)
        self.assertTrue(edges_paired(faces))
        self.assertAlmostEqual(np.ptp(points[:, 0]) / 18, 1, delta=0.05)
        self.assertIn("going on along x", done.stdout)

    def test_triangles_are_as_many_as_asked_for_and_near(self):
        words = ("--scale", "1.5,1,1", "--resolution", "48")
        self.synth(*words, "-o", "full.stl")
        points, faces = read_stl(self.path("full.stl"))
        wanted = len(faces) // 4
        self.synth(*words, "-o", "quarter.stl", "--triangles", str(wanted))
        fewer, quarter = read_stl(self.path("quarter.stl"))
        self.assertAlmostEqual(len(quarter) / wanted, 1, delta=0.05)
        self.assertTrue(edges_paired(quarter))
        # Points all over the lighter one, against the full one; the voxel is the longest side's 48th.
        corners = fewer[quarter]
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
        draws = np.random.default_rng(1)
        chosen = corners[draws.choice(len(corners), 400, p=area / area.sum())]
        weights = draws.dirichlet((1, 1, 1), 400)
        away = distances_to((weights[:, :, None] * chosen).sum(1), points[faces])
        print(f"{len(faces)} to {len(quarter)} triangles: {away.max() / (6 / 48):.3f} voxels away at most",
              file=sys.stderr)
        self.assertLess(away.max(), 0.5 * 6 / 48)

    def test_progress_is_json_that_never_falls(self):
        with open(self.path("e.txt"), "w", encoding="ascii") as file:
            file.write("ab\n\n\n2 2 1\n\n1 2\n2 1\n\n<Objects>\nab\na\n#\nb\n#\n")
        lines = [("synth", "e.txt", "-o", "o.txt", "--size", "20,20,1"),
                 ("synth", "e.txt", "-o", "o.txt", "--size", "5,1,1", "--pin", "0,0,0=a", "--pin", "1,0,0=a"),
                 ("synth", "nowhere.obj", "-o", "o.obj"), ("synth", "wall.obj", "-o", "o.xyz"),
                 ("synth", "wall.obj", "-o", "o.ply", "--sacle", "2"), ("info", "wall.obj"),
                 ("synth", "wall.obj", "-o", "o.ply", "-r", "16", "--scale", "2,1,1"),
                 ("sdf", "wall.obj", "-o", "f.vdb", "-r", "24"), ("scene", "castle", "-o", "c.obj")]
        draws = random.Random(5)
        for number in range(RUNS):
            words = lines[number] if number < len(lines) else draws.choice(lines)
            done = self.run_command(*words, "--progress", "json")
            events = [json.loads(line) for line in done.stderr.splitlines()]
            with self.subTest(words):
                self.assertEqual(events[-1]["event"], "done" if done.returncode == 0 else "error")
                if done.returncode:
                    self.assertEqual(events[-1]["status"], done.returncode)
                fractions = [e["fraction"] for e in events if e["event"] == "progress"]
                self.assertEqual(fractions, sorted(fractions))
                self.assertTrue(all(0 <= f <= 1 for f in fractions))
                for event in events:
                    self.assertIn(event["event"], ("start", "progress", "warning", "file", "done", "error"))
                    if event["event"] == "file":
                        self.assertTrue(os.path.isfile(self.path(event["path"])))

    def test_version_names_libraries_and_machine(self):
        text, for_programs = self.run_command("--version"), self.run_command("--version", "--json")
        self.assertEqual((text.returncode, for_programs.returncode), (0, 0))
        said = json.loads(for_programs.stdout)
        self.assertEqual(text.stdout.split("\n")[0], "exemplar " + said["version"])
        self.assertEqual(said["protocol"], 1)
        self.assertGreaterEqual(len(said["libraries"]), 12)
        for name, version in said["libraries"].items():
            self.assertIn(name, text.stdout)
            self.assertIn(version, text.stdout)
        self.assertIn(said["arithmetic"], text.stdout)

    def test_tells_triangles_and_megabytes(self):
        done = self.run_command("synth", "wall.obj", "-o", "o.glb", "-r", "24", "--scale", "2,1,1")
        self.assertEqual(done.returncode, 0, done.stderr)
        told = re.search(r"o\.glb: ([\d,]+) triangles,.*, ([\d.]+) ([KM]B)\n", done.stdout + done.stderr)
        self.assertIsNotNone(told, done.stdout + done.stderr)
        triangles, size, unit = told.groups()
        with open(self.path("o.glb"), "rb") as file:
            data = file.read()
        document = json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])
        corners = sum(document["accessors"][part["indices"]]["count"]
                      for mesh in document["meshes"] for part in mesh["primitives"])
        self.assertEqual(int(triangles.replace(",", "")), corners // 3)
        self.assertAlmostEqual(float(size) * {"MB": 1e6, "KB": 1e3}[unit] / len(data), 1, delta=0.1)

    def test_open_hands_the_picture_to_the_desktop(self):
        os.mkdir(self.path("bin"))
        opener = self.path("bin/xdg-open")
        with open(opener, "w", encoding="ascii") as file:
            file.write(f"#!/bin/sh\nprintf %s \"$1\" > '{self.path('new')}'\n"
                       f"mv '{self.path('new')}' '{self.path('opened')}'\n")
        os.chmod(opener, 0o755)
        words = ("synth", "wall.obj", "-o", "o.ply", "-r", "16", "--scale", "1,1,1", "--open")
        done = self.run_command(*words, "--preview", "o.png", "--picture-size", "64x48", "--samples", "1",
                                path=self.path("bin") + ":" + os.environ["PATH"])
        self.assertEqual(done.returncode, 0, done.stderr)
        for _ in range(200):  # it is another process, for which nobody waits
            if os.path.exists(self.path("opened")):
                break
            time.sleep(0.05)
        with open(self.path("opened"), encoding="utf-8") as file:
            self.assertTrue(os.path.samefile(file.read(), self.path("o.png")))
        # Where there is no desktop, that is said, and the result is there.
        done = self.run_command(*words, path=self.path("nowhere"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--open: nothing here opens", done.stderr)

    def test_volumes_may_have_y_up(self):
        read = ("-r", "16", "--padding", "2,3,4")
        lines = [("wall.obj", "z.vdb", *read), ("wall.obj", "y.vdb", *read, "--up", "y"),
                 ("z.vdb", "z_again.vdb"), ("y.vdb", "y_as_z.vdb"), ("y.vdb", "y_again.vdb", "--up", "y"),
                 ("z.vdb", "stood.vdb", "--up", "y")]
        held = {}
        for source, result, *more in lines:
            done = self.run_command("sdf", source, "-o", result, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(self.path(result), "rb") as file:
                held[result] = file.read()
        # The file says it: read without a word, it is the same volume; with one, too.
        self.assertEqual(held["y_as_z.vdb"], held["z_again.vdb"])
        self.assertEqual(held["y_again.vdb"], held["y.vdb"])
        self.assertNotEqual(held["y.vdb"], held["z.vdb"])
        # A volume of another program, whose second index is height, is stood up.
        sizes = [re.search(r"(\d+) x (\d+) x (\d+) samples", self.run_command("info", name).stdout).groups()
                 for name in ("z.vdb", "stood.vdb")]
        self.assertEqual((sizes[1][0], sizes[1][2], sizes[1][1]), sizes[0])

    def test_memory_is_the_commands_own(self):
        def peak():
            self.synth("-o", "o.ply", "-r", "32", "--scale", "1,1,1", "--threads", "1", "--stats", "s.json")
            with open(self.path("s.json"), encoding="utf-8") as file:
                return json.load(file)["peak_rss_bytes"]
        small = peak()
        held = bytearray(os.urandom(1 << 20)) * 2048  # 2 GB, all of it touched
        large = peak()
        self.assertEqual(len(held), 2048 << 20)
        print(f"peak {small / 1e6:.0f} MB, of a parent of 2 GB {large / 1e6:.0f} MB", file=sys.stderr)
        self.assertLess(abs(large / small - 1), 0.2)


if __name__ == "__main__":
    unittest.main()
