# SPDX-License-Identifier: GPL-3.0-or-later
"""The triangles of objects that cast shadows, as OBJ files beside the frames.

Each mesh is in its object's own space and its file is named by its content: what does not deform
is written once for the whole shot, instances share one file, and frames that different machines
render agree on names without talking to each other. OBJ, because Debian's Blender has neither
Alembic nor USD, and every tool reads it; nine digits keep single floats exact.
"""

import array
import hashlib
import os

MESHED = {'MESH', 'CURVE', 'SURFACE', 'FONT', 'META'}


class CasterFiles:
    """The caster meshes of one shot, in the folder `<shot>.casters` beside its frames."""

    def __init__(self, folder, before):
        stem = before.rstrip("._-") or "shot"
        self.folder, self.name = folder, f"{stem}.casters"

    def write(self, depsgraph, names, fogs=()):
        """Entries for the JSON of every casting object and instance at the evaluated frame but `fogs`."""
        entries, written = [], {}
        for instance in depsgraph.object_instances:
            item = instance.object
            if item.type not in MESHED or item.hide_render or not item.visible_shadow \
                    or item.original in fogs:
                continue
            key = item.original.name_full, item.data.as_pointer()
            if key not in written:
                written[key] = self._write_mesh(item)
            if written[key]:
                entries.append({"object": names.of(item), "file": written[key],
                                "world_from_object": [[float(value) for value in row]
                                                      for row in instance.matrix_world]})
        return sorted(entries, key=lambda entry: (entry["object"], entry["world_from_object"]))

    def _write_mesh(self, item):
        """The path of the mesh's file relative to the frames, or None for a mesh without faces."""
        text = evaluated_text(item)
        if text is None:
            return None
        data = text.encode("ascii")
        name = hashlib.sha1(data).hexdigest()[:20] + ".obj"
        folder = os.path.join(self.folder, self.name)
        path = os.path.join(folder, name)
        if not os.path.exists(path):
            os.makedirs(folder, exist_ok=True)
            part = os.path.join(folder, f".{name}.{os.getpid()}.part")
            with open(part, "wb") as file:
                file.write(data)
            os.replace(part, path)
        return f"{self.name}/{name}"


def evaluated_text(item):
    """The evaluated object's triangles as OBJ, or None when it has none."""
    # The renderer cuts the evaluated mesh itself; a copy by to_mesh has lost its normals, and then
    # some bent quads are cut along their other diagonal.
    if item.type == 'MESH' and not item.data.is_editmode:
        return obj_text(item.data)
    mesh = item.to_mesh()
    try:
        return obj_text(mesh) if mesh is not None else None
    finally:
        item.to_mesh_clear()


def obj_text(mesh):
    """The mesh's triangles as OBJ, or None when it has none."""
    mesh.calc_loop_triangles()
    if not mesh.loop_triangles:
        return None
    places = array.array("f", bytes(12 * len(mesh.vertices)))
    mesh.vertices.foreach_get("co", places)
    corners = array.array("i", bytes(12 * len(mesh.loop_triangles)))
    mesh.loop_triangles.foreach_get("vertices", corners)
    lines = ["v %.9g %.9g %.9g" % tuple(places[i:i + 3]) for i in range(0, len(places), 3)]
    lines += ["f %d %d %d" % (corners[i] + 1, corners[i + 1] + 1, corners[i + 2] + 1)
              for i in range(0, len(corners), 3)]
    return "\n".join(lines) + "\n"
