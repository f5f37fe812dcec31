# SPDX-License-Identifier: GPL-3.0-or-later
"""How hard shadow masks are rendered, `--masks-by`: which way suits a light, and its masks.

- `layers`: a view layer and a lamp for each mask. Right for everything; one render a mask, which on
  kept data costs about as much as rays of the Ambient Occlusion node.
- `groups`: a light group for each mask and one view layer, sampled until every lamp was picked.
- `occlusion`: rays of the Ambient Occlusion node, all masks in one sample (before 5.1).
- `raycast`: rays of the Raycast node, the same (from 5.1).

On coarse faces that are shaded smooth rays and lamps differ (smooth_faces.py, sight_nodes.py); `auto`
takes no rays where there are such.
"""

from functools import cached_property

from . import compat, mask_obstacles, sampler_probe, sight_nodes
from .light_state import new_mask_lamp, place_mask_lamp, TYPES
from .output_names import mask_layer

RAYS = ("occlusion", "raycast")


class MaskBackends:
    """Chooses a way for each light; `notes` says which were refused, one line a reason.

    `radius` is that of the shot's subject.
    """

    def __init__(self, wanted, data, objects, radius):
        self.wanted, self.data, self.objects, self.notes = wanted, data, objects, []
        self.radius = radius
        self._ask, self._sight, self._turn = None, None, None

    def masks_of(self, light, key, count):
        """The masks of a light, rendered the way that was asked for or, where that is wrong, by layers."""
        by = self._way(light)
        kind = TYPES[light.data.type]
        names = [mask_layer(key, number) for number in range(count)]
        if by == "layers":
            return LayerMasks(self.data, light, kind, names)
        if by == "groups":
            return GroupMasks(self.data, light, kind, names)
        return SightMasks(self.data, self._shared_sight(), by, kind, names)

    def _way(self, light):
        by = self.wanted
        if by == "auto":
            by = "raycast" if compat.has_raycast_node() else "layers"
        if by not in RAYS and not compat.has_raycast_node():
            self._steady_sampler()
        problem = self._problem(by, light)
        if not problem:
            return by
        if self.wanted != "auto" or problem.speaks:
            self._note(f"the masks of light '{light.name}' are rendered by layers instead of {by}: "
                       f"{problem.words}")
        return "layers"

    def _problem(self, by, light):
        if by not in RAYS:
            return None
        problem = self._missing(by) or mask_obstacles.of_rays(by, light, self.objects, self._turn)
        return problem or (self._coarse_faces if self.wanted == "auto" else None)

    @cached_property
    def _coarse_faces(self):
        return mask_obstacles.of_coarse_faces(self.objects, self.radius)

    def _missing(self, by):
        if self._ask:
            return None
        if by == "raycast":
            if not compat.has_raycast_node():
                return mask_obstacles.Obstacle("this Blender has no Raycast node (5.1 has)", False)
            self._ask = sight_nodes.ask_raycast
            for item in self.objects:
                compat.hide_from_raycast(item, not item.visible_shadow)
            return None
        if not self._steady_sampler():
            return mask_obstacles.Obstacle("this Blender's Ambient Occlusion node cannot be aimed",
                                           False)
        self._ask = sight_nodes.ask_occlusion(self._turn)
        return None

    def _steady_sampler(self):
        """Let every pixel's one sample be alike; whether that could be had.

        The Ambient Occlusion node is aimed by it, and what is half see-through is taken or left as
        a whole instead of pixel by pixel.
        """
        if self._turn is None:
            self._turn = sampler_probe.measure_turn()
            if self._turn is not None:
                sampler_probe.steady_sampler(self.data.scene, self._turn.seed)
        return self._turn is not None

    def _shared_sight(self):
        if self._sight is None:
            self._sight = self.data.add_sight(self._ask, self.objects)
        return self._sight

    def _note(self, note):
        if note not in self.notes:
            self.notes.append(note)


class LayerMasks:
    """A view layer for each mask, lit by a lamp of its own."""
    by = "layers"

    def __init__(self, data, light, kind, names):
        self.names, self.lamps = names, []
        for name in names:
            lamp = new_mask_lamp(light, kind, name)
            data.add_shadow_layer(name, lamp)
            self.lamps.append(lamp)

    def place(self, number, state, position, direction):
        """Move a mask: `position` of its lamp, `direction` in which a sun's light travels, else None."""
        place_mask_lamp(self.lamps[number], state, position, direction)


class GroupMasks(LayerMasks):
    """A light group for each mask, in the one view layer that all lights share."""
    by = "groups"

    def __init__(self, data, light, kind, names):
        self.names, self.lamps = names, [new_mask_lamp(light, kind, name) for name in names]
        for name, lamp in zip(names, self.lamps):
            data.add_group_mask(name, lamp)


class SightMasks:
    """AOVs in the one view layer that all lights share, written by the rays of its materials."""

    def __init__(self, data, sight, by, kind, names):
        self.by, self.names = by, names
        self.places = [sight.add(kind, data.add_sight_mask(name)) for name in names]

    def place(self, number, state, position, direction):
        self.places[number].put(position, direction, state)
