# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""Objects of a scene as triangles, and triangles as an object's mesh with the same materials."""

import bpy
import numpy as np
from mathutils import Matrix

from . import glb

KINDS = {"MESH", "CURVE", "SURFACE", "META", "FONT"}
CREASE = 0.6981317  # 40 degrees


def frame_of(thing):
    """Location and rotation of an object, without scale: voxels are cubes in the world."""
    place, turn, _scale = thing.matrix_world.decompose()
    return Matrix.Translation(place) @ turn.to_matrix().to_4x4()


class Exported:
    """What was written, and what is needed when the result comes back. Holds names and arrays,
    nothing that undo or deleting could take away."""

    def __init__(self):
        self.materials = []   # (name, library) or None, by number
        self.colors = []
        self.layers = []      # (kind, name, type, domain, values n x 3 x width)
        self.uv_name = self.color_name = ""
        self.triangles = None

    def paint_groups(self, names):
        """Colors corners by the weights of vertex groups: red by the first, green by the second;
        empty names paint nothing. Throws ValueError where there is no such group."""
        weights = {layer[1]: layer[4] for layer in self.layers if layer[0] == "GROUP"}
        colors = np.ones((len(self.triangles), 3, 4), np.float32)
        for channel, name in enumerate(names):
            if not name:
                continue
            if name not in weights:
                raise ValueError(f"the object has no vertex group '{name}'")
            colors[..., channel] = weights[name][..., 0]
        self.triangles.colors = colors


def _material_key(material):
    return None if material is None else (
        material.name, material.library.filepath if material.library else None)


def _material_of(key):
    return bpy.data.materials.get(key) if key else None


def gather(context, names, frame, thickness=0.0):
    """The evaluated triangles of objects, with their modifiers and what they instance, in `frame`.
    Hidden ones are shown while it lasts. Throws ValueError where there are none."""
    things = [bpy.data.objects.get(name) for name in names]
    gone = [name for name, thing in zip(names, things) if thing is None]
    if gone:
        raise ValueError(f"'{gone[0]}' is gone, from which this was made")
    hidden = [thing for thing in things if thing.name in context.view_layer.objects and
              thing.hide_get()]
    for thing in hidden:
        thing.hide_set(False)
    for thing in things:
        if thing.mode == "EDIT":
            thing.update_from_editmode()
    out = Exported()
    parts = []
    try:
        context.view_layer.update()
        inverse = frame.inverted()
        wanted = {thing.name for thing in things}
        for instance in context.evaluated_depsgraph_get().object_instances:
            owner = instance.parent if instance.is_instance else instance.object
            if owner is None or owner.original.name not in wanted or \
                    instance.object.type not in KINDS:
                continue
            part = _part(instance.object, inverse @ instance.matrix_world, out)
            if part:
                parts.append(part)
    finally:
        for thing in hidden:
            thing.hide_set(True)
    if not parts:
        raise ValueError("the selected objects have no faces")
    _join(parts, out)
    if thickness > 0:
        _thicken(out, thickness)
    order = glb.sorted_by_material(out.triangles)
    _reorder(out, order)
    return out


