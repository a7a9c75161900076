# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""More geometry like the selected objects'."""

import os
import shutil
import uuid

import bpy
import numpy as np
from mathutils import Matrix

from . import exchange, glb, run, settings

MERGED = 0.1  # voxels
DRAFT = 32  # samples


def _path_of(identity):
    """Where a result's field and origins are kept until Blender quits, to refine it from."""
    return os.path.join(bpy.app.tempdir, "exemplar_results", identity)


class Synthesis(run.Run):
    """Writes the example, runs the command, reads the mesh."""

    def begin(self, context, values, names, active, detail=1, identity=""):
        """The command's words for settings; the example is what `names` are, in `active`'s frame."""
        self.values, self.names, self.anchor, self.detail = values, names, active, detail
        self.before = _path_of(identity) if identity else ""
        self.identity = uuid.uuid4().hex
        thing = bpy.data.objects.get(active)
        if thing is None:
            raise run.Failure(f"'{active}' is gone, from which this was made")
        if values.get("on") and detail > 1:
            raise run.Failure("what lies on a surface is not refined: choose more Detail")
        frame = exchange.frame_of(thing)
        self.frame = [list(row) for row in frame]
        self.exported = self._write(context, names, frame, "in.glb", values["thickness"])
        self.exported.triangles = None  # not needed again
        # Results of older versions know nothing of surfaces.
        for key in ("on",) if values.get("on") else ("keep", "guide"):
            if values[key]:
                self._write(context, [values[key]], frame, key + ".glb")
        if values["mix"]:
            collection = bpy.data.collections.get(values["mix"])
            found = [t.name for t in collection.all_objects] if collection else []
            if not found:
                raise run.Failure(f"the collection '{values['mix']}' has no objects to mix with")
            self._write(context, found, frame, "mix.glb")
        return self.words(values["resolution"])

    def words(self, resolution, draft=False):
        """The command's, for what `begin` has written."""
        values = self.values
        out = ["-o", "out.glb", "--resolution", resolution]
        if values["mix"]:
            out += ["--with", "mix.glb"]
        elif self.exported.layers:
            out.append("--source")
        if values["triangles"] == "MERGED":
            out += ["--simplify", MERGED]
        elif values["triangles"] == "NUMBER":
            out += ["--triangles", values["number"]]
        if values.get("on"):
            cover = values.get("cover")
            out += ["--on", "on.glb", "--base", "none" if cover else values["base"],
                    "--height", f"{values['height']:.6g}"]
            out += ["--cover", "red"] if cover else []
            out += ["--size-map", "green"] if values.get("sizes") else []
            out += ["--span", f"{values['span']:.6g}"] if values["span"] else []
            return ["synth", "in.glb", "--engine", "surface", "--seed", values["seed"]] + out
        out += ["--scatter"] if values["scatter"] else []
        if self.detail > 1:
            out += ["--detail", self.detail]
            if os.path.isfile(os.path.join(self.before, "origins.vdb")):
                return ["mesh", os.path.join(self.before, "field.vdb"), "--origins",
                        os.path.join(self.before, "origins.vdb"), "--example", "in.glb"] + out
        for key in ("keep", "guide"):
            if values[key]:
                out += ["--" + key, key + ".glb"]
        out += ["--scale", ",".join(f"{side:.6g}" for side in values["scale"]),
                "--seed", values["seed"], "--engine", values["engine"]]
        if self.detail == 1 and not draft:
            out += ["-o", "field.vdb", "--origins", "origins.vdb"]
        if values["repeats"] != "auto":
            out += ["--stationary", values["repeats"]]
        tiles = ",".join(axis for axis, on in zip("xyz", values["tile"]) if on)
        if tiles:
            out += ["--periodic", tiles]
        if values["rotations"]:
            out.append("--rotations")
        return ["synth", "in.glb"] + out

    def _write(self, context, names, frame, name, thickness=0.0):
        exported = exchange.gather(context, names, frame, thickness)
        if name == "on.glb":
            exported.paint_groups([self.values.get("cover"), self.values.get("sizes")])
        example = bpy.path.clean_name(names[0]) or "example"
        glb.write(self.file(name), exported.triangles, exported.colors, example)
        return exported

    def result_mesh(self, name):
        mesh, groups = exchange.build(name, glb.read(self.file("out.glb")), self.exported)
        fields = [self.file(name) for name in ("field.vdb", "origins.vdb")]
        if all(map(os.path.isfile, fields)):
            kept = _path_of(self.identity)
            os.makedirs(kept, exist_ok=True)
            for file in fields:
                shutil.move(file, kept)
        return mesh, groups

    def record(self, thing, identity=None):
        run.remember(thing, "extend", self.values, sources=self.names, anchor=self.anchor,
                     frame=self.frame, detail=self.detail, identity=identity or self.identity,
                     warnings=self.job.warnings)


