# SPDX-License-Identifier: GPL-3.0-or-later
"""Which layers go into a frame's image, and how one image is rendered, checked and put in place."""

import glob
import os

import bpy

from . import compat, exr_header
from .errors import ExportError
from .export_scenes import DATA_PASSES, NOT_BEAUTY
from .layer_writer import Writer
from .output_names import LONGEST_LAYER
from .seen_points import SeenPoints

# The beauty's normals are the mean of all its samples: with the Cryptomatte they tell which sides of
# a thing share a pixel, where the data's one sample knows one of them.
MEAN_NORMAL = "MeanNormal"

# Not the beginning of the other part's name, and cleaned up by the same pattern.
SEEN = ".seen.part"


def shot_writer(beauty_scene, beauty_layer, data, middle_masks):
    """The writer of a frame: data, Cryptomatte, beauty, masks and truth, and notes on what is left out.

    `middle_masks` are layers that SeenPoints is to know of.
    """
    writer = Writer(beauty_scene, "shot")
    # Scenes are rendered in the order of their nodes, and one that keeps no data throws away what
    # others keep: the beauty goes first, so that the depth maps find the data scene's geometry.
    beauty = writer.source(beauty_scene, beauty_layer.name)
    node = writer.source(data.scene, "data")
    for name in DATA_PASSES + (("Emit",) if data.emission else ()):
        writer.add_pass(node, name, f"data.{name}")
    notes = _add_beauty(writer, beauty)
    for layer, reading in data.layers.items():
        writer.add_reading(layer, reading)
    if middle_masks:
        writer.keep_for_seen_points(node, middle_masks)
    return writer, notes


def depth_writer(depth_scene, size):
    writer = Writer(depth_scene, "light depth")
    writer.scene.render.resolution_x = writer.scene.render.resolution_y = size
    writer.add_pass(writer.source(depth_scene, "depth"), "Depth", "Depth")
    return writer


def _add_beauty(writer, node):
    """The beauty with the light passes that the artist turned on; Cryptomatte goes to the data.

    Cryptomatte comes from the beauty render, so that its coverage has the artist's filter and
    samples and agrees with the edges of his picture.
    """
    notes = []
    for socket in node.outputs:
        name = compat.pass_name(socket.name)
        if socket.enabled and name == "Normal":
            writer.add(socket, f"data.{MEAN_NORMAL}")
        if not socket.enabled or name in NOT_BEAUTY or name.startswith(("Denoising", "Noisy", "Debug")):
            continue
        layer = f"data.{name}" if name.startswith(("CryptoObject", "CryptoMaterial")) \
            else f"beauty.{name}"
        if len(layer.encode("utf-8")) > LONGEST_LAYER:
            notes.append(f"the pass '{name}' is left out: its name is too long for Blender's "
                         f"File Output node")
        else:
            writer.add(socket, layer)
    return notes


def render(writer, frame, path):
    """Render `writer`'s sources at `frame` into a part file beside `path`; returns the part's path."""
    base = _ready(writer.file, path, ".part")
    if writer.seen_file:
        _ready(writer.seen_file, path, SEEN)
    writer.scene.frame_set(frame)
    bpy.ops.render.render(scene=writer.scene.name)
    part = _written(base, frame, path)
    _check_layers(part, writer.names, frame)
    return part


def seen_points(frame, path):
    """What the frame shows that was just rendered for `path`."""
    return SeenPoints(_written(_base(path, SEEN), frame, path))


def _base(path, ending):
    folder, name = os.path.split(path)
    return os.path.join(folder, f".{name}{ending}")


def _ready(file, path, ending):
    base = _base(path, ending)
    for old in glob.glob(glob.escape(base) + "*"):
        os.remove(old)
    file.set_path(base)
    return base


def _written(base, frame, path):
    parts = glob.glob(glob.escape(base) + "*")
    if len(parts) != 1:
        raise ExportError(f"frame {frame}: Blender wrote no image for {path}; see its messages "
                          f"above")
    return parts[0]


def _check_layers(part, names, frame):
    written = {channel.rpartition(".")[0] for channel in exr_header.channel_names(part)}
    missing = [name for name in names if name not in written]
    if missing:
        raise ExportError(f"frame {frame}: Blender did not write the layer '{missing[0]}'")
