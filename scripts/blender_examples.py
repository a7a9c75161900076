# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Makes a file of the bundled scenes for Blender's asset browser, in the catalog Exemplar:

    blender -b --factory-startup --python-exit-code 1 -P scripts/blender_examples.py -- OUT.blend [SCENE]...

with EXEMPLAR, the command. Each scene is an object with its materials, ready to be dragged into a
scene and extended."""

import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "blender"))

import bpy
from exemplar_blender import assets

SCENES = ("castle", "city", "canyon", "cluster", "paths", "gears", "forest", "library",
          "chainmail", "terrain", "grass", "metal", "grid", "balls", "fibers")
COMMAND = os.environ.get("EXEMPLAR", "exemplar")


def imported(name, folder):
    """A scene as one object, standing on the ground."""
    path = os.path.join(folder, name + ".obj")
    subprocess.run([COMMAND, "scene", name, "-o", path, "-q"], check=True, stdin=subprocess.DEVNULL)
    bpy.ops.wm.obj_import(filepath=path)
    parts = list(bpy.context.selected_objects)
    bpy.context.view_layer.objects.active = parts[0]
    if len(parts) > 1:
        bpy.ops.object.join()
    thing = bpy.context.view_layer.objects.active
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    thing.name = thing.data.name = name.capitalize()
    return thing


def main(out, *scenes):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    at = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for name in scenes or SCENES:
            thing = imported(name, folder)
            assets.mark(thing, f"The bundled scene {name}, an example to make more of", ["exemplar", "example"])
            thing.location.x = at - min(corner[0] for corner in thing.bound_box)
            at += 1.25 * thing.dimensions.x
            print(f"{thing.name}: {len(thing.data.polygons)} faces, {len(thing.data.materials)} materials")
    assets.write_catalog(os.path.dirname(os.path.abspath(out)))
    bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(out), compress=True)


main(*sys.argv[sys.argv.index("--") + 1:])
