# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Makes docs/blender/*.png: the add-on's panel while it is at work, and what it has made.

    xvfb-run -a -s "-screen 0 960x440x24" blender -noaudio --factory-startup \\
      --enable-event-simulate -p 0 0 960 440 -P scripts/blender_pictures.py

with EXEMPLAR, the command, and EXEMPLAR_BLENDER_ZIP, the add-on."""

import os
import sys
import traceback

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "blender"))

import bpy
import scene_for_tests as scene
from mathutils import Euler

OUT = os.path.join(ROOT, "docs", "blender")
bpy.context.preferences.view.show_splash = False


def window():
    return bpy.context.window_manager.windows[0]


def view():
    return next(a for a in window().screen.areas if a.type == "VIEW_3D")


def in_view(operator, *given, **named):
    area = view()
    region = next(r for r in area.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=window(), area=area, region=region):
        return operator(*given, **named)


def click(x, y):
    window().event_simulate("MOUSEMOVE", "NOTHING", x=x, y=y)
    window().event_simulate("LEFTMOUSE", "PRESS", x=x, y=y)
    window().event_simulate("LEFTMOUSE", "RELEASE", x=x, y=y)


def shoot(name):
    in_view(bpy.ops.screen.screenshot, filepath=os.path.join(OUT, name))


def steps():
    scene.install()
    scene.empty_scene()
    wall = scene.wall()
    scene.choose(wall)
    in_view(bpy.ops.screen.screen_full_area, use_hide_panels=True)
    yield 0.5
    space = view().spaces[0]
    space.show_region_ui, space.show_region_toolbar, space.show_region_header = True, False, False
    space.show_region_tool_header = False
    space.shading.type, space.shading.color_type = "SOLID", "MATERIAL"
    space.region_3d.view_rotation = Euler((1.15, 0, 0.45)).to_quaternion()
    space.region_3d.view_location, space.region_3d.view_distance = (8.5, 0, 0.5), 15
    yield 0.5
    click(view().x + view().width - 8, view().y + view().height - 172)  # the tab
    yield 0.7
    group = bpy.context.scene.exemplar.extend
    group.scale, group.detail, group.samples = (3, 1, 1), "CUSTOM", 100
    in_view(bpy.ops.exemplar.extend, "INVOKE_DEFAULT")
    running = sys.modules["exemplar_blender.run"]
    while running.busy() and running.current().fraction < 0.25:
        yield 0.05
    yield 0.1
    shoot("panel.png")
    while running.busy():
        yield 0.1
    yield 0.7
    shoot("result.png")


running = steps()


def tick():
    try:
        return next(running)
    except StopIteration:
        pass
    except BaseException:
        traceback.print_exc()
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(tick, first_interval=0.5, persistent=True)
