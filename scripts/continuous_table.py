#!/usr/bin/python3
# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT
"""The fourteen results of Table 4.1 of Merrell's thesis, made again: continuous_table.py FOLDER.

Makes each of them with several seeds on one core and prints the table of docs/continuous.md. FOLDER
takes results, inputs that are written here, and with --pictures a picture of example and result.
"""

import argparse
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import zlib

# Name, what of Table 4.1 it stands for (polygons in and out, minutes), example, and arguments.
RESULTS = [
    ("skyscrapers", (27, 9542, 1.8), "skyscrapers", ["--scale", "25,25,1.2"]),
    ("terrain", (22, 922, 0.5), "ridges", ["--scale", "9,9,1.2"]),
    ("fractals", (8, 5743, 0.2), "tetrahedra", ["--scale", "21,21,10"]),
    ("arches", (20, 1002, 0.5), "arches", ["--scale", "8,8,2"]),
    ("houses", (39, 1908, 1.3), "houses", ["--scale", "9,9,1.5"]),
    ("pentagons", (33, 2004, 1.1), "pentagons", ["--scale", "9,8,1.4"]),
    ("oil platforms", (60, 1377, 0.5), "platforms", ["--scale", "5,5,1.5", "--groups", "24"]),
    ("domes", (21, 324, 0.1), "domes", ["--scale", "6,6,2"]),
    ("buildings", (116, 2230, 1.4), "buildings", ["--scale", "7,7,1.2", "--groups", "200"]),
    ("spaceships", (168, 4164, 0.6), "fleet", ["--scale", "2,2,2", "--groups", "12"]),
    ("roads", (126, 6888, 0.2), "roads", ["--scale", "6,8,1"]),
    ("plumbing", (282, 7422, 0.8), "pipes", ["--scale", "3,3,3"]),
    ("roller coaster", (124, 1376, 1.8), "tracks", ["--scale", "3,4,1"]),
    ("letters", (365, 7527, 3.5), None, []),
]
# The last result: ships in the shape of a letter, towers in that of another, houses in a third.
LETTERS = [
    ("fleet", "C", ["--scale", "2,2,1", "--groups", "0"]),
    ("skyscrapers", "M", ["--scale", "10,10,1.2"]),
    ("buildings", "S", ["--scale", "4,4,1.2", "--groups", "0"]),
]
FONT = {
    "C": ["01111", "11000", "10000", "10000", "10000", "11000", "01111"],
    "M": ["10001", "11011", "11111", "10101", "10001", "10001", "10001"],
    "S": ["01111", "11000", "11000", "01110", "00011", "00011", "11110"],
}


def dome():
    """Half a ball over a square plate, 4 x 4 x 2, as .obj text (y upward)."""
    lines, around, up = [], 32, 8
    for ring in range(up):
        angle = math.pi / 2 * ring / up
        for k in range(around):
            turn = 2 * math.pi * k / around
            x, y, z = math.cos(turn) * math.cos(angle), math.sin(turn) * math.cos(angle), math.sin(angle)
            lines.append(f"v {2 + 2 * x:.6f} {2 * z:.6f} {-2 - 2 * y:.6f}")
    lines.append("v 2 2 -2")
    top = up * around + 1
    for ring in range(up):
        for k in range(around):
            a, b = ring * around + k + 1, ring * around + (k + 1) % around + 1
            if ring + 1 < up:
                lines += [f"f {a} {b} {b + around}", f"f {a} {b + around} {a + around}"]
            else:
                lines.append(f"f {a} {b} {top}")
    lines.append("f " + " ".join(str(k + 1) for k in reversed(range(around))))
    return "\n".join(lines) + "\n"


DOMES = """kind = "solids"
unit = 1.0
scale = [3, 3, 2]
ground = { height = 0, substance = "court" }
[substances]
court = { color = "#b5ab93", roughness = 1.0 }
base = { color = "#d9cdb4" }
[[part]]
substance = "base"
box = [0, 0, 0, 4, 4, 4]
[[part]]
substance = "base"
box = [8, 0, 0, 12, 4, 2]
[[part]]
substance = "base"
box = [12, 0, 0, 20, 8, 2]
[[object]]
file = "dome.obj"
box = [0, 0, 4, 4, 4, 6]
[[object]]
file = "dome.obj"
box = [12, 0, 2, 20, 8, 6]
"""


def moved(scene, shifts):
    """A scene's text with its parts again, moved: more polygons of the same kinds."""
    head, *parts = scene.split("[[part]]")
    text = head + "".join("[[part]]" + part for part in parts)
    for x, y, z in shifts:
        for part in parts:
            part = part.rstrip("\n") + f"\nmove = [{x}, {y}, {z}]\n"
            text += "[[part]]" + part
    return text


def picture(rows):
    """Rows of 0 (black) and 1 (white) as a gray .png."""
    chunk = lambda kind, data: (struct.pack(">I", len(data)) + kind + data +
                                struct.pack(">I", zlib.crc32(kind + data)))
    lines = b"".join(b"\0" + bytes(255 * int(c) for c in row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines)) +
            chunk(b"IEND", b""))


