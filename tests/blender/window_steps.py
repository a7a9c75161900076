# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""The add-on in a window, with simulated events: Esc at several moments, undo, redo, the source
deleted meanwhile, and (by the caller) quitting meanwhile. Writes what failed to the file that is
its first argument; "fine" where nothing did."""

import os
import sys
import time
import traceback

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import scene_for_tests as scene

RESULT, MODE = scene.arguments()[:2]
bpy.context.preferences.view.show_splash = False


def window():
    return bpy.context.window_manager.windows[0]


def view():
    return next(a for a in window().screen.areas if a.type == "VIEW_3D")


def press(kind, **modifiers):
    area = view()
    x, y = area.x + area.width // 3, area.y + area.height // 3
    window().event_simulate("MOUSEMOVE", "NOTHING", x=x, y=y)
    window().event_simulate(kind, "PRESS", x=x, y=y, **modifiers)
    window().event_simulate(kind, "RELEASE", x=x, y=y)


def start(**settings):
    group = bpy.context.scene.exemplar.extend
    group.detail, group.samples, group.scale = "CUSTOM", 32, (2, 1, 1)
    for key, value in settings.items():
        setattr(group, key, value)
    area = view()
    region = next(r for r in area.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=window(), area=area, region=region):
        answer = bpy.ops.exemplar.extend("INVOKE_DEFAULT")
    assert answer == {"RUNNING_MODAL"}, answer


def busy():
    return sys.modules["exemplar_blender.run"].busy()


def current():
    return sys.modules["exemplar_blender.run"].current()


def until(condition, seconds):
    """Steps that wait; fails where it takes longer."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"not within {seconds} s: {condition.__name__}"
        yield 0.05


def idle():
    return not busy()


def drafted():
    return "Wall draft" in bpy.data.objects


def steps():
    scene.install()
    scene.empty_scene()
    scene.choose(scene.wall())
    bpy.ops.ed.undo_push(message="A wall")
    yield 0.5

    if MODE == "quit":
        start(samples=400, scale=(8, 1, 1))
        yield 1.0
        assert busy() and len(scene.leftovers()[1]) == 1, scene.leftovers()
        return

    # Esc leaves everything as it was: at once, while the example is read, while more is made of it,
    # while that becomes a surface.
    before = scene.state()
    stages = set()
    for share in (0, 0.05, 0.35, 0.55, 0.7):
        start(samples=96, scale=(4, 1, 1))
        yield from until(lambda: not busy() or current().fraction >= share, 200)
        assert busy(), f"it ended before Esc, at {share}"
        stages.add(current().stage)
        asked = time.monotonic()
        where = f"Esc at {current().fraction:.2f}, {current().stage}"
        press("ESC")
        yield from until(idle, 20)
        took = time.monotonic() - asked
        # Half a second where this process has a core of its own.
        allowed = 0.5 * max(1, os.getloadavg()[0] / os.cpu_count())
        print(f"{where}: {took:.2f} s of {allowed:.2f}")
        assert took < allowed, f"{where}: only {took:.2f} s later is it cancelled"
        assert scene.state() == before
        assert scene.leftovers() == ([], []), scene.leftovers()
    assert len(stages) >= 4, f"the moments were not those that they should be: {stages}"

    # One undo removes the result, its mesh, and no more; redo brings it back.
    start()
    yield from until(idle, 60)
    yield 0.3
    made = scene.state()
    assert "Wall more" in bpy.data.objects and "Wall more" in bpy.data.meshes
    assert bpy.data.objects["Wall"].hide_get() and scene.leftovers() == ([], [])
    press("Z", ctrl=True)
    yield 0.5
    assert scene.state() == before, scene.state()
    press("Z", ctrl=True, shift=True)
    yield 0.5
    assert scene.state() == made, scene.state()
    press("Z", ctrl=True)
    yield 0.5

    # A draft is shown as wires until the result replaces it, in one undo step; Esc leaves none.
    scene.choose(bpy.data.objects["Wall"])
    before = scene.state()
    start(draft=True, samples=120)
    yield from until(drafted, 60)
    draft = bpy.data.objects["Wall draft"]
    assert draft.display_type == "WIRE" and not bpy.data.objects["Wall"].hide_get() and busy()
    yield from until(idle, 120)
    yield 0.3
    assert "Wall draft" not in bpy.data.objects and "Wall draft" not in bpy.data.meshes
    assert bpy.data.objects["Wall more"].display_type == "TEXTURED"
    press("Z", ctrl=True)
    yield 0.5
    assert scene.state() == before, scene.state()
    scene.choose(bpy.data.objects["Wall"])
    before = scene.state()
    start(draft=True, samples=250, scale=(8, 1, 1))
    yield from until(drafted, 60)
    press("ESC")
    yield from until(idle, 20)
    assert scene.state() == before, scene.state()
    assert scene.leftovers() == ([], []), scene.leftovers()

    # The source is deleted while it runs: the result is where it was.
    place = bpy.data.objects["Wall"].matrix_world.copy()
    scene.choose(bpy.data.objects["Wall"])
    start()
    bpy.data.objects.remove(bpy.data.objects["Wall"])
    yield from until(idle, 60)
    yield 0.2
    more = bpy.data.objects["Wall more"]
    assert max(abs(a - b) for r, s in zip(more.matrix_world, place) for a, b in zip(r, s)) < 1e-6
    assert [m.name for m in more.data.materials] == ["Brick", "Mortar"]

    # Undo while it runs: no crash, and the run ends.
    scene.choose(more)
    more.name = "Base"
    bpy.ops.ed.undo_push(message="A name")
    start()
    yield 0.2
    press("Z", ctrl=True)
    yield from until(idle, 60)
    assert scene.leftovers() == ([], []), scene.leftovers()

    # Another file is loaded while it runs: it is ended.
    scene.choose(bpy.context.view_layer.objects[0])
    start(samples=250, scale=(8, 1, 1))
    yield 0.3
    bpy.ops.wm.read_homefile(use_factory_startup=False)
    yield 0.3
    assert scene.leftovers()[1] == [] and not busy(), scene.leftovers()


running = steps()


def tick():
    try:
        return next(running)
    except StopIteration:
        words = "fine"
    except BaseException:
        words = traceback.format_exc()
    with open(RESULT, "w", encoding="utf-8") as file:
        file.write(words)
    print(words)
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.quit_blender()
    return None


bpy.app.timers.register(tick, first_interval=0.5, persistent=True)
