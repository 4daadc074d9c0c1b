#!/usr/bin/python3
"""Measures a running daemon from outside, over HTTP on this machine. Standard library only.

  service_bench.py URL lists      list calls on a store of raywatch-fill-store: median and greatest time
  service_bench.py URL history    the history of a point over the 10,000 scans of its site "long"
  service_bench.py URL choose     choosing priors for a new scan amid the million of its site "large"
  service_bench.py URL latency    from POST of a 100,000-point scan to its alert on the event stream
  service_bench.py URL stream     130,000-point scans at 10 a second for two minutes: queue, memory, answers
"""

import argparse
import calendar
import http.client
import json
import math
import random
import socket
import struct
import threading
import time
import urllib.parse


class Daemon:
    def __init__(self, url):
        self.url = urllib.parse.urlsplit(url)
        self.connection = http.client.HTTPConnection(self.url.hostname, self.url.port, timeout=120)

    def call(self, method, path, body=None, kind="application/json"):
        if body is not None and not isinstance(body, bytes):
            body = json.dumps(body).encode()
        headers = {"Content-Type": kind} if body is not None else {}
        self.connection.request(method, path, body, headers)
        answer = self.connection.getresponse()
        text = answer.read()
        if answer.status >= 400:
            raise SystemExit(f"{method} {path}: {answer.status} {text.decode(errors='replace')}")
        return text

    def get(self, path):
        return json.loads(self.call("GET", path))

    def metric(self, name):
        for line in self.call("GET", "/metrics").decode().splitlines():
            if line.startswith(name + " "):
                return float(line.split()[1])
        raise SystemExit(f"no metric {name}")


def median_and_greatest_ms(action, repeats=15):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        action()
        times.append(1000 * (time.perf_counter() - start))
    times.sort()
    return times[len(times) // 2], times[-1]


def view_of_yard(box, seed, columns, rows, place=(1, 2, 1.5)):
    """A PCD of a wall 10 m ahead, ground 1.5 m below, and perhaps a box of one metre at 5 m; 5 mm of noise."""
    noise = random.Random(seed)
    points = bytearray()
    for row in range(rows):
        tangent = math.tan(math.radians(-20 + 40 * row / rows))
        for column in range(columns):
            azimuth = math.radians(-50 + 100 * column / columns)
            y, z = math.tan(azimuth), tangent / math.cos(azimuth)
            distance = min(10.0, 1.5 / -z) if z < 0 else 10.0
            if box and abs(5 * y) < 0.5 and abs(5 * z + 0.5) < 0.5:
                distance = min(distance, 5.0)
            distance *= 1 + noise.gauss(0, 0.0005)
            points += struct.pack("<3f", distance, y * distance, z * distance)
    count = rows * columns
    header = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        f"WIDTH {count}\nHEIGHT 1\nVIEWPOINT {place[0]} {place[1]} {place[2]} 1 0 0 0\nPOINTS {count}\nDATA binary\n"
    )
    return header.encode() + bytes(points)


def make_yard(daemon):
    daemon.call("POST", "/api/v1/sites", {"name": "bench"})
    daemon.call("POST", "/api/v1/sensors", {"name": "bench-gate", "site": "bench"})


def post_scan(daemon, body, captured_at, sensor="bench-gate"):
    query = urllib.parse.urlencode({"sensor": sensor, "captured_at": captured_at})
    return json.loads(daemon.call("POST", f"/api/v1/scans?{query}", body, "application/octet-stream"))


def lists(daemon, _):
    paths = [
        "scans?site=large", "scans?site=large&limit=1000", "scans?site=large&near=12,12,2",
        "scans?site=large&from=2026-02-01T00:00:00Z&to=2026-02-02T00:00:00Z", "vantages?site=large&limit=1000",
        "changes?site=large&reference=baseline", "changes?site=large&reference=baseline&limit=1000",
        "changes?site=large&reference=baseline&kind=removed&min_volume_m3=0.9",
        "changes?site=large&reference=baseline&min_volume_m3=5", "changes?site=large&kind=discrepancy",
        "changes?site=large&reference=baseline&box=10,10,0,12,12,1",
        "changes?site=large&reference=baseline&box=0,0,0,40,40,1&limit=1000",
        "changes?site=large&reference=baseline&from=2026-02-01T00:00:00Z&to=2026-02-02T00:00:00Z",
        "comparisons?site=large&limit=1000", "comparisons?site=large&state=failed",
        "tracks?site=large&limit=1000", "tracks?site=large&state=open",
        "alerts?site=large&limit=1000", "alerts?site=large&state=open", "events/log?limit=1000",
    ]
    for path in paths:
        count = len(daemon.get("/api/v1/" + path)["items"])
        median, greatest = median_and_greatest_ms(lambda: daemon.call("GET", "/api/v1/" + path))
        print(f"{path:82} {count:5} items  median {median:6.1f} ms  greatest {greatest:6.1f} ms", flush=True)