def write_inputs(folder, scenes):
    (folder / "dome.obj").write_text(dome())
    (folder / "domes.toml").write_text(DOMES)
    for name, source, shifts in [
        ("fleet", "spaceships", [(0, 20, 0), (16, 0, 0)]),
        ("pipes", "plumbing", [(16, 0, 0), (0, 12, 0), (16, 12, 0)]),
        ("tracks", "coaster", [(28, 0, 0)]),
    ]:
        (folder / f"{name}.toml").write_text(moved((scenes / f"{source}.toml").read_text(), shifts))
    for letter, rows in FONT.items():
        (folder / f"{letter}.png").write_bytes(picture(rows))


def run(command):
    """Runs a command; its status, CPU seconds and megabytes at its peak."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    text = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 3):
        sys.exit(" ".join(command) + "\n" + text)
    return process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def make(options, folder, example, arguments, name, seed):
    """One result: its figures, and CPU seconds and megabytes."""
    stats = folder / f"{name}.json"
    stats.unlink(missing_ok=True)
    status, seconds, megabytes = run(
        [options.exemplar, "synth", str(example), "-o", str(folder / f"{name}.off"), "--engine",
         "continuous", "--threads", "1", "--seed", str(seed), "--stats", str(stats), *arguments])
    return (json.loads(stats.read_text()) if status == 0 else None), seconds, megabytes


def faces_of(options, folder, example):
    """How many faces an example has, as the engine reads it."""
    process = subprocess.run(
        [options.exemplar, "synth", str(example), "-o", str(folder / "none.off"), "--engine", "continuous",
         "--size", "1,1,1"], capture_output=True, text=True, check=False)
    for line in process.stderr.splitlines() + process.stdout.splitlines():
        if " faces of " in line:
            return int(line.split(" faces of ")[0].split(", ")[-1].replace(",", ""))
    sys.exit(f"{example}: {process.stderr}")


CLASSES = ["empty", "within", "face", "edge", "corner"]


def span(values, form="{:,}"):
    low, high = form.format(min(values)), form.format(max(values))
    return low if low == high else f"{low}–{high}"


def row(options, folder, name, thesis, runs):
    """A row of the table; runs: of each seed a list of (figures, seconds, megabytes)."""
    whole = [r for r in runs if all(stats for stats, _, _ in r)]
    if not whole:
        print(f"| {name} | none of {len(runs)} |")
        return
    total = lambda key: [sum(s[key] for s, _, _ in r) for r in whole]
    shares = []
    for c in CLASSES:
        example = [s["example_share_" + c] for s, _, _ in whole[0]]
        made = sum(s["share_" + c] for r in whole for s, _, _ in r) / len(whole)
        shares.append(f"{made / sum(example):.2f}" if sum(example) > 0.005 * len(example) else "–")
    first = whole[0]
    cells = [
        name, f"{thesis[0]:,}", f"{thesis[1]:,}", f"{60 * thesis[2]:.0f}",
        f"{sum(faces_of(options, folder, s['example_path']) for s, _, _ in first):,}",
        span(total("faces")),
        "/".join(str(s["directions"]) for s, _, _ in first),
        "/".join(str(s["most_labels"]) for s, _, _ in first),
        f"{sum(s['free_vertices'] for s, _, _ in first):,}",
        span([sum(t for _, t, _ in r) for r in runs], "{:.2f}"),
        f"{max(m for r in runs for _, _, m in r):.0f}", f"{len(whole)} of {len(runs)}", *shares]
    print("| " + " | ".join(cells) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--exemplar", default="exemplar", help="the program")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--only", action="append", help="a result's name; may be repeated")
    parser.add_argument("--pictures", action="store_true")
    options = parser.parse_args()
    folder = options.folder
    folder.mkdir(parents=True, exist_ok=True)
    scenes = pathlib.Path(__file__).resolve().parent.parent / "scenes"
    write_inputs(folder, scenes)
    place = lambda example: next(
        f / f"{example}.toml" for f in (folder, scenes) if (f / f"{example}.toml").exists())
    print("| result | thesis: in | out | s | in | out | directions | labels | free vertices | CPU s | MB "
          "| complete | " + " | ".join(CLASSES) + " |")
    print("|" + "---|" * (12 + len(CLASSES)))
    for name, thesis, example, arguments in RESULTS:
        if options.only and name not in options.only:
            continue
        parts = [(place(example), arguments, name.replace(" ", "_"))] if example else [
            (place(e), [*a, "--guide", str(folder / f"{letter}.png")], f"letter_{letter}")
            for e, letter, a in LETTERS]
        runs = []
        for seed in range(1, options.seeds + 1):
            made = []
            for path, given, file in parts:
                stats, seconds, megabytes = make(options, folder, path, given, f"{file}_{seed}", seed)
                if stats:
                    stats["example_path"] = path
                made.append((stats, seconds, megabytes))
            runs.append(made)
        row(options, folder, name, thesis, runs)
        if options.pictures:
            for path, _, file in parts:
                subprocess.run([options.exemplar, "render", str(path), str(folder / f"{file}_1.off"),
                                "-o", str(folder / f"{file}.png"), "--size", "900x500", "-q"], check=True)


if __name__ == "__main__":
    main()
