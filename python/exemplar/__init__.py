# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT
"""Give it one example; get as much more of it as you want.

    import exemplar
    wall = exemplar.read("wall.obj", resolution=96)
    more = exemplar.synthesize(wall, scale=(3, 1, 1), seed=7)
    more.mesh(simplify=0.1).write("longer.glb")

Arrays are [x, y, z], the world's z up, and views of the library's memory: nothing is copied, and
what they are views of lives as long as they do. Work runs without the interpreter's lock; Ctrl-C
stops it. The same examples, settings and seed give the same result at any number of threads.
"""

import inspect as _inspect
import os as _os

# A wheel brings the bundled scenes.
_scenes = _os.path.join(_os.path.dirname(_os.path.abspath(__file__)), "scenes")
if _os.path.isdir(_scenes):
    _os.environ.setdefault("EXEMPLAR_SCENES", _scenes)

from . import _core  # noqa: E402
from ._core import (BlockIndex, Cancelled, Field, Heights, InputError, LabelGrid, Mesh, Pieces,
                    __version__, adjacency, block_average, cut_pieces, engines, field_to_mesh,
                    mesh_to_field, mesh_to_labels, nearest_neighbor_field, read_field,
                    read_heights, read_labels, redistance, sample, scenes, violations)

__all__ = ["BlockIndex", "Cancelled", "Example", "Field", "Heights", "Impossible", "InputError",
           "LabelGrid", "Mesh", "Pieces", "Result", "Unfinished", "World", "adjacency",
           "block_average", "cut_pieces", "engines", "field_to_mesh", "measure", "mesh_to_field",
           "mesh_to_labels", "nearest_neighbor_field", "read", "read_field", "read_heights",
           "read_labels", "read_mesh", "redistance", "render", "sample", "scene", "scenes",
           "settings", "synthesize", "transfer", "violations"]


class Impossible(RuntimeError):
    """Nothing meets the request; `conflict` says what excludes each other: a dict with `text`,
    `pins` (their numbers) and `sides`.

    >>> checkered = LabelGrid([[[1], [2]], [[2], [1]]], names=["", "black", "white"])
    >>> try:
    ...     synthesize(checkered, size=(4, 1, 1), pin=["0,0,0=white", "1,0,0=white"])
    ... except Impossible as error:
    ...     print(error.conflict["pins"])
    [0, 1]
    """

    def __init__(self, text, conflict=None):
        super().__init__(text)
        self.conflict = conflict


class Unfinished(RuntimeError):
    """The budget was spent, and nothing is proved."""


def settings(engine="geometry"):
    """What can be set for an engine: a list of dicts (key, type, meaning, unit, least, most,
    choices, default, repeats). As keywords of `synthesize` and `read`, hyphens are underscores.

    >>> next(s for s in settings("geometry") if s["key"] == "scale")["meaning"]
    "the result's size as a multiple of the example's"
    """
    return _core._settings(engine)


def _text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, _os.PathLike)):
        return _os.fspath(value)
    if isinstance(value, dict):
        return ",".join(f"{key}={_text(v)}" for key, v in value.items())
    if hasattr(value, "__iter__"):
        return ",".join(map(_text, value))
    return str(int(value)) if hasattr(value, "__index__") else repr(float(value))


def _given(keywords, repeating=()):
    """Keys and texts of keyword arguments; those that are None are as if they were not there."""
    given = []
    for key, value in keywords.items():
        key = key.replace("_", "-")
        if value is None:
            continue
        if key in repeating and not isinstance(value, (str, bytes)):
            items = value.items() if isinstance(value, dict) else value
            given += [(key, "=".join(map(_text, item)) if isinstance(value, dict) else _text(item))
                      for item in items]
        else:
            given.append((key, _text(value)))
    return given


def _repeating(engine):
    return {setting["key"] for setting in _core._settings(engine) if setting["repeats"]}


