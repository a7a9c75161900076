#!/usr/bin/env python3
"""Makes the height maps by formula that docs/terrain.md measures beside surveyed ones.

    scripts/terrain_examples.py FOLDER    eroded.asc, noise.asc, dunes.asc, coast.asc and lakes.asc

Needs numpy.
"""
import heapq
import os
import sys

import numpy as np


def fractal(shape, beta, seed):
    """Noise whose power falls as frequency ** -beta; mean 0, deviation 1; periodic."""
    power = np.fft.rfft2(np.random.default_rng(seed).standard_normal(shape))
    frequency = np.hypot(np.fft.fftfreq(shape[0])[:, None], np.fft.rfftfreq(shape[1])[None, :])
    frequency[0, 0] = 1
    power *= frequency ** (-beta / 2)
    power[0, 0] = 0
    noise = np.fft.irfft2(power, s=shape)
    return noise / noise.std()


def flood(heights):
    """Spill levels, the cells from the border up, and from which cell water reached each (priority
    flood); of a cell on the border, from itself."""
    rows, columns = heights.shape
    own = heights.ravel().tolist()
    levels, came_from, order = [None] * len(own), list(range(len(own))), []
    edge = [(own[y * columns + x], y * columns + x) for y in range(rows) for x in range(columns)
            if y in (0, rows - 1) or x in (0, columns - 1)]
    for level, cell in edge:
        levels[cell] = level
    heapq.heapify(edge)
    while edge:
        level, cell = heapq.heappop(edge)
        order.append(cell)
        y, x = divmod(cell, columns)
        for v in range(max(0, y - 1), min(rows, y + 2)):
            for u in range(max(0, x - 1), min(columns, x + 2)):
                near = v * columns + u
                if levels[near] is None:
                    levels[near] = max(level, own[near])
                    came_from[near] = cell
                    heapq.heappush(edge, (levels[near], near))
    return np.array(levels).reshape(heights.shape), order, came_from


def eroded(side=256):
    """Land that rivers have shaped: along them slopes fall with the area that drains through (the
    steady state of the stream power law); no hollows."""
    heights = fractal((side, side), 3, 2)
    rough = np.clip(fractal((side, side), 3, 7), -2, 2).ravel().tolist()
    for _ in range(4):
        _, order, down = flood(heights)
        area = [1.0] * heights.size
        for cell in reversed(order):
            if down[cell] != cell:
                area[down[cell]] += area[cell]
        new = (20 * fractal((side, side), 3, 3)).ravel().tolist()
        for cell in order:
            if down[cell] != cell:
                apart = abs(cell - down[cell])
                length = 1 if apart in (1, side) else 2**0.5
                new[cell] = new[down[cell]] + 10 * (3 + rough[cell]) * area[cell] ** -0.45 * length
        heights = np.array(new).reshape(heights.shape)
    return heights


def noise(side=256):
    """A fractal: hollows of every size, alike everywhere."""
    return fractal((side, side), 3.2, 12) * 100 + 300


def dunes(side=256):
    """Ridges across a wind, with a steep side away from it, between closed troughs."""
    y, x = np.mgrid[:side, :side].astype(float)
    phase = (x + 0.25 * y + fractal((side, side), 4, 3) * 10) / 22 % 1
    crest = np.where(phase < 0.75, phase / 0.75, (1 - phase) / 0.25)
    height = 8 * crest * (1 + 0.3 * fractal((side, side), 4, 9))
    return height + fractal((side, side), 2.5, 4) * 0.4 + 50


def coast(side=300):
    """Land that falls toward the west, under a sea at 0."""
    return np.maximum(fractal((side, side), 3.4, 11) * 80 + (np.arange(side) - 120) * 2.4, 0)


def lakes(side=320):
    """Hills whose hollows are lakes up to where they spill over."""
    return flood(fractal((side, side), 3.2, 12) * 100 + 300)[0]


CELLS = {"eroded": 30, "noise": 20, "dunes": 5, "coast": 20, "lakes": 20}  # meters


def make(name, folder):
    """Writes one of them, where it is not there; its path."""
    path = os.path.join(folder, name + ".asc")
    if not os.path.exists(path):
        heights = globals()[name]()
        head = (f"ncols {heights.shape[1]}\nnrows {heights.shape[0]}\nxllcorner 0\nyllcorner 0\n"
                f"cellsize {CELLS[name]}\nNODATA_value -9999")
        np.savetxt(path, heights, fmt="%.4f", header=head, comments="")
    return path


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    os.makedirs(sys.argv[1], exist_ok=True)
    for name in CELLS:
        print(make(name, sys.argv[1]))
