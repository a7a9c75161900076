# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Runs a notebook from top to bottom: notebook_test.py NOTEBOOK. Skipped, with a word, where what
runs it or the data that it reads is not there."""

import os
import sys
import tempfile

NOTEBOOK = sys.argv[1]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BEREA = os.environ.get("BEREA") or os.path.join(
    os.path.dirname(ROOT), "shared", "data", "berea_128_u8_zyx.raw.gz")


def skip(why):
    print(f"SKIPPED: {why}")
    sys.exit(77)


try:
    import nbformat
    from nbclient import NotebookClient
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import scipy  # noqa: F401
except ImportError as missing:
    skip(f"{missing.name} is missing (python3-nbclient, -ipykernel, -matplotlib, -scipy)")
if "rock" in os.path.basename(NOTEBOOK) and not os.path.isfile(BEREA):
    skip("the scan of Berea sandstone is not there; $BEREA names it")

with tempfile.TemporaryDirectory() as folder:
    # The kernel is this Python, with nothing of the user's.
    kernels = os.path.join(folder, "kernels", "python3")
    os.makedirs(kernels)
    with open(os.path.join(kernels, "kernel.json"), "w", encoding="utf-8") as file:
        file.write('{"argv": ["%s", "-m", "ipykernel_launcher", "-f", "{connection_file}"], '
                   '"display_name": "Python 3", "language": "python"}' % sys.executable)
    os.environ.pop("MPLBACKEND", None)
    os.environ.update(BEREA=BEREA, JUPYTER_PATH=folder, IPYTHONDIR=folder,
                      JUPYTER_RUNTIME_DIR=folder, MPLCONFIGDIR=folder, HOME=folder)
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    assert not any(cell.get("outputs") for cell in notebook.cells), "outputs are not kept"
    NotebookClient(notebook, timeout=300, kernel_name="python3",
                   resources={"metadata": {"path": folder}}).execute()
shown = sum("image/png" in output.get("data", {}) for cell in notebook.cells
            for output in cell.get("outputs", []))
print(f"{os.path.basename(NOTEBOOK)}: {len(notebook.cells)} cells, {shown} pictures")
assert shown >= 2, "meshes and plots show themselves"
