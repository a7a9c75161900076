# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""Grids of placed objects as the command's grids of labels (docs/labels.md), and grids of heights
as .asc. Knows nothing of Blender."""

import numpy as np


class GridError(ValueError):
    """What is not on a grid; `names` are the objects that show it."""

    def __init__(self, text, names=()):
        super().__init__(text)
        self.names = list(names)


def measured_cell(points):
    """The sides of the cells on which the points lie: along each axis the least distance of two of
    them that differ, and where none do, that of the other axes."""
    extent = float(np.ptp(points, axis=0).max()) if len(points) else 0.0
    sides = []
    for axis in range(3):
        steps = np.diff(np.unique(points[:, axis]))
        steps = steps[steps > max(1e-6, 1e-3 * extent)]
        sides.append(float(steps.min()) if len(steps) else 0.0)
    known = [side for side in sides if side > 0]
    if not known:
        raise GridError("all objects of the sample are at one place: give the cell's size")
    return np.array([side or min(known) for side in sides])


def cells_of(points, cell, origin, names, tolerance=0.1):
    """The cell of each point. Throws GridError naming a point that lies between cells."""
    places = (points - origin) / cell
    cells = np.rint(places).astype(int)
    off = np.abs(places - cells).max(axis=1) if len(points) else np.zeros(0)
    if len(off) and off.max() > tolerance:
        worst = int(off.argmax())
        raise GridError(f"'{names[worst]}' is {off[worst]:.2f} cells away from the grid; set the "
                        "cell's size, or move it", [names[worst]])
    return cells


def label_grid(cells, labels, names):
    """The cells as an array of labels, x y z, 0 where nothing is. Throws GridError naming two
    objects in one cell."""
    grid = np.zeros(cells.max(axis=0) + 1, int)
    owner = {}
    for cell, label, name in zip(map(tuple, cells), labels, names):
        if cell in owner:
            raise GridError(f"'{owner[cell]}' and '{name}' are in one cell", [owner[cell], name])
        owner[cell] = name
        grid[cell] = label
    return grid


def write_labels(path, grid, names, title="Blender"):
    """Writes a grid of labels; `names` are those of the labels from 1 on."""
    x, y, z = grid.shape
    lines = [title, "", "", f"{x} {y} {z}", ""]
    for layer in range(z):
        lines += [" ".join(map(str, grid[i, :, layer])) for i in range(x)] + [""]
    lines += ["<Objects>", title]
    for name in names:
        lines += [" ".join(str(name).split()) or "?", "#"]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def read_labels(path):
    """The grid of a file that the command wrote."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = file.read().split("\n")
    x, y, z = map(int, lines[3].split())
    numbers = " ".join(lines[4:]).split("<Objects>")[0].split()
    return np.array(numbers[:x * y * z], int).reshape(z, x, y).transpose(1, 2, 0)


def height_grid(points, tolerance=0.01):
    """Heights of points that are a grid seen from above, as an array with rows from the north, its
    side, and the south-western point. Throws GridError where they are not."""
    def steps(values, what):
        extent = float(np.ptp(values))
        levels = np.sort(values)
        starts = np.concatenate([[True], np.diff(levels) > 1e-4 * max(extent, 1e-9)])
        centers = levels[starts]
        if len(centers) < 2:
            raise GridError(f"the landscape has one {what} only")
        side = (centers[-1] - centers[0]) / (len(centers) - 1)
        if np.abs(np.diff(centers) - side).max() > tolerance * side:
            raise GridError(f"the landscape's {what}s are not at equal distances: it has to be a "
                            "grid seen from above")
        return centers, side

    columns, side_x = steps(points[:, 0], "column")
    rows, side_y = steps(points[:, 1], "row")
    if abs(side_x - side_y) > tolerance * side_x:
        raise GridError(f"the landscape's cells are {side_x:.4g} x {side_y:.4g}: they have to be square")
    i = np.rint((points[:, 0] - columns[0]) / side_x).astype(int)
    j = np.rint((points[:, 1] - rows[0]) / side_x).astype(int)
    heights = np.full((len(rows), len(columns)), np.nan)
    heights[len(rows) - 1 - j, i] = points[:, 2]
    if len(points) != heights.size or np.isnan(heights).any():
        raise GridError(f"the landscape has {len(points)} points, a grid of its size "
                        f"{heights.size}: overhangs and holes are no heights")
    return heights, float(side_x), np.array([columns[0], rows[0]])


def write_asc(path, heights, side, corner=(0, 0)):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ncols {heights.shape[1]}\nnrows {heights.shape[0]}\nxllcorner {corner[0]:.9g}\n"
                   f"yllcorner {corner[1]:.9g}\ncellsize {side:.9g}\n")
        np.savetxt(file, heights, fmt="%.7g")


def read_asc(path):
    """Heights, rows from the north, and the side of a cell."""
    head = {}
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")
    at = 0
    while lines[at].split() and lines[at].split()[0][0].isalpha():
        key, value = lines[at].split()[:2]
        head[key.lower()] = float(value)
        at += 1
    numbers = np.array(" ".join(lines[at:]).split(), float)
    return numbers.reshape(int(head["nrows"]), int(head["ncols"])), head["cellsize"]
