# SPDX-License-Identifier: GPL-3.0-or-later
"""The exporter as it is but for the Rest pass, to time what that costs; options as
blender_export/export_aovs.py has them."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))

from blender_export import export_aovs, frame_image, rest_pass  # noqa: E402  (after the path)

rest_pass.prepare = lambda objects: []
frame_image.DATA_PASSES = tuple(name for name in frame_image.DATA_PASSES
                                if name not in (rest_pass.REST, rest_pass.RANDOM))
_status = export_aovs.main(sys.argv[sys.argv.index("--") + 1:])
if _status:
    sys.exit(_status)
