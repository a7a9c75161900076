# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""What can be set: in the panels, kept with the scene; and in the preferences."""

import json

import bpy
from bpy.props import (BoolProperty, BoolVectorProperty, EnumProperty, FloatProperty,
                       FloatVectorProperty, IntProperty, IntVectorProperty, PointerProperty,
                       StringProperty)

from . import command

DETAIL = {"LOW": 48, "MEDIUM": 96, "HIGH": 192}


def _solid(_self, thing):
    return thing.type in {"MESH", "CURVE", "SURFACE", "META", "FONT"}


class Extend(bpy.types.PropertyGroup):
    """Of more geometry like the selected objects'."""
    engine: EnumProperty(name="Engine", default="auto", items=[
        ("auto", "Found", "Follows from the example"),
        ("quilting", "Quilting", "Large pieces of the example, joined by cuts"),
        ("voting", "Voting", "Overlapping patches, matched and voted"),
        ("blocks", "Blocks", "Best-matching blocks, as published by Lagae, Dumont and Dutré in 2004")])
    scale: FloatVectorProperty(
        name="Scale", default=(2, 2, 1), min=0.1, soft_max=8, size=3, subtype="XYZ",
        description="The result's size as a multiple of the example's, in the active object's axes")
    seed: IntProperty(name="Seed", min=0, description="Another seed, another result")
    detail: EnumProperty(name="Detail", default="MEDIUM", items=[
        ("LOW", "Low", "48 samples along the longest side"),
        ("MEDIUM", "Medium", "96 samples along the longest side"),
        ("HIGH", "High", "192 samples along the longest side"),
        ("AUTO", "Found", "As many samples as the thinnest parts and gaps need"),
        ("CUSTOM", "Samples", "A number of samples")])
    samples: IntProperty(name="Samples", default=64, min=8, max=1024,
                         description="Samples along the example's longest side")
    repeats: EnumProperty(name="Repeats", default="auto", description=(
        "Axes along which the example repeats itself, so that its parts may move along them"),
        items=[(a, n, "") for a, n in (
            ("auto", "Found"), ("none", "None"), ("x", "x"), ("y", "y"), ("z", "z"), ("xy", "xy"),
            ("xz", "xz"), ("yz", "yz"), ("xyz", "xyz"))])
    tile: BoolVectorProperty(name="Tile", size=3, subtype="XYZ",
                             description="Copies of the result tile along these axes")
    rotations: BoolProperty(name="Quarter Turns",
                            description="Parts may be turned by quarter turns about z")
    scatter: BoolProperty(name="Stands Alone", description=(
        "Take the example for an object with air around it, also where it looks like a piece of "
        "something longer, as a wall does"))
    mix: PointerProperty(name="Mix With", type=bpy.types.Collection,
                         description="Objects that are a further example, mixed with the selected")
    keep: PointerProperty(name="Keep", type=bpy.types.Object, poll=_solid, description=(
        "What is inside this object stays as it is, and all else is made of it"))
    guide: PointerProperty(name="Guide", type=bpy.types.Object, poll=_solid, description=(
        "Says coarsely where solid should be; it is stretched to the result's box"))
    on: PointerProperty(name="On Object", type=bpy.types.Object, poll=_solid, description=(
        "Lay the selected, which lies flat, on this object's surface"))
    span: FloatProperty(name="Span", min=0, unit="LENGTH", description=(
        "Length of the example's longest side on the surface; 0: a quarter of the surface's diagonal"))
    base: EnumProperty(name="Base", description="What is made of the object below", items=[
        ("none", "None", "A sheet of its own"),
        ("under", "Under", "The sheet stands on the object"),
        ("carve", "Carve", "The sheet is cut out of the object")])
    height: FloatProperty(name="Height", default=1, min=0.05, soft_max=4, description=(
        "Scales the example's height alone, on a surface"))
    cover: StringProperty(name="Cover", description=(
        "Vertex group of the object: the example lies where its weight is at least one half; none: "
        "everywhere. What lies on a part is a sheet of its own"))
    sizes: StringProperty(name="Sizes", description=(
        "Vertex group of the object: where its weight is 0 the example has half its size, where it "
        "is 1 twice; none: its size everywhere"))
    draft: BoolProperty(name="Draft First", description=(
        "Show a coarse result as wires until the final one replaces it. It shows the size, not the "
        "layout: another resolution is another layout"))
    thickness: FloatProperty(name="Thickness", min=0, unit="LENGTH", description=(
        "Gives open, thin meshes a thickness; 0 for solids"))
    triangles: EnumProperty(name="Triangles", default="MERGED", items=[
        ("ALL", "All", "The contour as it is: many small triangles"),
        ("MERGED", "Merged", "Merge triangles where the surface stays within 0.1 voxels"),
        ("NUMBER", "Number", "Merge triangles down to a number")])
    number: IntProperty(name="Number", default=20000, min=100, description="Triangles, at most")

    def resolution(self):
        return DETAIL.get(self.detail, "auto" if self.detail == "AUTO" else self.samples)


