# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""The sidebar's tab, the menu, and the operators that only serve them."""

import json
import textwrap

import bpy

from . import extend, modules, run, settings


class EXEMPLAR_OT_find_command(bpy.types.Operator):
    """Look for the exemplar command again"""
    bl_idname = "exemplar.find_command"
    bl_label = "Find Again"

    def execute(self, _context):
        settings.forget_command()
        path, version = settings.found_command()
        self.report({"INFO"} if version else {"WARNING"},
                    f"exemplar {version}: {path}" if version else settings.command.NOT_FOUND)
        return {"FINISHED"}


class EXEMPLAR_OT_set_command(bpy.types.Operator):
    """Choose the file of the exemplar command"""
    bl_idname = "exemplar.set_command"
    bl_label = "Set Its Path"

    filepath: bpy.props.StringProperty(subtype="FILE_PATH")

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        own = settings.preferences(context)
        if own is None:
            return {"CANCELLED"}
        own.path = self.filepath
        return bpy.ops.exemplar.find_command()


class EXEMPLAR_OT_copy_log(bpy.types.Operator):
    """Copy what the command said to the clipboard"""
    bl_idname = "exemplar.copy_log"
    bl_label = "Copy Log"

    def execute(self, context):
        context.window_manager.clipboard = json.loads(context.scene.exemplar.notes).get("log", "")
        return {"FINISHED"}


def _wrapped(layout, text, icon, width):
    for n, line in enumerate(textwrap.wrap(text, max(20, int(width / 7.5)))):
        layout.label(text=line, icon=icon if n == 0 else "BLANK1")


class _Tab:
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Exemplar"

    def columns(self):
        self.layout.use_property_split, self.layout.use_property_decorate = True, False
        return self.layout


class EXEMPLAR_PT_state(_Tab, bpy.types.Panel):
    """What runs, what went wrong, and what is missing; not there where nothing of it is."""
    bl_label = "Exemplar"
    bl_order = 0

    @classmethod
    def poll(cls, context):
        return run.busy() or bool(context.scene.exemplar.notes) or not settings.found_command()[1]

    def draw(self, context):
        layout, width = self.layout, context.region.width
        if not settings.found_command()[1]:
            _wrapped(layout, settings.command.NOT_FOUND, "ERROR", width)
            layout.operator("exemplar.set_command", icon="FILE_FOLDER")
        running = run.current()
        if running:
            layout.label(text=f"{running.stage}: {100 * running.fraction:.0f} %", icon="SORTTIME")
            layout.label(text="Esc: cancel", icon="CANCEL")
            return
        notes = json.loads(context.scene.exemplar.notes or "{}")
        if "error" in notes:
            _wrapped(layout, notes["error"], "ERROR", width)
            if notes.get("log"):
                layout.operator("exemplar.copy_log", icon="COPYDOWN")
        if "text" in notes:
            layout.label(text=notes["text"], icon="INFO")


class EXEMPLAR_PT_extend(_Tab, bpy.types.Panel):
    bl_label = "Extend"
    bl_order = 2

    def draw(self, context):
        group, layout = context.scene.exemplar.extend, self.columns()
        layout.prop(group, "scale")
        layout.prop(group, "seed")
        layout.prop(group, "detail")
        if group.detail == "CUSTOM":
            layout.prop(group, "samples")
        things = [t for t in context.selected_objects if t.type in extend.exchange.KINDS]
        if things and group.detail != "AUTO":
            longest = max(max(t.dimensions) for t in things)
            layout.label(text=f"A voxel is about {longest / group.resolution():.3g} wide",
                         icon="MESH_GRID")
        layout.prop(group, "triangles")
        if group.triangles == "NUMBER":
            layout.prop(group, "number")
        layout.prop(group, "draft")
        layout.operator("exemplar.extend", icon="MOD_ARRAY")


class EXEMPLAR_PT_control(_Tab, bpy.types.Panel):
    bl_label = "Control"
    bl_parent_id = "EXEMPLAR_PT_extend"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        group, layout = context.scene.exemplar.extend, self.columns()
        for key in ("keep", "guide", "mix", "engine", "repeats", "tile", "rotations", "scatter",
                    "thickness"):
            layout.prop(group, key)