def _part(thing, matrix, out):
    mesh = thing.to_mesh()
    try:
        mesh.calc_loop_triangles()
        count = len(mesh.loop_triangles)
        if count == 0:
            return None

        def get(items, name, width, kind=np.float32, size=None):
            values = np.empty((size or len(items)) * width, kind)
            items.foreach_get(name, values)
            return values.reshape(-1, width)

        loops = get(mesh.loop_triangles, "loops", 3, np.int32)
        owners = get(mesh.loops, "vertex_index", 1, np.int32)[:, 0]
        numbers = get(mesh.loop_triangles, "material_index", 1, np.int32)[:, 0]
        transform = np.array(matrix, np.float64)
        points = get(mesh.vertices, "co", 3) @ transform[:3, :3].T + transform[:3, 3]
        if np.linalg.det(transform[:3, :3]) < 0:
            loops = loops[:, ::-1]
        slots = []
        for slot in thing.material_slots or [None]:
            material = slot.material if slot else None
            key = _material_key(material.original if material else None)
            if key not in out.materials:
                out.materials.append(key)
                out.colors.append(tuple(material.diffuse_color) if material else (0.8, 0.8, 0.8, 1))
            slots.append(out.materials.index(key))
        part = {"positions": points[owners[loops]], "layers": {}, "uv": None, "color": None,
                "materials": np.array(slots, np.int32)[np.minimum(numbers, len(slots) - 1)]}
        active = mesh.uv_layers.active
        for layer in mesh.uv_layers:
            values = get(layer.data, "uv", 2)[loops]
            if active and layer.name == active.name:
                part["uv"], out.uv_name = values, out.uv_name or layer.name
            else:
                part["layers"]["UV", layer.name, "FLOAT2", "CORNER"] = values
        active = mesh.color_attributes.active_color
        for layer in mesh.color_attributes:
            values = get(layer.data, "color", 4)[loops if layer.domain == "CORNER" else owners[loops]]
            if active and layer.name == active.name:
                part["color"] = values
                out.color_name = out.color_name or (layer.name, layer.data_type)
            else:
                part["layers"]["COLOR", layer.name, layer.data_type, "CORNER"] = values
        for key, values in _groups(thing.original, mesh).items():
            part["layers"]["GROUP", key, "FLOAT", "POINT"] = values[owners[loops]][..., None]
        for layer in mesh.attributes:
            width = {"FLOAT": ("value", 1), "FLOAT_VECTOR": ("vector", 3)}.get(layer.data_type)
            if width is None or layer.name == "position" or layer.domain not in {"POINT", "CORNER"}:
                continue
            values = get(layer.data, *width)[loops if layer.domain == "CORNER" else owners[loops]]
            part["layers"]["ATTRIBUTE", layer.name, layer.data_type, layer.domain] = values
        return part
    finally:
        thing.to_mesh_clear()


def _groups(thing, mesh):
    """The weights of an object's vertex groups by name."""
    if not getattr(thing, "vertex_groups", None):
        return {}
    names = [group.name for group in thing.vertex_groups]
    weights = np.zeros((len(names), len(mesh.vertices)), np.float32)
    for vertex in mesh.vertices:
        for group in vertex.groups:
            weights[group.group, vertex.index] = group.weight
    return dict(zip(names, weights))


def _join(parts, out):
    def joined(key, width, fill):
        if all(part[key] is None for part in parts):
            return None
        return np.concatenate([part[key] if part[key] is not None else np.full(
            (len(part["positions"]), 3, width), fill, np.float32) for part in parts])

    out.triangles = glb.Triangles(np.concatenate([part["positions"] for part in parts]),
                                  np.concatenate([part["materials"] for part in parts]),
                                  joined("uv", 2, 0), joined("color", 4, 1))
    for key in dict.fromkeys(key for part in parts for key in part["layers"]):
        width = next(part["layers"][key].shape[2] for part in parts if key in part["layers"])
        out.layers.append((*key, np.concatenate([part["layers"].get(key, np.zeros(
            (len(part["positions"]), 3, width), np.float32)) for part in parts])))


def _reorder(out, order):
    t = out.triangles
    out.triangles = glb.Triangles(t.positions[order], t.materials[order],
                                  None if t.uvs is None else t.uvs[order],
                                  None if t.colors is None else t.colors[order])
    out.layers = [(*layer[:4], layer[4][order]) for layer in out.layers]


def _thicken(out, thickness):
    """Makes a sheet a solid: its faces half the thickness out, and in, and walls at its rim."""
    t = out.triangles
    points, index = np.unique(t.positions.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    index = index.reshape(-1, 3)
    a, b, c = (t.positions[:, n] for n in range(3))
    normals = np.zeros_like(points)
    np.add.at(normals, index, np.cross(b - a, c - a)[:, None])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-20)
    shift = normals[index] * (thickness / 2)
    edges = np.stack([index, np.roll(index, -1, 1)], -1).reshape(-1, 2)
    _, first, count = np.unique(np.sort(edges, 1), axis=0, return_index=True, return_counts=True)
    face, corner = np.divmod(first[count == 1], 3)
    after = (corner + 1) % 3
    pick = np.concatenate([np.arange(len(t)), np.arange(len(t)), face, face])
    corners = np.concatenate([np.tile([0, 1, 2], (len(t), 1)), np.tile([2, 1, 0], (len(t), 1)),
                              np.stack([after, corner, corner], 1), np.stack([after, corner, after], 1)])
    sign = np.concatenate([np.tile([1, 1, 1], (len(t), 1)), np.tile([-1, -1, -1], (len(t), 1)),
                           np.tile([1, 1, -1], (len(face), 1)), np.tile([1, -1, -1], (len(face), 1))])

    def taken(values):
        return None if values is None else values[pick[:, None], corners]

    positions = taken(t.positions) + taken(shift) * sign[..., None]
    out.triangles = glb.Triangles(positions, t.materials[pick], taken(t.uvs), taken(t.colors))
    out.layers = [(*layer[:4], taken(layer[4])) for layer in out.layers]