class Modules(bpy.types.PropertyGroup):
    """Of objects that are placed on a grid."""
    sample: PointerProperty(name="Sample", type=bpy.types.Collection,
                            description="Objects on a grid, of which more is made")
    cell: FloatVectorProperty(name="Cell", size=3, subtype="XYZ", min=0, unit="LENGTH", description=(
        "Sides of a cell; 0: measured, the least distance of two objects"))
    size: IntVectorProperty(name="Size", default=(20, 20, 1), min=1, soft_max=200, size=3, subtype="XYZ",
                            description="The result's size in cells")
    sides: EnumProperty(name="Sides", default="example", items=[
        ("example", "As in the Sample", "What is at a side is at that side of the sample"),
        ("free", "Free", "Anything may be at a side")])
    seed: IntProperty(name="Seed", min=0, description="Another seed, another result")
    form: EnumProperty(name="Result", items=[
        ("auto", "Found", "Linked duplicates up to 20,000 of them, else points"),
        ("objects", "Linked Duplicates", "An object for each cell: to go on editing by hand"),
        ("points", "Points", "One object of points, on which Geometry Nodes put the pieces")])
    pins: PointerProperty(name="Pins", type=bpy.types.Collection, description=(
        "Copies of the sample's objects, placed where the result must have them"))
    beside: BoolProperty(name="Beside the Sample", default=True, description=(
        "Put the result beside the sample along x; else it begins where the sample does"))


class Landscape(bpy.types.PropertyGroup):
    """Of a landscape that is a grid seen from above, or a height map in a file."""
    file: StringProperty(name="File", subtype="FILE_PATH", description=(
        "A height map to make more of (.tif, .exr, .png, .asc, .r16, ...); empty: the active object"))
    scale: FloatVectorProperty(name="Scale", size=2, default=(2, 2), min=0.1, soft_max=8,
                               description="The result's size as a multiple of the landscape's")
    seed: IntProperty(name="Seed", min=0, description="Another seed, another result")


class Settings(bpy.types.PropertyGroup):
    extend: PointerProperty(type=Extend)
    modules: PointerProperty(type=Modules)
    landscape: PointerProperty(type=Landscape)
    notes: StringProperty(description="What the last run said, as JSON")


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__
    path: StringProperty(name="Command", subtype="FILE_PATH", description=(
        "The exemplar command; empty: $EXEMPLAR, the PATH, beside the add-on, the usual folders"),
        update=lambda self, context: forget_command())
    cores: IntProperty(name="Cores", min=0, max=256, description="Cores to use; 0: all")
    keep_files: BoolProperty(name="Keep Files", description=(
        "Keep the files of each run, in Blender's temporary folder until it quits"))

    def draw(self, _context):
        row = self.layout.row(align=True)
        row.prop(self, "path")
        row.operator("exemplar.find_command", text="", icon="FILE_REFRESH")
        found, version = found_command()
        self.layout.label(text=f"exemplar {version}: {found}" if version else command.NOT_FOUND,
                          icon="CHECKMARK" if version else "ERROR")
        self.layout.prop(self, "cores")
        self.layout.prop(self, "keep_files")


_found = None


def forget_command():
    global _found
    _found = None


def preferences(context=None):
    """The add-on's preferences; None where the modules are used without being installed."""
    addon = (context or bpy.context).preferences.addons.get(__package__)
    return addon.preferences if addon else None


def found_command():
    """The command's path and version, remembered; empty texts where there is none."""
    global _found
    if _found is None:
        own = preferences()
        path = command.find(bpy.path.abspath(own.path) if own and own.path else "")
        _found = (path, command.version(path) if path else "")
    return _found


def frozen(group):
    """A group's values as plain data; what they point to by name."""
    values = {}
    for key in group.__annotations__:
        value = getattr(group, key)
        if isinstance(value, bpy.types.ID):
            value = value.name
        elif hasattr(value, "__len__") and not isinstance(value, str):
            value = list(value)
        values[key] = value
    return values


def thaw(group, values):
    """Sets a group to what `frozen` made."""
    for key, value in values.items():
        if key not in group.__annotations__:
            continue
        kind = group.bl_rna.properties[key]
        if kind.type == "POINTER":
            of = (bpy.data.objects if kind.fixed_type.identifier == "Object" else
                  bpy.data.collections)
            value = of.get(value) if value else None
        setattr(group, key, value)


def note(scene, **notes):
    """Keeps what a run said, for the panel."""
    scene.exemplar.notes = json.dumps(notes) if notes else ""


CLASSES = (Extend, Modules, Landscape, Settings, Preferences)