def _memory(thing, cell_size=None):
    """A thing as the library takes it: a path, one of its own, or anything with vertices and faces,
    or an array of distances (floats), labels (integers) or heights (two dimensions)."""
    if isinstance(thing, (str, _os.PathLike, Mesh, Field, LabelGrid, Heights)):
        return thing
    if hasattr(thing, "vertices") and hasattr(thing, "faces"):
        return Mesh(thing.vertices, thing.faces)
    import numpy
    array = numpy.asarray(thing)
    if array.ndim == 2:
        return Heights(array, cell_size=cell_size or 1.0)
    if array.ndim == 3:
        whole = numpy.issubdtype(array.dtype, numpy.integer) or array.dtype == bool
        return LabelGrid(array) if whole else Field(array)
    raise InputError(f"{type(thing).__name__}: a path, a Mesh, a Field, a LabelGrid, Heights, "
                     "something with vertices and faces, or an array is wanted")


class Example:
    """An example: from a file or a scene (`read`), or from memory: a `Mesh`, a `Field`, a
    `LabelGrid`, `Heights`, anything with `vertices` and `faces`, or an array.

    Settings are those of reading, `exemplar.settings(engine)`. A mesh is read for the size of what
    is made of it (`scale` or `size`): one that becomes longer has no air at the ends that look cut
    off. `synthesize` reads it again where it is asked for another size."""

    def __init__(self, source, *, engine="auto", scale=None, size=None, progress=None, threads=0,
                 **settings):
        settings = {key: value for key, value in settings.items() if value is not None}
        source = _memory(source, settings.get("cell_size"))
        name = _core._engine_for(source) if engine in ("auto", "") else engine
        known = set(_core._reading_keys(name))
        for key in settings:
            if key.replace("_", "-") not in known:
                raise InputError(f"`{key}`: reading an example for {name} has no such setting; it has "
                                 + ", ".join(sorted(k.replace("-", "_") for k in known)))
        self._core = _core._read(source, name, _given(settings), _given(
            {"scale": scale, "size": size}), progress, threads)

    name = property(lambda self: self._core.name, doc="The file's name.")
    description = property(lambda self: self._core.description, doc="What it is, for people.")
    warnings = property(lambda self: list(self._core.warnings), doc="What was left out or guessed.")
    field = property(lambda self: self._core.field, doc="Its distances, a `Field`, or None.")
    labels = property(lambda self: self._core.labels, doc="Its labels, a `LabelGrid`, or None.")
    heights = property(lambda self: self._core.heights, doc="Its heights, `Heights`, or None.")
    mesh = property(lambda self: self._core.mesh, doc="Its triangles, a `Mesh`, or None.")

    def __repr__(self):
        return f"<exemplar.Example {self.name}: {self.description}>"

    def _repr_png_(self):
        return _png(_core._pictured(self._core))


