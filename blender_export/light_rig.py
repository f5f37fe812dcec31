# SPDX-License-Identifier: GPL-3.0-or-later
"""One exported light: its mask and truth layers in the data scene, moved into place per frame."""

from . import light_offset, mask_positions, vectors
from .arguments import Arrangement
from .errors import ExportError
from .light_state import (area_extents, new_truth_lamp, place_truth_lamp, read_light,
                          travel_direction)
from .output_names import traced_layer, truth_layer
from .subject import Sphere


class LightRig:
    def __init__(self, light, name, key, masked, sized, options, data, backends):
        """`name` is the light's own in the JSON; a light that is not `masked` casts no shadow.

        One that is never `sized` gets its one hard mask, unless an offset is asked for.
        """
        self.light, self.name, self.key, self.masked, self.options = light, name, key, masked, options
        hard = not sized and not options.offset and options.masks.kind != "trace"
        self.arrangement = Arrangement("hard", 1) if hard else options.masks
        self.masks, self.truth_lamps = None, []
        if not masked:
            return
        self._refuse_what_cannot_work()
        if self.arrangement.kind == "trace":
            self._trace(data, traced_layer(key), self.arrangement.count)
        else:
            self.masks = backends.masks_of(light, key, self.arrangement.count)
        if options.truth_samples:
            self._trace(data, truth_layer(key), options.truth_samples)

    def _trace(self, data, layer, samples):
        lamps = [new_truth_lamp(self.light, layer, shadow) for shadow in (True, False)]
        self.truth_lamps += lamps
        data.add_truth_layer(layer, *lamps, samples)

    @property
    def middle_mask(self):
        """The layer that is nearest to what the light's middle sees."""
        if not self.masks:
            return traced_layer(self.key)
        names = self.masks.names
        return names[len(names) // 2 if self.arrangement.kind in ("line", "grid") else 0]

    def place(self, depsgraph, aim, radius):
        """Move the lamps to this frame's places; returns (light state, JSON entry).

        `aim` and `radius` are the light's subject over the whole shot.
        """
        evaluated = self.light.evaluated_get(depsgraph)
        state = read_light(evaluated, self.name)
        subject = Sphere(aim.center(state.position), radius)
        travel = travel_direction(state, subject.center)
        for lamp in self.truth_lamps:
            place_truth_lamp(lamp, state, evaluated)
        entry = self._describe(state, travel, subject, evaluated)
        arrangement = self._arrangement_on(entry)
        places = mask_positions.places_on_light(arrangement, travel, state.surface_axes)
        entry["axes"] = {"u": list(places.u_axis), "v": list(places.v_axis)}
        if self.masks:
            self._place_masks(arrangement.kind, state, travel, places, subject, entry)
        elif self.masked:
            entry["traced"] = {"layer": traced_layer(self.key),
                               "samples": self.options.masks.count}
        if self.masked and self.options.truth_samples:
            entry["truth_layer"] = truth_layer(self.key)
            entry["truth_samples"] = self.options.truth_samples
        return state, entry

    def _describe(self, state, travel, subject, evaluated):
        entry = {
            "name": state.name, "type": state.kind, "position": list(state.position),
            "direction": list(travel if state.kind == "point" else state.direction),
            "radius": state.radius, "color": list(state.color), "energy": state.energy,
            "shadow": state.casts_shadow,
            "subject": {"center": list(subject.center), "radius": subject.radius}}
        if state.cone:
            entry["cone"] = {"angle": state.cone[0], "blend": state.cone[1]}
        if state.kind == "area":
            shape, half_u, half_v = area_extents(evaluated)
            entry["area"] = {"shape": shape, "half_u": half_u, "half_v": half_v}
        if state.kind == "sun":
            nominal = vectors.scale(state.direction, -4.0 * max(subject.radius, 1.0))
            entry["position"] = list(vectors.add(subject.center, nominal))
        return entry

    def _arrangement_on(self, entry):
        """The arrangement asked for, but on a rectangle a disc's masks lie in rows and columns."""
        area = entry.get("area")
        if self.arrangement.kind != "disc" or self.options.offset or not area \
                or area["shape"] != "rectangle":
            return self.arrangement
        return mask_positions.on_rectangle(self.arrangement.count, area["half_u"], area["half_v"])

    def _place_masks(self, kind, state, travel, places, subject, entry):
        offset, offset_v = self._offsets(kind, state, subject, entry)
        samples, stretch = [], offset_v / offset
        for number, (layer, place) in enumerate(zip(self.masks.names, places.places)):
            sample = {"layer": layer, "uv": list(place)}
            direction = None
            if state.kind == "sun":
                direction = mask_positions.mask_direction(travel, places, place, offset)
                sample["direction"] = list(direction)
            else:
                position = mask_positions.mask_position(
                    state.position, places, (place[0], place[1] * stretch), offset)
                sample["position"] = list(position)
            self.masks.place(number, state, sample.get("position", entry["position"]), direction)
            samples.append(sample)
        entry["masks"] = {"arrangement": kind, "offset": offset, "samples": samples,
                          "by": self.masks.by}
        if offset_v != offset:
            entry["masks"]["offset_v"] = offset_v

    def _offsets(self, kind, state, subject, entry):
        """The offsets along u and v of masks that lie as `kind` says."""
        if self.options.offset:
            return self.options.offset, self.options.offset
        if kind in ("disc", "grid") and "area" in entry:
            return light_offset.area_offsets(state.radius, entry["area"])
        distance = vectors.length(vectors.subtract(state.position, subject.center))
        offset = light_offset.auto_offset(kind, state.radius, state.half_length,
                                          distance, subject.radius)
        return offset, offset

    def _refuse_what_cannot_work(self):
        if self.arrangement.kind == "pair" and self.light.data.type == 'SUN':
            raise ExportError(f"light '{self.light.name}' is a sun, whose shadows do not change "
                              f"along its axis, so a pair of masks would be twice the same; take "
                              f"masks on a line or a disc (line:5, disc:5)")
