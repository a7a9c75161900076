# exemplar for Blender. Copyright (c) 2026 The exemplar authors.
# SPDX-License-Identifier: GPL-3.0-or-later

"""What every run has in common: start the command, follow it, take what it made.

Between the start and the end only names are kept, as Blender may undo, rename and delete."""

import json
import os
import re
import tempfile

import bpy

from . import job, settings

_current = None  # the job that runs, one at a time


def busy():
    return _current is not None


def current():
    return _current


class Failure(Exception):
    """What the user has to know; `names` are objects to select."""

    def __init__(self, text, names=()):
        super().__init__(text)
        self.names = list(names)


class Run:
    """A mix-in for operators. `prepare` checks what is wanted, writes files into `self.folder` and
    returns the command's words; `take` puts the result into the scene."""
    following = None  # the words of the job after this one, where it is a draft
    bl_options = {"UNDO"}  # not REGISTER, whose panel would run it again, waiting

    @classmethod
    def poll(cls, context):
        if busy():
            cls.poll_message_set("Exemplar is at work; Esc cancels it")
            return False
        return context.mode == "OBJECT"

    def prepare(self, context):
        raise NotImplementedError

    def take(self, context):
        raise NotImplementedError

    def take_draft(self, context):
        """Shows what the draft has made, where there is one."""

    def drop_draft(self):
        """Removes what `take_draft` has shown."""

    def invoke(self, context, _event):
        self.shows_drafts = True
        if not self._start(context):
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        self._show(context)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        self.shows_drafts = False  # nobody would see it
        if not self._start(context):
            return {"CANCELLED"}
        try:
            self.job.wait()
        finally:
            done = self._end(context)
        return {"FINISHED"} if done else {"CANCELLED"}

    def modal(self, context, event):
        if _current is not self.job:  # ended by loading another file
            return self._leave(context, {"CANCELLED"})
        if event.type == "ESC" and event.value == "PRESS":
            self.job.stop()  # waits: the next timer may come late where drawing is slow
        elif event.type != "TIMER":
            return {"PASS_THROUGH"}
        elif not self.job.poll():
            self._show(context)
            return {"PASS_THROUGH"}
        elif self._follow(context):
            return {"PASS_THROUGH"}
        done = self._end(context)
        return self._leave(context, {"FINISHED"} if done else {"CANCELLED"})

    def cancel(self, context):
        """Blender ends the operator: its window closes, or it quits."""
        self.drop_draft()
        self._drop()
        self._leave(context, None)

    def _start(self, context):
        global _current
        path, version = settings.found_command()
        if not version:
            return self._fail(context, settings.command.NOT_FOUND)
        self.folder = tempfile.mkdtemp(prefix="exemplar_", dir=bpy.app.tempdir or None)
        self.job = None
        try:
            self._run(path, self.prepare(context))
        except (Failure, ValueError, OSError) as error:
            self._drop()
            return self._fail(context, str(error), getattr(error, "names", ()))
        return True

    def _run(self, path, words):
        global _current
        own = settings.preferences()
        if own and own.cores:
            words = words + ["--threads", own.cores]
        self.job = _current = job.Job(path, words, self.folder)

    def _follow(self, context):
        """After a draft that went well: shows it, and starts what follows it."""
        if self.following is None or self.job.cancelled or self.job.status != 0:
            return False
        words, self.following = self.following, None
        try:
            self.take_draft(context)
            self._run(settings.found_command()[0], words)
        except (Failure, ValueError, OSError, RuntimeError):
            return False  # `_end` says what is wrong with the draft
        self._show(context)
        return True

    def _end(self, context):
        """Takes the result of a job that has ended; whether there is one."""
        ended, done = self.job, False
        try:
            if ended.cancelled:
                settings.note(context.scene, text="cancelled")
                self.report({"INFO"}, "Exemplar: cancelled")
                return False
            if ended.status != 0:
                return self._fail(context, in_words(ended.error), self.conflicting(ended.pins),
                                  ended.text())
            ended.warnings = [in_words(warning) for warning in ended.warnings]
            self.take(context)
            done = True
            settings.note(context.scene)
            for warning in ended.warnings:
                self.report({"WARNING"}, warning)
            return True
        except (Failure, ValueError, OSError, RuntimeError) as error:
            return self._fail(context, str(error), getattr(error, "names", ()), ended.text())
        finally:
            if not done:
                self.drop_draft()
            own = settings.preferences(context)
            self._drop(keep=bool(own and own.keep_files))

    def conflicting(self, _pins):
        """The names of the objects that are these pins."""
        return []

    def _fail(self, context, text, names=(), log=""):
        self.report({"ERROR"}, text)
        settings.note(context.scene, error=text, log=log)
        select(context, names)
        return False

    def _drop(self, keep=False):
        """Ends the process, forgets the job, removes its files."""
        global _current
        if self.job:
            self.job.poll() if keep else self.job.kill()
        elif self.folder:
            job.shutil.rmtree(self.folder, ignore_errors=True)
        _current = None

    def _leave(self, context, result):
        if getattr(self, "_timer", None):
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        for space in bpy.data.workspaces:
            space.status_text_set(None)
        _redraw(context)
        return result

    def _show(self, context):
        if context.workspace:
            context.workspace.status_text_set(f"Exemplar: {progress_text(self.job)}    Esc: cancel")
        _redraw(context)

    def file(self, name):
        return os.path.join(self.folder, name)


