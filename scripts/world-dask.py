#!/usr/bin/python3
"""Makes a region of a world on many machines with Dask (Debian: python3-distributed).

    exemplar world init city -o town
    world-dask.py town --region 0:64,0:64 --local 2                    # two workers on this machine
    world-dask.py town --region 0:64,0:64 --scheduler tcp://head:8786  # workers that are running

Each job is one `exemplar world make`, which makes the tiles that are not there and leaves the others
alone; only names travel, so that the world's folder must be at the same path on all machines. Workers
may be lost and may join at any time. Where the scheduler is lost this program ends within half a
minute, with the command that goes on. Exit status: 0 all tiles are there; 3 some could not be made;
1 the scheduler was lost.
"""

import argparse
import asyncio
import json
import os
import shlex
import shutil
import subprocess
import sys
import threading
import time


def run(command):
    """A job, on a worker: its exit status, and its last line of errors."""
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    lines = done.stderr.strip().splitlines()
    if done.returncode not in (0, 3):
        # Raised, so that the scheduler tries again.
        raise RuntimeError(f"exit status {done.returncode}: {lines[-1] if lines else 'no message'}")
    return done.returncode, lines[-1] if lines else ""


def lost(resume):
    """Ends the program, whose scheduler is gone."""
    print("world-dask: the scheduler is lost; what was made is there. Go on with:\n  " + resume,
          file=sys.stderr, flush=True)
    os._exit(1)


class Watchdog(threading.Thread):
    """Notices that the scheduler is not heard of for half a minute: a client would wait."""

    def __init__(self, client, resume):
        super().__init__(daemon=True)
        self.client, self.resume, self.heard = client, resume, time.monotonic()

    def run(self):
        while True:
            ask = threading.Thread(target=self.ask, daemon=True)
            ask.start()
            ask.join(5)
            if self.client.status not in ("running", "connecting") or time.monotonic() - self.heard > 20:
                lost(self.resume)
            time.sleep(2)

    def ask(self):
        try:
            self.client.scheduler_info()
            self.client.run_on_scheduler(os.getpid)
            self.heard = time.monotonic()
        except Exception:  # the time since it was heard of decides
            pass


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("world", help="the world's folder, at the same path on all machines")
    options.add_argument("--region", required=True, metavar="I0:I1,J0:J1")
    options.add_argument("--formats", default="glb", metavar="LIST")
    options.add_argument("--job", type=int, default=4, metavar="N", help="tiles a side in a job (4)")
    options.add_argument("--exemplar", default=os.environ.get("EXEMPLAR") or shutil.which("exemplar"),
                         help="the command (exemplar)")
    options.add_argument("--retries", type=int, default=3, help="of a job that fails (3)")
    where = options.add_mutually_exclusive_group(required=True)
    where.add_argument("--scheduler", metavar="ADDRESS", help="of a scheduler: tcp://head:8786")
    where.add_argument("--local", type=int, metavar="N", help="start N workers on this machine")
    given = options.parse_args()
    if not given.exemplar:
        options.error("there is no exemplar on the path; say where with --exemplar")
    try:
        import distributed
    except ImportError:
        print("world-dask: needs Dask; install python3-distributed", file=sys.stderr)
        return 2
    world = os.path.abspath(given.world)
    plan = subprocess.run([given.exemplar, "world", "plan", world, "--region", given.region, "--as", "json",
                           "--formats", given.formats, "--job", str(given.job), "--progress", "none"],
                          stdout=subprocess.PIPE, text=True)
    if plan.returncode:
        return plan.returncode
    jobs = json.loads(plan.stdout)["jobs"]
    cluster = None
    if given.local:
        cluster = distributed.LocalCluster(n_workers=given.local, threads_per_worker=1, processes=True,
                                           dashboard_address=None, silence_logs=50)
    # A worker that dies takes its job along; that is no fault of the job.
    client = distributed.Client(cluster or given.scheduler)
    client.run_on_scheduler(lambda dask_scheduler: setattr(dask_scheduler, "allowed_failures", 10))
    resume = shlex.join(sys.argv)
    Watchdog(client, resume).start()
    begun, done, bad = time.monotonic(), 0, []
    futures = []
    for number, job in enumerate(jobs):
        command = [given.exemplar, *shlex.split(job["command"])[1:], "--threads", "1"]
        # In the plan's order, in which near jobs follow each other.
        futures.append(client.submit(run, command, key=f"world-{job['id']}", retries=given.retries,
                                     priority=-number, pure=False))
    for future in distributed.as_completed(futures):
        try:
            status, line = future.result()
        except (Exception, asyncio.CancelledError) as error:
            if future.status in ("cancelled", "lost"):  # nobody here cancels
                lost(resume)
            status, line = 3, str(error)
        if status:
            bad.append((future.key, line))
        done += 1
        rate = done / (time.monotonic() - begun)
        print(f"{done} of {len(jobs)} jobs, {60 * rate:.1f} a minute, "
              f"{(len(jobs) - done) / rate:.0f} s left, {len(bad)} failed", flush=True)
    for key, line in bad:
        print(f"{key}: {line}", file=sys.stderr)
    if cluster:
        cluster.close(timeout=10)
    return 3 if bad else 0


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # threads that still ask for a scheduler need not be waited for
