#!/usr/bin/env python3
"""Measures layered shape synthesis, as the tables of docs/layered.md show it.

    scripts/layered_figures.py EXEMPLAR FOLDER [PICTURE:LAYERS:WIDTHxHEIGHT ...]

Makes, by that command, a result of each fixture (discs, contours of fractal noise, rust) and of each
picture given, and prints a row of figures for it; what is made stays in FOLDER. Needs numpy.
"""
import json
import os
import subprocess
import sys
import time

import numpy as np

import layered_examples as examples

FIXTURES = ("discs:3:400x300", "contours:4:400x300", "rust:3:400x300")
SMALL_SHAPES = {"discs": ("--neighborhood", "5")}  # below the usual neighborhood's size


def discs(n=256):
    """Discs of one radius on a jittered lattice, each with a core, in plain colors and grain."""
    rng = np.random.default_rng(31)
    y, x = np.mgrid[:n, :n]
    image = examples.shaded([0.30, 0.34, 0.38], examples.fractal((n, n), 0.4, 32), 0.05)
    grain = examples.fractal((n, n), 0.4, 33)
    for cy in range(18, n, 36):
        for cx in range(18, n, 36):
            far = np.hypot(y - cy - rng.uniform(-3, 3), x - cx - rng.uniform(-3, 3))
            for radius, color in ((12, [0.75, 0.68, 0.52]), (6, [0.55, 0.20, 0.16])):
                image[far <= radius] = examples.shaded(color, grain, 0.05)[far <= radius]
    return image


def contours(n=256):
    """Plain steps of fractal noise."""
    image = examples.shaded([0.15, 0.2, 0.3], examples.fractal((n, n), 0.4, 42), 0.04)
    noise = examples.fractal((n, n), 2.0, 41)
    for step, share in enumerate((0.75, 0.5, 0.25), 1):
        color = np.array([0.15, 0.2, 0.3]) + step * np.array([0.22, 0.2, 0.15])
        where = examples.cut(noise, share)
        image[where] = examples.shaded(color, examples.fractal((n, n), 0.4, 42 + step), 0.04)[where]
    return image


def layer_figures(layers, key):
    values = []
    for layer in range(2, 9):
        value = layers.get(f"layer{layer}_{key}")
        if value is not None:
            values.append(f"{value:.3f}".lstrip("0"))
    return ", ".join(values)


def row(exemplar, folder, picture, layers, size):
    name = os.path.splitext(os.path.basename(picture))[0]
    result = os.path.join(folder, f"more_{name}_{size}")
    began = time.monotonic()
    process = subprocess.Popen(
        [exemplar, "synth", picture, "--engine", "layered", "--layers", layers, "--size",
         size.replace("x", ",") + ",1", "-o", result + ".png", "--write-layers", result + "_l.png",
         "--stats", result + ".json", "--quiet", *SMALL_SHAPES.get(name, ())])
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{picture}: status {status}")
    wall = time.monotonic() - began
    stats = json.load(open(result + ".json"))
    figures = stats["layers"]
    area = max(abs(value) for key, value in figures.items() if key.endswith("area_error"))
    print(f"| {name} | {size} | {area:.0e} | {layer_figures(figures, 'boundary_ratio')} | "
          f"{layer_figures(figures, 'to_example')} | {layer_figures(figures, 'to_result')} | "
          f"{layer_figures(figures, 'component_sizes')} | {figures['skipping']:.3f} "
          f"({figures['skipping_example']:.3f}) | {figures.get('repeated', 0):.2f} "
          f"({figures.get('repeated_example', 0):.2f}) | {usage.ru_utime + usage.ru_stime:.0f} | "
          f"{wall:.0f} | {usage.ru_maxrss / 1024:.0f} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    exemplar, folder = sys.argv[1:3]
    os.makedirs(folder, exist_ok=True)
    for make in (discs, contours, examples.rust):
        examples.write_png(f"{folder}/{make.__name__}.png", make())
    print("| example | result | area error | boundary ratio | `to_example` | `to_result` | "
          "sizes (KS) | skipping (example) | repeated (example) | CPU s | wall s | MB |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for fixture in FIXTURES:
        name, layers, size = fixture.split(":")
        row(exemplar, folder, f"{folder}/{name}.png", layers, size)
    for picture in sys.argv[3:]:
        row(exemplar, folder, *picture.rsplit(":", 2))