class Result:
    """More of an example, and where each part of it came from.

    >>> example = Example([[[1], [2]], [[2], [1]]])  # labels: integers in three dimensions
    >>> more = synthesize(example, size=(5, 4, 1), seed=3)
    >>> more
    <exemplar.Result of model, 5 x 4 x 1 cells, seed 3>
    >>> cells, origins = more.labels.labels, more.origins
    >>> bool((example.labels.labels[tuple(origins.transpose(3, 0, 1, 2))] == cells).all())
    True
    """

    def __init__(self, core):
        self._core, self._meshes = core, {}

    engine = property(lambda self: self._core.engine, doc="What made it.")
    seed = property(lambda self: self._core.seed)
    field = property(lambda self: self._core.field, doc="Its distances, a `Field`, or None.")
    labels = property(lambda self: self._core.labels, doc="Its labels, a `LabelGrid`, or None.")
    heights = property(lambda self: self._core.heights, doc="Its heights, `Heights`, or None.")
    frames = property(lambda self: self._core.frames, doc=(
        "Of labels, a list of `LabelGrid`: the frames of what changes over time, else the one."))
    origins = property(lambda self: self._core.origins, doc=(
        "(nx, ny, nz, 3) int16, for each cell the example's cell it was taken from; a view."))
    origin_example = property(lambda self: self._core.origin_example, doc=(
        "(nx, ny, nz) uint8: which example; a view."))
    origin_turns = property(lambda self: self._core.origin_turns, doc=(
        "(nx, ny, nz) uint8: quarter turns about z, from example to result; a view."))
    statistics = property(lambda self: self._core.statistics, doc="Figures of the run, a dict.")
    notes = property(lambda self: self._core.notes, doc="What was found out on the way, a dict.")
    warnings = property(lambda self: self._core.warnings, doc="What is doubtful, a list.")

    def mesh(self, *, progress=None, threads=0, **settings):
        """The surface with the example's materials, a `Mesh`; remembered. Settings: `simplify`,
        `triangles`, `surface`, `source`, ... as `exemplar.settings(engine)` lists them."""
        given = _given(settings)
        key = tuple(sorted(given))
        if key not in self._meshes:
            self._meshes[key] = self._core._mesh(given, progress, threads)
        return self._meshes[key]

    def measure(self, *, progress=None, threads=0):
        """How alike, how new, how seamless: a dict of dicts (docs/measures.md)."""
        return self._core._measure(progress, threads)

    def save(self, path, *, origins=None, progress=None, threads=0, **settings):
        """Writes it in the format of the path's ending: a mesh, .vdb, labels or heights; `origins`
        is a .vdb of its own. Returns what the format could not hold, a list of lines."""
        return self._core._save(path, origins or "", _given(settings), progress, threads)

    def report(self, path, *, progress=None, threads=0):
        """Writes a page (.html) that shows example and result to turn, with marks and figures
        (docs/report.md)."""
        self._core._report(path, progress, threads)

    def detail(self, factor, example=None, *, progress=None, threads=0):
        """The same layout at a multiple of its resolution, with the finer detail of its example, or
        of another one that has the same shape: a recolored copy, say."""
        of = [] if example is None else [_example(e)._core for e in _listed(example)]
        return Result(self._core._detail(factor, of, progress, threads))

    def __repr__(self):
        return f"<exemplar.Result of {self.engine}, {self._core.extent}, seed {self.seed}>"

    def _repr_png_(self):
        if self.heights:
            return self.heights._repr_png_()
        return self.mesh()._repr_png_() if self.field or self.labels else None


def read(path, *, engine="auto", scale=None, size=None, progress=None, threads=0, **settings):
    """Reads an example: a mesh, a volume, a height map, a grid of labels, a picture, or a bundled
    scene by its name. See `Example`."""
    return Example(path, engine=engine, scale=scale, size=size, progress=progress, threads=threads,
                   **settings)


def scene(name, *, engine="auto", seed=None, extent=None, **settings):
    """A bundled scene as an example; `scenes()` lists them. seed: another sample of its random
    process. extent: a larger one, (x, y, z) in its boxes, at the same voxels."""
    return Example(_core._find_scene(name), engine=engine, scene_seed=seed, scene_extent=extent,
                   **settings)


def _listed(thing):
    return list(thing) if isinstance(thing, (list, tuple)) else [thing]


def _example(thing, engine="auto"):
    return thing if isinstance(thing, Example) else Example(thing, engine=engine)


def synthesize(example, *, engine="auto", keep=None, guide=None, on=None, detail=1, progress=None,
               threads=0, **settings):
    """Makes more of an example, or of a list of examples mixed, and returns a `Result`.

    engine: who makes it; `engines()` lists them. auto: as the example asks for.
    keep: a Mesh, a Field or a path: what is inside this solid stays as it is.
    guide: a Mesh, a Field, Heights or a path that says coarsely where solid should be.
    on: a Mesh or a path: the surface that the example, which lies flat, is laid on.
    detail: re-make the result at this many times the resolution, with the example's finer detail.
    progress: called with (stage, fraction) about twenty times a second; False stops the work.
    threads: cores to use, 0 for all; the result does not depend on it.

    >>> import numpy
    >>> bumps = numpy.sin(numpy.arange(12) * (numpy.pi / 3))  # height above every place of a row
    >>> field = numpy.arange(8) - 3.5 - bumps[:, None, None] + numpy.zeros((1, 12, 1))
    >>> more = synthesize(Example(field), scale=(2, 1, 1), seed=7)
    >>> more.field.shape
    (24, 12, 8)
    >>> more.mesh().health()["manifold"]
    True

    Throws InputError, Impossible, Unfinished, Cancelled, and KeyboardInterrupt at Ctrl-C."""
    if engine == "auto" and on is not None:
        engine = "surface"
    examples = [_example(e, engine) for e in _listed(example)]
    if engine == "auto":
        first = examples[0]._core
        engine = "geometry" if first.field else "model" if first.labels else "auto"
    name = engine if engine != "auto" else "geometry"
    keep, guide, on = (thing if thing is None else _memory(thing) for thing in (keep, guide, on))
    core = _core._synthesize([e._core for e in examples], engine, _given(
        settings, _repeating(name)), keep, guide, on, detail, progress, threads)
    _require_complete(core.outcome, core.why, core.conflict)
    return Result(core)


