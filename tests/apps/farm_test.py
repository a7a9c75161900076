"""A farm on this machine: a scheduler and two workers of Dask make a region, while they are killed.

Run by ctest with EXEMPLAR (the command) and EXEMPLAR_SOURCE_DIR; skipped (77) without python3-distributed.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

try:
    import distributed  # noqa: F401
except ImportError:
    print("python3-distributed is not installed")
    sys.exit(77)

EXEMPLAR = os.environ["EXEMPLAR"]
SCRIPT = pathlib.Path(os.environ["EXEMPLAR_SOURCE_DIR"], "scripts", "world-dask.py")
REGION, TILES = "0:8,0:8", 64
started = []


def start(*command):
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    started.append(process)
    return process


def wait_for(what, condition, seconds):
    begun = time.monotonic()
    while not condition():
        assert time.monotonic() - begun < seconds, f"no {what} after {seconds} s"
        time.sleep(0.05)


def tiles(world):
    return {path: path.stat().st_mtime_ns for path in world.glob("tiles/0/*/*.txt")}


def farm(folder):
    world = folder / "w"
    subprocess.run([EXEMPLAR, "world", "init", "castle", "-o", world, "--tile", "24", "--window", "24",
                    "--moves", "1", "--quiet"], check=True)
    file = folder / "scheduler.json"
    python = [sys.executable, "-m"]
    scheduler = start(*python, "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard",
                      "--scheduler-file", str(file))
    wait_for("scheduler", file.exists, 60)
    wait_for("scheduler's address", lambda: file.read_text().rstrip().endswith("}"), 60)
    address = json.loads(file.read_text())["address"]
    worker = [*python, "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny",
              "--no-dashboard", "--local-directory", str(folder / "scratch")]
    first, _ = start(*worker), start(*worker)
    common = ["--region", REGION, "--formats", "txt", "--job", "2", "--exemplar", EXEMPLAR]
    client = subprocess.Popen([sys.executable, SCRIPT, world, *common, "--scheduler", address],
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    started.append(client)

    def made(count):
        return lambda: len(tiles(world)) >= count or client.poll() is not None

    wait_for("quarter", made(TILES // 4), 120)
    assert client.poll() is None, client.communicate()[1]
    first.kill()
    wait_for("half", made(TILES // 2), 120)
    start(*worker)
    wait_for("three quarters", made(3 * TILES // 4), 120)
    assert client.poll() is None, "done too soon to lose the scheduler"
    scheduler.kill()
    _, errors = client.communicate(timeout=60)
    assert client.returncode == 1, client.returncode
    assert "the scheduler is lost" in errors and "world-dask.py" in errors, errors
    for process in started:
        process.kill()
        process.wait()
    # Commands of killed workers may live on and finish: what they write is whole, and the same.
    time.sleep(2)

    before = tiles(world)
    assert len(before) < TILES, "nothing was left to go on with"
    subprocess.run([sys.executable, SCRIPT, world, *common, "--local", "2"], check=True,
                   stdout=subprocess.DEVNULL)
    after = tiles(world)
    assert len(after) == TILES, len(after)
    again = [path for path, when in before.items() if after[path] != when]
    assert not again, f"made twice: {again}"
    rest = [path for path in world.rglob("*") if path.name.startswith(".")]
    assert not rest, f"left: {rest}"
    # All are what one process makes.
    subprocess.run([EXEMPLAR, "world", "check", world, "--region", REGION, "--remake", "100", "--quiet"],
                   check=True)


with tempfile.TemporaryDirectory(prefix="exemplar_farm_", ignore_cleanup_errors=True) as name:
    try:
        farm(pathlib.Path(name))
    finally:
        for one in started:
            if one.poll() is None:
                one.kill()
print("ok")
