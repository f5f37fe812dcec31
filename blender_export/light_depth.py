# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders a light's depth map: the scene as the light sees it, in its own scene and render call."""

import bpy
from mathutils import Matrix

from . import export_scenes, frame_image
from .camera_view import hidden_points, visible_points
from .light_view import orthographic_view, perspective_view
from .subject import bounding_sphere, corners_of, standing_things


class LightDepth:
    def __init__(self, artist_scene, subjects, material, size):
        self.scene = export_scenes.exact_scene(artist_scene, "light depth")
        self.subjects = subjects
        view_layer = export_scenes.replace_view_layers(self.scene, "depth")
        view_layer.use_pass_z = True
        view_layer.material_override = material
        collection = export_scenes.link_collection(self.scene, "casters", subjects)
        export_scenes.show_only(view_layer, [collection])
        render = self.scene.render
        render.resolution_x = render.resolution_y = size
        render.pixel_aspect_x = render.pixel_aspect_y = 1.0
        data = bpy.data.cameras.new(export_scenes.PREFIX + "light")
        self.camera = bpy.data.objects.new(export_scenes.PREFIX + "light", data)
        self.scene.collection.objects.link(self.camera)
        self.scene.camera = self.camera
        self.writer = frame_image.depth_writer(self.scene)

    def render(self, light_view, frame, path):
        """Render what `light_view` sees into a part file; returns the part's path.

        The map shows what casts shadows, whether the shot's camera sees it or not.
        """
        self._aim(light_view)
        seen = {item: item.visible_camera for item in self.subjects}
        for item in self.subjects:
            item.visible_camera = item.visible_shadow
        try:
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
