# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the error of each kind of edge against the same picture painted at eight times the size, and
lays crops side by side: one sample, the truth, two by two samples. Called by edges.sh:

    edges_table.py FOLDER SCENE ...

The large picture is brought down twice: through a box, each pixel the mean of its own 64, and
through Blender's own pixel filter (Blackman-Harris, which for Cycles' width of 1.5 reaches over
three pixels), by which the beauty and the Cryptomattes of all sizes are filtered.
"""

import os
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from exr_planes import read_planes  # noqa: E402  (after the path)

SCALE = 8
KINDS = ("silhouette", "between", "material", "occlusion", "crease", "shadow", "elsewhere")
CROP, ZOOM = (96, 64), 6
FAR = 6.0        # a step between neighbours, in times the pixel's usual one, that is an occlusion
BENT = 0.866     # cosine between the normals of neighbours below which they meet in a crease
SHADED = 0.15    # change of the mean mask within a pixel that is a shadow's edge


def blocks(plane):
    """Rows by columns of the small picture, and its 64 values each."""
    height, width = plane.shape
    cut = plane.reshape(height // SCALE, SCALE, width // SCALE, SCALE)
    return cut.swapaxes(1, 2).reshape(height // SCALE, width // SCALE, SCALE * SCALE)


def square(plane):
    """The same with the 64 values as a square."""
    return blocks(plane).reshape(plane.shape[0] // SCALE, plane.shape[1] // SCALE, SCALE, SCALE)


def many(plane):
    """Where a pixel holds more than one value."""
    cut = blocks(plane)
    return cut.min(axis=2) != cut.max(axis=2)


def neighbours(planes, measure):
    """What `measure` says of every two neighbours within each pixel, all in one row a pixel."""
    cuts = [square(plane) for plane in planes]
    results = []
    for near, far in (((Ellipsis, slice(None), slice(0, -1)), (Ellipsis, slice(None), slice(1, None))),
                      ((Ellipsis, slice(0, -1), slice(None)), (Ellipsis, slice(1, None), slice(None)))):
        result = measure([cut[near] for cut in cuts], [cut[far] for cut in cuts])
        results.append(result.reshape(*result.shape[:2], -1))
    return np.concatenate(results, axis=2)


def kinds_of(path):
    """The kind of every pixel of the small picture, as a place in KINDS."""
    masks = [f"mask.Key.{k}.V" for k in range(9)]
    if "character" in path:
        masks = [name.replace("Key", "Sun") for name in masks]
    axes = [f"data.Normal.{axis}" for axis in "XYZ"] + [f"data.Position.{axis}" for axis in "XYZ"]
    planes = read_planes(path, ["data.CryptoObject00.R", "data.CryptoMaterial00.R", *axes, *masks])
    thing, stuff = planes["data.CryptoObject00.R"], planes["data.CryptoMaterial00.R"]
    # Outermost coverage of the large picture is a matter of its own filter: the surface counts.
    thing[(planes[axes[0]] == 0) & (planes[axes[1]] == 0) & (planes[axes[2]] == 0)] = 0
    normal, position = [planes[name] for name in axes[:3]], [planes[name] for name in axes[3:]]
    cosine = neighbours(normal, lambda a, b: sum(p * q for p, q in zip(a, b))).min(axis=2)
    step = neighbours(position, lambda a, b: np.sqrt(sum((p - q) ** 2 for p, q in zip(a, b))))
    torn = step.max(axis=2) > FAR * np.median(step, axis=2)
    lit = blocks(sum(planes[name] for name in masks) / len(masks))
    kinds = np.full(cosine.shape, KINDS.index("elsewhere"))
    for kind, where in (("shadow", lit.max(axis=2) - lit.min(axis=2) > SHADED), ("crease", cosine < BENT),
                        ("occlusion", torn), ("material", many(stuff)), ("between", many(thing)),
                        ("silhouette", many(thing) & (blocks(np.abs(thing)).min(axis=2) == 0))):
        kinds[where] = KINDS.index(kind)
    kinds[blocks(np.abs(thing)).max(axis=2) == 0] = -1
    return kinds


def remembered(folder, scene):
    """kinds_of, kept beside the render."""
    kept = os.path.join(folder, scene, "kinds.npy")
    source = os.path.join(folder, scene, "scale8", f"{scene}.0001.exr")
    newest = max(os.path.getmtime(source), os.path.getmtime(__file__))
    if not os.path.exists(kept) or os.path.getmtime(kept) < newest:
        np.save(kept, kinds_of(source))
    return np.load(kept)


def picture(folder, scene, scale):
    planes = read_planes(os.path.join(folder, scene, f"comp{scale}.exr"), ["R", "G", "B", "A"])
    return np.stack([planes[name] for name in "RGBA"], axis=2)


def box(offset):
    return (np.abs(offset) < 0.5).astype(float)


def blackman_harris(offset):
    turn = 2 * np.pi * (offset / 3 + 0.5)
    value = 0.35875 - 0.48829 * np.cos(turn) + 0.14128 * np.cos(2 * turn) - 0.01168 * np.cos(3 * turn)
    return np.where(np.abs(offset) < 1.5, value, 0.0)


def brought_down(plane, weight):
    """The large picture through a separable filter, in linear light."""
    reach = SCALE * 3 // 2
    places = np.arange(-reach, reach) + 0.5
    weights = weight(places / SCALE)
    for axis in (0, 1):
        pad = [(0, 0)] * plane.ndim
        pad[axis] = (reach, reach)
        padded, count, total = np.pad(plane, pad, mode="edge"), plane.shape[axis] // SCALE, 0
        for place, share in zip(places, weights / weights.sum()):
            first = int(reach + SCALE / 2 + place - 0.5)
            total = total + share * np.take(padded, range(first, first + SCALE * count, SCALE), axis)
        plane = total
    return plane


def oiio(*words):
    subprocess.run(["oiiotool", *map(str, words)], check=True)


def side_by_side(folder, scene, error):
    """The crop with the greatest error, zoomed: one sample, truth, two by two."""
    wide, high = CROP
    sums = np.pad((error ** 2).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    inside = sums[high:, wide:] - sums[:-high, wide:] - sums[high:, :-wide] + sums[:-high, :-wide]
    top, left = np.unravel_index(inside.argmax(), inside.shape)
    words = []
    for scale in (1, SCALE, 2):
        words += [os.path.join(folder, scene, f"comp{scale}.exr"), "--ch", "R,G,B"]
        if scale == SCALE:
            words += ["--resize:filter=box", f"{error.shape[1]}x{error.shape[0]}"]
        words += ["--cut", f"{wide}x{high}+{left}+{top}",
                  "--resize:filter=box", f"{wide * ZOOM}x{high * ZOOM}"]
    oiio(*words, "--mosaic:pad=6", "3x1", "--colorconvert", "linear", "sRGB",
         "-o", os.path.join(folder, scene, "side_by_side.png"))


def rmse(error, where):
    return np.sqrt((error[where][:, :3] ** 2).mean())


def main(folder, scenes):
    print(f"{'RMSE in linear light':36} {'box':>15} {'own filter':>15}")
    print(f"{'scene':16} {'kind':11} {'pixels':>7} {'one':>7} {'two':>7} {'one':>7} {'two':>7}")
    for scene in scenes:
        kinds = remembered(folder, scene)
        large = picture(folder, scene, SCALE)
        small = {scale: picture(folder, scene, scale) for scale in (1, 2)}
        errors = [small[scale] - truth for truth in (brought_down(large, box),
                                                     brought_down(large, blackman_harris))
                  for scale in (1, 2)]
        for number, kind in enumerate(KINDS):
            here = kinds == number
            if here.sum() >= 20:
                print(f"{scene:16} {kind:11} {here.sum():7}",
                      *(f"{rmse(error, here):7.4f}" for error in errors))
        if scene.startswith("rim_"):
            print(f"{scene:16} {'alpha, worst':19}",
                  *(f"{np.abs(error[..., 3]).max():7.4f}" for error in errors))
        side_by_side(folder, scene, np.sqrt((errors[2][..., :3] ** 2).mean(axis=2)))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
