"""From a knob's move to the new picture, beside one comp of the same frame, in one run.

    python3 tests/bench/live_latency.py KAGEFUDE LOOK FRAME.exr [--rounds N]

Asks `kagefude live` as its page does: a change, then pictures until the change is answered. A comp is
timed between the knobs, so that both have the same machine; medians are compared. Exit 1 when a gate
is missed.
"""

import argparse
import http.client
import json
import pathlib
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import urllib.parse

# Name, the two values between which the knob goes, and the gate as a share of a comp.
KNOBS = [
    ("strip", "style[0].strip=\"builtin:{}\"", ("soft", "fine"), 0.25),
    ("contrast", "brush.contrast={}", (0.4, 0.5), 0.25),
    ("brush", "brush.pole_fade={}", (0.4, 0.6), 0.25),
    ("tone", "tone.gamma={}", (1.1, 1.2), 0.35),
    ("shade", "shade.wrap={}", (0.1, 0.2), 0.35),
    ("shadow", "shadow.strength={}", (0.8, 0.9), 0.8),
    ("search", "light_shape.light_size={}", (0.8, 0.9), 0.8),
    ("smoothing", "smooth.h={}", (2, 3), 0.8),
]


class Page:
    def __init__(self, address):
        url = urllib.parse.urlparse(address)
        self.base = url.path
        self.connection = http.client.HTTPConnection(url.netloc)
        self.version = 0

    def ask(self, method, path, body=None):
        self.connection.request(method, self.base + path, body)
        answer = self.connection.getresponse().read()
        return answer

    def picture(self):
        answer = self.ask("GET", f"picture?seen={self.version}&stage=result")
        length, = struct.unpack("<I", answer[:4])
        state = json.loads(answer[4:4 + length])
        self.version = state["version"]
        return state

    def turn(self, override):
        """Milliseconds until the picture is here, and the stages that were made for it."""
        start = time.perf_counter()
        wanted = json.loads(self.ask("POST", "change", json.dumps({"overrides": [override]})))["change"]
        while (state := self.picture())["change"] < wanted:
            pass
        if state["error"]:
            sys.exit(f"{override}: {state['error']}")
        return 1e3 * (time.perf_counter() - start), state["made"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kagefude")
    parser.add_argument("look")
    parser.add_argument("frame")
    parser.add_argument("--rounds", type=int, default=9)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        comp = [options.kagefude, "comp", options.look, options.frame, "-o",
                str(pathlib.Path(folder, "out.exr")), "--progress", "none"]
        start = time.perf_counter()
        program = subprocess.Popen([options.kagefude, "live", options.look, options.frame, "--no-open"],
                                   stdout=subprocess.PIPE, text=True)
        try:
            page = Page(program.stdout.readline().strip())
            while "size" not in page.picture():
                pass
            first = time.perf_counter() - start
            missed = measure(page, comp, options.rounds, first)
        finally:
            program.terminate()
            program.wait()
    return 1 if missed else 0


def measure(page, comp, rounds, first):
    comps, turns, made = [], {name: [] for name, *_ in KNOBS}, {}
    for round_ in range(rounds):
        start = time.perf_counter()
        subprocess.run(comp, check=True)
        comps.append(1e3 * (time.perf_counter() - start))
        for name, override, values, _ in KNOBS:
            # The first turn also turns the knob before back.
            page.turn(override.format(values[0]))
            took, made[name] = page.turn(override.format(values[1]))
            turns[name].append(took)
    whole = statistics.median(comps)
    print(f"first picture {first:.2f} s; comp {whole:.0f} ms (median of {rounds})")
    print("| knob | ms | of a comp | gate | made |\n|---|---|---|---|---|")
    missed = first > 1
    for name, _, _, gate in KNOBS:
        took = statistics.median(turns[name])
        kept = took <= gate * whole
        missed |= not kept
        print(f"| {name} | {took:.0f} | {took / whole:.2f} | {gate} {'kept' if kept else 'MISSED'} | "
              f"{', '.join(made[name])} |")
    return missed


if __name__ == "__main__":
    sys.exit(main())