def _require_complete(outcome, why, conflict=None):
    if outcome == "impossible":
        raise Impossible(why, conflict)
    if outcome != "complete":
        raise Unfinished(why)


def measure(example, result=None, *, origins=None, mesh=None, progress=None, threads=0):
    """How alike, how new, how seamless: a dict of dicts (docs/measures.md). Of a `Result`, or of
    something against an example: a Field, a Mesh, a LabelGrid or a path. origins: as
    `Result.origins` has them; mesh: the surface of a Field.

    >>> import numpy
    >>> cells = numpy.indices((6, 6, 1)).sum(0) % 2 + 1
    >>> measure(Example(cells), LabelGrid(cells))["content"]["labels_used"]  # of two, both
    1.0
    """
    if result is None:
        return example.measure(progress=progress, threads=threads)
    if isinstance(result, Result):
        return result.measure(progress=progress, threads=threads)
    return _core._measure(_example(example)._core, _memory(result), origins, mesh, progress, threads)


def transfer(mesh, result, *, textures="auto", blend=1.5, source=False):
    """A copy of a mesh, which lies where a result's surface does (a decimated one, say), with the
    materials, colors and texture coordinates of the result's example, through its origins.

    textures: auto, coordinates, vertex_colors or drop. blend: voxels over which colors are mixed
    at seams. source: keep where each corner came from."""
    return _core._transfer(_memory(mesh), result._core, textures, blend, source)


class World:
    """An example of labels, pieces or heights without end: any tile alone, in any order, on any machine,
    always the same bytes, and fitting its neighbors (docs/worlds.md).

        world = exemplar.World.create("land", "castle", seed=7)
        world.tile(3, -2).mesh().write("there.glb")
    """

    def __init__(self, folder, *, cached=False):
        """Opens the world in a folder. cached: keep what tiles share in that folder, too."""
        self._core, self._warnings = _core._open_world(folder, cached), []

    @classmethod
    def create(cls, folder, example, *, engine="auto", tile=None, window=None, height=None,
               progress=None, threads=0, **settings):
        """Makes a world in a folder, or opens the same one where it is there. tile: columns along
        a tile's sides, 8 to 4096 (72; of heights 256). window: columns from one window to the
        next (36; of heights 384). height: cells; the example's. Settings are those of reading, of
        the engine, and `seed`."""
        name = "model" if engine == "auto" else engine
        core, outcome, why, warnings = _core._create_world(
            folder, _memory(example), engine, _given(settings, _repeating(name)), tile, window,
            height, progress, threads)
        _require_complete(outcome, why)
        world = cls.__new__(cls)
        world._core, world._warnings = core, warnings
        return world

    folder = property(lambda self: self._core.folder, doc="Where it is, a pathlib.Path.")
    engine = property(lambda self: self._core.engine, doc="What makes it.")
    seed = property(lambda self: self._core.seed)
    tile_size = property(lambda self: self._core.tile_size, doc="Columns along a tile's sides.")
    height = property(lambda self: self._core.height, doc="Cells.")
    warnings = property(lambda self: list(self._warnings), doc="What was doubtful when it was made.")

    def tile(self, x, y, *, progress=None, threads=0):
        """One tile, a `Result`. May be called from several threads."""
        return Result(self._core._tile(x, y, progress, threads))

    def tiles(self, x, y, *, progress=None, threads=0):
        """Several tiles as one `Result`: x and y are ranges, (first, one past the last)."""
        return Result(self._core._tiles([*x, *y], progress, threads))

    def __repr__(self):
        return f"<exemplar.World in {self.folder}, {self.engine}, seed {self.seed}>"


