# SPDX-License-Identifier: Apache-2.0
"""Measures what shot.sh says."""

import argparse
import glob
import os
import re
import shutil
import subprocess
import sys

import cost
from timed import load

# The lamp moves, so that nothing of a frame can be kept for the next.
MAKE_SHOT = """
import bpy
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = {width}, {height}
scene.frame_start, scene.frame_end = 1, {frames}
scene.cycles.samples = {samples}
lamp = bpy.data.objects["Key"]
for frame in (1, {frames}):
    lamp.location.x = -2.6 + 0.04 * (frame - 1)
    lamp.keyframe_insert("location", frame=frame)
bpy.ops.wm.save_as_mainfile(filepath={path!r})
"""
LOOK = '[output]\nlayers = ["visibility.*", "brush.tone"]\n'
CODECS = ("none", "zips", "zip:9", "piz", "dwaa")
LOSSY = ("dwaa",)
UNREAD = ("data.UV", "data.Depth", "data.InstanceRandom", "data.IndexMA")


def make_shot(scene, options):
    path = os.path.abspath(f"{scene}/{scene}.blend")
    cost.make_scene(scene, path)
    width, height = options.size.split("x")
    program = MAKE_SHOT.format(width=width, height=height, frames=max(options.frames, 24),
                               samples=options.samples, path=path)
    cost.blender(path, "--python-exit-code", "3", "--python-expr", program)
    return path


def report_seconds(folder):
    """Seconds that the frames of a report took to read, to compute and to write."""
    with open(f"{folder}/report/index.html", encoding="utf-8") as file:
        rows = re.findall(r'<tr id=.*?</tr>', file.read(), re.DOTALL)
    times = [[float(word) for word in re.findall(r'<td class="n">([0-9.]+)</td>', row)[1:4]] for row in rows]
    return [sum(each) for each in zip(*times)]


def megabytes(pattern, count):
    """Of what a frame has on the disk."""
    return sum(map(os.path.getsize, glob.glob(pattern))) / count / 1e6


def one_at_a_time(folder, count, *words):
    return cost.comp("look.toml", folder, "--frames-at-once", "1", "--report", f"{folder}/report", *words,
                     frames=f"1-{count}")


def shot_rows(scene, path, options):
    """Exports and comps the whole shot; rows of the first table."""
    count, frames = options.frames, f"1-{options.frames}"
    folder = f"{scene}/shot"
    plain = cost.plain(path, options.samples, f"1..{count}")
    exported = cost.export(path, folder, frames=frames)
    read = megabytes(f"{folder}/s.*", count)
    one_at_a_time(folder, count)  # also warms up
    parts = report_seconds(folder)
    comped = cost.comp("look.toml", folder, frames=frames)
    written = megabytes(f"{folder}/comp.*.exr", count)

    def row(what, took, size=""):
        return (f"| {scene} | {what} | {took.wall:.0f} | {took.user:.0f} | {took.system:.0f} | "
                f"{took.wall / count:.2f} | {took.cpu / count:.2f} | {size} |")
    yield row(f"Blender, the beauty alone ({options.samples} a pixel)", plain)
    yield row("Blender, the export", exported, f"{read:.1f}")
    yield row("comp", comped, f"{written:.1f}")
    for what, seconds in zip(("reading", "computing", "writing"), parts):
        yield (f"| {scene} | of it {what}: {seconds / sum(parts):.0%} | {seconds:.1f} | | | "
               f"{seconds / count:.2f} | | |")
    whole = exported.cpu + comped.cpu
    yield (f"| {scene} | **Blender to the last frame** | {exported.wall + comped.wall:.0f} | "
           f"{exported.user + comped.user:.0f} | {exported.system + comped.system:.0f} | "
           f"{(exported.wall + comped.wall) / count:.2f} | {whole / count:.2f} | "
           f"comp: {comped.cpu / whole:.0%} of CPU |")


def channels_of(path):
    said = subprocess.run(["oiiotool", "--info", "-v", path], check=True, capture_output=True, text=True).stdout
    return re.search(r"channel list: (.*)", said)[1].split(", ")


def oiiotool(*words):
    subprocess.run(["oiiotool", *words], check=True)


def pack(source, target, how):
    """Writes a frame anew with another codec, or other channels, types or parts."""
    names = channels_of(source)
    if how in CODECS:
        oiiotool(source, "--compression", how, "-o", target)
    elif how == "masks and beauty as half":
        halves = [name for name in names if name.startswith(("mask.", "beauty."))]
        types = [word for name in halves for word in ("-d", f"{name}=half")]
        oiiotool(source, "-d", "float", *types, "--compression", "zip", "-o", target)
    elif how == "without UV, Depth and material ids":
        kept = [name for name in names if name.rpartition(".")[0] not in UNREAD]
        oiiotool(source, "--ch", ",".join(kept), "--compression", "zip", "-o", target)
    else:  # a part a pass
        passes = {}
        for name in names:
            passes.setdefault(name.rpartition(".")[0], []).append(name)
        words = []
        for number, (title, channels) in enumerate(passes.items()):
            words += [source, "--ch", ",".join(channels), "--attrib", "oiio:subimagename", title]
            words += ["--siappend"] if number else []
        oiiotool(*words, "--compression", "zip", "-o", target)


