# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""More objects on a grid, as linked duplicates or as points that Geometry Nodes put them on."""

import bpy
import numpy as np
from mathutils import Matrix, Vector

from . import grid, run, settings

MOST = 20000  # linked duplicates; more of them make Blender slow


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
        form = self.values.get("form", "auto")  # results of older versions have none
        if form == "objects" and len(cells) > MOST:
            raise run.Failure(f"the result has {len(cells):,} objects; more than {MOST:,} make "
                              "Blender slow: choose points, or a smaller size")
        shown = [bpy.data.objects.get(name) for name in self.sample.shown]
        if None in shown:
            gone = self.sample.shown[shown.index(None)]
            raise run.Failure(f"'{gone}' is gone, of which copies were to be placed")
        numbers = labels[tuple(cells.T)] - 1
        clear(collection)
        places = self.sample.start + cells * self.sample.cell
        if form == "points" or len(cells) > MOST:
            put_points(collection, shown, places, numbers)
        else:
            put_objects(collection, shown, places, numbers)
        run.remember(collection, "modules", self.values, sources=self.sample.names,
                     warnings=self.job.warnings)
        if not self.values["beside"]:
            run.hide(context, self.sample.names)
        context.view_layer.update()
        if collection.objects:
            run.select(context, [collection.objects[0].name])


def clear(collection):
    """Removes what a collection holds, and what was made for its points alone."""
    for thing in list(collection.objects):
        mesh = thing.data
        bpy.data.objects.remove(thing)
        if isinstance(mesh, bpy.types.Mesh) and mesh.users == 0:
            bpy.data.meshes.remove(mesh)
    for group in [g for g in bpy.data.node_groups if g.users == 0 and g.get("exemplar_points")]:
        pieces = group.nodes["Pieces"].inputs["Collection"].default_value
        bpy.data.node_groups.remove(group)
        if pieces and pieces.users == 0:
            for thing in list(pieces.objects):
                bpy.data.objects.remove(thing)
            bpy.data.collections.remove(pieces)


def copy_of(thing, place):
    """A linked duplicate, turned as it is, somewhere else."""
    copy = thing.copy()
    copy.parent = None
    copy.animation_data_clear()
    copy.hide_viewport = copy.hide_render = False
    copy.matrix_world = Matrix.Translation(Vector(place)) @ thing.matrix_world.to_3x3().to_4x4()
    return copy


def put_objects(collection, shown, places, numbers):
    for place, number in zip(places, numbers):
        collection.objects.link(copy_of(shown[number], place))


def put_points(collection, shown, places, numbers):
    """One object of points, each with the number of its piece, and Geometry Nodes that put them
    there: "Instance on Points, Pick Instance"."""
    mesh = bpy.data.meshes.new(collection.name)
    mesh.vertices.add(len(places))
    mesh.vertices.foreach_set("co", places.astype(np.float32).ravel())
    mesh.attributes.new("piece", "INT", "POINT").data.foreach_set("value", numbers.astype(np.int32))
    thing = bpy.data.objects.new(collection.name, mesh)
    collection.objects.link(thing)
    pieces = bpy.data.collections.new(collection.name + " pieces")
    for number, piece in enumerate(shown):
        copy = copy_of(piece, (0, 0, 0))
        copy.name = f"{number:05d} {piece.name}"  # they are picked in the order of their names
        pieces.objects.link(copy)
    thing.modifiers.new("Pieces", "NODES").node_group = _instances_of(pieces)


def _instances_of(pieces):
    group = bpy.data.node_groups.new(pieces.name, "GeometryNodeTree")
    group["exemplar_points"] = True
    if hasattr(group, "interface"):  # from 4.0 on; written from the manual, not run
        for way in ("INPUT", "OUTPUT"):
            group.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    nodes, links = group.nodes, group.links
    points, result = nodes.new("NodeGroupInput"), nodes.new("NodeGroupOutput")
    number = nodes.new("GeometryNodeInputNamedAttribute")
    number.data_type = "INT"
    number.inputs["Name"].default_value = "piece"
    picked = nodes.new("GeometryNodeCollectionInfo")
    picked.name = "Pieces"
    picked.inputs["Collection"].default_value = pieces
    picked.inputs["Separate Children"].default_value = True
    put = nodes.new("GeometryNodeInstanceOnPoints")
    put.inputs["Pick Instance"].default_value = True
    links.new(points.outputs["Geometry"], put.inputs["Points"])
    links.new(picked.outputs[0], put.inputs["Instance"])
    links.new(next(o for o in number.outputs if o.enabled and o.type == "INT"),
              put.inputs["Instance Index"])
    links.new(put.outputs["Instances"], result.inputs["Geometry"])
    for node, x in ((points, -400), (number, -400), (picked, -400), (put, 0), (result, 300)):
        node.location.x = x
    return group


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


CLASSES = (EXEMPLAR_OT_modules, EXEMPLAR_OT_modules_again)
