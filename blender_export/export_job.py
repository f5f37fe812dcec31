# SPDX-License-Identifier: GPL-3.0-or-later
"""The export of a range of frames: sets up the scenes once, then renders and describes each frame."""

import os

import bpy

from . import camera_view, exr_header, export_notes, export_scenes, frame_image, light_emission
from . import mask_materials, shot, sidecar, survey, unseen, whole_shot
from .casters import CasterFiles
from .errors import ExportError
from .light_depth import LightDepth, plan_view
from .light_rig import LightRig
from .mask_backends import MaskBackends
from .output_names import light_keys, parse_output
from .unique_names import UniqueNames


class ExportJob:
    """One run; `say` takes the lines meant for the user."""

    def __init__(self, options, say):
        self.options, self.say = options, say
        self.scene = bpy.context.scene
        self.unique = UniqueNames(bpy.data.objects, bpy.data.materials)
        self.frames = options.frames or [self.scene.frame_current]
        self.names = parse_output(options.output, len(self.frames))
        self._set_up()

    def _set_up(self):
        scene, options = self.scene, self.options
        view_layer = shot.active_view_layer(scene)
        objects = shot.rendered_objects(view_layer)
        lights = shot.lights_asked_for(objects, options.lights, self.unique)
        subjects = [item for item in objects if item.type not in {'LIGHT', 'CAMERA', 'LIGHT_PROBE'}]
        shot.refuse_instanced_lights(subjects)
        shot.evaluate_as_rendered(objects, view_layer)
        self.objects = objects
        lights = self._survey(lights)
        self.materials = sorted(bpy.data.materials, key=lambda material: material.name_full)
        shot.give_distinct_indices(shot.all_geometry())
        shot.give_distinct_indices(self.materials)
        notes = export_notes.ignored_settings(scene, view_layer)
        unseen.hide_indirect(view_layer)
        self.unpainted = unseen.unpainted_objects(view_layer)
        notes += export_scenes.prepare_beauty(scene, view_layer, options)
        glow = any(material.use_nodes and light_emission.emits(material.node_tree)
                   for material in self.materials)
        self.data = export_scenes.DataScene(scene, subjects, glow)
        backends = MaskBackends(options.masks_by, self.data, shot.all_geometry(),
                                self.shot.subject.radius)
        self.rigs = self._rigs(lights, backends)
        self.data.add_rest(shot.all_geometry())
        self.data.finish()
        self.writer, more = frame_image.shot_writer(
            scene, view_layer, self.data, [rig.middle_mask for rig in self.rigs if rig.masked])
        notes += backends.notes + more + export_notes.scene_notes(scene, view_layer, options)
        self.depth = LightDepth(self.data, subjects, options.depth_size)
        self.fogs = [item for item in shot.all_geometry() if mask_materials.is_volume_only(item)]
        if options.casters:
            notes += mask_materials.caster_notes(shot.all_geometry())
        notes += mask_materials.keep_what_blocks(
            [layer for made in bpy.data.scenes if made != scene for layer in made.view_layers],
            self.data.material, shot.all_geometry())
        self.layers = {"data": "data", "beauty": "beauty"}
        if "beauty.Freestyle" in self.writer.names:
            self.layers["lines"] = "beauty.Freestyle"
        self.cameras = camera_view.SharpCameras(self.data.uses_rays)
        self.casters = CasterFiles(self.names.folder, self.names.before) if options.casters else None
        for note in notes:
            self.say(f"note: {note}")

    def _survey(self, lights):
        """Measures the whole shot; returns the lights that shine in it, or those asked for."""
        names = {light: self.unique.of(light) for light in lights}
        samples = survey.survey(self.scene, self.objects, lights, self.unique)
        if not self.options.lights:
            lights = survey.shining_lights(lights, samples, names)
        if not lights:
            raise ExportError("the scene has no light that renders; add a point, spot, sun or "
                              "area light")
        self.shot = whole_shot.measure(self.scene.frame_start, self.scene.frame_end, samples)
        self.shot_entry = survey.describe_shot(self.shot, samples, lights, names)
        self.aims = {light: survey.aim_of_light(self.shot, samples, names[light])
                     for light in lights}
        for light in lights:
            for note in survey.light_notes(samples, names[light], self.options.offset):
                self.say(f"note: {note}")
        self.sized = {light for light in lights if survey.ever_sized(samples, names[light])}
        self.casting = {light for light in lights if survey.ever_casts(samples, names[light])}
        return lights

    def _rigs(self, lights, backends):
        names = [self.unique.of(light) for light in lights]
        keys = light_keys(names)
        return [LightRig(light, name, keys[name], light in self.casting, light in self.sized,
                         self.options, self.data, backends)
                for light, name in zip(lights, names)]

    def run(self):
        os.makedirs(self.names.folder, exist_ok=True)
        steps = len(self.frames) * (1 + sum(rig.masked for rig in self.rigs))
        done = 0
        for number, frame in enumerate(self.frames, 1):
            self.say(f"frame {frame} ({number} of {len(self.frames)})")
            for _ in self._export_frame(frame):
                done += 1
                self.say(f"Progress: {100 * done // steps}%")

    def _export_frame(self, frame):
        """Renders one frame, yielding after each image; the files appear together at the end."""
        shot.go_to_frame(self.scene, self.objects, frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        view = camera_view.read_camera(self.scene, depsgraph)
        entries, things = sidecar.describe_objects(depsgraph, self.unique, self.unpainted)
        placed = [rig.place(depsgraph, self.aims[rig.light], self.shot.subject.radius)
                  for rig in self.rigs]
        for scene in self.data.scenes:
            scene.camera = self.cameras.copy_of(self.scene.camera, self.data.scene)
        image = os.path.join(self.names.folder, self.names.image(frame))
        parts = [(frame_image.render(self.writer, frame, image), image)]
        yield
        mapped = [(rig, state, entry) for rig, (state, entry) in zip(self.rigs, placed)
                  if rig.masked]
        seen = frame_image.seen_points(frame, image) if mapped else None
        for rig, state, entry in mapped:
            light_view = self._light_view(frame, state, seen.of_mask(rig.middle_mask), things)
            name = self.names.light_depth(rig.key, frame)
            path = os.path.join(self.names.folder, name)
            part = self.depth.render(light_view, frame, path)
            parts.append((part, path))
            entry["depth_map"] = sidecar.describe_depth_map(
                light_view, name, exr_header.channel_names(part)[0], self.options.depth_size)
            yield
        document = self._document(frame, view, [entry for _, entry in placed], entries)
        world = light_emission.world_radiance(bpy.context.evaluated_depsgraph_get().scene_eval.world)
        if world is not None:
            document["world"] = {"radiance": list(world)}
        if self.casters:
            document["casters"] = self.casters.write(bpy.context.evaluated_depsgraph_get(),
                                                       self.unique, self.fogs)
        sidecar.check(document)
        parts.append(self._write_sidecar(frame, document))
        for part, path in parts:
            os.replace(part, path)

    def _light_view(self, frame, state, seen, things):
        light_view = plan_view(state, seen, things)
        if light_view.cut:
            self.say(f"note: frame {frame}: the depth map of light '{state.name}' cannot show all "
                     f"that the camera sees; what is outside it counts as lit")
        return light_view

    def _document(self, frame, view, lights, objects):
        render = self.scene.render
        return {
            "kagefude": sidecar.VERSION, "frame": frame, "fps": render.fps / render.fps_base,
            "image": self.names.image(frame), "resolution": list(export_scenes.resolution(self.scene)),
            "pixel_aspect": render.pixel_aspect_x / render.pixel_aspect_y,
            "scale": self.options.scale, "shot": self.shot_entry, "layers": self.layers,
            "camera": sidecar.describe_camera(view), "lights": lights, "objects": objects,
            "materials": sidecar.describe_materials(self.materials, self.unique)}

    def _write_sidecar(self, frame, document):
        name = self.names.sidecar(frame)
        part = os.path.join(self.names.folder, f".{name}.part")
        with open(part, "w", encoding="utf-8") as file:
            file.write(sidecar.text(document))
        return part, os.path.join(self.names.folder, name)
