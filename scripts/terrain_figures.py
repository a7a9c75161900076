#!/usr/bin/env python3
"""Measures terrain synthesis against its targets, as the tables of docs/terrain.md show it.

    scripts/terrain_figures.py EXEMPLAR FOLDER [--scales 2,4] [--seeds 1,2,3] [MAP[:OPTIONS] ...]

Makes, by that command, results of each map at each scale and seed in FOLDER (they stay there, with a
picture in two lights each) and prints a row of figures for each; a figure that misses its target has
a ! after it. A MAP is a height map and options of `synth` as in "land.pgm:--cell-size 30", or one of
those of terrain_examples.py by its name: eroded, noise, dunes, coast, lakes.
"""
import argparse
import json
import os
import shlex
import subprocess
import sys

import terrain_examples


def text(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


class Row:
    """A run's figures, each beside what is asked of it."""

    def __init__(self, stats):
        self.stats, self.terrain = stats, stats["terrain"]
        self.cells, self.missed = [], []

    def add(self, name, shown, good):
        self.cells.append(shown + ("" if good else "!"))
        if not good:
            self.missed.append(name)

    def within_floor(self, name):
        distance, floor = self.terrain[name + "_distance"], self.terrain[name + "_distance_floor"]
        self.add(name, f"{text(distance, 3)} ({text(floor, 3)})", distance <= floor)

    def beside(self, name, good, digits=2, times=1):
        result, example = self.terrain[name], self.terrain[name + "_example"]
        shown = f"{text(result and result * times, digits)} / {text(example and example * times, digits)}"
        self.add(name, shown, result is None or example is None or good(result, example))


HEADS = ("map", "x", "seed", "slopes (floor)", "curvature", "flooded %", "hollows a million",
         "valley line", "bifurcation", "step", "seam step", "verbatim", "peaks twice",
         "copied shapes (floor)", "copied layout (floor)", "before outlets %", "mean cut", "flat %")


def figures(stats):
    row = Row(stats)
    terrain = row.terrain
    row.within_floor("slopes")
    row.within_floor("curvature")
    row.beside("flooded_share", lambda r, e: r <= 2 * e, times=100)
    row.beside("depressions_per_million_cells", lambda r, e: r <= 1.3 * e, digits=0)
    row.beside("valley_length", lambda r, e: r >= 0.8 * e, digits=0)
    row.beside("bifurcation_ratio", lambda r, e: abs(r / e - 1) <= 0.15)
    row.add("step", text(terrain["step_ratio"]), terrain["step_ratio"] <= 1.3)
    row.add("seam", text(terrain["seam_step_ratio"]), terrain["seam_step_ratio"] <= 1)
    row.add("verbatim", text(terrain["verbatim_share"]), (terrain["verbatim_share"] or 0) <= 0.02)
    row.beside("repeated_peaks", lambda r, e: r <= e + 0.05)
    for copies in ("copied_shapes", "copied_layout"):
        share, floor = terrain[copies], terrain[copies + "_floor"]
        row.add(copies, f"{text(share)} ({text(floor)})",
                share is None or share <= (floor or 0) + 0.05)
    row.add("", text(100 * stats["flooded_before_outlets"], 1), True)
    row.add("", text(stats["mean_cut"]), True)
    row.beside("flat_share", lambda r, e: r <= 1.3 * e + 0.005, times=100, digits=1)
    return row


def run(exemplar, folder, name, path, options, scale, seed):
    base = os.path.join(folder, f"{name}_x{scale}_s{seed}")
    made = [exemplar, "synth", path, *options, "--scale", f"{scale},{scale},1", "--seed", str(seed),
            "-o", base + ".tif", "--stats", base + ".json", "--progress", "none"]
    subprocess.run(made, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    shown = [exemplar, "render", base + ".tif", "--light", "315,45", "--streams", "200",
             "-o", base + ".png", "--progress", "none"]
    subprocess.run(shown, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(base + ".json", encoding="utf-8") as file:
        return json.load(file)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("exemplar")
    parser.add_argument("folder")
    parser.add_argument("--scales", default="2,4")
    parser.add_argument("--seeds", default="1,2,3")
    parser.add_argument("maps", nargs="+")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    missed = 0
    print("| " + " | ".join(HEADS) + " |\n|" + "---|" * len(HEADS))
    for given in arguments.maps:
        path, _, options = given.partition(":")
        if path in terrain_examples.CELLS:
            path = terrain_examples.make(path, arguments.folder)
        name = os.path.splitext(os.path.basename(path))[0]
        for scale in arguments.scales.split(","):
            for seed in arguments.seeds.split(","):
                row = figures(run(arguments.exemplar, arguments.folder, name, path,
                                  shlex.split(options), scale, seed))
                print(f"| {name} | {scale} | {seed} | " + " | ".join(row.cells) + " |", flush=True)
                if row.missed:
                    missed += 1
                    print(f"{name} x{scale} seed {seed} misses: {', '.join(row.missed)}",
                          file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
