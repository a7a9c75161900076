# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""The Python module: what it makes is what the command makes, arrays are views, work can be stopped."""

import ast
import gc
import inspect
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import exemplar
from files import WithFiles

COMMAND = os.environ["EXEMPLAR"]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def cube(size=1.0, at=(0, 0, 0)):
    corner = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], float) * size + at
    quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    faces = [[q[i] for i in order] for q in quads for order in ((0, 1, 2), (0, 2, 3))]
    return corner, np.array(faces)


def blocks():
    """A few cubes, two materials."""
    vertices, faces, materials = [], [], []
    for n, at in enumerate([(0, 0, 0), (1.6, 0.5, 0.1), (0.3, 1.7, 0.2), (1.9, 1.9, 0)]):
        v, f = cube(1.0, at)
        faces.append(f + 8 * n)
        vertices.append(v)
        materials += [n % 2] * 12
    return exemplar.Mesh(np.concatenate(vertices), np.concatenate(faces), face_materials=materials,
                         materials=[{"name": "red", "color": (0.8, 0.1, 0.1, 1)}, {"name": "blue"}])


def crumbs(count):
    """Small triangles here and there."""
    draws = np.random.default_rng(2)
    corners = draws.random((count, 1, 3)) + draws.normal(0, 0.004, (count, 3, 3))
    return exemplar.Mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def checkered():
    return exemplar.LabelGrid(np.indices((4, 4, 1)).sum(0) % 2 + 1, names=["", "black", "white"])


