# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""Give it one example; get as much more of it as you want: the exemplar command in Blender."""

bl_info = {
    "name": "Exemplar",
    "author": "The exemplar authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Exemplar",
    "description": "More of a mesh, of placed objects or of a landscape, with the same materials",
    "category": "Object",
}

try:
    import bpy
except ImportError:  # job.py, glb.py and grid.py serve without Blender
    bpy = None

if bpy:
    import atexit

    from . import assets, extend, job, landscape, modules, panel, run, settings

    _classes = (*settings.CLASSES, *extend.CLASSES, *modules.CLASSES, *landscape.CLASSES,
                *assets.CLASSES, *panel.CLASSES)

    @bpy.app.handlers.persistent
    def _end_jobs(*_):
        run.end()

    def register():
        for kind in _classes:
            bpy.utils.register_class(kind)
        bpy.types.Scene.exemplar = bpy.props.PointerProperty(type=settings.Settings)
        bpy.types.VIEW3D_MT_object.append(panel.draw_menu)
        bpy.app.handlers.load_pre.append(_end_jobs)
        atexit.register(job.end_all)

    def unregister():
        run.end()
        atexit.unregister(job.end_all)
        bpy.app.handlers.load_pre.remove(_end_jobs)
        bpy.types.VIEW3D_MT_object.remove(panel.draw_menu)
        del bpy.types.Scene.exemplar
        for kind in reversed(_classes):
            bpy.utils.unregister_class(kind)
