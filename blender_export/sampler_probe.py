# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds out which way the Ambient Occlusion node of this Blender sends its one ray.

With one sample, and with the sampler told to use the same numbers in every pixel
(`scrambling_distance` 0), the node's ray leaves at a fixed turn from the normal that it is given.
Where that turn is known it can be undone, and the node tells whether a point of our choice is
seen: a hard shadow mask without a lamp (see mask_nodes). The turn is measured, not assumed: a
small scene with one straight edge is rendered, and the place of the edge's shadow read off.

The ray is d_x T + d_y N x T + d_z N with T the unit vector across N and (1, 1, 1), and (d_x, d_y,
d_z) a fixed point of the unit hemisphere. A long N leaves no room for d_x, which has no length to
grow with; with N upright the edge at x = 0, one unit above, then shades from x = -(d_y / d_z) /
sqrt(2) on, and with a unit N from x = -(d_x + d_y) / d_z / sqrt(2) on.
"""

import math
import os
import shutil
import tempfile
from dataclasses import dataclass

import bpy

from . import compat
from .export_scenes import PREFIX, exact_scene
from .sight_nodes import LONG

# Seeds with a small turn, in the samplers of 3.4 and of 4.x.
SEEDS = (265, 1492)
LARGEST_TURN = 0.02
_PIXELS = 512


@dataclass
class SamplerTurn:
    seed: int
    slope: float    # d_y / d_z
    height: float   # d_z


def measure_turn():
    """The turn of this Blender's sampler, or None where no fixed and small one was found."""
    folder = tempfile.mkdtemp(prefix="kagefude-")
    stage = _Stage(os.path.join(folder, "edge.exr"))
    try:
        for seed in SEEDS:
            turn = _measure(stage, seed)
            if turn:
                return turn
        return None
    finally:
        stage.remove()
        shutil.rmtree(folder, ignore_errors=True)


def steady_sampler(scene, seed):
    """Let the scene use the same random numbers in every pixel."""
    compat.use_tabulated_sampler(scene.cycles)
    compat.set_if_known(scene.cycles, scrambling_distance=0.0, auto_scrambling_distance=False,
                        seed=seed)


def _measure(stage, seed):
    steady_sampler(stage.scene, seed)
    steep = stage.edge(LONG, -0.05, 0.05)
    plain = stage.edge(1.0, -8.0, 8.0) if steep is not None else None
    if plain is None:
        return None
    slope = -math.sqrt(2.0) * steep
    side = -math.sqrt(2.0) * plain - slope
    if abs(slope) > LARGEST_TURN:
        return None
    return SamplerTurn(seed, slope, 1.0 / math.sqrt(1.0 + slope * slope + side * side))


class _Stage:
    """A floor whose colour is the node's answer, half a roof above it, and a camera looking down."""

    def __init__(self, path):
        self.path = path
        self.scene = exact_scene(bpy.context.scene, "sampler")
        render = self.scene.render
        render.use_compositing, render.use_persistent_data = False, True
        render.resolution_x, render.resolution_y, render.resolution_percentage = _PIXELS, 4, 100
        render.pixel_aspect_x = render.pixel_aspect_y = 1.0
        render.use_border = render.use_file_extension = False
        compat.set_if_known(render.image_settings, media_type='IMAGE')
        render.image_settings.file_format, render.image_settings.color_depth = 'OPEN_EXR', '32'
        render.filepath = path
        self.material = self._material()
        self._mesh("floor", (-32.0, 32.0), 0.0)
        self._mesh("roof", (0.0, 512.0), 1.0).visible_camera = False
        self.camera = bpy.data.objects.new(PREFIX + "sampler", bpy.data.cameras.new("sampler"))
        self.camera.data.type = 'ORTHO'
        self.scene.collection.objects.link(self.camera)
        self.scene.camera = self.camera

    def edge(self, length, low, high):
        """The x between `low` and `high` where the roof begins to hide, or None if there is none."""
        self.normal.inputs[2].default_value = length
        self.occlusion.inputs["Distance"].default_value = 100.0 / length
        for _ in range(3):
            self.camera.location = (0.5 * (low + high), 0.0, 0.5)
            self.camera.data.ortho_scale = high - low
            lit = [value > 0.5 for value in self._row()]
            count = sum(lit)
            if count in (0, _PIXELS) or not all(lit[:count]):
                return None
            step = (high - low) / _PIXELS
            found = low + count * step
            low, high = found - 1.5 * step, found + 1.5 * step
        return found

    def remove(self):
        for item in list(self.scene.collection.objects):
            data = item.data
            bpy.data.objects.remove(item)
            (bpy.data.cameras if isinstance(data, bpy.types.Camera) else bpy.data.meshes).remove(data)
        bpy.data.materials.remove(self.material)
        bpy.data.scenes.remove(self.scene)

    def _row(self):
        bpy.ops.render.render(scene=self.scene.name, write_still=True)
        image = bpy.data.images.load(self.path)
        try:
            return list(image.pixels)[0:4 * _PIXELS:4]
        finally:
            bpy.data.images.remove(image)

    def _material(self):
        material = bpy.data.materials.new(PREFIX + "sampler")
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        self.normal = tree.nodes.new('ShaderNodeCombineXYZ')
        self.occlusion = tree.nodes.new('ShaderNodeAmbientOcclusion')
        self.occlusion.samples = 1
        light = tree.nodes.new('ShaderNodeEmission')
        output = tree.nodes.new('ShaderNodeOutputMaterial')
        tree.links.new(self.normal.outputs[0], self.occlusion.inputs["Normal"])
        tree.links.new(self.occlusion.outputs["AO"], light.inputs["Color"])
        tree.links.new(light.outputs[0], output.inputs["Surface"])
        return material

    def _mesh(self, name, x_range, height):
        (left, right), far = x_range, 512.0
        mesh = bpy.data.meshes.new(PREFIX + name)
        mesh.from_pydata([(left, -far, height), (right, -far, height), (right, far, height),
                          (left, far, height)], [], [(0, 1, 2, 3)])
        mesh.materials.append(self.material)
        item = bpy.data.objects.new(PREFIX + name, mesh)
        self.scene.collection.objects.link(item)
        return item
