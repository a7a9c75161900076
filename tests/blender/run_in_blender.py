# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

"""Runs one of the add-on's tests: run_in_blender.py TEST COMMAND ZIP.

Each has folders of its own, and leaves none of its files and no process of the command behind."""

import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TEST, COMMAND, ZIP = sys.argv[1:4]


def missing():
    """What the test needs and is not there."""
    if TEST == "WithoutBlender":
        try:
            import numpy  # noqa: F401
        except ImportError:
            return f"NumPy for {sys.executable} (python3-numpy)"
        return ""
    needed = ["blender"] + (["xvfb-run"] if TEST in {"InAWindow", "QuitMeanwhile"} else [])
    return ", ".join(name for name in needed if not shutil.which(name))


def ours(folder):
    """Processes that work in a folder or below."""
    found = []
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            place = os.readlink(f"/proc/{number}/cwd")
        except OSError:
            continue
        if place.startswith(folder):
            found.append(f"{number} in {place}")
    return found


def fail(text):
    sys.exit(f"Blender.{TEST}: {text}")


def main():
    lacking = missing()
    if lacking:
        print(f"SKIPPED: {lacking} is missing")
        sys.exit(1 if os.environ.get("EXEMPLAR_BLENDER_TESTS") == "required" else 77)
    with tempfile.TemporaryDirectory() as root:
        folders = {name: os.path.join(root, name) for name in ("tmp", "scripts", "config", "home")}
        for folder in folders.values():
            os.mkdir(folder)
        environment = dict(os.environ, EXEMPLAR=COMMAND, EXEMPLAR_BLENDER_ZIP=ZIP,
                           TMPDIR=folders["tmp"], HOME=folders["home"],
                           BLENDER_USER_SCRIPTS=folders["scripts"],
                           BLENDER_USER_CONFIG=folders["config"], PYTHONDONTWRITEBYTECODE="1")
        result = os.path.join(root, "result")
        blender = ["blender", "-noaudio", "--factory-startup", "--python-exit-code", "1"]
        window = ["xvfb-run", "-a", "-s", "-screen 0 640x480x24"] + blender + [
            "--enable-event-simulate", "-p", "0", "0", "480", "360", "-P",
            os.path.join(HERE, "window_steps.py"), "--", result]
        line = {"WithoutBlender": [sys.executable, os.path.join(HERE, "plain_test.py")],
                "Headless": blender + ["-b", "-P", os.path.join(HERE, "headless_test.py")],
                "InAWindow": window + ["steps"], "QuitMeanwhile": window + ["quit"]}[TEST]
        status = subprocess.run(line, env=environment, stdin=subprocess.DEVNULL,
                                check=False).returncode
        if TEST in {"InAWindow", "QuitMeanwhile"}:
            if not os.path.isfile(result):
                fail(f"Blender ended with status {status} before the steps did")
            with open(result, encoding="utf-8") as file:
                words = file.read()
            if words != "fine":
                fail(words)
        elif status != 0:
            fail(f"status {status}")
        if ours(root):
            fail(f"these still run: {ours(root)}")
        # Sound and sessions are not ours.
        left = [name for name in os.listdir(folders["tmp"]) if name.startswith(("exemplar", "blender_"))]
        if left:
            fail(f"these files are left: {left}")


main()
