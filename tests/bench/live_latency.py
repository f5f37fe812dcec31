"""From a knob's move to the new picture, beside one comp of the same frame, in one run.

    python3 tests/bench/live_latency.py KAGEFUDE LOOK FRAME.exr [--rounds N]

Asks `kagefude live` as its page does: a change, then pictures until the change is answered. A comp is
timed between the knobs, so that both have the same machine; medians are compared. What is seen first counts:
every n-th pixel where a knob takes longer than the hand waits. Then 500 changes come
as fast as they are taken: the last must be the one that is seen, and memory stay flat. Exit 1 when a
gate is missed.
"""

import argparse
import http.client
import json
import os
import pathlib
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import urllib.parse

# Name, overrides (&), the two values between which the knob goes, and the gate as a share of a comp.
KNOBS = [
    ("strip", "style[0].strip=\"builtin:{}\"", ("soft", "fine"), 0.25),
    ("contrast", "brush.contrast={}", (0.4, 0.5), 0.25),
    ("brush", "brush.pole_fade={}", (0.4, 0.6), 0.25),
    ("tone", "tone.gamma={}", (1.1, 1.2), 0.35),
    ("shade", "shade.wrap={}", (0.1, 0.2), 0.35),
    ("shadow", "shadow.strength={}", (0.8, 0.9), 0.8),
    ("search", "light_shape.light_size={}", (0.8, 0.9), 0.8),
    ("smoothing", "smooth.all_methods=true & smooth.h={}", (2, 3), 0.8),
]


def change(overrides):
    return json.dumps({"overrides": overrides.split(" & ")})


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
        """Milliseconds until the picture is here, and its state."""
        start = time.perf_counter()
        wanted = json.loads(self.ask("POST", "change", change(override)))["change"]
        while (state := self.picture())["change"] < wanted:
            pass
        if state["error"]:
            sys.exit(f"{override}: {state['error']}")
        return 1e3 * (time.perf_counter() - start), state


def resident(process):
    """Megabytes."""
    for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024


def cpu(process):
    """Milliseconds that its threads have worked."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return 1e3 * (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def hurry(page, process):
    """500 changes without waiting for a picture; True when a gate is missed."""
    knobs = [override.format(value) for _, override, values, _ in KNOBS for value in values]
    for knob in knobs:
        page.turn(knob)
    before, start = resident(process), time.perf_counter()
    for i in range(500):
        last = json.loads(page.ask("POST", "change", change(knobs[i % len(knobs)])))
    seen = 1
    while page.picture()["change"] < last["change"]:
        seen += 1
    took, after = time.perf_counter() - start, resident(process)
    missed = after > 1.1 * before
    print(f"500 changes in {took:.1f} s, {seen} pictures waited for; memory {before:.0f} MB before, "
          f"{after:.0f} MB after: {'MISSED' if missed else 'kept'}")
    return missed


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
            while "size" not in (state := page.picture()):
                if state["error"]:
                    sys.exit(state["error"])
            first = time.perf_counter() - start
            missed = measure(page, program.pid, comp, options.rounds, first)
            missed |= hurry(page, program.pid)
        finally:
            program.terminate()
            program.wait()
    return 1 if missed else 0


def measure(page, process, comp, rounds, first):
    comps, worked = [], 0
    turns, works, states = ({name: [] for name, *_ in KNOBS} for _ in range(3))
    for _ in range(rounds):
        start = time.perf_counter()
        child = subprocess.Popen(comp, stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        comps.append(1e3 * (time.perf_counter() - start))
        if status:
            sys.exit("the comp failed")
        worked += 1e3 * (usage.ru_utime + usage.ru_stime) / rounds
        for name, override, values, _ in KNOBS:
            # The first turn also turns the knob before back.
            page.turn(override.format(values[0]))
            before = cpu(process)
            took, state = page.turn(override.format(values[1]))
            turns[name].append(took)
            states[name].append(state)
            works[name].append(cpu(process) - before)
    whole = statistics.median(comps)
    print(f"first picture {first:.2f} s; comp {whole:.0f} ms, {worked:.0f} ms of CPU (median of {rounds})")
    print("| knob | ms | every n-th pixel | of a comp | gate | ms of CPU | made |\n|---|---|---|---|---|---|---|")
    missed = first > 1
    for name, _, _, gate in KNOBS:
        took = statistics.median(turns[name])
        kept = took <= gate * whole
        missed |= not kept
        step = statistics.median_low(state["step"] for state in states[name])
        print(f"| {name} | {took:.0f} | {step} | {took / whole:.2f} | {gate} {'kept' if kept else 'MISSED'} | "
              f"{statistics.mean(works[name]):.0f} | {', '.join(states[name][-1]['made'])} |")
    return missed


if __name__ == "__main__":
    sys.exit(main())