def copy_packed(source, target, how, count):
    os.makedirs(target)
    for number in range(1, count + 1):
        name = f"s.{number:04}"
        pack(f"{source}/{name}.exr", f"{target}/{name}.exr", how)
        for path in glob.glob(f"{source}/{name}.json") + glob.glob(f"{source}/s.*.depth.{number:04}.exr"):
            shutil.copy(path, target)


def difference(folder, base, count):
    """The RMS difference of the pictures of two comps, and whether all their bits are the same."""
    total, same = 0.0, True
    for number in range(1, count + 1):
        name = f"comp.{number:04}.exr"
        said = subprocess.run(["oiiotool", "--fail", "0", "--warn", "0", f"{folder}/{name}", f"{base}/{name}",
                               "--diff"], capture_output=True, text=True).stdout
        same &= "PASS" in said
        rms = re.search(r"RMS error = (\S+)", said)
        total += float(rms[1]) if rms else 0.0
    return total / count, same


def choice_rows(scene, path, options, version):
    """Rows of the second table, each with whether it kept the picture as it must."""
    count = options.choice_frames
    by = "raycast" if tuple(map(int, version.split("."))) >= (5, 1) else "occlusion"
    base = f"{scene}/choice"

    def least_of_comps(folder, *words):
        """Columns: the least seconds a frame of three comps, to which other work only adds."""
        parts = []
        for _ in range(3):
            took = one_at_a_time(folder, count, *words)
            parts.append((*report_seconds(folder), took.cpu))
        return " | ".join(f"{min(each) / count:.2f}" for each in zip(*parts))

    def row(what, folder, exported=None, base=None, lossless=False):
        seconds = least_of_comps(folder)
        blender = f"{exported.cpu / count:.1f}" if exported else ""
        rms, same = difference(folder, base, count) if base else (0.0, True)
        picture = "" if not base else "the same bits" if same else f"RMS {rms:.4f}"
        kept = same or not lossless
        return (f"| {scene} | {what} | {blender} | {megabytes(f'{folder}/s.*', count):.1f} | {seconds} | "
                f"{picture}{'' if kept else ', MISSED'} |"), kept

    exports = (("as exported: nine masks, zip", ()), ("`--masks disc:5`", ("--masks", "disc:5")),
               ("`--masks pair`, with the map", ("--masks", "pair")),
               (f"`--masks-by {by}`", ("--masks-by", by)), ("`--depth-size 512`", ("--depth-size", "512")))
    for what, words in exports:
        folder = base if not words else f"{scene}/other"
        shutil.rmtree(folder, ignore_errors=True)
        exported = cost.export(path, folder, *words, frames=f"1-{count}")
        yield row(what, folder, exported, base if words else None)
    for how in (*CODECS, "masks and beauty as half", "without UV, Depth and material ids", "a part a pass"):
        folder = f"{scene}/packed"
        shutil.rmtree(folder, ignore_errors=True)
        copy_packed(base, folder, how, count)
        yield row(how, folder, None, base, how not in LOSSY and how != "masks and beauty as half")
        shutil.rmtree(folder)
    for how in ("none", "zips", "piz"):
        seconds = least_of_comps(base, "--set", f"output.compression={how}")
        size = megabytes(f"{base}/comp.*", count)
        yield f"| {scene} | comp written as {how}: {size:.1f} MB | | | {seconds} | |", True


def main():
    parser = argparse.ArgumentParser(prog="shot.sh", allow_abbrev=False)
    parser.add_argument("--frames", default=24, type=int)
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--scenes", default=["ball_and_box", "heads"], type=lambda t: t.split(","))
    parser.add_argument("--samples", default=1, type=int)
    parser.add_argument("--choice-frames", default=3, type=int)
    options = parser.parse_args()
    version = cost.blender_version()
    folder = os.path.join(cost.ROOT, "build", "shot", version)
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    with open("look.toml", "w", encoding="utf-8") as file:
        file.write(LOOK)
    print(f"Blender {version}, {options.frames} frames of {options.size}, {options.samples} a pixel; "
          f"load {load()} before\n")
    if options.frames:
        print("| scene | what | wall s | user s | system s | wall s a frame | CPU s a frame | MB a frame |\n"
              "|---|---|---|---|---|---|---|---|", flush=True)
    shots = {}
    for scene in options.scenes:
        shutil.rmtree(scene, ignore_errors=True)
        os.makedirs(scene)
        shots[scene] = make_shot(scene, options)
        for row in shot_rows(scene, shots[scene], options) if options.frames else ():
            print(row, flush=True)
    print(f"\nEach choice: the first {options.choice_frames} frames; seconds a frame; load {load()}\n")
    print("| scene | choice | Blender, CPU | MB | read | compute | write | comp, CPU | picture |\n"
          "|---|---|---|---|---|---|---|---|---|", flush=True)
    missed = 0
    for scene, path in shots.items():
        for row, kept in choice_rows(scene, path, options, version):
            print(row, flush=True)
            missed += not kept
    print(f"\nload {load()} after")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
