# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""The parts of the add-on that know nothing of Blender: jobs, .glb files, grids."""

import json
import os
import signal
import stat
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "blender"))
from exemplar_blender import command, glb, grid, job  # noqa: E402

COMMAND = os.environ["EXEMPLAR"]


class Folder(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = held.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def script(self, text):
        """A program in place of the command."""
        path = self.path("command")
        with open(path, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + text)
        os.chmod(path, 0o755)
        return path


def events(*lines):
    return "".join(f"echo '{json.dumps(line)}' >&2\n" for line in lines)


START = {"event": "start", "version": "9", "protocol": 1}


class Jobs(Folder):
    def test_follow_the_real_command(self):
        ball(self.path("ball.glb"))
        run = job.Job(COMMAND, ["synth", self.path("ball.glb"), "-o", "out.glb", "--resolution", 24])
        self.assertTrue(run.wait(), run.error)
        self.assertEqual([kind for kind, _ in run.files], ["mesh"])
        self.assertTrue(os.path.isfile(os.path.join(run.folder, "out.glb")))
        self.assertIn('"event":"done"', run.text())
        run.clean()
        self.assertFalse(os.path.exists(run.folder))

    def test_say_what_the_command_says(self):
        run = job.Job(COMMAND, ["synth", "nowhere.glb", "-o", "out.glb"])
        self.assertFalse(run.wait())
        self.assertEqual(run.status, 2)
        self.assertIn("nowhere.glb", run.error)
        run.kill()

    def test_name_the_pins_that_exclude_each_other(self):
        grid.write_labels(self.path("s.txt"), np.array([[[1]], [[2]], [[1]], [[2]]]), ["a", "b"])
        run = job.Job(COMMAND, ["synth", self.path("s.txt"), "-o", "out.txt", "--size", "6,1,1",
                                "--side", "all=free", "--pin", "5,0,0=1", "--pin", "2,0,0=1",
                                "--pin", "3,0,0=1"])
        self.assertFalse(run.wait())
        self.assertEqual(run.status, 3)
        self.assertIn(len(run.pins), (2, 3))
        self.assertIn(2, run.pins)  # it excludes either of the others
        run.kill()

    def test_end_within_the_grace_what_hears_no_signal(self):
        run = job.Job(self.script("trap '' INT TERM\n" + events(START) + "while :; do :; done"), [])
        while not run._started:
            run.poll()
        run.stop()
        self.assertEqual(run.status, -signal.SIGKILL)
        self.assertTrue(run.cancelled)
        run.kill()

    def test_read_progress_that_comes_in_pieces(self):
        text = json.dumps({"event": "progress", "stage": "cutting", "fraction": 0.5})
        run = job.Job(self.script(events(START) + f"printf '{text[:20]}' >&2; sleep 0.3\n"
                                  f"printf '{text[20:]}\\n' >&2; sleep 0.3\n" + events(
                                      {"event": "progress", "stage": "later", "fraction": 0.25})), [])
        seen = set()
        while not run.poll():
            seen.add((run.stage, run.fraction))
            time.sleep(0.02)
        self.assertIn(("cutting", 0.5), seen)
        self.assertEqual((run.stage, run.fraction), ("later", 0.5))  # it never falls
        run.kill()

    def test_refuse_another_protocol(self):
        run = job.Job(self.script(events(dict(START, protocol=2)) + "exec sleep 10"), [])
        run.wait()
        self.assertIn("protocol 2", run.error)
        self.assertFalse(run.cancelled)  # by the user
        run.kill()

    def test_know_what_is_no_exemplar(self):
        run = job.Job(self.script("echo what >&2; exit 1"), [])
        self.assertFalse(run.wait())
        self.assertIn("is not an exemplar", run.error)
        self.assertIn("what", run.error)
        run.kill()

    def test_end_with_the_program(self):
        program = (f"import sys, time, atexit; sys.path.insert(0, {os.path.join(ROOT, 'blender')!r})\n"
                   "from exemplar_blender import job\natexit.register(job.end_all)\n"
                   f"run = job.Job({self.script(events(START) + 'exec sleep 60')!r}, [])\n"
                   "time.sleep(0.2); print(run.process.pid, run.folder)\n")
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True)
        number, folder = done.stdout.decode().split()
        self.assertFalse(os.path.exists(f"/proc/{number}"))
        self.assertFalse(os.path.exists(folder))


