# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks at the shot in a few frames of the scene's range, before any of them is rendered."""

import bpy

from . import animation, shot, vectors, whole_shot
from .camera_view import read_camera
from .light_emission import irradiance, luminance
from .light_state import read_light
from .sidecar import describe_objects
from .subject import subject_things


def survey(scene, objects, lights, unique):
    """Samples of the whole shot; leaves the scene at the frame that it was at."""
    frame = scene.frame_current, scene.frame_subframe
    samples = []
    for sampled in whole_shot.sampled_frames(scene.frame_start, scene.frame_end):
        shot.go_to_frame(scene, objects, sampled)
        samples.append(_sample(scene, bpy.context.evaluated_depsgraph_get(), lights, unique))
    shot.go_to_frame(scene, objects, *frame)
    return samples


def shining_lights(lights, samples, names):
    """Those that shine in a sampled frame, or that may do so between two of them."""
    def may_shine(light):
        tree = light.data.node_tree if light.data.use_nodes else None
        return animation.is_animated(light, "hide_render") \
            or animation.is_animated(light.data, "energy") \
            or animation.is_animated(tree, "default_value")
    return [light for light in lights if may_shine(light)
            or any(sample.lights[names[light]].shines for sample in samples)]


def ever_casts(samples, name):
    return any(sample.lights[name].casts for sample in samples)


def ever_sized(samples, name):
    return any(sample.lights[name].sized for sample in samples)


def light_notes(samples, name, offset):
    """What is to be said of a light once."""
    node = next((sample.lights[name].unknown_node for sample in samples
                 if sample.lights[name].unknown_node), None)
    if node:
        yield (f"light '{name}' has the node '{node}', which cannot be followed here; it counts as "
               f"1 in the light's energy and color")
    if any(sample.lights[name].narrowed for sample in samples):
        yield (f"light '{name}' has a spread of less than 180 degrees, which is not followed here; "
               f"paint is lit outside of its beam as well")
    if not ever_casts(samples, name):
        yield f"light '{name}' casts no shadow, so it has no masks and only shades"
    elif not ever_sized(samples, name) and not offset:
        yield f"light '{name}' has no size, so it gets one hard mask; give it a radius for soft shadows"


def aim_of_light(measured, samples, name):
    return whole_shot.aim_of(measured.subject.center, measured.centers,
                             [sample.lights[name].position for sample in samples])


def describe_shot(measured, samples, lights, names):
    """The `shot` of the JSON, the same in every frame."""
    def describe(light):
        states = [sample.lights[names[light]] for sample in samples]
        given = [state.irradiance_at(center) for state, center in zip(states, measured.centers)]
        return {"name": names[light], "irradiance": sum(given) / len(given),
                "largest_irradiance": max(given),
                "largest_power": max(state.power for state in states),
                "largest_on_axis": max(state.on_axis_at(center)
                                       for state, center in zip(states, measured.centers))}
    return {
        "first": measured.first, "last": measured.last,
        "subject": {"center": list(measured.subject.center), "radius": measured.subject.radius},
        "distance": measured.distance,
        "lights": [describe(light) for light in lights]}


def _sample(scene, depsgraph, lights, unique):
    view = read_camera(scene, depsgraph)
    _, things = describe_objects(depsgraph, unique)
    seen = {thing.name for thing in subject_things(things, view.clip_from_world)}
    forward = tuple(-view.world_from_camera[row][2] for row in range(3))
    return whole_shot.FrameSample(
        {thing.name: thing for thing in things}, seen,
        tuple(view.world_from_camera.translation), vectors.normalize(forward),
        {unique.of(light): _light_sample(light.evaluated_get(depsgraph)) for light in lights})


def _light_sample(evaluated):
    state = read_light(evaluated, evaluated.name)
    power = state.energy * luminance(state.color)

    def irradiance_at(point):
        return irradiance(state.kind, power, state.position, state.direction, state.cone, point)

    def on_axis_at(point):
        way = vectors.subtract(point, state.position)
        axis = vectors.normalize(way, state.direction)
        return irradiance(state.kind, power, state.position, axis, None, point)
    return whole_shot.LightSample(state.position, power > 0.0, state.casts_shadow,
                                  state.unknown_node, power, irradiance_at, on_axis_at,
                                  max(state.radius, state.half_length) > 0.0, state.narrowed)
