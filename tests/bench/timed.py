"""Times a command for the scripts that measure: wall, user and system seconds apart, and peak memory."""

import os
import shlex
import subprocess
import tempfile
import time
from dataclasses import dataclass


@dataclass
class Took:
    wall: float
    user: float    # of the command and what it waited for
    system: float
    peak: int      # bytes resident, of the largest process
    said: str

    @property
    def cpu(self):
        return self.user + self.system

    @property
    def busy(self):
        """The share of all cores that it kept busy."""
        return self.cpu / self.wall / len(os.sched_getaffinity(0))


def timed(command):
    """Runs a command; where it fails, ends with what it said."""
    command = [str(word) for word in command]
    with tempfile.TemporaryFile("w+", errors="replace") as output:
        start = time.perf_counter()
        child = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        said = output.read()
    if child.returncode:
        raise SystemExit(f"{shlex.join(command)} failed:\n{said[-3000:]}")
    return Took(wall, usage.ru_utime, usage.ru_stime, usage.ru_maxrss * 1024, said)


def load():
    """The load average, for the record: other work makes seconds on the wall longer."""
    return f"{os.getloadavg()[0]:.1f}"


class Gates:
    """Rows of a table of measured values and what is demanded of them."""

    def __init__(self):
        self.rows, self.missed = [], 0
        print("| what | measured | gate | |\n|---|---|---|---|", flush=True)

    def add(self, name, value, gate, kept, unit="x"):
        self.rows.append({"name": name, "value": value, "gate": gate, "kept": kept})
        self.missed += not kept
        print(f"| {name} | {value:.2f}{unit} | {gate} | {'kept' if kept else 'MISSED'} |", flush=True)

    def note(self, name, text):
        """A row that says something and demands nothing."""
        print(f"| {name} | {text} | | |", flush=True)
