# SPDX-License-Identifier: GPL-3.0-or-later
"""The temporary scenes that one frame is rendered from.

Data passes and masks need one sample at the pixel's centre, the beauty needs the artist's own
samples and filter, and a pixel filter belongs to a scene. So there is a data scene beside the
artist's, with one view layer for the data, one per mask and one per traced truth; and a writing
scene whose compositor takes the layers of both and puts them into one multilayer EXR. The lights'
depth maps are a layer of the data scene too, which keeps its geometry from render to render.
"""

from contextlib import contextmanager
from dataclasses import dataclass

import bpy

from . import compat, rest_pass, sight_nodes
from .errors import ExportError

DATA_PASSES = ("Normal", "Position", "Depth", "IndexOB", "IndexMA", "UV", "Vector", "DiffCol",
               rest_pass.REST, rest_pass.RANDOM)
NOT_BEAUTY = {"Alpha", "Depth", "Mist", "Position", "Normal", "UV", "Vector", "IndexOB", "IndexMA",
              "Shadow"}
PREFIX = "kagefude "


def prepare_beauty(scene, view_layer, options):
    """The artist's scene as it is, but one view layer, no compositing, and Cryptomatte on."""
    notes = []
    render_whole_frame(scene, options.scale * options.percentage / 100)
    compat.remove_compositor(scene)
    for other in scene.view_layers:
        other.use = other == view_layer
    view_layer.use_pass_cryptomatte_object = True
    view_layer.use_pass_cryptomatte_material = True
    view_layer.use_pass_normal = True
    view_layer.pass_cryptomatte_depth = max(view_layer.pass_cryptomatte_depth, 2)
    if scene.render.engine != 'CYCLES':
        notes.append(f"the beauty is rendered with Cycles instead of {scene.render.engine}, which "
                     f"needs a display")
        scene.render.engine = 'CYCLES'
    if scene.render.use_freestyle and hasattr(view_layer.freestyle_settings, "as_render_pass"):
        # Drawn into the picture, lines would be painted over.
        view_layer.freestyle_settings.as_render_pass = True
    if scene.cycles.use_denoising and not compat.has_denoiser():
        notes.append("the beauty is not denoised: this Blender is built without a denoiser")
        scene.cycles.use_denoising = False
    return notes


def render_whole_frame(scene, scale):
    render = scene.render
    render.use_border = False
    render.use_crop_to_border = False
    render.use_multiview = False
    render.use_compositing = False
    render.use_sequencer = False
    width, height = resolution(scene)
    render.resolution_x, render.resolution_y = (max(4, round(side * scale)) for side in (width, height))
    render.resolution_percentage = 100


def resolution(scene):
    share = scene.render.resolution_percentage / 100.0
    return int(scene.render.resolution_x * share), int(scene.render.resolution_y * share)


def exact_scene(artist_scene, name):
    """A copy of the scene without contents that samples each pixel once, at its centre."""
    scene = artist_scene.copy()
    scene.name = PREFIX + name
    scene.animation_data_clear()
    scene.timeline_markers.clear()
    compat.remove_compositor(scene)
    scene.world = None
    for child in list(scene.collection.children):
        scene.collection.children.unlink(child)
    for item in list(scene.collection.objects):
        scene.collection.objects.unlink(item)
    compat.set_if_known(scene.render, engine='CYCLES', use_motion_blur=False, use_freestyle=False,
                        film_transparent=False, use_single_layer=False, use_persistent_data=True)
    compat.set_if_known(
        scene.cycles, samples=1, use_adaptive_sampling=False, use_denoising=False, time_limit=0.0,
        use_layer_samples='USE', max_bounces=0, seed=0, use_animated_seed=False,
        # A box filter would sample each pixel at a random place, whatever its width.
        pixel_filter_type='GAUSSIAN', filter_width=0.01,
        # The default drops weak lights at random and fills the masks with noise.
        light_sampling_threshold=0.0, use_light_tree=False)
    return scene


def replace_view_layers(scene, name):
    """Leave the scene with one fresh view layer."""
    fresh = scene.view_layers.new(name)
    for old in list(scene.view_layers):
        if old != fresh:
            scene.view_layers.remove(old)
    fresh.name = name
    return fresh


