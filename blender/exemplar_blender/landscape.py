# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""More of a landscape: a grid seen from above, or a height map in a file."""

import os

import bpy
import numpy as np

from . import exchange, grid, run, settings


class EXEMPLAR_OT_landscape(run.Run, bpy.types.Operator):
    """Make more of the active landscape, a grid seen from above, or of a height map in a file"""
    bl_idname = "exemplar.landscape"
    bl_label = "More Landscape"

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        active = context.active_object
        if not context.scene.exemplar.landscape.file and (active is None or active.type != "MESH"):
            cls.poll_message_set("Choose a height map, or make a landscape the active object")
            return False
        return True

    def prepare(self, context):
        self.values = settings.frozen(context.scene.exemplar.landscape)
        active = context.active_object
        named = bpy.path.abspath(self.values["file"])
        if named:
            if not os.path.isfile(named):
                raise run.Failure(f"there is no file {named}")
            self.anchor, self.corner, self.material = "", (0, 0), None
            self.frame = context.scene.cursor.matrix.copy()
            self.title = os.path.splitext(os.path.basename(named))[0]
            example, longest = named, None
        else:
            self.anchor = self.title = active.name
            example, longest = "in.asc", self._write(context, active)
        engine = ["--engine", "terrain"]
        if "terrain" not in settings.command.engines(settings.found_command()[0]):
            engine = ["--engine", "geometry"] + (["--resolution", longest] if longest else [])
        return ["synth", example, "-o", "out.asc", "--seed", self.values["seed"], "--scale",
                "{:.6g},{:.6g},1".format(*self.values["scale"])] + engine

    def _write(self, context, active):
        """Writes the active object's heights; how many there are along the longer side."""
        self.frame = exchange.frame_of(active)
        evaluated = active.evaluated_get(context.evaluated_depsgraph_get())
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
        return max(heights.shape)

    def take(self, context):
        heights, side = grid.read_asc(self.file("out.asc"))
        rows, columns = heights.shape
        x, y = np.meshgrid(self.corner[0] + side * np.arange(columns),
                           self.corner[1] + side * np.arange(rows)[::-1])
        number = np.arange(rows * columns).reshape(rows, columns)
        faces = np.stack([number[1:, :-1], number[1:, 1:], number[:-1, 1:], number[:-1, :-1]], -1)
        mesh = bpy.data.meshes.new(self.title + " more")
        mesh.vertices.add(rows * columns)
        mesh.vertices.foreach_set("co", np.stack([x, y, heights], -1).astype(np.float32).ravel())
        count = faces.size // 4
        mesh.loops.add(4 * count)
        mesh.loops.foreach_set("vertex_index", faces.astype(np.int32).ravel())
        mesh.polygons.add(count)
        mesh.polygons.foreach_set("loop_start", np.arange(0, 4 * count, 4, dtype=np.int32))
        mesh.polygons.foreach_set("loop_total", np.full(count, 4, np.int32))
        mesh.polygons.foreach_set("use_smooth", np.ones(count, bool))
        if self.anchor:
            mesh.materials.append(exchange._material_of(self.material))
        mesh.update(calc_edges=True)
        thing = bpy.data.objects.new(mesh.name, mesh)
        thing.matrix_world = self.frame
        anchor = bpy.data.objects.get(self.anchor)
        owners = anchor.users_collection if anchor else ()
        (owners[0] if owners else context.collection).objects.link(thing)
        sources = [self.anchor] if self.anchor else []
        run.remember(thing, "landscape", self.values, sources=sources, warnings=self.job.warnings)
        run.hide(context, sources)
        run.select(context, [thing.name])


CLASSES = (EXEMPLAR_OT_landscape,)
