#!/usr/bin/env python3
"""Packs the Blender add-on: blender_zip.py [OUT.zip]. The same sources give the same bytes."""

import pathlib
import sys
import zipfile

source = pathlib.Path(__file__).resolve().parent.parent / "blender" / "exemplar_blender"
out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/exemplar_blender.zip")
out.parent.mkdir(parents=True, exist_ok=True)
with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
    for path in sorted(source.iterdir()):
        if path.suffix not in {".py", ".toml"} and path.name != "LICENSE":
            continue
        entry = zipfile.ZipInfo(f"{source.name}/{path.name}", (2026, 1, 1, 0, 0, 0))
        entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
        archive.writestr(entry, path.read_bytes())
print(f"{out}: install it in Blender by Edit > Preferences > Add-ons > Install")
