# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""A run of the command as a process. Knows nothing of Blender.

No thread and no pipe: the process writes its progress (docs/progress.md) to a file in the job's
folder, and `poll`, which a timer calls, reads what was added."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from .command import PROTOCOL, hidden_window

GRACE = 0.4  # seconds between asking the process to stop and ending it

_running = []


class Job:
    """Starts `command arguments` at once; `arguments` is a function of the job's folder, which is
    made for it and removed with it."""

    def __init__(self, command, arguments, folder=None):
        self.folder = folder or tempfile.mkdtemp(prefix="exemplar_")
        self.stage, self.fraction, self.seconds_left = "starting", 0.0, None
        self.warnings, self.files = [], []
        self.error, self.status, self.pins = "", None, []
        self.log = os.path.join(self.folder, "log")
        self._read, self._rest, self._started = 0, b"", False
        self._asked, self._refused = None, False
        arguments = [str(word) for word in arguments] + ["--progress", "json"]
        self.line = [command] + arguments
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(self.line, stdin=subprocess.DEVNULL,
                                            stdout=subprocess.DEVNULL, stderr=log,
                                            cwd=self.folder, **hidden_window())
        _running.append(self)

    def poll(self):
        """Reads what is new; whether the process has ended. Quick."""
        ended = self.process.poll() is not None  # before reading: nothing is missed
        if not ended and self._asked is not None and time.monotonic() - self._asked > GRACE:
            self.process.kill()
            self.process.wait()
            ended = True
        self._follow()
        if ended and self.status is None:
            self.status = self.process.returncode
            if self in _running:
                _running.remove(self)
            if self.status != 0 and not self.error:
                self.error = self._last_words()
        return ended

    def cancel(self):
        """Asks the process to stop; `poll` ends it where it does not within GRACE."""
        if self._asked is not None or self.process.poll() is not None:
            return
        self._asked = time.monotonic()
        self.process.terminate() if sys.platform == "win32" else self.process.send_signal(signal.SIGINT)

    def stop(self):
        """Cancels, and waits for the end: GRACE at most."""
        self.cancel()
        self.wait()

    @property
    def cancelled(self):
        """Whether the user has stopped it, however it ended then."""
        return self._asked is not None and not self._refused

    def wait(self, every=0.02):
        """Waits for the end, as scripts do; whether it went well."""
        while not self.poll():
            time.sleep(every)
        return self.status == 0

    def kill(self):
        """Ends the process, now, and removes the folder."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        if self in _running:
            _running.remove(self)
        self.clean()

    def clean(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def text(self):
        """Everything that the process has written."""
        try:
            with open(self.log, encoding="utf-8", errors="replace") as log:
                return " ".join(self.line) + "\n" + log.read()
        except OSError:
            return ""

    def _follow(self):
        with open(self.log, "rb") as log:
            log.seek(self._read)
            added = log.read()
        self._read += len(added)
        *lines, self._rest = (self._rest + added).split(b"\n")
        for line in lines:
            try:
                event = json.loads(line)
                self._hear(event["event"], event)
            except (ValueError, KeyError, TypeError):
                pass  # not for programs; `_last_words` shows it where it was the last

    def _hear(self, kind, event):
        if kind == "start":
            self._started = True
            if event.get("protocol") != PROTOCOL:
                self.error = (f"exemplar {event.get('version', '')} speaks protocol "
                              f"{event.get('protocol')}, this add-on {PROTOCOL}: use the add-on "
                              "that came with the command")
                self._refused = True
                self.cancel()
        elif kind == "progress":
            self.stage = str(event["stage"])
            self.fraction = max(self.fraction, float(event["fraction"]))
            self.seconds_left = event.get("seconds_left")
        elif kind == "warning":
            self.warnings.append(str(event["text"]))
        elif kind == "file":
            self.files.append((event.get("kind", ""), event["path"]))
        elif kind == "error":
            self.error = self.error or str(event["text"])
            self.pins = [int(pin) for pin in event.get("pins", [])]

    def _last_words(self):
        lines = [line for line in self.text().splitlines()[1:] if line.strip()]
        words = lines[-1][:300] if lines else "it wrote nothing"
        if not self._started:
            return f"{self.line[0]} is not an exemplar of this add-on's version: {words}"
        return f"exemplar ended with status {self.process.returncode}: {words}"


def end_all():
    """Ends all jobs, when the program quits or another file is loaded."""
    for job in list(_running):
        job.kill()
