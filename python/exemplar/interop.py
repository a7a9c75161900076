# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT
"""Meshes and fields as other packages have them. Each is imported when it is called for."""

import numpy as _np


def to_trimesh(mesh):
    """A trimesh.Trimesh."""
    import trimesh
    colors = mesh.colors
    return trimesh.Trimesh(_np.array(mesh.vertices), _np.array(mesh.faces), process=False,
                           vertex_colors=None if colors is None else _np.array(colors))


def to_meshio(mesh):
    """A meshio.Mesh of triangles; materials as cell data."""
    import meshio
    data = {} if mesh.face_materials is None else {"material": [_np.array(mesh.face_materials)]}
    return meshio.Mesh(_np.array(mesh.vertices), [("triangle", _np.array(mesh.faces))],
                       cell_data=data)


def to_pyvista(mesh):
    """A pyvista.PolyData."""
    import pyvista
    faces = _np.empty((len(mesh.faces), 4), _np.int64)
    faces[:, 0], faces[:, 1:] = 3, mesh.faces
    return pyvista.PolyData(_np.array(mesh.vertices), faces.ravel())


def to_open3d(mesh):
    """An open3d.geometry.TriangleMesh."""
    import open3d
    made = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(_np.array(mesh.vertices)),
        open3d.utility.Vector3iVector(_np.array(mesh.faces, _np.int32)))
    if mesh.colors is not None:
        made.vertex_colors = open3d.utility.Vector3dVector(_np.array(mesh.colors[:, :3], float))
    return made


def to_openvdb(field):
    """A FloatGrid of pyopenvdb: a level set with the field's transform.

    pyopenvdb reads the memory of an array in C's order whatever its strides say, so a view of a
    field would come in shuffled; this hands it a copy in that order."""
    vdb = _openvdb()
    grid = vdb.FloatGrid(field.truncation if _np.isfinite(field.truncation) else 1e30)
    grid.name, grid.gridClass = "surface", vdb.GridClass.LEVEL_SET
    grid.copyFromArray(_np.ascontiguousarray(field.values))
    grid.transform = vdb.createLinearTransform(
        [[field.voxel_size, 0, 0, 0], [0, field.voxel_size, 0, 0], [0, 0, field.voxel_size, 0],
         [*field.origin, 1]])
    return grid


def from_openvdb(grid):
    """A Field of a FloatGrid of pyopenvdb: its active box, its background as the truncation."""
    from ._core import Field, InputError
    low, high = grid.evalActiveVoxelBoundingBox()
    values = _np.empty([h - l + 1 for l, h in zip(low, high)], _np.float32)
    grid.copyToArray(values, ijk=low)
    voxel = grid.transform.voxelSize()
    if max(voxel) - min(voxel) > 1e-6 * max(voxel):
        raise InputError(f"from_openvdb: the voxels are {tuple(voxel)}: they have to be cubes")
    return Field(values, voxel_size=voxel[0], origin=list(grid.transform.indexToWorld(low)),
                 truncation=grid.background if grid.background > 0 else float("inf"))


def to_xarray(grid):
    """An xarray.DataArray of a Field or a LabelGrid, with the coordinates of centers."""
    import xarray
    distances = hasattr(grid, "voxel_size")
    steps = [grid.voxel_size] * 3 if distances else grid.cell_size
    # A field's origin is its first sample, a grid's the corner of its first cell.
    first = [o + (0 if distances else h / 2) for o, h in zip(grid.origin, steps)]
    axes = [o + h * _np.arange(n) for o, h, n in zip(first, steps, grid.shape)]
    return xarray.DataArray(grid.values if distances else grid.labels, dims=("x", "y", "z"),
                            name="distance" if distances else "label",
                            coords=dict(zip("xyz", axes)))


def heights_to_xarray(heights):
    """An xarray.DataArray, rows from the north."""
    import xarray
    rows, columns = heights.heights.shape
    return xarray.DataArray(
        heights.heights, dims=("y", "x"), name="height",
        coords={"y": heights.cell_size * (rows - 1 - _np.arange(rows)),
                "x": heights.cell_size * _np.arange(columns)})


def _openvdb():
    try:
        import pyopenvdb
        return pyopenvdb
    except ImportError:
        import openvdb
        return openvdb
