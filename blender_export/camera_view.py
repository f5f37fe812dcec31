# SPDX-License-Identifier: GPL-3.0-or-later
"""The shot's camera: its matrices, and a copy of it that is everywhere in focus."""

from dataclasses import dataclass

from mathutils import Matrix

from .errors import ExportError
from .export_scenes import PREFIX, resolution

# Pixels. A ray of a shader node that starts on the very edge of two faces is stopped by the other
# face; a camera that stands square to the geometry would see whole rows of such points.
NUDGE = (0.0011, 0.0019)


@dataclass
class CameraView:
    kind: str
    world_from_camera: Matrix
    clip_from_camera: Matrix

    @property
    def clip_from_world(self):
        return self.clip_from_camera @ self.world_from_camera.inverted()


def read_camera(scene, depsgraph):
    """The scene's camera at the evaluated frame; ExportError where it has none or a panoramic one."""
    if scene.camera is None:
        raise ExportError(f"scene '{scene.name}' has no camera")
    camera = scene.camera.evaluated_get(depsgraph)
    if camera.type != 'CAMERA' or camera.data.type not in {'PERSP', 'ORTHO'}:
        raise ExportError(f"camera '{camera.name}' is neither perspective nor orthographic")
    width, height = resolution(scene)
    clip = camera.calc_matrix_camera(depsgraph, x=width, y=height,
                                     scale_x=scene.render.pixel_aspect_x,
                                     scale_y=scene.render.pixel_aspect_y)
    location, rotation, _ = camera.matrix_world.decompose()
    world = Matrix.Translation(location) @ rotation.to_matrix().to_4x4()
    return CameraView({'PERSP': "perspective", 'ORTHO': "orthographic"}[camera.data.type],
                      world, clip)


class SharpCameras:
    """Copies of the artist's cameras without depth of field, animated as they are.

    They move as the originals do, which the motion vectors need.
    """

    def __init__(self, nudged=False):
        self.nudged, self._copies = nudged, {}

    def copy_of(self, camera, scene):
        if camera.name_full not in self._copies:
            sharp = camera.copy()
            sharp.data = camera.data.copy()
            sharp.name = PREFIX + camera.name
            sharp.data.dof.use_dof = False
            if self.nudged:
                size = max(scene.render.resolution_x, scene.render.resolution_y)
                sharp.data.shift_x += NUDGE[0] / size
                sharp.data.shift_y += NUDGE[1] / size
            scene.collection.objects.link(sharp)
            self._copies[camera.name_full] = sharp
        return self._copies[camera.name_full]