def progress_text(running):
    bar = int(20 * running.fraction)
    text = f"{running.stage}  [{'=' * bar}{' ' * (20 - bar)}] {100 * running.fraction:.0f} %"
    left = running.seconds_left
    return text + (f", about {max(1, round(left))} s left" if left is not None else "")


_WORDS = {"resolution": "Detail, Samples", "stationary": "Repeats", "scatter": "Stands Alone",
          "periodic": "Tile", "with": "Mix With", "pin": "the pin", "simplify": "Triangles"}


def in_words(text):
    """A message of the command, with its options as the panels name them, without our file's name."""
    text = re.sub(r"^(in|sample)\.(glb|txt|asc): ", "", text).replace(" (or auto)", " (or Found)")
    return re.sub(r"--([a-z]+(?:-[a-z]+)*)",
                  lambda m: _WORDS.get(m[1], m[1].replace("-", " ").title()), text)


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def select(context, names):
    """Selects objects, and nothing else, where any of them is there."""
    context.view_layer.update()  # it knows of what was linked just now
    things = [bpy.data.objects.get(name) for name in names]
    things = [t for t in things if t and t.name in context.view_layer.objects]
    if not things:
        return
    for thing in context.view_layer.objects:
        thing.select_set(False)
    for thing in things:
        thing.hide_set(False)
        thing.select_set(True)
    context.view_layer.objects.active = things[-1]


def hide(context, names, hidden=True):
    for name in names:
        thing = bpy.data.objects.get(name)
        if thing and thing.name in context.view_layer.objects:
            thing.select_set(False)
            thing.hide_set(hidden)


def remember(thing, kind, values, **more):
    """Keeps on a result (an object or a collection) what it was made from."""
    thing["exemplar"] = json.dumps({"version": settings.found_command()[1], "kind": kind,
                                    "settings": values, **more})
    thing["exemplar_seed"] = values["seed"]


def remembered(thing):
    """What `remember` kept, or None; the seed as the user may have changed it."""
    if thing is None or "exemplar" not in thing:
        return None
    try:
        record = json.loads(thing["exemplar"])
        record["settings"]["seed"] = int(thing.get("exemplar_seed", record["settings"]["seed"]))
        return record
    except (ValueError, KeyError, TypeError):
        return None


def result_of(context):
    """The result that the active object is, or is in: (object or collection, its record)."""
    thing = context.active_object
    if thing is None:
        return None, None
    for owner in (thing, *thing.users_collection):
        record = remembered(owner)
        if record:
            return owner, record
    return None, None


def end():
    """Ends what runs, when another file is loaded or the add-on is switched off."""
    global _current
    job.end_all()
    _current = None
