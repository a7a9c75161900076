# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""The bytes of the .glb files between the add-on and the command. Knows nothing of Blender.

Triangles as NumPy arrays, in Blender's axes (z up); the files have glTF's (y up)."""

import json
import struct
from dataclasses import dataclass, field

import numpy as np

_COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32,
               5126: np.float32}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


@dataclass
class Triangles:
    """n triangles; what a corner has is n x 3 x width."""
    positions: np.ndarray                     # float64
    materials: np.ndarray                     # int32, n
    uvs: np.ndarray = None                    # float32, v up
    colors: np.ndarray = None                 # float32, linear RGBA
    normals: np.ndarray = None                # float32
    sources: tuple = None                     # (face int64 n x 3, weights float n x 3 x 2)
    count: int = field(default=1)             # of materials

    def __len__(self):
        return len(self.positions)


def _to_gltf(v):
    return np.stack([v[..., 0], v[..., 2], -v[..., 1]], axis=-1)


def _from_gltf(v):
    return np.stack([v[..., 0], -v[..., 2], v[..., 1]], axis=-1)


def write(path, triangles, colors=(), name="example"):
    """Writes the triangles, one primitive for each material that they use, in the order of their
    numbers; `colors` are the materials' base colors, for pictures. The triangles must be in that
    order already (`sorted_by_material`), so that a triangle's number is its number in the file."""
    chunks, views, accessors, primitives = [], [], [], []

    def accessor(array, kind, target, bounds=False):
        data = np.ascontiguousarray(array)
        views.append({"buffer": 0, "byteOffset": sum(map(len, chunks)), "byteLength": data.nbytes,
                      "target": target})
        chunks.append(data.tobytes() + b"\0" * (-data.nbytes % 4))
        entry = {"bufferView": len(views) - 1, "count": len(data), "type": kind,
                 "componentType": 5125 if data.dtype == np.uint32 else 5126}
        if bounds:
            entry["min"], entry["max"] = data.min(0).tolist(), data.max(0).tolist()
        accessors.append(entry)
        return len(accessors) - 1

    used = np.unique(triangles.materials)
    for number in used:
        mine = triangles.materials == number
        corners = [_to_gltf(triangles.positions[mine]).reshape(-1, 3).astype(np.float32)]
        if triangles.uvs is not None:
            corners.append(triangles.uvs[mine].reshape(-1, 2) * [1, -1] + [0, 1])
        if triangles.colors is not None:
            corners.append(triangles.colors[mine].reshape(-1, 4))
        rows = np.ascontiguousarray(np.concatenate(corners, axis=1, dtype=np.float32)) + np.float32(0)
        _, first, indices = np.unique(rows.view([("", "V", rows.shape[1] * 4)]).ravel(),
                                      return_index=True, return_inverse=True)
        rows = rows[first]
        attributes = {"POSITION": accessor(rows[:, :3], "VEC3", 34962, True)}
        at = 3
        if triangles.uvs is not None:
            attributes["TEXCOORD_0"] = accessor(rows[:, at:at + 2], "VEC2", 34962)
            at += 2
        if triangles.colors is not None:
            attributes["COLOR_0"] = accessor(rows[:, at:at + 4], "VEC4", 34962)
        primitives.append({"attributes": attributes, "material": len(primitives), "indices":
                           accessor(indices.astype(np.uint32).ravel(), "SCALAR", 34963)})
    materials = []
    for number in used:
        color = list(colors[number]) if number < len(colors) else [0.8, 0.8, 0.8, 1]
        materials.append({"name": f"slot {number}", "pbrMetallicRoughness": {
            "baseColorFactor": [float(c) for c in color[:3]] + [1.0], "metallicFactor": 0.0}})
    body = b"".join(chunks)
    document = {"asset": {"version": "2.0", "generator": "exemplar for Blender"}, "scene": 0,
                "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": name}],
                "meshes": [{"primitives": primitives, "name": name}], "materials": materials,
                "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": len(body)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(body), b"BIN\0") + body)


