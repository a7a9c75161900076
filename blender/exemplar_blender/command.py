# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""Where the `exemplar` command is, and whether it can be talked to. Knows nothing of Blender."""

import json
import os
import shutil
import subprocess
import sys

PROTOCOL = 1  # of --progress json that job.py reads

NAME = "exemplar.exe" if sys.platform == "win32" else "exemplar"
USUAL_FOLDERS = ("/usr/local/bin", "/usr/bin", "/opt/exemplar/bin", "~/.local/bin", "/opt/homebrew/bin")
NOT_FOUND = ("The command 'exemplar' was not found. Install it, or set its path below "
             "(Preferences > Add-ons > Exemplar)")


def find(preferred=""):
    """The path of the command: `preferred` where it is given, else $EXEMPLAR, the PATH, beside the
    add-on, and the usual folders; an empty text where there is none."""
    if preferred:
        preferred = os.path.abspath(os.path.expanduser(preferred))
        if os.path.isdir(preferred):
            preferred = os.path.join(preferred, NAME)
        return preferred if _runs(preferred) else ""
    here = os.path.dirname(os.path.abspath(__file__))
    places = [os.environ.get("EXEMPLAR", ""), shutil.which(NAME) or "", os.path.join(here, NAME),
              os.path.join(here, "bin", NAME)]
    places += [os.path.join(os.path.expanduser(folder), NAME) for folder in USUAL_FOLDERS]
    return next((place for place in places if place and _runs(place)), "")


def _runs(path):
    return os.path.isfile(path) and os.access(path, os.X_OK)


def version(path):
    """The command's version, as "0.1.0"; an empty text where it does not answer within 5 s."""
    words = _said(path, "--version").split()
    return words[1] if words[:1] == ["exemplar"] and len(words) > 1 else ""


def engines(path):
    """The names of the command's engines."""
    try:
        return {engine["name"] for engine in json.loads(_said(path, "engines", "--json"))}
    except (ValueError, KeyError, TypeError):
        return set()


def _said(*line):
    try:
        done = subprocess.run(line, stdin=subprocess.DEVNULL, capture_output=True, timeout=5,
                              check=False, **hidden_window())
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.decode("utf-8", "replace") if done.returncode == 0 else ""


def hidden_window():
    """What keeps Windows from opening a console window for a process."""
    return {"creationflags": subprocess.CREATE_NO_WINDOW} if sys.platform == "win32" else {}
