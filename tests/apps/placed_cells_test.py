# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Cells and a library of pieces, put together as docs/hosts.md says, are the mesh that the command
writes: checked by what an engine of games would do, and nothing of ours."""

import csv
import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

COMMAND = os.environ["EXEMPLAR"]
CHECKERED = "checkered\n\n\n2 2 1\n\n1 2\n2 1\n\n<Objects>\ncheckered\nred\n#\nblue\n#\n"


def read_glb(path):
    """{name: triangles, m x 3 x 3, z up} of the meshes of a .glb, without their nodes' places."""
    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack_from("<I", data, 12)[0]
    tree, binary = json.loads(data[20:20 + length]), data[28 + length:]

    def array(number):
        accessor = tree["accessors"][number]
        view = tree["bufferViews"][accessor["bufferView"]]
        kind = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}[
            accessor["componentType"]]
        wide = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return np.frombuffer(binary, kind, accessor["count"] * wide, start).reshape(-1, wide)

    meshes = {}
    for mesh in tree["meshes"]:
        parts = []
        for part in mesh["primitives"]:
            points = array(part["attributes"]["POSITION"]).astype(float)
            points = np.stack([points[:, 0], -points[:, 2], points[:, 1]], 1)
            parts.append(points[array(part["indices"]).ravel()].reshape(-1, 3, 3))
        meshes[mesh["name"]] = np.concatenate(parts)
    return meshes, tree


def moments(triangles):
    """Integrals over a surface of 1, the coordinates and their products: however it is cut into
    triangles they are the same."""
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0],
                                   triangles[:, 2] - triangles[:, 0]), axis=1) / 2
    middles = (triangles + np.roll(triangles, -1, axis=1)) / 2
    weights = np.repeat(area / 3, 3)
    points = middles.reshape(-1, 3)
    rows = [np.ones(len(points)), *points.T]
    rows += [points[:, a] * points[:, b] for a in range(3) for b in range(a, 3)]
    return np.array([(weights * row).sum() for row in rows])


class PlacedCells(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = held.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_command(self, *words):
        return subprocess.run([COMMAND, *words], cwd=self.folder, capture_output=True, text=True,
                              check=False)

    def test_put_together_are_the_mesh(self):
        done = self.run_command("synth", "castle", "-o", "c.json", "-o", "c.csv", "-o", "m.glb",
                                "--pieces", "l.glb", "--size", "14,12,7", "--seed", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        library, tree = read_glb(self.path("l.glb"))
        self.assertEqual({tree["meshes"][node["mesh"]]["name"] for node in tree["nodes"]},
                         {node["name"] for node in tree["nodes"]})
        with open(self.path("c.json"), encoding="utf-8") as file:
            placed = json.load(file)
        size, cell, origin = (np.array(placed[key]) for key in ("size", "cell_size", "origin"))
        cells = np.array(placed["cells"]).reshape(*size[::-1])  # z, y, x
        self.assertGreater((cells >= 0).sum(), 100)
        total, rows = np.zeros(10), []
        for z, y, x in np.argwhere(cells >= 0):
            piece = placed["pieces"][cells[z, y, x]]
            rows.append([str(x), str(y), str(z), piece["name"], str(piece["turns"]),
                         str(int(piece["mirror"]))])
            triangles = library[piece["name"]]
            if piece["mirror"]:
                triangles = triangles * (-1, 1, 1)
            for _ in range(piece["turns"]):
                triangles = np.stack([-triangles[..., 1], triangles[..., 0], triangles[..., 2]], -1)
            total += moments(triangles + (np.array((x, y, z)) + 0.5) * cell + origin)
        self.assertTrue(any(p["turns"] for p in placed["pieces"]))
        self.assertLess(len(library), len(placed["pieces"]))
        whole, _ = read_glb(self.path("m.glb"))
        expected = moments(np.concatenate(list(whole.values())))
        np.testing.assert_allclose(total, expected, rtol=1e-4, atol=1e-3 * expected[0])
        with open(self.path("c.csv"), encoding="utf-8", newline="") as file:
            table = list(csv.reader(file))
        self.assertEqual(table[0], ["x", "y", "z", "piece", "turns", "mirror"])
        self.assertEqual(sorted(table[1:]), sorted(rows))

    def test_of_labels_alone_have_names_and_colors(self):
        with open(self.path("e.txt"), "w", encoding="utf-8") as file:
            file.write(CHECKERED)
        done = self.run_command("synth", "e.txt", "-o", "o.json", "--size", "6,4,1")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("o.json"), encoding="utf-8") as file:
            placed = json.load(file)
        self.assertEqual(placed["size"], [6, 4, 1])
        self.assertEqual({piece["name"] for piece in placed["pieces"]}, {"red", "blue"})
        cells = np.array(placed["cells"]).reshape(4, 6)
        self.assertTrue((cells[1:] != cells[:-1]).all() and (cells[:, 1:] != cells[:, :-1]).all())

    def test_a_library_needs_pieces(self):
        with open(self.path("e.txt"), "w", encoding="utf-8") as file:
            file.write(CHECKERED)
        for words in (("e.txt", "-o", "o.json", "--pieces", "l.glb"),
                      ("chainmail", "-o", "o.glb", "--pieces", "l.glb"),
                      ("castle", "-o", "o.json", "--pieces", "l.obj")):
            done = self.run_command("synth", *words)
            self.assertEqual((done.returncode, done.stderr.count("exemplar: ")), (2, 1), done.stderr)
            self.assertEqual(sorted(os.listdir(self.folder)), ["e.txt"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
