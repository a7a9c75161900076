#!/usr/bin/python3
# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT
"""Writes the surfaces of docs/surfaces.md as .obj: surfaces.py FOLDER. Needs NumPy."""

import pathlib
import sys

import numpy as np


def write(path, vertices, triangles):
    with open(path, "w", encoding="ascii") as file:
        for x, y, z in vertices:  # .obj files have y upward
            file.write(f"v {x:.6f} {z:.6f} {-y:.6f}\n")
        for a, b, c in triangles:
            file.write(f"f {a + 1} {b + 1} {c + 1}\n")


def write_painted(path, vertices, triangles, reds, alphas):
    """A .ply, which has z upward, with two channels of 0..1."""
    red, alpha = (np.clip(np.round(255 * np.asarray(c)), 0, 255).astype(int) for c in (reds, alphas))
    properties = [f"property float {axis}" for axis in "xyz"]
    properties += [f"property uchar {channel}" for channel in ("red", "green", "blue", "alpha")]
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\n" + "\n".join(properties))
        file.write(f"\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
        for n, (x, y, z) in enumerate(vertices):
            file.write(f"{x:.6f} {y:.6f} {z:.6f} {red[n]} 180 180 {alpha[n]}\n")
        for a, b, c in triangles:
            file.write(f"3 {a} {b} {c}\n")


def write_sized(path, vertices, triangles, sizes):
    """Its alpha is 0 where an example has half its size, 1 for twice."""
    write_painted(path, vertices, triangles, np.full(len(vertices), 180 / 255), (np.log2(sizes) + 1) / 2)


def grid(columns, rows, place, around):
    """Cells of a grid, bent by `place`; `around` joins the last ones to the first, both ways."""
    n, m = (columns, rows) if around else (columns + 1, rows + 1)
    vertices = [place(i, j) for i in range(n) for j in range(m)]
    triangles = []
    for i in range(columns):
        for j in range(rows):
            a, b = i * m + j, (i + 1) % n * m + j
            c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
            triangles += [(a, b, c), (a, c, d)]
    return vertices, triangles


def contour(distance, low, high, count):
    """The zero set of a function of x, y and z, by marching tetrahedra."""
    axes = [np.linspace(low[k], high[k], count[k]) for k in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), -1)
    values = distance(points[..., 0], points[..., 1], points[..., 2])
    inside = values < 0
    nx, ny, nz = count
    corners = [(i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    sums = sum(inside[i:nx - 1 + i, j:ny - 1 + j, k:nz - 1 + k].astype(int) for i, j, k in corners)
    points, values = points.reshape(-1, 3), values.reshape(-1)
    vertices, triangles, known = [], [], {}

    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in known:
            a, b = key
            known[key] = len(vertices)
            share = values[a] / (values[a] - values[b])
            vertices.append(points[a] + share * (points[b] - points[a]))
        return known[key]

    tetrahedra = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
    for cell in np.argwhere((sums > 0) & (sums < 8)):
        ids = [((cell[0] + i) * ny + cell[1] + j) * nz + cell[2] + k for i, j, k in corners]
        for tetrahedron in tetrahedra:
            these = [ids[k] for k in tetrahedron]
            within = [p for p in these if values[p] < 0]
            without = [p for p in these if values[p] >= 0]
            if len(within) in (1, 3) and without:
                lone, others = (within, without) if len(within) == 1 else (without, within)
                faces = [[between(lone[0], p) for p in others]]
            elif len(within) == 2:
                (a, b), (c, d) = within, without
                q = [between(a, c), between(a, d), between(b, d), between(b, c)]
                faces = [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
            else:
                continue
            outward = points[without].mean(0) - points[within].mean(0)
            for a, b, c in faces:
                normal = np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a])
                if len({a, b, c}) == 3:
                    triangles.append((a, b, c) if normal @ outward > 0 else (a, c, b))
    return vertices, triangles


def fused(a, b, width):
    share = np.clip(0.5 + 0.5 * (b - a) / width, 0, 1)
    return b * (1 - share) + a * share - width * share * (1 - share)


def egg(x, y, z, center, radii):
    squares = [((p - c) / r) ** 2 for p, c, r in zip((x, y, z), center, radii)]
    return (np.sqrt(sum(squares)) - 1) * min(radii)


def rod(x, y, z, start, end, radius):
    offset = [p - s for p, s in zip((x, y, z), start)]
    step = np.subtract(end, start)
    share = np.clip(sum(o * s for o, s in zip(offset, step)) / (step @ step), 0, 1)
    return np.sqrt(sum((o - share * s) ** 2 for o, s in zip(offset, step))) - radius


def rabbit(x, y, z):
    d = egg(x, y, z, (0, 0, 0.5), (0.62, 0.46, 0.5))
    d = fused(d, egg(x, y, z, (0.55, 0, 1.05), (0.34, 0.28, 0.3)), 0.18)
    for side in (-1, 1):
        d = fused(d, rod(x, y, z, (0.45, 0.13 * side, 1.25), (0.28, 0.2 * side, 1.75), 0.1), 0.1)
        d = fused(d, egg(x, y, z, (-0.2, 0.33 * side, 0.3), (0.33, 0.2, 0.28)), 0.12)
        d = fused(d, rod(x, y, z, (0.5, 0.22 * side, 0.3), (0.66, 0.22 * side, 0.1), 0.12), 0.12)
    return fused(d, egg(x, y, z, (-0.66, 0, 0.5), (0.17, 0.17, 0.17)), 0.08)


def bend(t):
    """A body that winds from the tip of its tail (0) to its snout (1): middles and radii."""
    x, y = 3.4 * t - 1.7, 0.42 * np.sin(5.2 * t + 0.4) * (1 - 0.35 * t)
    z = 0.34 + 0.75 * np.clip(t - 0.72, 0, 1) ** 1.2 * 2.2 - 0.2 * (1 - t) ** 3
    radius = np.interp(t, [0, 0.25, 0.5, 0.68, 0.82, 0.92, 0.97, 1],
                       [0.045, 0.13, 0.27, 0.25, 0.15, 0.17, 0.15, 0.08])
    return np.stack([x, y, z], -1), radius


def lizard(x, y, z):
    middles, radii = bend(np.linspace(0, 1, 220))
    d = np.full(x.shape, 9.0)
    for (a, b, c), radius in zip(middles, radii):
        d = np.minimum(d, np.sqrt((x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2) - radius)
    for t, forward in ((0.45, -0.12), (0.68, 0.12)):
        (a, b, c), radius = bend(np.float64(t))
        for side in (-1, 1):
            knee = (a + forward, b + side * 0.52, c + 0.02)
            d = fused(d, rod(x, y, z, (a, b + side * 0.1, c - 0.05), knee, 0.1), 0.12)
            d = fused(d, rod(x, y, z, knee, (a + 2 * forward, b + side * 0.6, 0.02), 0.085), 0.06)
    return d


def scale_sizes(vertices):
    """Small on tail, snout and legs, large on the back."""
    points = np.array(vertices)
    middles, radii = bend(np.linspace(0, 1, 220))
    near = np.argmin(np.linalg.norm(points[:, None] - middles, axis=2), axis=1)
    legs = np.clip((np.linalg.norm(points - middles[near], axis=1) - radii[near]) / 0.15, 0, 1)
    return np.clip(radii[near] / 0.22, 0.5, 1.25) * (1 - legs) + 0.55 * legs


def lines_along_the_back():
    """From tail to head, on the back and both flanks."""
    middles, radii = bend(np.linspace(0.02, 0.97, 60))
    ways = np.gradient(middles, axis=0)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    across = np.cross(ways, (0, 0, 1))
    across /= np.linalg.norm(across, axis=1)[:, None]
    above = np.cross(across, ways)
    return [middles + radii[:, None] * (np.cos(a) * above + np.sin(a) * across) for a in (-1.2, 0, 1.2)]


def write_lines(path, lines):
    with open(path, "w", encoding="ascii") as file:
        first = 1
        for line in lines:
            for x, y, z in line:
                file.write(f"v {x:.6f} {z:.6f} {-y:.6f}\n")
            file.write("l " + " ".join(str(first + n) for n in range(len(line))) + "\n")
            first += len(line)


def trunk(x, y, z):
    lean = 0.12 * np.sin(1.6 * z)
    d = rod(x - lean, y, z, (0, 0, -0.4), (0, 0, 1.3), 0.34) - 0.25 * np.clip(0.3 - z, 0, 0.7)
    for start, end, radius in (((0.1, 0, 1.0), (0.85, 0.25, 2.1), 0.22),
                               ((0, 0, 1.1), (-0.55, -0.2, 2.3), 0.24),
                               ((-0.2, -0.05, 1.55), (-1.0, 0.35, 1.9), 0.14)):
        d = fused(d, rod(x, y, z, start, end, radius), 0.16)
    return np.maximum(d, -0.3 - z)


def torus(i, j):
    a, b = 2 * np.pi * i / 96, 2 * np.pi * j / 48
    return ((1 + 0.4 * np.cos(b)) * np.cos(a), (1 + 0.4 * np.cos(b)) * np.sin(a), 0.4 * np.sin(b))


def patches(vertices):
    """Red in three places on the outside of a torus."""
    x, y, z = np.array(vertices).T
    outward = (np.hypot(x, y) - 1) / 0.4
    return np.where(np.sin(3 * np.arctan2(y, x)) + outward > 0.2, 1.0, 0.0)


def hill(i, j):
    x, y = 2 * i / 39 - 1, 2 * j / 39 - 1
    return (x, y, 0.6 * np.exp(-3 * (x * x + y * y)) + 0.08 * np.sin(3 * x))


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    folder.mkdir(parents=True, exist_ok=True)
    write(folder / "torus.obj", *grid(96, 48, torus, True))
    ring = grid(96, 48, torus, True)
    write_painted(folder / "ring.ply", *ring, patches(ring[0]), np.ones(len(ring[0])))
    write(folder / "hill.obj", *grid(39, 39, hill, False))
    write(folder / "rabbit.obj", *contour(rabbit, (-1, -0.8, -0.2), (1.2, 0.8, 2), (56, 41, 56)))
    body = contour(lizard, (-2, -1.1, -0.2), (2.2, 1.1, 1.5), (106, 56, 44))
    write_sized(folder / "lizard.ply", *body, scale_sizes(body[0]))
    write_lines(folder / "lizard_lines.obj", lines_along_the_back())
    write(folder / "trunk.obj", *contour(trunk, (-1.5, -1, -1.1), (1.5, 1, 2.8), (61, 41, 79)))