class TheVersion(unittest.TestCase):
    def test_is_one(self):
        """The project's, the command's, and the add-on's in its two manifests."""
        import exemplar_blender
        number = ".".join(map(str, exemplar_blender.bl_info["version"]))
        with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
            self.assertIn(f"project(exemplar VERSION {number} ", file.read())
        with open(os.path.join(ROOT, "blender", "exemplar_blender", "blender_manifest.toml"),
                  encoding="utf-8") as file:
            self.assertIn(f'\nversion = "{number}"\n', file.read())
        self.assertEqual(command.version(COMMAND), number)


class TheCommand(Folder):
    def test_is_found_where_it_is_said_to_be(self):
        self.assertEqual(command.find(COMMAND), COMMAND)
        self.assertEqual(command.find(os.path.dirname(COMMAND)), COMMAND)
        self.assertRegex(command.version(COMMAND), r"^\d+\.\d+\.\d+")
        self.assertIn("geometry", command.engines(COMMAND))

    def test_is_nothing_else(self):
        self.assertEqual(command.find(self.path("nowhere")), "")
        plain = self.script("")
        os.chmod(plain, stat.S_IRUSR)
        self.assertEqual(command.find(plain), "")
        self.assertEqual(command.version(self.path("nowhere")), "")


def cube():
    """Twelve triangles around the unit cube, outward."""
    quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    corner = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], float)
    return np.array([[corner[q[i]] for i in order] for q in quads
                     for order in ((0, 1, 2), (0, 2, 3))])


def ball(path):
    points = cube() - 0.5
    glb.write(path, glb.Triangles(points, np.zeros(12, np.int32)))


class Glb(Folder):
    def triangles(self):
        rng = np.random.default_rng(1)
        return glb.Triangles(cube(), np.repeat([0, 2], 6).astype(np.int32),
                             rng.random((12, 3, 2)).astype(np.float32),
                             rng.random((12, 3, 4)).astype(np.float32))

    def test_comes_back_as_it_went(self):
        sent = self.triangles()
        glb.write(self.path("a.glb"), sent)
        back = glb.read(self.path("a.glb"))
        np.testing.assert_array_equal(back.positions, sent.positions)
        np.testing.assert_array_equal(back.materials, sent.materials)
        np.testing.assert_allclose(back.uvs, sent.uvs, atol=2e-7)  # 1 - v, rounded twice
        np.testing.assert_array_equal(back.colors, sent.colors)

    def test_is_what_the_format_says(self):
        glb.write(self.path("a.glb"), self.triangles())
        with open(self.path("a.glb"), "rb") as file:
            data = file.read()
        magic, version, length = struct.unpack_from("<4sII", data)
        self.assertEqual((magic, version, length), (b"glTF", 2, len(data)))
        size, kind = struct.unpack_from("<I4s", data, 12)
        self.assertEqual((size % 4, kind), (0, b"JSON"))
        document = json.loads(data[20:20 + size])
        self.assertEqual(document["buffers"][0]["byteLength"], len(data) - 28 - size)
        self.assertEqual([m["name"] for m in document["materials"]], ["slot 0", "slot 2"])
        # Up is y: the cube's top, z = 1 in Blender, is y = 1 here.
        top = cube()[:, :, 2].max()
        where = document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
        self.assertEqual(where["max"][1], top)

    def test_goes_through_the_command(self):
        """Materials, texture coordinates and the places that corners came from survive it."""
        sent = self.triangles()
        glb.write(self.path("a.glb"), sent)
        run = job.Job(COMMAND, ["synth", self.path("a.glb"), "-o", "out.glb", "--resolution", 16,
                                "--scale", "2,1,1", "--source", "--scatter"])
        self.assertTrue(run.wait(), run.error)
        back = glb.read(os.path.join(run.folder, "out.glb"))
        run.clean()
        self.assertEqual(set(back.materials), {0, 2})
        self.assertIsNotNone(back.uvs)
        faces, weights = back.sources
        self.assertTrue(((faces >= 0) & (faces < 12)).all())
        # A triangle's material is that of the triangles of the example that it came from.
        np.testing.assert_array_equal(sent.materials[faces[:, 0]], back.materials)
        # What is pulled through the places agrees with what the command pulled: texture coordinates.
        weights = np.concatenate([weights, 1 - weights.sum(-1, keepdims=True)], -1)
        pulled = (sent.uvs[faces] * weights[..., None]).sum(-2)
        self.assertLess(np.median(np.abs(pulled - back.uvs).max(-1)), 1e-5)

    def test_refuses_what_is_none(self):
        with open(self.path("a.glb"), "wb") as file:
            file.write(b"solid nothing")
        with self.assertRaises(ValueError):
            glb.read(self.path("a.glb"))