class Synthesis(WithFiles):
    def test_makes_what_the_command_makes(self):
        blocks().write(self.path("e.ply"))
        subprocess.run([COMMAND, "synth", "e.ply", "-o", "c.vdb", "-o", "c.glb", "--origins", "co.vdb",
                        "--scale", "2,1,1", "--seed", "5", "--resolution", "24", "-q"],
                       cwd=self.folder, check=True)
        example = exemplar.read(self.path("e.ply"), resolution=24)
        made = exemplar.synthesize(example, scale=(2, 1, 1), seed=5)
        of_command = exemplar.read_field(self.path("c.vdb"))
        np.testing.assert_array_equal(made.field.values, of_command.values)
        made.save(self.path("p.glb"))
        with open(self.path("c.glb"), "rb") as a, open(self.path("p.glb"), "rb") as b:
            self.assertEqual(a.read(), b.read())

    def test_knows_where_each_sample_came_from(self):
        example = exemplar.Example(blocks(), resolution=24)
        made = exemplar.synthesize(example, scale=(2, 2, 1), seed=1)
        self.assertEqual(made.origins.shape, made.field.shape + (3,))
        i, j, k = np.moveaxis(made.origins.astype(int), -1, 0)
        self.assertTrue((made.origin_example == 0).all() and (made.origin_turns == 0).all())
        at = exemplar.Example(blocks(), resolution=24).field.values
        # Most samples are those of the example; the rest were evened out at seams.
        came, now = at[i, j, k], made.field.values
        self.assertGreater(np.isclose(came, now, atol=0.5 * made.field.voxel_size).mean(), 0.7)

    def test_is_a_function_of_the_seed_alone(self):
        example = exemplar.Example(blocks(), resolution=20)
        one, eight, other = (exemplar.synthesize(example, scale=(2, 1, 1), seed=s, threads=t)
                             for s, t in ((3, 1), (3, 8), (4, 2)))
        np.testing.assert_array_equal(one.field.values, eight.field.values)
        self.assertTrue((one.field.values != other.field.values).any())

    def test_of_labels_holds_pins_and_says_what_excludes_each_other(self):
        made = exemplar.synthesize(checkered(), size=(7, 5, 1), side=["all=free"],
                                   pin={"2,0,0": "white"})
        cells = made.labels.labels
        self.assertEqual((made.labels.names[1], cells[2, 0, 0]), ("black", 2))
        self.assertTrue((cells[1:] != cells[:-1]).all() and (cells[:, 1:] != cells[:, :-1]).all())
        with self.assertRaises(exemplar.Impossible) as caught:
            exemplar.synthesize(checkered(), size=(7, 1, 1), side=["all=free"],
                                pin=["2,0,0=white", "3,0,0=white"])
        self.assertEqual(caught.exception.conflict["pins"], [0, 1])

    def test_mesh_is_sound_remembered_and_has_the_materials(self):
        made = exemplar.synthesize(exemplar.Example(blocks(), resolution=24), scale=(2, 1, 1))
        mesh = made.mesh()
        health = mesh.health()
        self.assertTrue(health["closed"] and health["manifold"] and health["oriented"])
        self.assertEqual([m["name"] for m in mesh.materials], ["red", "blue"])
        self.assertIs(made.mesh(), mesh)
        fewer = made.mesh(simplify=0.2, source=True)
        self.assertLess(len(fewer.faces), len(mesh.faces))
        self.assertEqual(fewer.source_faces.shape, (len(fewer.faces), 3))
        self.assertLess(fewer.source_faces.max(), 48)
        colored = np.repeat([0, 1, 0, 1], 12)[fewer.source_faces[:, 0]]
        # All but those that lie on both sides of a border between materials.
        self.assertGreater((colored == fewer.face_materials).mean(), 0.9)
        self.assertLessEqual(len(made.field.to_mesh().decimate(triangles=200).faces), 220)

    def test_measures_and_refines(self):
        made = exemplar.synthesize(exemplar.Example(blocks(), resolution=32), scale=(2, 1, 1))
        figures = made.measure()
        self.assertGreater(figures["likeness"]["coverage"], 0.2)
        finer = made.detail(2)
        self.assertEqual(finer.field.shape, tuple(2 * n for n in made.field.shape))

    def test_keeps_and_mixes(self):
        example = exemplar.Example(blocks(), resolution=20)
        kept = exemplar.synthesize(example, scale=(2, 1, 1), keep=exemplar.Mesh(*cube(1.5, (-.3,) * 3)))
        field, was = kept.field, example.field
        at = np.rint((np.array([0.5, 0.5, 0.5]) - field.origin) / field.voxel_size).astype(int)
        before = np.rint((np.array([0.5, 0.5, 0.5]) - was.origin) / was.voxel_size).astype(int)
        self.assertEqual(field.values[tuple(at)], was.values[tuple(before)])
        other = exemplar.Mesh(blocks().vertices * (-1, -1, 1), blocks().faces)
        mixed = exemplar.synthesize([example, other], scale=(3, 3, 1), engine="voting")
        self.assertEqual(set(np.unique(mixed.origin_example)), {0, 1})