def link_collection(scene, name, objects):
    collection = bpy.data.collections.new(PREFIX + name)
    for item in objects:
        collection.objects.link(item)
    scene.collection.children.link(collection)
    return collection


def show_only(view_layer, collections):
    for child in view_layer.layer_collection.children:
        child.exclude = child.collection not in collections


def plain_material():
    """White diffuse: masks do not depend on gloss, emission, bumps or glass."""
    material = bpy.data.materials.new(PREFIX + "mask")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    shader = nodes.new('ShaderNodeBsdfDiffuse')
    shader.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    material.node_tree.links.new(shader.outputs[0],
                                 nodes.new('ShaderNodeOutputMaterial').inputs["Surface"])
    return material


def enable_data_passes(view_layer, emission):
    for name in ("normal", "position", "z", "object_index", "material_index", "uv", "vector",
                 "diffuse_color"):
        setattr(view_layer, "use_pass_" + name, True)
    view_layer.use_pass_emit = emission


@dataclass
class Reading:
    """How a layer's one channel is made of a pass of a view layer."""
    scene: object
    view_layer: str
    pass_name: str
    threshold: float = None   # 1 above it, 0 elsewhere
    share_of: str = None      # name of a view layer by whose pass it is divided


class DataScene:
    """Data layer, mask layers and truth layers, with their lamps.

    What takes many samples lies in a scene of its own, made when it is needed: the data scene may
    use the same random numbers in every pixel, which would show in them.
    """

    def __init__(self, artist_scene, subjects, emission=False):
        self.scene = exact_scene(artist_scene, "data")
        self.subjects = link_collection(self.scene, "subjects", subjects)
        self.material, self.emission = plain_material(), emission
        self.layers = {}      # layer name -> Reading
        self._artist_scene, self._sampled = artist_scene, None
        data = replace_view_layers(self.scene, "data")
        data.samples = 1
        enable_data_passes(data, emission)
        self._lamps = {data.name: []}
        self._sight, self._sight_layer, self._sight_names = None, data.name, []
        self._group_layer = None
        self._rest_aovs = []

    @property
    def scenes(self):
        return [scene for scene in (self.scene, self._sampled) if scene]

    @property
    def uses_rays(self):
        """Whether some masks are taken by rays of a shader node."""
        return self._sight is not None

    def add_shadow_layer(self, name, lamp):
        """A view layer lit by `lamp` alone, a point, that holds whether each pixel sees it."""
        layer = self._add_layer(self.scene, name, [lamp], 1)
        pass_name, threshold = compat.enable_mask_pass(layer)
        self.layers[name] = Reading(self.scene, name, pass_name, threshold)

    def add_truth_layer(self, name, lamp, bare_lamp, samples):
        """One that holds how much of `lamp` each pixel sees; `bare_lamp` is the same without shadows."""
        scene = self._sampled_scene()
        layer = self._add_layer(scene, name, [lamp], samples)
        pass_name, threshold = compat.enable_mask_pass(layer)
        bare = None
        if threshold is not None:
            bare = "bare." + name
            compat.enable_mask_pass(self._add_layer(scene, bare, [bare_lamp], samples))
        self.layers[name] = Reading(scene, name, pass_name, None, bare)

    def add_group_mask(self, name, lamp):
        """A light group of the one layer that all of them share; sampled until each lamp was picked."""
        if self._group_layer is None:
            self._group_layer = self._add_layer(self._sampled_scene(), "groups", [], 1)
        group = f"g{len(self._group_layer.lightgroups)}"
        self._group_layer.lightgroups.add(name=group)
        lamp.lightgroup = group
        self._lamps["groups"].append(lamp)
        # A sample picks one lamp, and samples in powers of two are spread evenly over the lamps.
        self._group_layer.samples = 1 << (2 * len(self._lamps["groups"]) - 1).bit_length()
        self.layers[name] = Reading(self._sampled, "groups", f"Combined_{group}", 0.0)

    def add_rest(self, objects):
        """Let the data layer hold where surfaces rest (see rest_pass)."""
        self._rest_aovs = rest_pass.prepare(objects)

    def add_sight(self, ask, objects):
        """Let materials write masks into AOVs; returns their Sight.

        The artist's own, in the data layer, where those of all `objects` can; else a white one in
        a layer of its own, for which the geometry is read again.
        """
        self._sight = sight_nodes.Sight(ask)
        if sight_nodes.can_stand_in(objects):
            for material in {slot.material for item in objects for slot in item.material_slots}:
                if material:
                    self._sight.put_into(material)
            return self._sight
        white = plain_material()
        self._sight.put_into(white)
        self._sight_layer = "sight"
        self._add_layer(self.scene, "sight", [], 1).material_override = white
        return self._sight

    def add_sight_mask(self, name):
        """One more mask of that layer; returns the name of its AOV."""
        aov = f"{PREFIX}{len(self._sight_names)}"
        self._sight_names.append(aov)
        self.layers[name] = Reading(self.scene, self._sight_layer, aov)
        return aov

    @contextmanager
    def depth_alone(self, camera, size):
        """Let the scene render nothing but the depth layer, through another camera."""
        render, shot_camera = self.scene.render, self.scene.camera
        kept = {name: getattr(render, name) for name in
                ("resolution_x", "resolution_y", "pixel_aspect_x", "pixel_aspect_y")}
        self._render_only(lambda name: name == "depth")
        self._set_sight(0.0)
        self.scene.camera = camera
        render.resolution_x = render.resolution_y = size
        render.pixel_aspect_x = render.pixel_aspect_y = 1.0
        try:
            yield
        finally:
            for name, value in kept.items():
                setattr(render, name, value)
            self.scene.camera = shot_camera
            self._set_sight(1.0)
            self._render_only(lambda name: name != "depth")

    def _render_only(self, wanted):
        for view_layer in self.scene.view_layers:
            view_layer.use = wanted(view_layer.name)

    def _set_sight(self, value):
        if self._sight:
            self._sight.switch(value)

    def finish(self):
        """Keep every lamp out of all layers but its own."""
        self._add_depth_layer()
        self._render_only(lambda name: name != "depth")
        lit = {name: link_collection(self._scene_of(name), name, lamps)
               for name, lamps in self._lamps.items() if lamps}
        for scene in self.scenes:
            for view_layer in scene.view_layers:
                show_only(view_layer, [self.subjects, lit.get(view_layer.name)])
        # Layers that share their scene's data between them must have the same AOVs, or Cycles
        # writes some into others (before 5.2), unless their materials change between the layers,
        # as they do where rays are sent.
        aovs = self._rest_aovs + [(name, 'VALUE') for name in self._sight_names]
        for view_layer in self.scene.view_layers:
            alone = view_layer.name == "depth" and self.uses_rays
            for name, kind in [] if alone else aovs:
                made = view_layer.aovs.add()
                made.name, made.type = name, kind

    def _add_depth_layer(self):
        """Last, and alike to mask layers, so that the geometry need not be read again after them.

        After the artist's materials, which rays are sent from, it is before 5.1 (a tenth of the export of
        a million triangles); white and without other passes, the map takes 130 to 200 MB less.
        """
        self._add_layer(self.scene, "depth", [], 1).use_pass_z = True

    def _scene_of(self, layer):
        return next(scene for scene in self.scenes if layer in scene.view_layers)

    def _sampled_scene(self):
        if self._sampled is None:
            self._sampled = exact_scene(self._artist_scene, "sampled")
            self._sampled.collection.children.link(self.subjects)
            self._sampled.view_layers[0].name = "unused"
            for view_layer in self._sampled.view_layers:
                view_layer.use = False
        return self._sampled

    def _add_layer(self, scene, name, lamps, samples):
        view_layer = scene.view_layers.new(name)
        if view_layer.name != name:
            raise ExportError(f"the layer name '{name}' cannot be used in Blender")
        view_layer.samples = samples
        view_layer.material_override = self.material
        self._lamps[name] = lamps
        return view_layer
