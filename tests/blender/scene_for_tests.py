# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Run inside Blender: what the tests of the add-on have in common.

The test runs in Blender's own process and imports the GPL add-on; it is installed from the zip that
the build made."""

import os
import sys

import bpy
import numpy as np
from mathutils import Matrix


def install():
    """Installs and switches on the add-on from $EXEMPLAR_BLENDER_ZIP."""
    bpy.ops.preferences.addon_install(filepath=os.environ["EXEMPLAR_BLENDER_ZIP"])
    bpy.ops.preferences.addon_enable(module="exemplar_blender")
    bpy.context.preferences.addons["exemplar_blender"].preferences.path = os.environ["EXEMPLAR"]


def empty_scene():
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    for stock in (bpy.data.meshes, bpy.data.materials):
        for block in list(stock):
            stock.remove(block)


def material(name, color):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.diffuse_color = (*color, 1)
    nodes, links = made.node_tree.nodes, made.node_tree.links
    noise, bump = nodes.new("ShaderNodeTexNoise"), nodes.new("ShaderNodeBump")
    links.new(noise.outputs["Fac"], bump.inputs["Height"])
    links.new(bump.outputs["Normal"], nodes["Principled BSDF"].inputs["Normal"])
    nodes["Principled BSDF"].inputs["Base Color"].default_value = (*color, 1)
    return made


def wall(name="Wall", columns=5, rows=5):
    """Bricks in mortar, with UVs, two materials and a Bevel modifier; along x, 0.3 thick."""
    points, faces, numbers, uvs = [], [], [], []

    def box(low, high, number):
        at = len(points)
        corners = [(low[0] if i & 1 == 0 else high[0], low[1] if i & 2 == 0 else high[1],
                    low[2] if i & 4 == 0 else high[2]) for i in range(8)]
        points.extend(corners)
        for quad in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            faces.append([at + n for n in quad])
            numbers.append(number)
            uvs.extend(((corners[n][0] + corners[n][1]) / 8 + 0.05, corners[n][2] / 8 + 0.05)
                       for n in quad)

    box((0, 0.06, 0), (columns, 0.34, 0.5 * rows), 1)
    for row in range(rows):
        shift = 0.5 * (row % 2)
        for column in range(columns + row % 2):
            x = max(0, column - shift), min(columns, column + 1 - shift)
            box((x[0] + 0.05, 0, 0.5 * row + 0.05), (x[1] - 0.05, 0.4, 0.5 * row + 0.45), 0)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.polygons.foreach_set("material_index", numbers)
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", np.array(uvs, np.float32).ravel())
    mesh.materials.append(bpy.data.materials.get("Brick") or material("Brick", (0.5, 0.16, 0.1)))
    mesh.materials.append(bpy.data.materials.get("Mortar") or material("Mortar", (0.6, 0.6, 0.55)))
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    bevel = thing.modifiers.new("Bevel", "BEVEL")
    bevel.width, bevel.segments = 0.03, 1
    return thing


def choose(*things):
    for other in bpy.context.view_layer.objects:
        other.select_set(False)
    for thing in things:
        thing.select_set(True)
    bpy.context.view_layer.objects.active = things[-1]


def world_points(thing, frame=None):
    """An object's evaluated points in the world, or in a frame, n x 3."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    evaluated.to_mesh_clear()
    matrix = np.array((frame.inverted() if frame else Matrix()) @ thing.matrix_world)
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def state():
    """What Esc has to leave as it was: the scene's objects, data, and what is selected."""
    return (sorted((t.name, t.hide_get(), t.select_get()) for t in bpy.context.view_layer.objects),
            sorted(m.name for m in bpy.data.meshes), sorted(m.name for m in bpy.data.materials),
            sorted(c.name for c in bpy.data.collections))


def leftovers():
    """Folders of runs in Blender's temporary folder, and processes of ours that still run."""
    folders = [n for n in os.listdir(bpy.app.tempdir) if n.startswith("exemplar_") and
               n != "exemplar_results"]
    running = []
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{number}/stat", encoding="utf-8", errors="replace") as file:
                words = file.read().rsplit(")", 1)
            with open(f"/proc/{number}/cmdline", "rb") as file:
                line = file.read()
        except OSError:
            continue
        if int(words[1].split()[1]) == os.getpid() and line:
            running.append(line.replace(b"\0", b" ").decode("utf-8", "replace"))
    return folders, running


def arguments():
    return sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