class Arrays(WithFiles):
    def test_are_views_that_keep_their_owner(self):
        field = exemplar.mesh_to_field(exemplar.Mesh(*cube()), resolution=16)
        a, b = np.asarray(field), field.values
        self.assertTrue(np.shares_memory(a, b))
        self.assertTrue(a.flags.f_contiguous and not a.flags.writeable)
        copy = a.copy()
        del field, b
        gc.collect()
        np.testing.assert_array_equal(a, copy)
        mesh = blocks()
        vertices, before = mesh.vertices, mesh.vertices.copy()
        self.assertTrue(np.shares_memory(vertices, mesh.vertices))
        del mesh
        gc.collect()
        np.testing.assert_array_equal(vertices, before)
        origins = exemplar.synthesize(exemplar.Example(blocks(), resolution=16), scale=2).origins
        gc.collect()
        self.assertGreaterEqual(int(origins.min()), 0)

    def test_are_x_y_z_whatever_their_strides(self):
        x, y, z = np.meshgrid(np.arange(5.0), np.arange(6.0), np.arange(7.0), indexing="ij")
        values = x - 2 * y + z * 0.5
        for given in (values, np.asfortranarray(values), values[::-1, ::2], values.astype("f8")):
            field = exemplar.Field(given)
            self.assertEqual(field.shape, given.shape)
            np.testing.assert_array_equal(field.values, given.astype(np.float32))
            np.testing.assert_array_equal(np.asarray(field, dtype=float), given)

    def test_are_distances_of_the_world(self):
        field = exemplar.mesh_to_field(exemplar.Mesh(*cube(2.0, (1, 2, 3))), resolution=20, padding=2)
        index = np.stack(np.meshgrid(*map(np.arange, field.shape), indexing="ij"), -1)
        place = index * field.voxel_size + field.origin
        inside = ((place > (1, 2, 3)) & (place < (3, 4, 5))).all(-1)
        np.testing.assert_array_equal(field.values < 0, inside)

    def test_files_come_back(self):
        field = exemplar.mesh_to_field(blocks(), resolution=16)
        field.write(self.path("f.vdb"))
        np.testing.assert_array_equal(exemplar.read_field(self.path("f.vdb")).values, field.values)
        blocks().write(self.path("m.obj"))
        np.testing.assert_allclose(exemplar.read_mesh(self.path("m.obj")).vertices, blocks().vertices)
        checkered().write(self.path("l.txt"))
        np.testing.assert_array_equal(exemplar.read_labels(self.path("l.txt")).labels,
                                      checkered().labels)
        heights = exemplar.Heights(np.random.default_rng(1).random((5, 7)), cell_size=2)
        heights.write(self.path("h.asc"))
        back = exemplar.read_heights(self.path("h.asc"))
        np.testing.assert_allclose(back.heights, heights.heights, rtol=1e-5)
        self.assertEqual(back.cell_size, 2)

    def test_do_not_come_shuffled_into_openvdb(self):
        try:
            import pyopenvdb as vdb
        except ImportError:
            try:
                import openvdb as vdb
            except ImportError:
                self.skipTest("python3-openvdb is not installed")
        field = exemplar.mesh_to_field(exemplar.Mesh(*cube(2.0, (1, 2, 3))), resolution=12, padding=3)
        self.assertEqual(len(set(field.shape)), 1)
        field = exemplar.Field(field.values[:, :-2, :-5], voxel_size=field.voxel_size,
                               origin=field.origin, truncation=field.truncation)
        grid = field.to_openvdb()
        accessor = grid.getAccessor()
        for ijk in ((0, 0, 0), (8, 5, 6), (3, 9, 2), (11, 4, 7)):
            self.assertEqual(np.float32(accessor.getValue(ijk)), field.values[ijk])
        back = exemplar.Field.from_openvdb(grid)
        np.testing.assert_allclose(back.origin, field.origin, atol=1e-9)
        np.testing.assert_array_equal(back.values, field.values)
        vdb.write(self.path("a.vdb"), grids=[grid])
        read = exemplar.read_field(self.path("a.vdb"))
        self.assertEqual(read.values.min(), field.values.min())

    def test_are_taken_from_anything_with_vertices_and_faces(self):
        class Other:
            vertices, faces = cube()
        made = exemplar.synthesize(Other(), scale=2, resolution=None)
        self.assertGreater(len(made.mesh().faces), 100)
        np.testing.assert_array_equal(exemplar.Example(np.eye(4, dtype=int)[:, :, None]).labels.labels[
            ..., 0], np.eye(4))

    def test_pictures_are_pictures(self):
        picture = exemplar.render(blocks(), size=(64, 48), samples=4)
        self.assertEqual((picture.shape, picture.dtype), ((48, 64, 3), np.uint8))
        self.assertGreater(picture.std(), 5)
        png = blocks()._repr_png_()
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        with open(self.path("p.png"), "wb") as file:
            file.write(png)
        self.assertEqual(exemplar.Example(self.path("p.png"), engine="layered").labels, None)


