# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""The add-on in Blender without a window, installed from its zip."""

import json
import math
import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import numpy as np
import scene_for_tests as scene
from mathutils import Matrix

scene.install()
from exemplar_blender import exchange, run  # noqa: E402


def settings(**values):
    group = bpy.context.scene.exemplar.extend
    for key in group.__annotations__:
        group.property_unset(key)
    group.detail, group.samples = "CUSTOM", 32
    for key, value in values.items():
        setattr(group, key, value)


def extend(*things, **values):
    """The result of a run that goes well."""
    settings(**values)
    scene.choose(*things)
    assert bpy.ops.exemplar.extend() == {"FINISHED"}
    return bpy.context.active_object


def vertex_bytes(thing):
    values = np.empty(3 * len(thing.data.vertices), np.float32)
    thing.data.vertices.foreach_get("co", values)
    return values.tobytes()


def solid(name="Ball", place=(0, 0, 0), size=1.0, segments=12):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=segments, ring_count=segments // 2, radius=size,
                                         location=place)
    bpy.context.active_object.name = name
    return bpy.context.active_object


def studded_plate():
    """6 x 6 studs of gold on a plate, which goes on to its sides."""
    made = bpy.data.meshes.new("Studs")
    points, faces = [], []
    for x in range(6):
        for y in range(6):
            for low, high in (((x, y, 0), (x + 1, y + 1, 0.3)),
                              ((x + 0.25, y + 0.25, 0.2), (x + 0.75, y + 0.75, 0.8))):
                at = len(points)
                points += [tuple((low, high)[n >> a & 1][a] for a in range(3)) for n in range(8)]
                faces += [[at + n for n in quad] for quad in (
                    (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]
    made.from_pydata(points, [], faces)
    made.materials.append(scene.material("Gold", (0.9, 0.7, 0.1)))
    studs = bpy.data.objects.new("Studs", made)
    studs.location = (30, 0, 0)
    bpy.context.scene.collection.objects.link(studs)
    return studs


class InAScene(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_homefile(use_factory_startup=False, use_empty=True)
        scene.empty_scene()
        self.addCleanup(lambda: self.assertEqual(scene.leftovers(), ([], [])))

    def error(self, *things, **values):
        """What is said where it fails."""
        settings(**values)
        scene.choose(*things)
        before = [t.name for t in bpy.data.objects]
        with self.assertRaises(RuntimeError) as caught:
            bpy.ops.exemplar.extend()
        self.assertEqual([t.name for t in bpy.data.objects], before)
        notes = json.loads(bpy.context.scene.exemplar.notes)
        self.assertIn(notes["error"], str(caught.exception))
        return notes["error"]


class Extend(InAScene):
    def test_goes_where_the_selection_is_with_its_materials(self):
        turn = Matrix.Translation((3, 2, 1)) @ Matrix.Rotation(0.6, 4, "Z")
        parents = {"plain": Matrix(), "turned, small": turn @ Matrix.Scale(0.5, 4),
                   "mirrored": turn @ Matrix.Diagonal((-1, 1, 1, 1)),
                   "stretched": turn @ Matrix.Diagonal((1, 2, 1.5, 1))}
        for name, matrix in parents.items():
            with self.subTest(name):
                scene.empty_scene()
                wall = scene.wall()
                parent = bpy.data.objects.new("Parent", None)
                bpy.context.scene.collection.objects.link(parent)
                wall.parent = parent
                parent.matrix_world = matrix
                bpy.context.view_layer.update()
                brick, mortar = wall.data.materials
                more = extend(wall, scale=(2, 1, 1))
                self.assertIs(more.data.materials[0], brick)
                self.assertIs(more.data.materials[1], mortar)
                self.assertEqual(len(bpy.data.materials), 2)
                np.testing.assert_allclose(more.scale, 1, atol=1e-6)
                frame = exchange.frame_of(wall)
                was, now = scene.world_points(wall, frame), scene.world_points(more, frame)
                voxel = np.ptp(was, axis=0).max() / 32
                np.testing.assert_allclose(np.ptp(now, axis=0), np.ptp(was, axis=0) * [2, 1, 1],
                                           atol=2 * voxel)  # a voxel at either end
                np.testing.assert_allclose(now.min(0)[1:], was.min(0)[1:], atol=voxel)
                self.assertTrue(wall.hide_get())
                self.assertEqual(more.users_collection[0], wall.users_collection[0])

    def test_keeps_texture_coordinates_and_both_materials(self):
        wall = scene.wall()
        more = extend(wall, scale=(2, 1, 1), samples=64)
        uvs = np.empty(2 * len(more.data.loops), np.float32)
        more.data.uv_layers["UVMap"].data.foreach_get("uv", uvs)
        self.assertGreaterEqual(uvs.min(), 0.04)
        self.assertLessEqual(uvs.max(), 0.9)
        self.assertGreater(uvs.std(), 0.1)
        area = np.zeros(2)
        for face in more.data.polygons:
            area[face.material_index] += face.area
        self.assertTrue((area > 0.1 * area.sum()).all(), area)
        self.assertTrue(more.data.has_custom_normals)
        self.assertTrue(all(face.use_smooth for face in more.data.polygons))

    def test_shows_the_files_normals_to_a_degree(self):
        came = []

        def watched(name, triangles, exported):
            came.append(triangles)
            return build(name, triangles, exported)
        build = exchange.build
        for thing, shape in ((scene.wall(), "edges"), (solid(segments=24, place=(9, 0, 0)), "round")):
            with self.subTest(shape), unittest.mock.patch.object(exchange, "build", watched):
                mesh = extend(thing, scale=(2, 1, 1), scatter=True).data
                mesh.calc_normals_split()
                shown, points = (np.empty(3 * len(mesh.loops), np.float32) for _ in range(2))
                mesh.loops.foreach_get("normal", shown)
                for loop, at in zip(mesh.loops, points.reshape(-1, 3)):
                    at[:] = mesh.vertices[loop.vertex_index].co
                file = came.pop()
                # The same corners in the same order, but for triangles without area.
                p = file.positions.astype(np.float32)
                whole = ((p != np.roll(p, 1, 1)).any(-1)).all(-1)
                np.testing.assert_array_equal(points.reshape(-1, 3, 3), p[whole])
                plain = np.array([mesh.vertices[loop.vertex_index].normal for loop in mesh.loops])
                away, plain = (np.degrees(np.arccos((n.reshape(-1, 3, 3) * file.normals[whole]).sum(
                    -1).clip(-1, 1))).max() for n in (shown, plain))
                print(f"{shape}: normals of {len(mesh.loops)} corners are {away:.3f} degrees away at "
                      f"most, {plain:.1f} without the file's", file=sys.stderr)
                self.assertLess(away, 1)
                self.assertGreater(plain, 5)

    def test_brings_groups_colors_and_further_attributes(self):
        ball = solid(segments=24)
        mesh = ball.data
        x = np.array([v.co.x for v in mesh.vertices])
        for group, values in (("right", x > 0), ("left", x < -0.2)):
            ball.vertex_groups.new(name=group).add(np.flatnonzero(values).tolist(), 1.0, "REPLACE")
        mesh.attributes.new("height", "FLOAT", "POINT").data.foreach_set(
            "value", [v.co.z for v in mesh.vertices])
        mesh.color_attributes.new("Paint", "FLOAT_COLOR", "POINT").data.foreach_set(
            "color", np.stack([(x > 0) * 1.0, 0 * x, (x <= 0) * 1.0, 0 * x + 1], 1).ravel())
        further = mesh.uv_layers.new(name="Further")
        further.data.foreach_set("uv", np.full(2 * len(mesh.loops), 0.25, np.float32))
        mesh.uv_layers.active = mesh.uv_layers["UVMap"]
        more = extend(ball, scale=(1, 1, 1), samples=40, scatter=True, repeats="none")
        self.assertEqual(set(more.data.uv_layers.keys()), {"UVMap", "Further"})
        values = np.empty(2 * len(more.data.loops), np.float32)
        more.data.uv_layers["Further"].data.foreach_get("uv", values)
        np.testing.assert_allclose(values, 0.25, atol=1e-5)
        self.assertEqual({g.name for g in more.vertex_groups}, {"right", "left"})
        self.assertIn("Paint", more.data.color_attributes)
        # As high as where it came from: a sphere's v is the latitude, and came another way.
        heights = np.empty(len(more.data.vertices), np.float32)
        more.data.attributes["height"].data.foreach_get("value", heights)
        owners = np.empty(len(more.data.loops), np.int32)
        more.data.loops.foreach_get("vertex_index", owners)
        more.data.uv_layers["UVMap"].data.foreach_get("uv", values)
        error = np.abs(heights[owners] + np.cos(np.pi * values[1::2]))
        self.assertLess(np.median(error), 0.02)
        self.assertGreater(heights.max() - heights.min(), 1.5)

    def test_takes_modifiers_instances_and_curves(self):
        inner = scene.wall(columns=2, rows=2)
        bricks = bpy.data.collections.new("Bricks")
        bricks.objects.link(inner)
        bpy.context.scene.collection.objects.unlink(inner)
        place = bpy.data.objects.new("Place", None)
        place.instance_type, place.instance_collection = "COLLECTION", bricks
        place.location = (5, 0, 0)
        bpy.context.scene.collection.objects.link(place)
        bpy.ops.mesh.primitive_cube_add()
        cube = bpy.context.active_object
        cube.modifiers.new("Array", "ARRAY").count = 2
        bpy.ops.curve.primitive_bezier_circle_add(location=(0, 6, 0))
        curve = bpy.context.active_object
        curve.data.bevel_depth = 0.2
        got = exchange.gather(bpy.context, [cube.name, curve.name, place.name], Matrix())
        points = got.triangles.positions.reshape(-1, 3)
        np.testing.assert_allclose(points[:, 0].max(), 7, atol=0.02)  # the instance
        self.assertGreater(points[:, 1].max(), 7)                      # the curve
        twelve = exchange.gather(bpy.context, [cube.name], Matrix()).triangles
        self.assertEqual(len(twelve), 24)                              # the array
        self.assertEqual({key and key[0] for key in got.materials}, {None, "Brick", "Mortar"})

    def test_gives_sheets_a_thickness(self):
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8, size=4)
        sheet = bpy.context.active_object
        for vertex in sheet.data.vertices:
            vertex.co.z = 0.3 * math.sin(2 * vertex.co.x)
        more = extend(sheet, thickness=0.5, scale=(2, 1, 1))
        self.assertGreater(len(more.data.polygons), 100)
        got = exchange.gather(bpy.context, [sheet.name], Matrix(), 0.5).triangles.positions
        edges = {}
        for triangle in got.round(6):
            corners = [tuple(c) for c in triangle]
            for a, b in zip(corners, corners[1:] + corners[:1]):
                edges[a, b] = edges.get((a, b), 0) + 1
        self.assertTrue(all(edges.get((b, a)) == n for (a, b), n in edges.items()))  # closed

    def test_keeps_what_is_kept(self):
        first, second = solid(size=0.8), solid("Other", (1.7, 0.4, 0), 0.7)
        bpy.ops.mesh.primitive_cube_add(size=2.1)
        keep = bpy.context.active_object
        more = extend(first, second, scale=(2, 1, 1), keep=keep, engine="voting", scatter=True)
        self.assertFalse(keep.hide_get())
        points = scene.world_points(more)
        inside = points[(np.abs(points) < 0.95).all(1)]
        far = np.abs(np.linalg.norm(inside, axis=1) - 0.8)
        self.assertGreater(len(inside), 50)
        self.assertLess(np.quantile(far, 0.9), 0.1)  # the ball is there, to a voxel

    def test_lies_on_another_object(self):
        studs = studded_plate()
        ball = solid("Ball", (5, 5, 5), 6.0, 32)
        more = extend(studs, on=ball, span=8.0, samples=24)
        self.assertIs(more.data.materials[0], bpy.data.materials["Gold"])
        away = np.linalg.norm(scene.world_points(more) - (5, 5, 5), axis=1)
        # 0.8 of height, 8/6 as large on the ball, which lies about in the middle of them.
        self.assertLess(abs(np.median(away) - 6), 0.3)
        self.assertLess(abs(np.ptp(away) - 0.8 * 8 / 6), 0.25)
        # All around it, not on one side.
        self.assertLess(np.abs(scene.world_points(more).mean(0) - (5, 5, 5)).max(), 0.5)
        self.assertFalse(ball.hide_get())
        scene.choose(more)
        with self.assertRaisesRegex(RuntimeError, "choose more Detail"):
            bpy.ops.exemplar.again(how="REFINE2")

    def test_vertex_groups_say_where_on_an_object_and_how_large(self):
        studs = studded_plate()
        ball = solid("Ball", (5, 5, 5), 6.0, 32)
        top, size = ball.vertex_groups.new(name="top"), ball.vertex_groups.new(name="size")
        for vertex in ball.data.vertices:
            top.add([vertex.index], 1.0 if vertex.co.z > 0 else 0.0, "REPLACE")
            size.add([vertex.index], 0.0, "REPLACE")
        more = extend(studs, on=ball, span=8.0, samples=16, cover="top")
        points = scene.world_points(more)
        self.assertGreater(points[:, 2].min(), 4)
        self.assertGreater(points[:, 2].max(), 10.8)
        # Half as large, it is half as thick.
        thick = np.ptp(np.linalg.norm(points - (5, 5, 5), axis=1))
        studs.hide_set(False)
        less = extend(studs, on=ball, span=8.0, samples=16, sizes="size")
        thin = np.ptp(np.linalg.norm(scene.world_points(less) - (5, 5, 5), axis=1))
        self.assertLess(thin, 0.75 * thick)
        studs.hide_set(False)
        with self.assertRaisesRegex(RuntimeError, "no vertex group 'skirt'"):
            extend(studs, on=ball, cover="skirt")

    def test_guide_and_mix_are_heard(self):
        first = solid(size=0.8)
        other = bpy.data.collections.new("Others")
        cube = solid("Cube", (0, 3, 0), 0.6)
        other.objects.link(cube)
        guide = solid("Guide", (0, 0, 0), 1.0)
        mixed = extend(first, scale=(2, 2, 1), mix=other, engine="voting")
        plain = vertex_bytes(mixed)
        bpy.data.objects.remove(mixed)
        first.hide_set(False)
        guided = extend(first, scale=(2, 2, 1), mix=other, guide=guide, engine="voting")
        self.assertNotEqual(vertex_bytes(guided), plain)

    def test_says_what_is_wrong(self):
        bpy.ops.mesh.primitive_cube_add()
        cube = bpy.context.active_object
        cube.data.clear_geometry()
        self.assertIn("no faces", self.error(cube))
        ball = solid()
        empty = bpy.data.collections.new("Nothing")
        self.assertIn("Nothing", self.error(ball, mix=empty))
        self.assertIn("Keep", self.error(ball, keep=ball))

    def test_says_that_the_command_is_missing(self):
        own = bpy.context.preferences.addons["exemplar_blender"].preferences
        right = own.path
        try:
            own.path = "/nowhere/exemplar"
            self.assertIn("was not found", self.error(solid()))
        finally:
            own.path = right
        self.assertEqual(bpy.ops.exemplar.find_command(), {"FINISHED"})


class AgainAndAgain(InAScene):
    def test_one_seed_one_result_another_seed_another(self):
        wall = scene.wall()
        more = extend(wall, scale=(2, 1, 1), seed=4)
        more.name = "Ruin"
        more.location.x += 7
        more.modifiers.new("Weld", "WELD")
        bpy.context.view_layer.update()
        first, place = vertex_bytes(more), more.matrix_world.copy()
        meshes = len(bpy.data.meshes)
        self.assertEqual(bpy.ops.exemplar.again(how="REROLL"), {"FINISHED"})
        second = vertex_bytes(more)
        self.assertEqual((more["exemplar_seed"], more.name), (5, "Ruin"))
        self.assertEqual(more.modifiers[0].name, "Weld")
        self.assertEqual(more.matrix_world, place)
        self.assertEqual(len(bpy.data.meshes), meshes)
        self.assertNotEqual(first, second)
        more["exemplar_seed"] = 3
        bpy.ops.exemplar.again(how="REROLL")
        self.assertEqual(vertex_bytes(more), first)
        settings(scale=(3, 1, 1), seed=4)
        bpy.ops.exemplar.again(how="REDO")
        self.assertGreater(np.ptp(scene.world_points(more)[:, 0]), 14)
        self.assertTrue(wall.hide_get())

    def test_works_after_save_and_load(self):
        more = extend(scene.wall(), scale=(2, 1, 1))
        path = os.path.join(bpy.app.tempdir, "saved.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.assertEqual(bpy.ops.exemplar.again(how="REROLL"), {"FINISHED"})
        self.assertEqual(bpy.context.active_object["exemplar_seed"], 1)
        bpy.data.objects.remove(bpy.data.objects["Wall"])
        with self.assertRaisesRegex(RuntimeError, "'Wall' is gone"):
            bpy.ops.exemplar.again(how="REROLL")
        with self.assertRaisesRegex(RuntimeError, "'Wall' is gone"):
            bpy.ops.exemplar.restore()

    def test_refines_what_it_made_with_or_without_the_files(self):
        more = extend(scene.wall(), scale=(2, 1, 1), triangles="ALL")
        count = len(more.data.polygons)
        bpy.ops.exemplar.again(how="REFINE2")
        fine = vertex_bytes(more)
        self.assertGreater(len(more.data.polygons), 2.5 * count)
        files = os.path.join(bpy.app.tempdir, "exemplar_results")
        for folder, _, names in os.walk(files):
            for name in names:
                os.remove(os.path.join(folder, name))
        bpy.ops.exemplar.again(how="REFINE2")
        self.assertEqual(vertex_bytes(more), fine)

    def test_restores_and_gives_its_settings_back(self):
        wall = scene.wall()
        ball = solid()
        more = extend(wall, scale=(2, 1, 1), seed=7, guide=ball)
        settings()
        bpy.ops.exemplar.adopt()
        group = bpy.context.scene.exemplar.extend
        self.assertEqual((group.seed, list(group.scale), group.guide), (7, [2, 1, 1], ball))
        bpy.ops.exemplar.restore()
        self.assertFalse(wall.hide_get())
        self.assertTrue(wall.select_get() and more.hide_get())
        self.assertEqual(bpy.context.active_object, wall)


class Assets(InAScene):
    def test_a_result_is_one_with_its_settings_and_a_catalog(self):
        more = extend(scene.wall(), scale=(2, 1, 1), seed=9)
        # Where no file is, there is no asset browser that would find it.
        with self.assertRaises(RuntimeError):
            bpy.ops.exemplar.mark_asset()
        with tempfile.TemporaryDirectory() as folder:
            path, catalogs = (os.path.join(folder, n) for n in ("walls.blend", "blender_assets.cats.txt"))
            with open(catalogs, "w", encoding="utf-8") as file:
                file.write("VERSION 1\n\n00000000-0000-0000-0000-000000000001:Mine:Mine\n")
            bpy.ops.wm.save_as_mainfile(filepath=path)
            for _ in range(2):
                self.assertEqual(bpy.ops.exemplar.mark_asset(), {"FINISHED"})
            self.assertIn("2 x 1 x 1 of Wall, seed 9", more.asset_data.description)
            with open(catalogs, encoding="utf-8") as file:
                lines = file.read().split("\n")
            self.assertEqual((lines[0], sum(":Mine" in n for n in lines)), ("VERSION 1", 1))
            self.assertEqual([n for n in lines if more.asset_data.catalog_id in n],
                             [more.asset_data.catalog_id + ":Exemplar:Exemplar"])
            bpy.ops.wm.save_mainfile()
            bpy.ops.wm.read_homefile(use_factory_startup=False, use_empty=True)
            with bpy.data.libraries.load(path, assets_only=True) as (there, taken):
                self.assertEqual(there.objects, ["Wall more"])
                taken.objects = there.objects
            self.assertEqual(bpy.data.objects["Wall more"]["exemplar_seed"], 9)

    def test_the_bundled_scenes_are_a_file_of_them(self):
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts",
                              "blender_examples.py")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "examples.blend")
            done = subprocess.run([bpy.app.binary_path, "-b", "-noaudio", "--factory-startup",
                                   "--python-exit-code", "1", "-P", script, "--", path, "castle"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with bpy.data.libraries.load(path, assets_only=True) as (there, taken):
                taken.objects = there.objects
            castle = bpy.data.objects["Castle"]
            self.assertGreater(len(castle.data.polygons), 100)
            self.assertGreater(len(castle.data.materials), 3)
            self.assertGreaterEqual(min(corner[2] for corner in castle.bound_box), -1e-3)
            self.assertTrue(os.path.isfile(os.path.join(folder, "blender_assets.cats.txt")))


class Modules(InAScene):
    def sample(self, pattern):
        """Objects on a grid of cells of 2: a letter is a mesh, lower case turned by a quarter."""
        collection = bpy.data.collections.new("Sample")
        bpy.context.scene.collection.children.link(collection)
        for y, row in enumerate(pattern):
            for x, letter in enumerate(row):
                if letter == ".":
                    continue
                mesh = bpy.data.meshes.get(letter.upper()) or self.piece(letter.upper())
                thing = bpy.data.objects.new(letter, mesh)
                thing.location = (2 * x, 2 * y, 1)
                thing.rotation_euler.z = 0 if letter.isupper() else math.pi / 2
                collection.objects.link(thing)
        bpy.context.view_layer.update()
        group = bpy.context.scene.exemplar.modules
        group.sample, group.size, group.sides = collection, (12, 9, 1), "free"
        return collection, group

    def piece(self, name):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        return mesh

    def letters(self, things, origin=0.0):
        found = {}
        for thing in things:
            place = thing.matrix_world.translation
            turned = abs(thing.matrix_world.to_euler().z) > 0.1
            cell = round((place.x - origin) / 2), round(place.y / 2)
            found[cell] = thing.data.name.lower() if turned else thing.data.name
        return found

    def pairs(self, letters, size):
        found = set()
        for x in range(size[0]):
            for y in range(size[1]):
                here = letters.get((x, y), ".")
                if x + 1 < size[0]:
                    found.add((here, "x", letters.get((x + 1, y), ".")))
                if y + 1 < size[1]:
                    found.add((here, "y", letters.get((x, y + 1), ".")))
        return found

    def test_every_two_neighbors_are_a_pair_of_the_sample(self):
        pattern = ["AbAb.", "bAbA.", "AbAb.", "....."]
        collection, group = self.sample(pattern)
        group.sides = "example"
        sample = self.letters(collection.objects)
        self.assertEqual(bpy.ops.exemplar.modules(), {"FINISHED"})
        more = bpy.data.collections["Sample more"]
        bpy.context.view_layer.update()
        # The sample has no row or column without objects in its box.
        start = 2 * (4 + 1)
        made = self.letters(more.objects, start)
        self.assertTrue(made)
        self.assertLessEqual(self.pairs(made, (12, 9)), self.pairs(sample, (4, 3)))
        self.assertEqual({t.data.name for t in more.objects}, {"A", "B"})
        self.assertEqual(len(bpy.data.meshes), 2)  # linked duplicates
        places = sorted(tuple(t.location) for t in more.objects)
        self.assertEqual(bpy.ops.exemplar.modules_again(), {"FINISHED"})
        self.assertEqual(bpy.data.collections["Sample more"]["exemplar_seed"], 1)
        self.assertEqual(len(places), len(more.objects))

    def shown(self):
        """What is seen of the result, instances as objects: data and place."""
        bpy.context.view_layer.update()
        made = set(bpy.data.collections["Sample more"].objects)
        found = []
        for instance in bpy.context.evaluated_depsgraph_get().object_instances:
            owner = instance.parent if instance.is_instance else instance.object
            if owner is None or owner.original not in made or not instance.object.data:
                continue
            if len(instance.object.data.vertices) != 3:
                continue  # the points themselves
            found.append((instance.object.data.name,
                          tuple(round(v, 3) + 0.0 for row in instance.matrix_world for v in row)))
        return sorted(found)

    def test_as_points_show_what_objects_show(self):
        collection, group = self.sample(["AbAb", "bAbA", "AbAb"])
        collection.objects[0].scale.x = -1  # a mirrored one is a label of its own
        bpy.context.view_layer.update()
        group.form = "objects"
        self.assertEqual(bpy.ops.exemplar.modules(), {"FINISHED"})
        as_objects = self.shown()
        self.assertGreater(len(as_objects), 20)
        group = bpy.context.scene.exemplar.modules
        more = bpy.data.collections["Sample more"]
        for thing in list(more.objects):
            bpy.data.objects.remove(thing)
        bpy.data.collections.remove(more)
        group.form = "points"
        self.assertEqual(bpy.ops.exemplar.modules(), {"FINISHED"})
        self.assertEqual(len(bpy.data.collections["Sample more"].objects), 1)
        self.assertEqual(self.shown(), as_objects)
        # Another seed leaves nothing of the one before.
        blocks = [len(stock) for stock in (bpy.data.objects, bpy.data.meshes, bpy.data.collections,
                                           bpy.data.node_groups)]
        self.assertEqual(bpy.ops.exemplar.modules_again(), {"FINISHED"})
        self.assertEqual([len(stock) for stock in (bpy.data.objects, bpy.data.meshes,
                                                   bpy.data.collections, bpy.data.node_groups)], blocks)

    def test_many_become_points(self):
        _, group = self.sample(["AB", "BA"])
        group.size = (160, 150, 1)
        self.assertEqual(bpy.ops.exemplar.modules(), {"FINISHED"})
        thing, = bpy.data.collections["Sample more"].objects
        self.assertEqual(len(thing.data.vertices), 160 * 150)
        group.form = "objects"
        with self.assertRaisesRegex(RuntimeError, "choose points"):
            bpy.ops.exemplar.modules()

    def test_pins_hold_and_those_that_exclude_each_other_are_selected(self):
        collection, group = self.sample(["AB", "BA"])
        pins = bpy.data.collections.new("Pins")
        bpy.context.scene.collection.children.link(pins)
        group.pins, group.size = pins, (6, 1, 1)

        def pin(name, x, mesh):
            thing = bpy.data.objects.new(name, bpy.data.meshes[mesh])
            thing.location = (2 * (3 + x), 0, 1)
            pins.objects.link(thing)
            bpy.context.view_layer.update()

        pin("one", 4, "B")
        self.assertEqual(bpy.ops.exemplar.modules(), {"FINISHED"})
        bpy.context.view_layer.update()
        made = self.letters(bpy.data.collections["Sample more"].objects, 2 * 3)
        self.assertEqual(made[4, 0], "B")
        bpy.data.collections.remove(bpy.data.collections["Sample more"])
        pin("two", 5, "B")
        with self.assertRaises(RuntimeError):
            bpy.ops.exemplar.modules()
        self.assertEqual({t.name for t in bpy.context.selected_objects}, {"one", "two"})
        self.assertNotIn("Sample more", bpy.data.collections)

    def test_what_is_off_the_grid_is_selected(self):
        collection, _ = self.sample(["ABAB"])
        collection.objects["B"].location.x += 0.7
        bpy.context.scene.exemplar.modules.cell = (2, 2, 2)
        bpy.context.view_layer.update()
        with self.assertRaisesRegex(RuntimeError, "'B' is"):
            bpy.ops.exemplar.modules()
        self.assertEqual([t.name for t in bpy.context.selected_objects], ["B"])


class Landscape(InAScene):
    def test_is_a_grid_with_the_same_material(self):
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=31, y_subdivisions=31, size=8)
        ground = bpy.context.active_object
        for vertex in ground.data.vertices:
            x, y = vertex.co.x, vertex.co.y
            vertex.co.z = 0.5 * math.sin(1.7 * x + math.sin(y)) + 0.3 * math.cos(2.3 * y)
        ground.location = (1, 2, 3)
        ground.data.materials.append(scene.material("Grass", (0.1, 0.4, 0.1)))
        bpy.context.scene.exemplar.landscape.scale = (2, 1)
        scene.choose(ground)
        self.assertEqual(bpy.ops.exemplar.landscape(), {"FINISHED"})
        more = bpy.context.active_object
        self.assertEqual(more.data.materials[0], bpy.data.materials["Grass"])
        self.assertEqual(len(more.data.vertices), 64 * 32)
        was, now = scene.world_points(ground), scene.world_points(more)
        np.testing.assert_allclose(now.min(0)[:2], was.min(0)[:2], atol=1e-4)
        self.assertLess(abs(now[:, 2].std() / was[:, 2].std() - 1), 0.4)
        self.assertGreater(min(f.normal.z for f in more.data.polygons), 0)

    def test_may_come_from_a_file(self):
        path = os.path.join(bpy.app.tempdir, "land.asc")
        y, x = np.mgrid[:40, :50]
        with open(path, "w", encoding="ascii") as file:
            file.write("ncols 50\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 2\n")
            np.savetxt(file, 5 * np.sin(x / 6) + 4 * np.cos(y / 5), fmt="%.4f")
        group = bpy.context.scene.exemplar.landscape
        group.file, group.scale = path, (1, 2)
        self.assertEqual(bpy.ops.exemplar.landscape(), {"FINISHED"})
        more = bpy.context.active_object
        self.assertEqual((more.name, len(more.data.vertices)), ("land more", 50 * 80))
        np.testing.assert_allclose(np.ptp(scene.world_points(more), axis=0)[:2], [98, 158], atol=1e-3)
        self.assertFalse(bpy.ops.exemplar.restore.poll())
        group.file = path + ".gone"
        with self.assertRaisesRegex(RuntimeError, "there is no file"):
            bpy.ops.exemplar.landscape()
        os.remove(path)

    def test_refuses_what_is_no_grid(self):
        scene.choose(solid())
        with self.assertRaises(RuntimeError):
            bpy.ops.exemplar.landscape()


unittest.main(argv=["headless_test", *scene.arguments()], verbosity=1)
