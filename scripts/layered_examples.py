#!/usr/bin/env python3
"""Makes the examples of docs/layered.md (procedural textures of layers, for anyone to use) and its
pictures.

    scripts/layered_examples.py FOLDER            rust.png, lichen.png, paint.png and heights.png (16
                                                  bits), 256 x 256 each
    scripts/layered_examples.py FOLDER EXEMPLAR   and, by that command, the pictures and figures

Needs numpy; the pictures need Pillow.
"""
import json
import struct
import subprocess
import sys
import zlib

import numpy as np


def fractal(shape, slope, seed, stretch=1.0):
    """Noise whose amplitude falls as frequency ** -slope; mean 0, deviation 1."""
    rng = np.random.default_rng(seed)
    fy = np.fft.fftfreq(shape[0])[:, None] * stretch
    fx = np.fft.fftfreq(shape[1])[None, :]
    frequency = np.hypot(fy, fx)
    frequency[0, 0] = 1
    spectrum = np.fft.fft2(rng.standard_normal(shape)) * frequency**-slope
    spectrum[0, 0] = 0
    noise = np.real(np.fft.ifft2(spectrum))
    return noise / noise.std()


def cut(noise, share, within=None):
    """Where noise is largest: `share` of all, inside `within`."""
    values = noise if within is None else np.where(within, noise, -np.inf)
    return values >= np.sort(values, axis=None)[int((1 - share) * values.size)]


def shaded(color, noise, amount):
    return np.array(color)[None, None] * (1 + amount * noise[..., None])


def rust(n=256):
    """Brushed steel, flaking rust on it, dark pits in the rust."""
    spread = fractal((n, n), 1.7, 1, 0.6)
    stains = cut(spread, 0.42)
    pits = cut(spread + 0.6 * fractal((n, n), 1.2, 2), 0.14, stains)
    image = shaded([0.56, 0.58, 0.60], fractal((n, n), 0.7, 3, 8), 0.06)
    image[stains] = shaded([0.62, 0.33, 0.14], fractal((n, n), 0.9, 4), 0.16)[stains]
    image[pits] = shaded([0.25, 0.13, 0.09], fractal((n, n), 0.8, 5), 0.22)[pits]
    return image


def lichen(n=256):
    """Granite, lobes of pale lichen on it, orange fruit bodies in their middles."""
    rng = np.random.default_rng(11)
    y, x = np.mgrid[:n, :n]
    field = np.full((n, n), -9.0)
    edge = fractal((n, n), 1.3, 12)
    for _ in range(26):
        cy, cx, radius = rng.uniform(0, n), rng.uniform(0, n), rng.uniform(12, 30)
        dy, dx = (y - cy + n / 2) % n - n / 2, (x - cx + n / 2) % n - n / 2
        field = np.maximum(field, 1 - np.hypot(dy, dx) / radius)
    field += 0.14 * edge
    lobes = cut(field, 0.45)
    fruit = cut(field + 0.25 * fractal((n, n), 0.9, 13), 0.11, lobes)
    grain = fractal((n, n), 0.35, 14)
    image = shaded([0.47, 0.45, 0.44], grain, 0.17)
    image[lobes] = shaded([0.71, 0.76, 0.60], fractal((n, n), 1.0, 15), 0.09)[lobes]
    image[fruit] = shaded([0.80, 0.48, 0.13], fractal((n, n), 0.6, 16), 0.18)[fruit]
    return image


def paint(n=256):
    """Blue paint, chips down to the primer, bare wood in their middles."""
    chips = fractal((n, n), 1.9, 21) + 0.35 * np.abs(fractal((n, n), 1.2, 22))
    primer = cut(chips, 0.38)
    wood = cut(chips + 0.12 * fractal((n, n), 1.1, 23), 0.22, primer)
    image = shaded([0.16, 0.36, 0.52], fractal((n, n), 1.1, 24), 0.05)
    image[primer] = shaded([0.83, 0.81, 0.74], fractal((n, n), 0.8, 25), 0.04)[primer]
    image[wood] = shaded([0.48, 0.34, 0.22], fractal((n, n), 1.0, 26, 0.12), 0.15)[wood]
    return image