class Errors(WithFiles):
    def test_say_what_would_be_right(self):
        for text, call in {
                "nowhere.obj": lambda: exemplar.read("nowhere.obj"),
                "`resolution`": lambda: exemplar.read(blocks(), resolution=1),
                "`reslution`": lambda: exemplar.read(blocks(), reslution=20),
                "`scale`": lambda: exemplar.synthesize(blocks(), scale=(1, 2)),
                "`sacle`": lambda: exemplar.synthesize(blocks(), sacle=2),
                "`field_block`": lambda: exemplar.synthesize(blocks(), field_block=2),
                "vertex 9 of 8": lambda: exemplar.Mesh(cube()[0], [[0, 1, 9]]),
                "n x 3": lambda: exemplar.Mesh(np.zeros((4, 2)), [[0, 1, 2]]),
                "NaN": lambda: exemplar.Field(np.full((3, 3, 3), np.nan)),
                "three dimensions": lambda: exemplar.Field(np.zeros((3, 3))),
                "65535": lambda: exemplar.LabelGrid(np.full((2, 2, 2), 70000)),
                ".doc": lambda: blocks().write(self.path("a.doc"))}.items():
            with self.subTest(text), self.assertRaises(exemplar.InputError) as caught:
                call()
            self.assertIn(text, str(caught.exception))
        self.assertTrue(issubclass(exemplar.InputError, ValueError))


