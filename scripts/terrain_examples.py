#!/usr/bin/env python3
"""Makes the height maps by formula that docs/terrain.md measures beside surveyed ones.

    scripts/terrain_examples.py FOLDER    eroded.asc, noise.asc, dunes.asc, coast.asc and lakes.asc

Needs numpy; eroded land takes a minute.
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


def steepest_descent(heights):
    """For each cell the lower neighbor down the steepest way, itself in pits, and the distance."""
    rows, columns = heights.shape
    numbers = np.arange(heights.size).reshape(heights.shape)
    steepest = np.zeros(heights.shape)
    receiver, distance = numbers.copy(), np.ones(heights.shape)
    for dy, dx in ((y, x) for y in (-1, 0, 1) for x in (-1, 0, 1) if x or y):
        here = (slice(max(0, -dy), rows - max(0, dy)), slice(max(0, -dx), columns - max(0, dx)))
        there = (slice(max(0, dy), rows - max(0, -dy)), slice(max(0, dx), columns - max(0, -dx)))
        slope = np.full(heights.shape, -1.0)
        slope[here] = (heights[here] - heights[there]) / np.hypot(dx, dy)
        neighbor = numbers.copy()
        neighbor[here] = numbers[there]
        steeper = slope > steepest
        steepest[steeper] = slope[steeper]
        receiver[steeper] = neighbor[steeper]
        distance[steeper] = np.hypot(dx, dy)
    return receiver.ravel(), distance.ravel()


def eroded(side=200, steps=120, erosion=0.05, uplift=6.0, creep=0.05):
    """Uplift against rivers (stream power law, exponents 1/2 and 1, implicit) and creep of slopes."""
    random = np.random.default_rng(5)
    heights = fractal((side, side), 2, 2) * 5 + 10
    border = np.ones(heights.shape, bool)
    border[1:-1, 1:-1] = False
    for _ in range(steps):
        rough = heights + random.random(heights.shape) * 1e-3
        receiver, distance = steepest_descent(rough)
        down = np.argsort(-rough.ravel()).tolist()
        to = receiver.tolist()
        area = [1.0] * heights.size
        for cell in down:
            if to[cell] != cell:
                area[to[cell]] += area[cell]
        factor = (erosion * np.sqrt(area) / distance).tolist()
        new = np.where(border, heights, heights + uplift).ravel().tolist()
        fixed = border.ravel().tolist()
        for cell in reversed(down):
            if not fixed[cell] and to[cell] != cell:
                new[cell] = (new[cell] + factor[cell] * new[to[cell]]) / (1 + factor[cell])
        heights = np.array(new).reshape(heights.shape)
        p = np.pad(heights, 1, mode="edge")
        heights += creep * (p[:-2, 1:-1] + p[2:, 1:-1] + p[1:-1, :-2] + p[1:-1, 2:] - 4 * heights)
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
    return np.maximum(fractal((side, side), 3.4, 11) * 120 + (np.arange(side) - 150) * 1.2, 0)


def filled(heights):
    """Each hollow up to where it spills over (priority flood)."""
    rows, columns = heights.shape
    levels = np.full(heights.shape, np.inf)
    border = [(heights[y, x], y, x) for y in range(rows) for x in range(columns)
              if y in (0, rows - 1) or x in (0, columns - 1)]
    for level, y, x in border:
        levels[y, x] = level
    heapq.heapify(border)
    while border:
        level, y, x = heapq.heappop(border)
        for v in range(max(0, y - 1), min(rows, y + 2)):
            for u in range(max(0, x - 1), min(columns, x + 2)):
                if levels[v, u] == np.inf:
                    levels[v, u] = max(level, heights[v, u])
                    heapq.heappush(border, (levels[v, u], v, u))
    return levels


def lakes(side=320):
    """Hills whose hollows are lakes up to where they spill over."""
    return filled(fractal((side, side), 3.2, 12) * 100 + 300)


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
