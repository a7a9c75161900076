#!/usr/bin/env python3
# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT
"""`exemplar world serve` as browsers and strangers see it."""

import concurrent.futures
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

EXEMPLAR = os.environ["EXEMPLAR"]


def run(*arguments):
    return subprocess.run([EXEMPLAR, "world", *arguments], capture_output=True, text=True, check=False)


class Server:
    def __init__(self, world, *options):
        self.process = subprocess.Popen(
            [EXEMPLAR, "world", "serve", world, "--port", "0", *options],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        if "http://127.0.0.1:" not in line:
            raise AssertionError(line + self.process.stderr.read())
        self.port = int(line.split("127.0.0.1:")[1].split("/")[0])

    def get(self, path):
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port}{path}", timeout=120) as answer:
                return answer.status, answer.read()
        except urllib.error.HTTPError as error:
            return error.code, error.read()

    def raw(self, text):
        """The status of an answer to bytes as they are; 0 where the connection is closed."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as connection:
            connection.sendall(text.encode("latin-1"))
            answer = b""
            while b"\r\n" not in answer:
                more = connection.recv(4096)
                if not more:
                    return 0
                answer += more
        return int(answer.split()[1])

    def ask(self, path, method="GET", host="localhost"):
        return self.raw(f"{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n")

    def end(self):
        """Ctrl-C. Returns the exit status."""
        self.process.send_signal(signal.SIGINT)
        try:
            return self.process.wait(60)
        finally:
            self.process.kill()
            self.process.communicate()


def check(claim, what):
    if not claim:
        raise AssertionError(what)


def serves_tiles_and_a_page(world):
    server = Server(world)
    status, page = server.get("/")
    check(status == 200 and b"<canvas>" in page and b"/tiles/0/" in page, "the page")
    about = json.loads(server.get("/world.json")[1])
    check(about["engine"] == "model" and about["cells"] == 24 and about["format"] == "glb", about)
    status, tile = server.get("/tiles/0/2/-1.glb")
    check(status == 200 and tile[:4] == b"glTF", "a tile")
    alone = os.path.join(os.path.dirname(world), "alone.glb")
    check(run("tile", world, "2,-1", "-o", alone).returncode == 0, "tile")
    with open(alone, "rb") as file:
        check(file.read() == tile, "a tile that is served is what `tile` writes")
    with open(os.path.join(world, "tiles/0/2/-1.glb"), "rb") as file:
        check(file.read() == tile, "and is kept")
    check(server.get("/tiles/0/2/-1.glb") == (200, tile), "a tile again")
    check(server.end() == 4, "Ctrl-C ends it")


def answers_nothing_else(world):
    server = Server(world)
    secret = os.path.join(os.path.dirname(world), "secret.glb")
    with open(secret, "w", encoding="utf-8") as file:
        file.write("secret")
    for path in (
            "/secret.glb", "/../secret.glb", "/tiles/0/../../../secret.glb", "/%2e%2e/secret.glb",
            "/tiles/0/%2e%2e/%2e%2e/%2e%2e/secret.glb", "/tiles/0/0/..%2f..%2f..%2f..%2fsecret.glb",
            "/tiles/0/0/0.glb/../../../../../secret.glb", "//etc/passwd", secret, "/example/castle.toml",
            "/tiles/0/0/0.", "/tiles/0/0/0", "/tiles/0/0/0.exe", "/tiles/1/0/0.glb", "/tiles/0/+0/0.glb",
            "/tiles/0/00/0.glb", "/tiles/0/1048576/0.glb", "/tiles/0/99999999999999999999/0.glb",
            "/tiles/0/0/0.glb%00.txt", "/tiles/0/0/0.txt.json.json", "/tiles/0/0\\0.glb", "/tileset.json"):
        status = server.ask(path)
        check(status in (400, 404), f"{path}: {status}")
    check(not os.path.exists(os.path.join(world, "tiles/0/0")), "nothing was made")
    check(server.ask("/" + "a" * 20000) in (0, 400, 404, 414), "a path without end")
    check(server.raw("nonsense\r\n\r\n") in (0, 400), "no HTTP")
    for method in ("POST", "PUT", "DELETE", "OPTIONS"):
        check(server.ask("/", method) in (400, 405), method)
    check(server.ask("/", host="evil.example") == 403, "a page of another name that leads here")
    check(server.ask("/", host="") == 403, "no name")
    check(server.ask("/") == 200, "it is still there")
    # It listens at this machine's own address alone.
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))
            other = probe.getsockname()[0]
        except OSError:
            other = "127.0.0.1"
    if not other.startswith("127."):
        with socket.socket() as connection:
            connection.settimeout(5)
            check(connection.connect_ex((other, server.port)) != 0, f"it listens at {other}, too")
    check(server.end() == 4, "Ctrl-C ends it")


def bounds_its_work(world):
    server = Server(world, "--waiting", "0", "--most", "3")
    with concurrent.futures.ThreadPoolExecutor(12) as many:
        found = list(many.map(lambda n: server.get(f"/tiles/0/{40 * n + 40}/7.txt")[0], range(12)))
    check(set(found) == {200, 503}, f"some are refused while one is made: {found}")
    for n in range(8):
        server.get(f"/tiles/0/{50 * n + 700}/9.txt")
    status, why = server.get("/tiles/0/5000/9.txt")
    check(status == 503 and b"as many as may be" in why, why)
    made = [name for _, _, names in os.walk(os.path.join(world, "tiles")) for name in names
            if name.endswith(".txt")]
    check(len(made) == 3, f"as many as may be: {made}")
    check(server.end() == 4, "Ctrl-C ends it")


def hears_ctrl_c_while_it_makes_a_tile(world):
    server = Server(world)
    with concurrent.futures.ThreadPoolExecutor(4) as many:
        answers = [many.submit(server.ask, f"/tiles/0/{9000 + 40 * n}/0.glb") for n in range(4)]
        time.sleep(0.05)
        began = time.monotonic()
        check(server.end() == 4, "Ctrl-C ends it")
        check(time.monotonic() - began < 30, "soon")
        for answer in answers:
            try:
                check(answer.result() in (0, 200, 503), "an answer, or none")
            except OSError:
                pass
    for folder, _, names in os.walk(os.path.join(world, "tiles")):
        check(all(name.endswith((".glb", ".txt")) and not name.startswith(".") for name in names),
              f"{folder}: {names}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        world = os.path.join(folder, "w")
        made = run("init", "castle", "-o", world, "--tile", "24", "--window", "24", "--moves", "1")
        check(made.returncode == 0, made.stderr)
        refused = run("serve", world, "--host", "192.0.2.1", "--port", "0")
        if "without cpp-httplib" in refused.stderr:
            sys.exit(77)
        check(refused.returncode == 2 and "cannot listen" in refused.stderr, refused.stderr)
        for test in (serves_tiles_and_a_page, answers_nothing_else, bounds_its_work,
                     hears_ctrl_c_while_it_makes_a_tile):
            began = time.monotonic()
            test(world)
            print(f"{test.__name__}: {time.monotonic() - began:.1f} s", flush=True)


if __name__ == "__main__":
    main()