class Grids(Folder):
    def test_labels_come_back_as_they_went(self):
        sent = np.random.default_rng(1).integers(0, 4, (3, 5, 2))
        grid.write_labels(self.path("a.txt"), sent, ["a wall", "b", "c"])
        np.testing.assert_array_equal(grid.read_labels(self.path("a.txt")), sent)

    def test_labels_go_through_the_command(self):
        sample = np.indices((4, 4, 1)).sum(0) % 2 + 1
        grid.write_labels(self.path("a.txt"), sample, ["black", "white"])
        run = job.Job(COMMAND, ["synth", self.path("a.txt"), "-o", "out.txt", "--size", "7,9,1",
                                "--side", "all=free"])
        self.assertTrue(run.wait(), run.error)
        back = grid.read_labels(os.path.join(run.folder, "out.txt"))
        run.clean()
        self.assertEqual(back.shape, (7, 9, 1))
        self.assertTrue((back[1:] != back[:-1]).all() and (back[:, 1:] != back[:, :-1]).all())

    def test_cells_are_measured(self):
        points = np.array([[0, 0, 1], [2, 0, 1], [6, 3, 1]], float)
        np.testing.assert_array_equal(grid.measured_cell(points), [2, 3, 2])
        with self.assertRaises(grid.GridError):
            grid.measured_cell(points[:1])

    def test_what_is_off_the_grid_is_named(self):
        points = np.array([[0, 0, 0], [1.5, 0, 0]], float)
        with self.assertRaises(grid.GridError) as caught:
            grid.cells_of(points, np.ones(3), points[0], ["a", "b"])
        self.assertEqual(caught.exception.names, ["b"])
        with self.assertRaises(grid.GridError) as caught:
            grid.label_grid(np.zeros((2, 3), int), [1, 2], ["a", "b"])
        self.assertEqual(caught.exception.names, ["a", "b"])

    def test_heights_come_back_as_they_went(self):
        sent = np.random.default_rng(1).random((4, 6))
        x, y = np.meshgrid(np.arange(6) * 0.5 - 1, np.arange(4)[::-1] * 0.5 + 2)
        points = np.stack([x.ravel(), y.ravel(), sent.ravel()], 1)
        order = np.random.default_rng(2).permutation(len(points))
        heights, side, corner = grid.height_grid(points[order])
        np.testing.assert_array_equal(heights, sent)
        np.testing.assert_allclose([side, *corner], [0.5, -1, 2])
        grid.write_asc(self.path("a.asc"), heights, side)
        back, again = grid.read_asc(self.path("a.asc"))
        np.testing.assert_allclose(back, sent, rtol=1e-6)
        self.assertEqual(again, 0.5)

    def test_what_is_no_grid_of_heights_is_refused(self):
        points = np.stack([*np.meshgrid([0, 1, 2.5], [0, 1, 2], [0])], -1).reshape(-1, 3)
        with self.assertRaises(grid.GridError):
            grid.height_grid(points)
        with self.assertRaises(grid.GridError):
            grid.height_grid(np.stack([*np.meshgrid([0, 1], [0, 1], [0, 1])], -1).reshape(-1, 3))


if __name__ == "__main__":
    unittest.main()