def render(thing, *, size=(640, 480), view="iso", samples=32, progress=None):
    """A picture of a mesh, an example or a result: height x width x 3, uint8. `view` is iso, front,
    back, left, right, top, bottom, or "AZIMUTH,ELEVATION" in degrees.

    >>> corner = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    ...               [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    >>> render(corner, size=(64, 48), samples=4).shape
    (48, 64, 3)
    """
    if isinstance(thing, Result):
        thing = thing.heights or thing.mesh()
    elif isinstance(thing, Example):
        thing = _core._pictured(thing._core)
    elif isinstance(thing, (Field, LabelGrid, Heights)):
        thing = thing.to_mesh()
    return _memory(thing)._render(int(size[0]), int(size[1]), view, samples, progress)


def read_mesh(path, *, up="auto"):
    """The triangles of a mesh file. up: which axis is up in it: y, z, or auto."""
    return _core._read_mesh(path, up)


def _png(mesh):
    """A picture as the bytes of a .png."""
    import struct
    import zlib
    picture = render(mesh, size=(480, 360), samples=24)
    height, width, channels = picture.shape
    rows = b"".join(b"\0" + row.tobytes() for row in picture)

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(
        ">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b""))


def _add_methods():
    """What is plain Python of the classes that are not."""
    from . import interop

    def write(self, path, *, up="auto", normals="crease"):
        """Writes the mesh in the format of the path's ending. up: which axis is up in it. normals:
        crease (hard edges where faces meet at more than 40 degrees), smooth or none."""
        self._write(path, up, normals)

    Mesh.write = write
    for kind in (Mesh, Field, LabelGrid, Heights):
        kind._repr_png_ = lambda self: _png(self if isinstance(self, Mesh) else self.to_mesh())
    for name in ("to_trimesh", "to_meshio", "to_pyvista", "to_open3d"):
        setattr(Mesh, name, getattr(interop, name))
    Field.to_openvdb, Field.from_openvdb = interop.to_openvdb, staticmethod(interop.from_openvdb)
    Field.to_xarray = LabelGrid.to_xarray = interop.to_xarray
    Heights.to_xarray = interop.heights_to_xarray

    def as_array(values):
        def __array__(self, dtype=None, copy=None):
            array = getattr(self, values)
            if dtype is not None and array.dtype != dtype:
                return array.astype(dtype)
            return array.copy(order="K") if copy else array
        return __array__

    Field.__array__, LabelGrid.__array__, Heights.__array__ = map(
        as_array, ("values", "labels", "heights"))


def _document():
    """Signature and docstring of `synthesize`, from the list of settings."""
    keywords, lines = {}, []
    own = set(_inspect.signature(synthesize).parameters)
    reading = {key for name in engines() for key in _core._reading_keys(name)}
    for engine in engines():
        for setting in _core._settings(engine):
            key = setting["key"].replace("-", "_")
            surface = setting["key"] in _core._surface_keys(engine)
            if key in own or key in keywords or surface or setting["key"] in reading:
                continue
            keywords[key] = _inspect.Parameter(key, _inspect.Parameter.KEYWORD_ONLY, default=None)
            default = f" (default: {setting['default']})" if setting["default"] else ""
            lines.append(f"    {key}: {setting['meaning']}{default}")
    synthesize.__doc__ += "\n\n    Settings, of which each engine has some:\n" + "\n".join(lines)
    signature = _inspect.signature(synthesize)
    parameters = [p for p in signature.parameters.values() if p.kind != p.VAR_KEYWORD]
    synthesize.__signature__ = signature.replace(parameters=parameters + list(keywords.values()))


_add_methods()
_document()