class Waiting(unittest.TestCase):
    def test_progress_rises_and_may_stop_the_work(self):
        example = exemplar.Example(blocks(), resolution=48)
        seen = []
        exemplar.synthesize(example, scale=(3, 3, 1), progress=lambda s, f: seen.append(f))
        self.assertEqual(seen, sorted(seen))
        self.assertTrue(seen and 0 <= seen[0] <= seen[-1] <= 1)
        with self.assertRaises(exemplar.Cancelled):
            exemplar.synthesize(example, scale=(8, 8, 2), progress=lambda s, f: False)

        def fails(stage, fraction):
            raise KeyError(stage)
        with self.assertRaises(KeyError):
            exemplar.synthesize(example, scale=(8, 8, 2), progress=fails)

    def interrupted(self, work, after):
        """Presses Ctrl-C so many seconds after work began; the CPU seconds until it stops, and those
        of the clock."""
        asked = []

        def ask():
            asked.extend((time.process_time(), time.monotonic()))
            os.kill(os.getpid(), signal.SIGINT)
        timer = threading.Timer(after, ask)
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            work()
        ended = time.process_time(), time.monotonic()
        timer.join()
        return ended[0] - asked[0], ended[1] - asked[1]

    def test_ctrl_c_is_heard_within_half_a_second(self):
        example = exemplar.Example(blocks(), resolution=48)
        soup = crumbs(1_000_000)
        noise = exemplar.Field(np.random.default_rng(1).normal(size=(180,) * 3).astype(np.float32))
        works = {"synthesis": (lambda: exemplar.synthesize(example, scale=(12, 12, 3)), (0.3,)),
                 "distances": (lambda: exemplar.mesh_to_field(blocks(), resolution=400, half_width=200),
                               (0.3,)),
                 "reading": (lambda: exemplar.Example(blocks(), resolution=400), (0.3,)),
                 "reading a soup": (lambda: exemplar.Example(soup, resolution=100), (0.3, 0.8)),
                 "redistancing": (lambda: exemplar.redistance(noise), (0.2, 0.6)),
                 "a picture": (lambda: exemplar.render(soup, size=(960, 720), samples=64), (0.1, 0.4, 0.8)),
                 "labels": (lambda: exemplar.mesh_to_labels(blocks(), resolution=900), (0.1, 0.5, 1.2))}
        for name, (work, moments) in works.items():
            for after in moments:
                with self.subTest(name, after=after):
                    cpu, clock = self.interrupted(work, after)
                    print(f"{name}, after {after} s: stopped {clock:.2f} s after Ctrl-C, {cpu:.2f} s of CPU",
                          file=sys.stderr)
                    # What two cores do in half a second: the clock is others' too.
                    self.assertLess(cpu, 1)

    def test_other_threads_go_on_meanwhile(self):
        example = exemplar.Example(blocks(), resolution=32)
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)
        counting = threading.Thread(target=count)
        counting.start()
        exemplar.synthesize(example, scale=(3, 3, 1))
        done.set()
        counting.join()
        self.assertGreater(counted[0], 10)

    def test_eight_threads_at_once(self):
        example = exemplar.Example(blocks(), resolution=16)
        expected = exemplar.synthesize(example, scale=2, seed=2).field.values
        made = [None] * 8

        def make(n):
            made[n] = exemplar.synthesize(example, scale=2, seed=2).field.values
        threads = [threading.Thread(target=make, args=(n,)) for n in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for values in made:
            np.testing.assert_array_equal(values, expected)

    def test_a_forked_child_has_threads_of_its_own(self):
        mesh = exemplar.Mesh(*cube())
        self.assertTrue(mesh.health()["closed"])
        child = os.fork()
        if child == 0:
            signal.alarm(60)  # ends it where it would wait for one that is not there
            os._exit(0 if mesh.health()["closed"] else 1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)

    def test_calls_do_not_leak(self):
        def resident():
            with open("/proc/self/statm", encoding="ascii") as file:
                return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        values = np.random.default_rng(1).random((16, 16, 16)).astype(np.float32)
        example, mesh = exemplar.Example(checkered()), exemplar.Mesh(*cube())
        works = {"arrays": lambda: np.asarray(exemplar.Field(values)).sum(),  # 16 KB each
                 "synthesis": lambda: exemplar.synthesize(example, size=(4, 4, 1)).origins.sum(),
                 "loops": lambda: exemplar.mesh_to_field(mesh, resolution=8),
                 "errors": lambda: self.assertRaises(exemplar.InputError, exemplar.Mesh,
                                                     cube()[0], [[0, 1, 9]])}
        for name, work in works.items():
            with self.subTest(name):
                for _ in range(200):
                    work()
                before = resident()
                for _ in range(1000):
                    work()
                more = resident() - before
                print(f"1,000 calls of {name}: {more / 1e6:.2f} MB more", file=sys.stderr)
                self.assertLess(more, 1_000_000)


class Documents(unittest.TestCase):
    def test_settings_are_keywords_with_their_meaning(self):
        signature = inspect.signature(exemplar.synthesize)
        for engine in exemplar.engines():
            for setting in exemplar.settings(engine):
                key = setting["key"].replace("-", "_")
                if key in ("patch", "seed", "scale", "side", "rotations", "field_block"):
                    if key != "field_block":
                        self.assertIn(key, signature.parameters)
                        self.assertIn(f"    {key}: ", exemplar.synthesize.__doc__)
        self.assertIs(signature.parameters["seed"].kind, inspect.Parameter.KEYWORD_ONLY)

    def test_stubs_name_what_there_is(self):
        with open(os.path.join(ROOT, "python", "exemplar", "__init__.pyi"), encoding="utf-8") as file:
            tree = ast.parse(file.read())
        named = {n.name: n for n in tree.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(named), set(exemplar.__all__))
        for name, node in named.items():
            if not isinstance(node, ast.ClassDef) or not node.body:
                continue
            own = {n.name if isinstance(n, ast.FunctionDef) else n.target.id for n in node.body
                   if isinstance(n, (ast.FunctionDef, ast.AnnAssign))}
            there = {n for n in vars(getattr(exemplar, name)) if not n.startswith("_")}
            if name not in ("Impossible", "InputError", "Cancelled", "Unfinished"):
                self.assertEqual({n for n in own if not n.startswith("_")}, there, name)

    def test_the_readme_runs(self):
        """Its ten lines of Python, as they are, in a folder with what they read."""
        with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
            text = file.read().split("```python\n")[1].split("```")[0]
        with tempfile.TemporaryDirectory() as folder:
            was = os.getcwd()
            os.chdir(folder)
            try:
                blocks().write("wall.obj")
                exec(compile(text.replace("resolution=96", "resolution=24"), "README.md", "exec"), {})
                self.assertTrue(os.path.isfile("longer.glb"))
            finally:
                os.chdir(was)


if __name__ == "__main__":
    unittest.main()
