# SPDX-License-Identifier: GPL-3.0-or-later
"""The two ways an export stops: a wrong request, or a scene that cannot be exported."""

import difflib


class ExportError(Exception):
    """The scene cannot be exported as asked; the message is one lower-case sentence."""


class UsageError(ExportError):
    """The command line is wrong; nothing has been touched."""


def nearest(name, names):
    """`; did you mean 'x'?`, or nothing where no known name comes close."""
    close = difflib.get_close_matches(name, names, 1, 0.5)
    return f"; did you mean '{close[0]}'?" if close else ""
