# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's settings as words of the headless exporter's command line."""


def frame_range(settings, scene):
    """The frame range that the panel asks for, as the command line writes it."""
    if settings.frames == 'SCENE':
        return f"{scene.frame_start}-{scene.frame_end}x{scene.frame_step}"
    return settings.frame_list if settings.frames == 'LIST' else str(scene.frame_current)


def export_words(settings, scene, output, frames=None):
    """Words after Blender's `--`; `output` is an absolute path pattern, `frames` wins over the panel's."""
    counts = {'line': settings.line_count, 'trace': settings.trace_count}
    masks = settings.masks
    if masks in counts:
        masks = f"{masks}:{counts[masks]}"
    words = ["--output", output, f"--frames={frames or frame_range(settings, scene)}", "--masks", masks,
             "--masks-by", settings.masks_by,
             "--scale", str(settings.scale), "--depth-size", str(settings.depth_size)]
    if settings.light:
        words.append(f"--light={settings.light.name}")
    if not settings.offset_auto:
        words += ["--offset", repr(float(settings.offset))]
    if settings.use_casters:
        words.append("--casters")
    if settings.use_truth:
        words += ["--truth", str(settings.truth_samples)]
    return words
