# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""More objects on a grid, as linked duplicates; and more of a landscape."""

import bpy
import numpy as np
from mathutils import Matrix, Vector

from . import exchange, grid, run, settings

MOST = 20000  # objects; more of them make Blender slow


def _pieces(collection):
    return [t for t in collection.all_objects
            if t.type not in {"CAMERA", "LIGHT", "SPEAKER"} and not t.name.endswith(".pin")]


def _looks(thing):
    """What tells labels apart: what is shown, and how it is turned, scaled or mirrored."""
    shown = (thing.instance_collection or thing.data) if thing.type == "EMPTY" else thing.data
    turned = tuple(round(v, 3) + 0.0 for row in thing.matrix_world.to_3x3() for v in row)
    return (thing.type, shown.name if shown else "", turned)


class Sample:
    """The grid that a collection's objects show. Holds names and arrays only."""

    def __init__(self, values):
        collection = bpy.data.collections.get(values["sample"] or "")
        things = _pieces(collection) if collection else []
        if not things:
            raise run.Failure("choose a collection of objects on a grid as the sample")
        self.names = [t.name for t in things]
        points = np.array([t.matrix_world.translation for t in things])
        cell = np.array(values["cell"])
        if (cell <= 0).any():
            cell = np.where(cell > 0, cell, grid.measured_cell(points))
        self.cell, self.origin = cell, points.min(axis=0)
        self.labels, self.shown, numbers = {}, [], []
        for thing in things:
            looks = _looks(thing)
            if looks not in self.labels:
                self.labels[looks] = len(self.labels) + 1
                self.shown.append(thing.name)
            numbers.append(self.labels[looks])
        cells = grid.cells_of(points, cell, self.origin, self.names)
        self.cells = grid.label_grid(cells, numbers, self.names)
        self.start = self.origin.copy()
        if values["beside"]:
            self.start[0] += (self.cells.shape[0] + 1) * cell[0]

    def pins(self, values):
        """The words of pins, and their objects' names."""
        collection = bpy.data.collections.get(values["pins"] or "")
        things = list(collection.all_objects) if collection else []
        things += [t for t in bpy.data.objects if t.name.endswith(".pin") and t not in things]
        words, names = [], []
        for thing in things:
            label = self.labels.get(_looks(thing))
            if label is None:
                raise run.Failure(f"the pin '{thing.name}' looks like nothing in the sample",
                                  [thing.name])
            place = np.array(thing.matrix_world.translation)[None]
            at = grid.cells_of(place, self.cell, self.start, [thing.name], 0.5)[0]
            if (at < 0).any() or (at >= values["size"]).any():
                raise run.Failure(f"the pin '{thing.name}' is outside of the result", [thing.name])
            words += ["--pin", f"{at[0]},{at[1]},{at[2]}={label}"]
            names.append(thing.name)
        return words, names


class Assembly(run.Run):
    """Writes the sample, runs model synthesis, places linked duplicates."""

    def begin(self, values):
        self.values = values
        self.sample = Sample(values)
        pins, self.pinned = self.sample.pins(values)
        cells = int(np.prod(values["size"]))
        if cells > 50_000_000:
            raise run.Failure(f"{cells:,} cells are more than a scene can hold")
        grid.write_labels(self.file("sample.txt"), self.sample.cells, self.sample.shown)
        words = ["synth", "sample.txt", "-o", "out.txt", "--engine", "model", "--seed",
                 values["seed"], "--size", ",".join(map(str, values["size"]))] + pins
        return words + (["--side", "all=free"] if values["sides"] == "free" else [])

    def conflicting(self, pins):
        return [self.pinned[pin] for pin in pins if pin < len(self.pinned)]

    def fill(self, context, collection):
        labels = grid.read_labels(self.file("out.txt"))
        cells = np.argwhere(labels > 0)
        if len(cells) > MOST:
            raise run.Failure(f"the result has {len(cells):,} objects; more than {MOST:,} make "
                              "Blender slow: choose a smaller size")
        shown = [bpy.data.objects.get(name) for name in self.sample.shown]
        if None in shown:
            gone = self.sample.shown[shown.index(None)]
            raise run.Failure(f"'{gone}' is gone, of which copies were to be placed")
        turned = [thing.matrix_world.to_3x3().to_4x4() for thing in shown]
        for thing in list(collection.objects):
            bpy.data.objects.remove(thing)
        for cell, label in zip(cells, labels[tuple(cells.T)]):
            copy = shown[label - 1].copy()
            copy.parent = None
            copy.animation_data_clear()
            copy.hide_viewport = False
            copy.matrix_world = Matrix.Translation(
                Vector(self.sample.start + cell * self.sample.cell)) @ turned[label - 1]
            collection.objects.link(copy)
        run.remember(collection, "modules", self.values, sources=self.sample.names,
                     warnings=self.job.warnings)
        if not self.values["beside"]:
            run.hide(context, self.sample.names)
        context.view_layer.update()
        if collection.objects:
            run.select(context, [collection.objects[0].name])


