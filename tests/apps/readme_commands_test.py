# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Every command that README.md shows runs, in its order, in one folder with what it reads; only those
that would take long are made smaller. The pictures that they make are filled by what they show."""

import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

COMMAND = os.environ["EXEMPLAR"]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# What makes a command quick: by how it begins, words to add or to replace.
QUICK = {
    "synth wall.obj": ["--resolution", "32"],
    "synth balls": ["--resolution", "16"],
    "synth castle": {"40,40,7": "16,16,7"},
    "synth houses": {"60,40,5": "16,12,5"},
    "synth grid.txt": {"80,80,10": "30,30,4"},
    "synth rust.jpg": {"rust.jpg": "rust.png"},  # nothing here writes a .jpg
    "synth chainmail --on": ["--resolution", "24"],
    "synth grass --on": ["--resolution", "24"],
    "synth metal --on": ["--resolution", "24"],
    "synth bark --on": ["--resolution", "24"],
    "world make land": {"0:8,0:8": "0:2,0:1"},
    "compare EXAMPLE": None, "synth EXAMPLE": None, "sdf EXAMPLE": None, "render EXAMPLE": None,
    "scene NAME": None, "voxelize EXAMPLE": None, "info EXAMPLE": None, "measure EXAMPLE": None,
    "world init EXAMPLE": None, "mesh F.vdb": None,  # the table of what there is
}


def commands():
    """The words of each command in README.md, without their remarks."""
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        blocks = re.findall(r"^```\n(.*?)^```", file.read(), re.M | re.S)
    lines = [line for block in blocks for line in block.splitlines() if line.startswith("exemplar ")]
    return [re.split(r"#|  ", line)[0].split()[1:] for line in lines]


def box(low, high):
    corners = [[(low, high)[n >> axis & 1][axis] for axis in range(3)] for n in range(8)]
    return corners, ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def write_obj(path, boxes):
    """Boxes, y up."""
    with open(path, "w", encoding="ascii") as file:
        for n, (low, high) in enumerate(boxes):
            corners, quads = box(low, high)
            file.writelines(f"v {x:.6g} {z:.6g} {-y:.6g}\n" for x, y, z in corners)
            for quad in quads:
                file.write("f " + " ".join(str(8 * n + c + 1) for c in quad) + "\n")


def write_grid(path, heights):
    """A sheet of triangles over x and y from -1 to 1, y up."""
    side = len(heights)
    at = np.linspace(-1, 1, side)
    with open(path, "w", encoding="ascii") as file:
        for j in range(side):
            file.writelines(f"v {at[i]:.5f} {heights[j, i]:.5f} {-at[j]:.5f}\n" for i in range(side))
        for j in range(side - 1):
            for i in range(side - 1):
                a = j * side + i + 1
                file.write(f"f {a} {a + 1} {a + side + 1} {a + side}\n")


def write_png(path, picture):
    height, width, channels = picture.shape
    rows = b"".join(b"\0" + row.astype(np.uint8).tobytes() for row in picture)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(
            ">IIBBBBB", width, height, 8, {1: 0, 3: 2}[channels], 0, 0, 0)) + chunk(
                b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_png(path):
    """The pixels of a picture of 8 bits a channel."""
    with open(path, "rb") as file:
        data = file.read()
    at, parts = 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack_from(">IIBB", data, at + 8)
            assert depth == 8
            wide = {0: 1, 2: 3, 6: 4}[color]
        elif kind == b"IDAT":
            parts += data[at + 8:at + 8 + length]
        at += length + 12
    raw = np.frombuffer(zlib.decompress(parts), np.uint8).reshape(height, 1 + width * wide)
    rows = np.zeros((height + 1, wide + width * wide), int)  # a row and a pixel of zeros before
    for y in range(height):
        kind, line, above = raw[y, 0], raw[y, 1:].astype(int), rows[y]
        out = rows[y + 1]
        if kind in (0, 2):
            out[wide:] = (line + (above[wide:] if kind == 2 else 0)) & 255
            continue
        for n in range(width * wide):
            left, up, corner = out[n], above[n + wide], above[n]
            guess = left
            if kind == 3:
                guess = (left + up) // 2
            elif kind == 4:
                p = left + up - corner
                guess = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
            out[n + wide] = (line[n] + guess) & 255
    return rows[1:, wide:].reshape(height, width, wide)


def filled(picture):
    """The shares of its height and of its width over which it shows something: what differs from the
    background, which varies from top to bottom only."""
    background = np.median(np.concatenate([picture[:, :4], picture[:, -4:]], 1), axis=1, keepdims=True)
    ink = np.abs(picture[:, :, :3] - background[:, :, :3]).max(2) > 12
    rows, columns = np.flatnonzero(ink.any(1)), np.flatnonzero(ink.any(0))
    if not len(rows):
        return 0, 0
    return (np.ptp(rows) + 1) / ink.shape[0], (np.ptp(columns) + 1) / ink.shape[1]


class Readme(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = held.name
        random = np.random.default_rng(1)
        stones = [((0, 0.1, 0), (6, 0.9, 3))]
        for row in range(3):
            x = -0.5 * (row % 2)
            while x < 6:
                ends = max(x + 0.05, 0), min(x + 0.95, 6)
                stones.append(((ends[0], -0.1 * random.random(), row + 0.05), (ends[1], 1, row + 0.95)))
                x += 1
        write_obj(self.path("wall.obj"), stones)
        y, x = np.mgrid[:128, :128] / 128
        noise = sum(np.sin(2 * np.pi * (a * x + b * y) + c) / np.hypot(a, b)
                    for a, b, c in random.normal(0, 6, (40, 3)))
        with open(self.path("terrain.asc"), "w", encoding="ascii") as file:
            file.write("ncols 128\nnrows 128\nxllcorner 0\nyllcorner 0\ncellsize 30\n")
            np.savetxt(file, 400 + 60 * noise, fmt="%.2f")
        for name, of in (("terrain.tif", "terrain.asc"), ("more.tif", "terrain.asc")):
            self.run_command("synth", of, "-o", name, "--seed", str(len(name)))
        with open(self.path("grid.txt"), "w", encoding="ascii") as file:
            ground, houses = np.ones((6, 6), int), np.kron([[0, 2], [2, 0]], np.ones((3, 3), int))
            file.write("houses\n\n\n6 6 3\n")
            for layer in (ground, houses, 0 * ground):
                file.write("\n" + "\n".join(" ".join(map(str, row)) for row in layer) + "\n")
        rust = noise[..., None] * 40 + 120 + random.normal(0, 9, (128, 128, 3))
        write_png(self.path("rust.png"), np.clip(rust, 0, 255))
        # A body whose corners the samples have rounded.
        write_obj(self.path("box.obj"), [((0, 0, 0), (3, 2, 2))])
        self.run_command("sdf", "box.obj", "-o", "box.vdb", "-r", "32")
        for surface in ("body.obj", "trunk.obj"):
            self.run_command("mesh", "box.vdb", "-o", surface)
        write_grid(self.path("hill.obj"), 0.4 * np.exp(-3 * ((2 * x - 1) ** 2 + (2 * y - 1) ** 2))[::4, ::4])

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_command(self, *words):
        done = subprocess.run([COMMAND, *words, "-q"], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, f"{' '.join(words)}: {done.stderr}")

    def test_every_command_runs(self):
        ran = 0
        for words in commands():
            line = " ".join(words)
            keys = [key for key in QUICK if line.startswith(key)]
            change = QUICK[max(keys, key=len)] if keys else []
            if change is None:
                continue
            if isinstance(change, dict):
                for old in change:
                    self.assertIn(old, words, "the table QUICK is of another README.md")
                words = [change.get(word, word) for word in words]
            else:
                words = words + change
            with self.subTest(line):
                self.run_command(*words)
                for option, name in zip(words, words[1:]):
                    if option in ("-o", "--preview", "--stats"):
                        self.assertTrue(os.path.exists(self.path(name)), name)
            ran += 1
        self.assertGreaterEqual(ran, 14)
        for name in ("longer.png", "relief.png"):
            shares = filled(read_png(self.path(name)))
            print(f"{name}: filled to {shares[0]:.2f} of its height, {shares[1]:.2f} of its width",
                  file=sys.stderr)
            # As large as the longer side lets it be: a wall of 18 by 3 leaves some of the height.
            self.assertGreater(max(shares), 0.85, name)
            self.assertGreater(min(shares), 0.55, name)

    def test_a_picture_that_is_not_filled_is_found(self):
        picture = np.full((60, 80, 3), 200.0)
        picture[20:40, 10:70] = 30
        self.assertEqual(filled(picture), (20 / 60, 60 / 80))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