class EXEMPLAR_PT_surface(_Tab, bpy.types.Panel):
    bl_label = "On a Surface"
    bl_parent_id = "EXEMPLAR_PT_extend"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        group, layout = context.scene.exemplar.extend, self.columns()
        layout.prop(group, "on")
        rest = layout.column()
        rest.enabled = group.on is not None
        if group.on is not None:
            for key in ("cover", "sizes"):
                rest.prop_search(group, key, group.on, "vertex_groups")
        for key in ("span", "base", "height"):
            line = rest.column()
            line.enabled = key != "base" or not group.cover
            line.prop(group, key)


class EXEMPLAR_PT_modules(_Tab, bpy.types.Panel):
    bl_label = "Modules"
    bl_options = {"DEFAULT_CLOSED"}
    bl_order = 4

    def draw(self, context):
        group, layout = context.scene.exemplar.modules, self.columns()
        for key in ("sample", "cell", "size", "sides", "pins", "beside", "form", "seed"):
            layout.prop(group, key)
        layout.operator("exemplar.modules", icon="MOD_BUILD")


class EXEMPLAR_PT_landscape(_Tab, bpy.types.Panel):
    bl_label = "Landscape"
    bl_options = {"DEFAULT_CLOSED"}
    bl_order = 5

    def draw(self, context):
        group, layout = context.scene.exemplar.landscape, self.columns()
        layout.prop(group, "file")
        layout.prop(group, "scale")
        layout.prop(group, "seed")
        layout.operator("exemplar.landscape", icon="RNDCURVE")


class EXEMPLAR_PT_result(_Tab, bpy.types.Panel):
    bl_label = "Result"
    bl_order = 1

    @classmethod
    def poll(cls, context):
        return run.result_of(context)[1] is not None

    def draw(self, context):
        thing, record = run.result_of(context)
        layout = self.columns()
        layout.prop(thing, '["exemplar_seed"]', text="Seed")
        if record["kind"] == "extend":
            layout.operator("exemplar.again", text="Re-roll", icon="FILE_REFRESH").how = "REROLL"
            layout.operator("exemplar.again", text="With the Panel's Settings").how = "REDO"
            row = layout.row(align=True)
            row.enabled = not record["settings"].get("on")
            for how, text in (("REFINE2", "Refine x2"), ("REFINE4", "x4")):
                row.operator("exemplar.again", text=text).how = how
            layout.operator("exemplar.compare", icon="URL")
        elif record["kind"] == "modules":
            layout.operator("exemplar.modules_again", icon="FILE_REFRESH")
        layout.operator("exemplar.adopt", icon="COPYDOWN")
        layout.operator("exemplar.mark_asset", icon="ASSET_MANAGER")
        layout.operator("exemplar.restore", icon="LOOP_BACK")
        gone = [name for name in record["sources"] if name not in bpy.data.objects]
        if gone:
            layout.label(text=f"'{gone[0]}' is gone, from which it was made", icon="ERROR")
        for warning in record.get("warnings", ()):
            _wrapped(layout, warning, "INFO", context.region.width)


class EXEMPLAR_MT_menu(bpy.types.Menu):
    bl_label = "Exemplar"

    def draw(self, _context):
        for name in ("exemplar.extend", "exemplar.modules", "exemplar.landscape"):
            self.layout.operator(name)
        self.layout.separator()
        self.layout.operator("exemplar.again", text="Re-roll").how = "REROLL"
        self.layout.operator("exemplar.restore")


def draw_menu(self, _context):
    self.layout.menu("EXEMPLAR_MT_menu")


CLASSES = (EXEMPLAR_OT_find_command, EXEMPLAR_OT_set_command, EXEMPLAR_OT_copy_log,
           EXEMPLAR_PT_state, EXEMPLAR_PT_extend, EXEMPLAR_PT_control, EXEMPLAR_PT_surface, EXEMPLAR_PT_modules,
           EXEMPLAR_PT_landscape, EXEMPLAR_PT_result, EXEMPLAR_MT_menu)