class EXEMPLAR_OT_modules(Assembly, bpy.types.Operator):
    """Place more objects as the sample's are placed: every two neighbors are a pair it shows"""
    bl_idname = "exemplar.modules"
    bl_label = "Build More"

    def prepare(self, context):
        return self.begin(settings.frozen(context.scene.exemplar.modules))

    def take(self, context):
        collection = bpy.data.collections.new(self.values["sample"] + " more")
        context.scene.collection.children.link(collection)
        try:
            self.fill(context, collection)
        except Exception:
            bpy.data.collections.remove(collection)
            raise


class EXEMPLAR_OT_modules_again(Assembly, bpy.types.Operator):
    """Place the objects anew, with another seed"""
    bl_idname = "exemplar.modules_again"
    bl_label = "Re-roll"

    @classmethod
    def poll(cls, context):
        _, record = run.result_of(context)
        return super().poll(context) and record is not None and record["kind"] == "modules"

    def prepare(self, context):
        collection, record = run.result_of(context)
        self.result = collection.name
        record["settings"]["seed"] += 1
        return self.begin(record["settings"])

    def take(self, context):
        collection = bpy.data.collections.get(self.result)
        if collection is None:
            raise run.Failure(f"the collection '{self.result}' is gone")
        self.fill(context, collection)


class EXEMPLAR_OT_landscape(run.Run, bpy.types.Operator):
    """Make more of the active landscape, a grid seen from above"""
    bl_idname = "exemplar.landscape"
    bl_label = "More Landscape"

    @classmethod
    def poll(cls, context):
        active = context.active_object
        return super().poll(context) and active is not None and active.type == "MESH"

    def prepare(self, context):
        active = context.active_object
        self.values = settings.frozen(context.scene.exemplar.landscape)
        self.anchor, self.frame = active.name, exchange.frame_of(active)
        depsgraph = context.evaluated_depsgraph_get()
        evaluated = active.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        points = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", points)
        materials = [exchange._material_key(s.material) for s in active.material_slots]
        self.material = materials[0] if materials else None
        evaluated.to_mesh_clear()
        local = np.array(self.frame.inverted() @ active.matrix_world)
        points = points.reshape(-1, 3) @ local[:3, :3].T + local[:3, 3]
        heights, side, self.corner = grid.height_grid(points)
        grid.write_asc(self.file("in.asc"), heights, side)
        engine = ["--engine", "terrain"]
        if "terrain" not in settings.command.engines(settings.found_command()[0]):
            engine = ["--engine", "geometry", "--resolution", max(heights.shape)]
        return ["synth", "in.asc", "-o", "out.asc", "--seed", self.values["seed"], "--scale",
                "{:.6g},{:.6g},1".format(*self.values["scale"])] + engine

    def take(self, context):
        heights, side = grid.read_asc(self.file("out.asc"))
        rows, columns = heights.shape
        x, y = np.meshgrid(self.corner[0] + side * np.arange(columns),
                           self.corner[1] + side * np.arange(rows)[::-1])
        number = np.arange(rows * columns).reshape(rows, columns)
        faces = np.stack([number[1:, :-1], number[1:, 1:], number[:-1, 1:], number[:-1, :-1]], -1)
        mesh = bpy.data.meshes.new(self.anchor + " more")
        mesh.vertices.add(rows * columns)
        mesh.vertices.foreach_set("co", np.stack([x, y, heights], -1).astype(np.float32).ravel())
        count = faces.size // 4
        mesh.loops.add(4 * count)
        mesh.loops.foreach_set("vertex_index", faces.astype(np.int32).ravel())
        mesh.polygons.add(count)
        mesh.polygons.foreach_set("loop_start", np.arange(0, 4 * count, 4, dtype=np.int32))
        mesh.polygons.foreach_set("loop_total", np.full(count, 4, np.int32))
        mesh.polygons.foreach_set("use_smooth", np.ones(count, bool))
        mesh.materials.append(exchange._material_of(self.material))
        mesh.update(calc_edges=True)
        thing = bpy.data.objects.new(mesh.name, mesh)
        thing.matrix_world = self.frame
        anchor = bpy.data.objects.get(self.anchor)
        owners = anchor.users_collection if anchor else ()
        (owners[0] if owners else context.collection).objects.link(thing)
        run.remember(thing, "landscape", self.values, sources=[self.anchor],
                     warnings=self.job.warnings)
        run.hide(context, [self.anchor])
        run.select(context, [thing.name])


CLASSES = (EXEMPLAR_OT_modules, EXEMPLAR_OT_modules_again, EXEMPLAR_OT_landscape)
