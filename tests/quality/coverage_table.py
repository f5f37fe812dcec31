#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the six scenes of the coverage comparison and prints its table:

    tests/quality/coverage_table.py COVERAGE_COMPARE FOLDER [SCENE …]

COVERAGE_COMPARE is the built program; pictures and renders go to FOLDER and are kept, so a second
run only compares. Beside SCENE_coverage.png and SCENE_volume.png (ours, Blender's, difference) it
writes coverage.png, all scenes on one sheet. Exit code 1 when a demand is missed.
"""

import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
EXPORTER = os.path.join(HERE, "..", "..", "blender_export", "export_aovs.py")
SCENES = ["open_meshes", "concave", "contact", "behind_camera", "inside_volume", "many_triangles"]
WIDTH, HEIGHT = 240, 135
TITLES = ["scene", "triangles", "edge pixels", "mean error", "worst", "of them at silhouettes",
          "mean error there", "wrong off the edges", "left out (terminator)", "seconds"]


def blender(*words):
    done = subprocess.run(["blender", "-b", *words], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        sys.exit(f"blender failed:\n{done.stdout}")


def render(scene, size, folder):
    """The frame at 1 or 8 times the base size; the path of its image."""
    name = f"{scene}_{size}"
    image = os.path.join(folder, f"{name}.exr")
    if not os.path.exists(image):
        blend = os.path.join(folder, f"{name}.blend")
        blender("--factory-startup", "--python-exit-code", "3", "-P",
                os.path.join(HERE, "coverage_scenes.py"), "--", scene, str(WIDTH * size),
                str(HEIGHT * size), blend)
        blender(blend, "--python-exit-code", "3", "-P", EXPORTER, "--", "--output", image,
                "--casters", "--masks", "disc:5", "--offset", "0.1", "--depth-size", "16")
    return image


def main(program, folder, *scenes):
    folder = os.path.abspath(folder)  # Blender saves to absolute paths only
    os.makedirs(folder, exist_ok=True)
    print("| " + " | ".join(TITLES) + " |")
    print("|" + "---|" * len(TITLES), flush=True)
    good = True
    chosen = scenes or SCENES
    for scene in chosen:
        frame, fine = (render(scene, size, folder) for size in (1, 8))
        for method in ("coverage", "volume"):
            picture = os.path.join(folder, f"{scene}_{method}.png")
            done = subprocess.run([program, scene, frame, fine, picture, method], check=False)
            good &= done.returncode == 0
    sheet = [os.path.join(folder, f"{scene}_coverage.png") for scene in chosen]
    subprocess.run(["oiiotool", *sheet, "--mosaic:pad=4", f"1x{len(sheet)}", "-o",
                    os.path.join(folder, "coverage.png")], check=True)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
