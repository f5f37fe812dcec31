# SPDX-License-Identifier: GPL-3.0-or-later
"""How far from a smooth-shaded face Cycles lets a lamp's ray begin, where the face turns away.

It begins on the surface that the face stands for: a bulge between its corners, as high in an edge's
middle as a quarter of the edge times the turn of the normal along it. On fine faces that is nothing.
On coarse ones the ray begins elsewhere, and on a tube whose ends are shaded smooth as well, at half
its length: past its neighbours. Rays of a shader node begin on the face, so their masks differ there.
"""

from . import vectors
from .casters import MESHED

LOOKED_AT = 1000  # edges or faces of a mesh, evenly spread
# Share of the subject's radius. Nine masks by rays had 1.16 times the error of layers at 0.0014 (a
# subdivided head), 1.18 at 0.0039 (a column), 2.6 at 0.34 (poles), and less at 0.0004 (a ring).
FINE = 0.0005


def coarse_object(objects, radius, depsgraph):
    """The first of the objects whose rays begin farther off than fine faces' do, or None.

    `radius` is the subject's: what is small in the shot may be coarse.
    """
    leaps = {}
    for item in objects:
        if item.type not in MESHED:
            continue
        # Things that share a mesh are looked at once.
        shape = item if item.modifiers else item.data
        if shape not in leaps:
            leaps[shape] = _leap_of(item, depsgraph)
        scale = max(abs(value) for value in item.matrix_world.to_scale())
        if scale * leaps[shape] > FINE * radius:
            return item
    return None


def leap(edges):
    """The highest bulge over edges, which are pairs of (place, normal)."""
    return 0.25 * max((abs(vectors.dot(vectors.subtract(end, place),
                                       vectors.subtract(turned, normal)))
                       for (place, normal), (end, turned) in edges), default=0.0)


def _leap_of(item, depsgraph):
    levels = sum(modifier.render_levels for modifier in item.modifiers if _rounds(modifier))
    if levels and item.type == 'MESH':
        # Each level halves an edge and its turn. Asked for, the subdivided mesh would be made, which
        # nothing else of the export needs: half a second and 80 MB for a million triangles.
        return leap(_edges_of(item.data)) / 4 ** levels
    evaluated = item.evaluated_get(depsgraph)
    if item.type == 'MESH':  # a copy by to_mesh has lost its normals
        return leap(_edges_of(evaluated.data))
    mesh = evaluated.to_mesh()
    try:
        return leap(_edges_of(mesh)) if mesh else 0.0
    finally:
        evaluated.to_mesh_clear()


def _rounds(modifier):
    return modifier.type == 'SUBSURF' and modifier.show_render \
        and modifier.subdivision_type == 'CATMULL_CLARK'


def _edges_of(mesh):
    """Ends of smooth edges."""
    if mesh.normals_domain == 'POINT':
        for edge in _spread(mesh.edges):
            ends = [mesh.vertices[number] for number in edge.vertices]
            yield [(end.co, end.normal) for end in ends]
    elif mesh.normals_domain == 'CORNER':
        for face in _spread(mesh.polygons):
            ends = [(mesh.vertices[mesh.loops[corner].vertex_index].co,
                     mesh.corner_normals[corner].vector) for corner in face.loop_indices]
            yield from zip(ends, ends[1:] + ends[:1])


def _spread(items):
    step = -(-len(items) // LOOKED_AT)
    return (items[number] for number in range(0, len(items), step)) if step else ()
