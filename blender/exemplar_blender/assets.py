# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""Results as assets, under the catalog Exemplar of Blender's asset browser."""

import os

import bpy

from . import run

CATALOG = "8f0c6f1e-4f1b-4f6e-9d0a-2c5b7a3e9d41"
_LINE = f"{CATALOG}:Exemplar:Exemplar"


def write_catalog(folder):
    """Adds the catalog to those of a folder of .blend files; what is there stays."""
    path = os.path.join(folder, "blender_assets.cats.txt")
    text = ""
    if os.path.isfile(path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if CATALOG in text:
            return
    with open(path, "w", encoding="utf-8") as file:
        file.write((text.rstrip("\n") or "VERSION 1\n") + "\n" + _LINE + "\n")


def mark(thing, description, tags):
    """Makes an object an asset of the catalog."""
    thing.asset_mark()
    thing.asset_data.catalog_id = CATALOG
    thing.asset_data.description = description
    for tag in tags:
        thing.asset_data.tags.new(tag, skip_if_exists=True)


class EXEMPLAR_OT_mark_asset(bpy.types.Operator):
    """Show the result, with the settings that it was made with, in the asset browser"""
    bl_idname = "exemplar.mark_asset"
    bl_label = "Mark as Asset"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        thing, record = run.result_of(context)
        if record is None or not isinstance(thing, bpy.types.Object):
            return False
        if not bpy.data.filepath:
            cls.poll_message_set("Save the file first: assets are found by their file's folder")
            return False
        return True

    def execute(self, context):
        thing, record = run.result_of(context)
        values = record["settings"]
        scale = " x ".join(f"{side:g}" for side in values["scale"])
        mark(thing, f"{scale} of {', '.join(record['sources']) or 'a file'}, seed {values['seed']}",
             ["exemplar", record["kind"]])
        write_catalog(os.path.dirname(bpy.data.filepath))
        if not bpy.app.background:
            thing.asset_generate_preview()
        return {"FINISHED"}


CLASSES = (EXEMPLAR_OT_mark_asset,)