def history(daemon, _):
    for place in ("5,1,1", "5,1,0.1", "-8,3,1.5"):
        path = f"/api/v1/history?site=long&point={place}"
        answer = daemon.get(path)
        median, greatest = median_and_greatest_ms(lambda: daemon.get(path), 5)
        print(f"{place}: {answer['scans']} scans, {len(answer['intervals'])} intervals, "
              f"median {median:.0f} ms, greatest {greatest:.0f} ms", flush=True)


def choose(daemon, _):
    for number in range(8):
        body = view_of_yard(False, number, 650, 200, place=(4.0 * number + 1, 3.0 * number + 2, 2.0))
        newest = daemon.get("/api/v1/scans?site=large&limit=1")["items"][0]["captured_at"]
        second = calendar.timegm(time.strptime(newest, "%Y-%m-%dT%H:%M:%SZ")) + 60
        scan = post_scan(daemon, body, time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(second)), "large-sensor")
        while (state := daemon.get(f"/api/v1/scans/{scan['id']}")["state"]) not in ("compared", "failed"):
            time.sleep(0.05)
        for comparison in daemon.get(f"/api/v1/comparisons?scan={scan['id']}")["items"]:
            offered = len(daemon.get(f"/api/v1/scans/{scan['id']}/candidates?comparison={comparison['id']}")["items"])
            print(f"{state} with {comparison['reference']}: {offered} offered, chosen in "
                  f"{comparison['timings_ms'].get('choose', math.nan):.1f} ms", flush=True)


class EventStream(threading.Thread):
    """Notes when each event of a scan came."""

    def __init__(self, daemon):
        super().__init__(daemon=True)
        self.came = {}
        self.socket = socket.create_connection((daemon.url.hostname, daemon.url.port))
        self.socket.sendall(b"GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n")

    def run(self):
        rest = b""
        while data := self.socket.recv(65536):
            now = time.perf_counter()
            *lines, rest = (rest + data).split(b"\n")
            for line in lines:
                if line.startswith(b"data: "):
                    event = json.loads(line[6:])
                    self.came.setdefault((event["type"], event["scan"]), now)


def latency(daemon, _):
    make_yard(daemon)
    rule = daemon.get("/api/v1/rules?site=bench")["items"][0]
    target = f"/api/v1/rules/{rule['id']}"
    for key in ("id", "created_at", "edited_at"):
        rule.pop(key)
    rule["persistence"] = {"scans": 1, "of": 1, "seconds": 0}
    daemon.call("PUT", target, rule)
    stream = EventStream(daemon)
    stream.start()
    times = []
    for number in range(30):
        box = number >= 6 and number % 2 == 0
        body = view_of_yard(box, number, 500, 200)
        start = time.perf_counter()
        scan = post_scan(daemon, body, f"2026-03-01T08:{number:02d}:00Z")
        while daemon.get(f"/api/v1/scans/{scan['id']}")["state"] != "compared":
            time.sleep(0.005)
        time.sleep(0.1)
        came = [at for (kind, of), at in stream.came.items() if of == scan["id"] and kind.startswith("alert.") and "open" in kind]
        if came:
            times.append(1000 * (came[0] - start))
    times.sort()
    print(f"{len(times)} alerts: median {times[len(times) // 2]:.0f} ms, greatest {times[-1]:.0f} ms after POST")


def stream(daemon, arguments):
    make_yard(daemon)
    bodies = [view_of_yard(number % 3 == 2, number, 650, 200) for number in range(6)]
    scans = int(arguments.seconds * arguments.rate)
    start, worst_ms, queue, memory, refused = time.perf_counter(), 0.0, 0.0, 0.0, 0
    for number in range(scans):
        time.sleep(max(0.0, start + number / arguments.rate - time.perf_counter()))
        at = 1772352000 + number / arguments.rate
        stamp = time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(at)) + f"{at % 1:.3f}"[1:] + "Z"
        began = time.perf_counter()
        post_scan(daemon, bodies[number % len(bodies)], stamp)
        worst_ms = max(worst_ms, 1000 * (time.perf_counter() - began))
        if number % 10 == 9:
            queue = max(queue, daemon.metric("raywatch_queue_length"))
            memory = max(memory, daemon.metric("raywatch_resident_memory_bytes"))
        if number % 100 == 99:
            late = time.perf_counter() - start - number / arguments.rate
            print(f"{number + 1} scans, {late:.2f} s late, queue {daemon.metric('raywatch_queue_length'):.0f}", flush=True)
    sent = time.perf_counter() - start
    while daemon.metric("raywatch_queue_length") > 0:
        time.sleep(0.05)
    print(f"{scans} scans sent in {sent:.1f} s, all compared after {time.perf_counter() - start:.1f} s; slowest answer "
          f"{worst_ms:.0f} ms; longest queue {queue:.0f} jobs; most memory {memory / 2**20:.0f} MiB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("url")
    parser.add_argument("what", choices=("lists", "history", "choose", "latency", "stream"))
    parser.add_argument("--rate", type=float, default=10.0, help="scans a second")
    parser.add_argument("--seconds", type=float, default=120.0)
    arguments = parser.parse_args()
    globals()[arguments.what](Daemon(arguments.url), arguments)


if __name__ == "__main__":
    main()