def build(name, triangles, exported):
    """A new mesh of what came back, with the materials, layers and attributes of what was sent."""
    t = triangles
    flat = t.positions.reshape(-1, 3).astype(np.float32) + np.float32(0)
    _, first, index = np.unique(flat.view([("", "V12")]).ravel(), return_index=True,
                                return_inverse=True)
    index = index.reshape(-1, 3)
    whole = (index[:, 0] != index[:, 1]) & (index[:, 1] != index[:, 2]) & (index[:, 2] != index[:, 0])
    index, count = index[whole], int(whole.sum())
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(first))
    mesh.vertices.foreach_set("co", flat[first].ravel())
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", index.astype(np.int32).ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(count, 3, np.int32))
    used = [n for n in np.unique(t.materials) if n < len(exported.materials)]
    slots = np.zeros(max(int(t.materials.max()), len(exported.materials)) + 1, np.int32)
    for number in used:
        slots[number] = len(mesh.materials)
        mesh.materials.append(_material_of(exported.materials[number]))
    mesh.polygons.foreach_set("material_index", slots[t.materials[whole]])
    mesh.polygons.foreach_set("use_smooth", np.ones(count, bool))
    if t.uvs is not None and exported.uv_name:
        mesh.uv_layers.new(name=exported.uv_name).data.foreach_set("uv", t.uvs[whole].ravel())
    if t.colors is not None and exported.color_name:
        layer = mesh.color_attributes.new(*exported.color_name, "CORNER")
        layer.data.foreach_set("color", t.colors[whole].ravel())
    mesh.update(calc_edges=True)
    groups = {}
    if t.sources is not None:
        groups = _pull(mesh, exported.layers, t.sources[0][whole], t.sources[1][whole], index)
    mesh.validate(clean_customdata=False)
    if hasattr(mesh, "use_auto_smooth"):  # before 4.1
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, CREASE
    if t.normals is not None and len(mesh.loops) == 3 * count:
        mesh.normals_split_custom_set(t.normals[whole].reshape(-1, 3))
    return mesh, groups


def _pull(mesh, layers, faces, weights, index):
    """Sets the further layers from the places of the example that the corners came from; the
    weights of vertex groups, by name, are for the object."""
    weights = np.concatenate([weights, 1 - weights.sum(-1, keepdims=True)], -1)
    groups = {}
    for kind, name, data, domain, values in layers:
        if not len(values):
            continue
        at = np.clip(faces, 0, len(values) - 1)
        corners = (values[at] * weights[..., None]).sum(-2).astype(np.float32)  # n x 3 x width
        if kind == "UV":
            mesh.uv_layers.new(name=name, do_init=False).data.foreach_set("uv", corners.ravel())
            continue
        if kind == "COLOR":
            mesh.color_attributes.new(name, data, domain).data.foreach_set("color", corners.ravel())
            continue
        width = corners.shape[2]
        points = np.zeros((len(mesh.vertices), width), np.float32)
        points[index.ravel()] = corners.reshape(-1, width)
        if kind == "GROUP":
            groups[name] = points[:, 0]
        else:
            layer = mesh.attributes.new(name, data, domain)
            layer.data.foreach_set("value" if width == 1 else "vector",
                                   (corners if domain == "CORNER" else points).ravel())
    return groups


def set_groups(thing, groups):
    """Sets an object's vertex groups, weights rounded to a hundredth."""
    for name, weights in groups.items():
        group = thing.vertex_groups.get(name) or thing.vertex_groups.new(name=name)
        levels = np.rint(np.clip(weights, 0, 1) * 100).astype(int)
        for level in np.unique(levels[levels > 0]):
            group.add(np.flatnonzero(levels == level).tolist(), level / 100, "REPLACE")
