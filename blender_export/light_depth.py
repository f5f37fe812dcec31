# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a light's depth map: the scene as the light sees it, in its own render call."""

import math

import bpy
from mathutils import Matrix

from . import export_scenes, frame_image, vectors
from .light_view import orthographic_view, perspective_view
from .subject import corners_of, standing_things


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


def plan_view(state, seen, things):
    """The view of a light's depth map for what the camera sees of `things`.

    `seen` are (point, whether the light's mask hides it) of the rendered frame.
    """
    casters = corners_of(things)
    visible = [point for point, _ in seen]
    framed = [point for point, hidden in seen if hidden and shines_toward(state, point)] \
        + corners_of(standing_things(things))
    if state.kind == "sun":
        return orthographic_view(state.direction, framed, visible or casters, casters)
    cone = (state.direction, state.cone[0]) if state.cone else None
    return perspective_view(state.position, framed, visible or casters, cone)


def shines_toward(state, point):
    """Whether the light would reach the point if nothing hid it: in a spot's cone, before an area."""
    if state.kind not in ("spot", "area"):
        return True
    way = vectors.subtract(point, state.position)
    half = 0.5 * state.cone[0] if state.cone else 0.5 * math.pi
    return vectors.dot(way, state.direction) > vectors.length(way) * math.cos(half)
