"""Watches an output folder until a file STOP appears: every file that is seen under a final name must
be, the moment it is seen, byte for byte the one of the reference folder.

    watch_folder.py REFERENCE OUTPUT STOP
"""
import os
import sys
import time


def contents(path):
    with open(path, "rb") as file:
        return file.read()


def main(reference, output, stop):
    expected = {name: contents(os.path.join(reference, name)) for name in os.listdir(reference)}
    seen = set()
    wrong = 0
    ended = False
    while not ended:
        ended = os.path.exists(stop)
        for entry in os.scandir(output):
            if entry.name.startswith("."):
                continue
            status = entry.stat()
            key = (entry.name, status.st_ino, status.st_mtime_ns)
            if key in seen:
                continue
            seen.add(key)
            try:
                found = contents(entry.path)
            except FileNotFoundError:
                continue
            if found != expected.get(entry.name):
                wrong += 1
                print(f"{entry.name} is seen with {len(found)} bytes that are not the frame's")
        time.sleep(0.0005)
    print(f"watched {len(seen)} files appear, {wrong} wrong")
    return 1 if wrong or not seen else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