class EXEMPLAR_OT_extend(Synthesis, bpy.types.Operator):
    """Make more of the selected objects: larger, different everywhere, with their materials"""
    bl_idname = "exemplar.extend"
    bl_label = "More of It"
    drafted = ("", "")  # names of the object and the mesh that show the draft

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        if not any(thing.type in exchange.KINDS for thing in context.selected_objects):
            cls.poll_message_set("Select the objects to make more of")
            return False
        return True

    def prepare(self, context):
        group = context.scene.exemplar.extend
        values = settings.frozen(group)
        values["resolution"] = group.resolution()
        apart = {values["keep"], values["guide"], values["on"]}
        names = [t.name for t in context.selected_objects
                 if t.type in exchange.KINDS and t.name not in apart]
        if not names:
            raise run.Failure("select the objects to make more of; Keep, Guide and On Object are none "
                              "of them")
        active = context.active_object
        words = self.begin(context, values, names,
                           active.name if active and active.name in names else names[0])
        if not (values["draft"] and self.shows_drafts and values["resolution"] != "auto" and
                values["resolution"] > DRAFT):
            return words
        self.following = words
        return self.words(DRAFT, draft=True)

    def place(self, context, mesh):
        """An object of a mesh where the example is, in its collection."""
        anchor = bpy.data.objects.get(self.anchor)
        thing = bpy.data.objects.new(mesh.name, mesh)
        thing.matrix_world = Matrix(self.frame)
        owners = anchor.users_collection if anchor else ()
        (owners[0] if owners else context.collection).objects.link(thing)
        return thing

    def take_draft(self, context):
        mesh, _ = exchange.build(self.anchor + " draft", glb.read(self.file("out.glb")),
                                 self.exported)
        thing = self.place(context, mesh)
        thing.display_type, thing.show_in_front = "WIRE", True
        self.drafted = (thing.name, mesh.name)
        os.remove(self.file("out.glb"))

    def drop_draft(self):
        thing, mesh = self.drafted
        self.drafted = ("", "")
        if bpy.data.objects.get(thing):
            bpy.data.objects.remove(bpy.data.objects[thing])
        mesh = bpy.data.meshes.get(mesh)
        if mesh and mesh.users == 0:
            bpy.data.meshes.remove(mesh)

    def take(self, context):
        mesh, groups = self.result_mesh(self.anchor + " more")
        self.drop_draft()
        if bpy.data.objects.get(self.anchor) is None:
            self.report({"INFO"}, f"'{self.anchor}' is gone; the result is where it was")
        thing = self.place(context, mesh)
        exchange.set_groups(thing, groups)
        self.record(thing)
        run.hide(context, self.names)
        run.select(context, [thing.name])


