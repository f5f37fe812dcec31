"""Composites a frame from inside Nuke or Natron, or from any Python: one call a frame, or one for a range.

In Nuke, as a button on a Group with file knobs `look`, `input`, `output`:

    import nuke_comp
    node = nuke.thisNode()
    nuke_comp.comp(node["look"].value(), node["input"].value(), node["output"].value(), nuke.frame())

or before every frame of a Write that reads the result (Python tab, "before each frame"):

    nuke_comp.comp("look.toml", "aovs/shot.####.exr", "painted/shot.####.exr", nuke.frame())

Natron's callbacks are alike: frame is what its beforeFrameRender callback gets. Frames that are done with the same
look and inputs are kept, so a call costs next to nothing where nothing changed.
"""
import os
import subprocess


def comp(look, input_frames, output_frames, first, last=None, program=None, options=()):
    """Makes frames first..last; raises RuntimeError with kagefude's own line when one fails."""
    last = first if last is None else last
    command = [
        program or os.environ.get("KAGEFUDE", "kagefude"), "comp", look, input_frames,
        "--output", output_frames, "--frames", "%d-%d" % (first, last),
        "--existing", "update", "--progress", "none",
    ] + list(options)
    result = subprocess.run(command, stderr=subprocess.PIPE, universal_newlines=True)
    if result.returncode != 0:
        errors = [line for line in result.stderr.splitlines() if line.startswith("ERROR:")]
        raise RuntimeError("\n".join(errors) or result.stderr)
