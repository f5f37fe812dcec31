# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a light's depth map: the scene as the light sees it, in its own render call."""

import bpy
from mathutils import Matrix

from . import export_scenes, frame_image
from .camera_view import hidden_points, visible_points
from .light_view import orthographic_view, perspective_view
from .subject import bounding_sphere, corners_of, standing_things


class LightDepth:
    """Renders in the data scene, which has the geometry at hand, through a camera at the light."""

    def __init__(self, data, subjects, size):
        self.data, self.subjects, self.size = data, subjects, size
        camera = bpy.data.cameras.new(export_scenes.PREFIX + "light")
        self.camera = bpy.data.objects.new(export_scenes.PREFIX + "light", camera)
        data.scene.collection.objects.link(self.camera)
        self.writer = frame_image.depth_writer(data.scene, size)

    def render(self, light_view, frame, path):
        """Render what `light_view` sees into a part file; returns the part's path.

        The map shows what casts shadows, whether the shot's camera sees it or not.
        """
        self._aim(light_view)
        # Setting it, even to what it is, makes Cycles read the geometry again.
        seen = {item: item.visible_camera for item in self.subjects
                if item.visible_camera != item.visible_shadow}
        for item in seen:
            item.visible_camera = item.visible_shadow
        try:
            with self.data.depth_alone(self.camera, self.size):
                return frame_image.render(self.writer, frame, path)
        finally:
            for item, visible in seen.items():
                item.visible_camera = visible

    def _aim(self, light_view):
        self.camera.matrix_world = Matrix(light_view.world_from_light)
        data = self.camera.data
        data.clip_start, data.clip_end = light_view.near, light_view.far
        if light_view.projection == "orthographic":
            data.type, data.ortho_scale = 'ORTHO', light_view.extent
        else:
            data.type, data.sensor_fit, data.angle = 'PERSP', 'AUTO', light_view.extent


def plan_view(state, scene, depsgraph, camera, things):
    """The view of a light's depth map for what `camera` sees of `things`."""
    casters = corners_of(things)
    visible = visible_points(scene, depsgraph, camera)
    reach = 2.0 * bounding_sphere(casters).radius
    hidden = hidden_points(scene, depsgraph, visible, state, reach)
    framed = hidden + corners_of(standing_things(things))
    seen = visible or casters
    if state.kind == "sun":
        return orthographic_view(state.direction, framed, seen, casters)
    cone = (state.direction, state.cone[0]) if state.cone else None
    return perspective_view(state.position, framed, seen, cone)