class EXEMPLAR_OT_again(Synthesis, bpy.types.Operator):
    """Make this result anew, in its place"""
    bl_idname = "exemplar.again"
    bl_label = "Make It Anew"

    how: bpy.props.EnumProperty(items=[
        ("REROLL", "Re-roll", "Another seed: the same in another way"),
        ("REDO", "With the Panel's Settings", "Make it anew with the settings of the panel Extend"),
        ("REFINE2", "Refine x2", "The same layout at twice its resolution, with the finer detail"),
        ("REFINE4", "Refine x4", "The same layout at four times its resolution")])

    @classmethod
    def description(cls, _context, properties):
        items = cls.bl_rna.properties["how"].enum_items
        return items[properties.how].description

    @classmethod
    def poll(cls, context):
        _, record = run.result_of(context)
        return super().poll(context) and record is not None and record["kind"] == "extend"

    def prepare(self, context):
        thing, record = run.result_of(context)
        values, detail = record["settings"], 1
        if self.how == "REROLL":
            values["seed"] += 1
        elif self.how == "REDO":
            group = context.scene.exemplar.extend
            values = settings.frozen(group)
            values["resolution"] = group.resolution()
        else:
            detail = 4 if self.how == "REFINE4" else 2
        self.result, self.was = thing.name, record["identity"]
        return self.begin(context, values, record["sources"], record["anchor"], detail,
                          record["identity"])

    def take(self, context):
        thing = bpy.data.objects.get(self.result)
        if thing is None or thing.type != "MESH":
            raise run.Failure(f"'{self.result}' is gone, which was to be made anew")
        before = thing.data
        mesh, groups = self.result_mesh(before.name)
        thing.data = mesh
        if before.users == 0:
            name = before.name
            bpy.data.meshes.remove(before)
            mesh.name = name
        thing.vertex_groups.clear()
        exchange.set_groups(thing, groups)
        self.record(thing, self.was if self.detail > 1 else None)


class EXEMPLAR_OT_adopt(bpy.types.Operator):
    """Set the panels to the settings that this result was made with"""
    bl_idname = "exemplar.adopt"
    bl_label = "Its Settings to the Panel"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return run.result_of(context)[1] is not None

    def execute(self, context):
        _, record = run.result_of(context)
        settings.thaw(getattr(context.scene.exemplar, record["kind"]), record["settings"])
        return {"FINISHED"}


class EXEMPLAR_OT_restore(bpy.types.Operator):
    """Show the objects that this result was made from, and select them"""
    bl_idname = "exemplar.restore"
    bl_label = "Restore the Source"
    bl_options = {"UNDO"}

    hide_result: bpy.props.BoolProperty(name="Hide the Result", default=True)

    @classmethod
    def poll(cls, context):
        record = run.result_of(context)[1]
        return record is not None and bool(record["sources"])

    def execute(self, context):
        thing, record = run.result_of(context)
        here = [n for n in record["sources"] if n in context.view_layer.objects]
        if not here:
            self.report({"ERROR"}, f"'{record['sources'][0]}' is gone, from which this was made")
            return {"CANCELLED"}
        if self.hide_result:
            results = [thing] if isinstance(thing, bpy.types.Object) else list(thing.objects)
            run.hide(context, [t.name for t in results])
        run.select(context, here)
        return {"FINISHED"}


class EXEMPLAR_OT_compare(run.Run, bpy.types.Operator):
    """Measure the result against its example, and open the page that shows both"""
    bl_idname = "exemplar.compare"
    bl_label = "Compare"
    bl_options = set()

    @classmethod
    def poll(cls, context):
        thing, record = run.result_of(context)
        return (super().poll(context) and record is not None and record["kind"] == "extend" and
                os.path.isfile(os.path.join(_path_of(record["identity"]), "origins.vdb")))

    def prepare(self, context):
        _, record = run.result_of(context)
        kept = _path_of(record["identity"])
        exported = exchange.gather(context, record["sources"], Matrix(record["frame"]),
                                   record["settings"]["thickness"])
        glb.write(self.file("in.glb"), exported.triangles, exported.colors)
        self.page = os.path.join(kept, "report.html")
        return ["measure", "in.glb", os.path.join(kept, "field.vdb"), "--origins",
                os.path.join(kept, "origins.vdb"), "--report", self.page,
                "--resolution", record["settings"]["resolution"]]

    def take(self, context):
        if not bpy.app.background:
            bpy.ops.wm.url_open(url="file://" + self.page)


CLASSES = (EXEMPLAR_OT_extend, EXEMPLAR_OT_again, EXEMPLAR_OT_adopt, EXEMPLAR_OT_restore,
           EXEMPLAR_OT_compare)
