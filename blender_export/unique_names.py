# SPDX-License-Identifier: GPL-3.0-or-later
"""Names for what is written, where linked libraries bring two data-blocks of one name."""

from collections import Counter


class UniqueNames:
    """The names of a file's objects or materials, each its own, the same in every frame."""

    def __init__(self, *lists):
        """`lists`: data-blocks of one kind each, which may share names with those of another kind."""
        self._names = {}
        for items in lists:
            counts = Counter(item.name for item in items)
            # With its library in brackets, as Blender writes it: Body [cast.blend].
            self._names.update({
                _key(item): item.name if counts[item.name] == 1 else item.name_full
                for item in items})

    def of(self, item):
        """The name of a data-block or of its evaluated copy."""
        original = item.original
        return self._names.get(_key(original), original.name)


def _key(item):
    return type(item).__name__, item.name_full