def heights(n=256):
    """Ridged hills, as heights from 0 to 1."""
    hills = fractal((n, n), 1.8, 41) - 0.7 * np.abs(fractal((n, n), 1.7, 42))
    return (hills - hills.min()) / (hills.max() - hills.min())


def write_png(path, image):
    """Writes colors in 8 bits, or what has no colors in 16."""
    deep = image.ndim == 2
    pixels = (np.clip(image, 0, 1) * (65535 if deep else 255) + 0.5).astype(">u2" if deep else "u1")
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + pixels[y].tobytes() for y in range(height))

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n"
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16 if deep else 8,
                                                0 if deep else 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def beside(path, *pictures):
    """Pictures of one height in a row, four pixels apart."""
    from PIL import Image

    def colored(path):
        image = Image.open(path)
        if image.mode.startswith("I"):  # 16 bits
            image = Image.fromarray((np.asarray(image) // 257).astype(np.uint8))
        return image.convert("RGB")

    images = [colored(p) for p in pictures]
    height = max(image.height for image in images)
    row = Image.new("RGB", (sum(i.width + 4 for i in images) - 4, height), "white")
    left = 0
    for image in images:
        row.paste(image, (left, (height - image.height) // 2))
        left += image.width + 4
    row.point(lambda v: v // 4 * 4).save(path, optimize=True)


def make_pictures(folder, exemplar):
    def run(*arguments):
        subprocess.run([exemplar, *arguments], cwd=folder, check=True)

    def synth(name, result, *more, layers=3):
        run("synth", f"{name}.png", "--engine", "layered", "--layers", str(layers), "-o",
            f"{result}.png", "--write-layers", f"{result}_l.png", "--stats", f"{result}.json", *more)
        figures = json.load(open(f"{folder}/{result}.json"))["layers"]
        print(result, {key: round(value, 3) for key, value in figures.items()})

    for name, layers in (("rust", 3), ("lichen", 3), ("paint", 3), ("heights", 5)):
        synth(name, f"more_{name}", "--size", "384,256,1", layers=layers)
        beside(f"{folder}/layered_{name}.png", f"{folder}/{name}.png",
               f"{folder}/more_{name}_l_example.png", f"{folder}/more_{name}_l.png",
               f"{folder}/more_{name}.png")

    # A hole in the paint, filled.
    hole = np.zeros((256, 256, 3))
    hole[96:176, 80:190] = 1
    write_png(f"{folder}/hole.png", hole)
    image = paint()
    image[96:176, 80:190] = 1
    write_png(f"{folder}/torn.png", image)
    synth("torn", "filled", "--inpaint", "hole.png")
    beside(f"{folder}/layered_inpaint.png", f"{folder}/torn.png", f"{folder}/filled_l.png",
           f"{folder}/filled.png")

    # A ring of pits, painted: rust comes around it by itself.
    y, x = np.mgrid[:256, :384]
    radius = np.hypot(y - 128, x - 192)
    sketch = np.repeat((np.abs(radius - 80) < 22)[..., None] * 1.0, 3, axis=2)
    write_png(f"{folder}/sketch.png", sketch)
    synth("rust", "painted", "--size", "384,256,1", "--paint", "sketch.png")
    beside(f"{folder}/layered_painted.png", f"{folder}/sketch.png", f"{folder}/painted_l.png",
           f"{folder}/painted.png")

    for scene, size in (("minerals", "96,96,64"), ("lichen", "64,64,64")):
        run("synth", scene, "--engine", "layered", "--size", size, "-o", f"more_{scene}.vdb",
            "--stats", f"more_{scene}.json")
        run("render", scene, f"more_{scene}.vdb", "-o", f"layered_volume_{scene}.png", "--size",
            "420x360")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    for make in (rust, lichen, paint, heights):
        write_png(f"{sys.argv[1]}/{make.__name__}.png", make())
    if len(sys.argv) == 3:
        make_pictures(sys.argv[1], sys.argv[2])