def sorted_by_material(triangles):
    """The order of triangles, as indices, in which `write` wants them."""
    return np.argsort(triangles.materials, kind="stable")


def read(path):
    """Reads the triangles of a .glb of one mesh, as the command writes it. Materials are numbered
    as `write` named them; others follow from the first number that is free."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] != b"glTF":
        raise ValueError(f"{path} is no .glb file")
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20:20 + length])
    body = memoryview(data)[28 + length:]

    def values(index):
        entry = document["accessors"][index]
        view = document["bufferViews"][entry["bufferView"]]
        kind, width = _COMPONENTS[entry["componentType"]], _WIDTHS[entry["type"]]
        start = view.get("byteOffset", 0) + entry.get("byteOffset", 0)
        step = view.get("byteStride", 0) or width * np.dtype(kind).itemsize
        array = np.ndarray((entry["count"], width), kind, body, start,
                           (step, np.dtype(kind).itemsize))
        if entry.get("normalized"):
            return array.astype(np.float32) / np.float32(np.iinfo(kind).max)
        return array

    numbers = _numbers(document.get("materials", []))
    parts = []
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        matrix = _matrix(node)
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            parts.append(_part(primitive, matrix, numbers, values))
    if not parts:
        raise ValueError(f"{path} holds no triangles")

    def joined(index, width, fill):
        if all(part[index] is None for part in parts):
            return None
        return np.concatenate([np.full((len(part[0]), 3, width), fill, np.float32)
                               if part[index] is None else part[index] for part in parts])

    sources = None
    if all(part[5] is not None for part in parts):
        sources = tuple(np.concatenate([part[5][n] for part in parts]) for n in (0, 1))
    materials = np.concatenate([part[1] for part in parts])
    return Triangles(np.concatenate([part[0] for part in parts]), materials, joined(2, 2, 0),
                     joined(3, 4, 1), joined(4, 3, 0), sources, int(materials.max()) + 1)


def _numbers(materials):
    """The number of each material of a file."""
    numbers = []
    for material in materials:
        head, _, tail = material.get("name", "").rpartition(" ")
        numbers.append(int(tail) if head == "slot" and tail.isdigit() else None)
    free = max((n for n in numbers if n is not None), default=-1) + 1
    for at, number in enumerate(numbers):
        if number is None:
            numbers[at], free = free, free + 1
    return numbers


def _matrix(node):
    matrix = np.eye(4)
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    matrix[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def _part(primitive, matrix, numbers, values):
    attributes = primitive["attributes"]
    points = values(attributes["POSITION"]).astype(np.float64)
    if "indices" in primitive:
        corners = values(primitive["indices"]).astype(np.int64).reshape(-1, 3)
    else:
        corners = np.arange(len(points)).reshape(-1, 3)
    positions = _from_gltf(points @ matrix[:3, :3].T + matrix[:3, 3])[corners]
    material = numbers[primitive["material"]] if "material" in primitive else 0
    uvs = colors = normals = sources = None
    if "TEXCOORD_0" in attributes:
        uvs = (values(attributes["TEXCOORD_0"]) * [1, -1] + [0, 1]).astype(np.float32)[corners]
    if "COLOR_0" in attributes:
        colors = values(attributes["COLOR_0"]).astype(np.float32)
        if colors.shape[1] == 3:
            colors = np.concatenate([colors, np.ones((len(colors), 1), np.float32)], axis=1)
        colors = colors[corners]
    if "NORMAL" in attributes:
        turned = values(attributes["NORMAL"]) @ np.linalg.inv(matrix[:3, :3])
        turned /= np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-20)
        normals = _from_gltf(turned).astype(np.float32)[corners]
    if "_SOURCE_FACE" in attributes:
        faces = values(attributes["_SOURCE_FACE"])[:, 0].astype(np.int64)
        sources = (faces[corners], values(attributes["_SOURCE_WEIGHTS"]).astype(np.float64)[corners])
    return (positions, np.full(len(corners), material, np.int32), uvs, colors, normals, sources)
