#!/usr/bin/env python3
"""What calls cost beyond their work, beside /bin/true and `oiiotool --version`.

Every command runs in turn, round after round, in one go; printed are medians of wall-clock and
processor seconds, their ratios to `oiiotool --version` of the same run, and the load before and
after. Wall-clock times mean something on a quiet machine only; ratios of processor seconds hold
better. Exits with 1 when a bound is missed and --check is given.

    tests/bench/startup.py [ROUNDS] [--check]
"""

import os
import re
import statistics
import subprocess
import sys
import tempfile

from timed import timed

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
KAGEFUDE = os.path.join(ROOT, 'build', 'release', 'kagefude')
DATA = os.path.join(ROOT, 'tests', 'data', 'still')


def frame_seconds(words):
    """What a comp says that reading, computing and writing its frame took."""
    return float(re.search(r'done in ([0-9.]+)', words).group(1))


def make_case(folder):
    """A small frame, strips, and looks with an EXR strip, one TIFF strip, and four."""
    run = lambda *command: subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    run('oiiotool', os.path.join(DATA, 'shot.0001.exr'), '--crop', '64x36+60+40', '-o',
        f'{folder}/shot.0001.exr')
    run('cp', os.path.join(DATA, 'shot.Key.depth.0001.exr'), folder)
    run('cp', os.path.join(DATA, 'shot.0001.json'), folder)
    run(KAGEFUDE, 'strip', 'make', f'{folder}/strip.png', '--set', 'width=64', '--set', 'height=32')
    run('oiiotool', f'{folder}/strip.png', '-d', 'half', '--attrib', 'oiio:ColorSpace', 'sRGB',
        '-o', f'{folder}/strip.exr')
    for name in 'abcd':
        run('oiiotool', f'{folder}/strip.png', '-o', f'{folder}/{name}.tif')
    objects = ['Vase', 'Bowl', 'Table*', 'Red*']
    looks = {'plain': ['strip.exr'], 'one': ['a.tif'], 'four': ['a.tif', 'b.tif', 'c.tif', 'd.tif']}
    for look, strips in looks.items():
        with open(f'{folder}/{look}.toml', 'w') as file:
            for name, strip in zip(objects, strips):
                file.write(f'[[style]]\nobject = "{name}"\nstrip = "{strip}"\n')

    def comp(look):
        return [KAGEFUDE, 'comp', f'{folder}/{look}.toml', f'{folder}/shot.0001.exr', '-o',
                f'{folder}/out.exr', '--progress', 'plain']

    return {
        '/bin/true': ['/bin/true'],
        'oiiotool --version': ['oiiotool', '--version'],
        'kagefude --version': [KAGEFUDE, '--version'],
        'kagefude passes': [KAGEFUDE, 'passes'],
        'comp': comp('plain'),
        'comp, a TIFF strip': comp('one'),
        'comp, four TIFF strips': comp('four'),
    }


def measure(commands, rounds):
    walls = {name: [] for name in commands}
    works = {name: [] for name in commands}
    beyond = []
    for _ in range(rounds):
        for name, command in commands.items():
            took = timed(command)
            walls[name].append(took.wall)
            works[name].append(took.cpu)
            if name == 'comp':
                beyond.append(took.wall - frame_seconds(took.said))
    median = lambda lists: {name: statistics.median(times) for name, times in lists.items()}
    return median(walls), median(works), statistics.median(beyond)


def main():
    check = '--check' in sys.argv[1:]
    numbers = [int(a) for a in sys.argv[1:] if a.isdigit()]
    rounds = numbers[0] if numbers else 21
    before = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        walls, works, beyond = measure(make_case(folder), rounds)
    print(f'medians of {rounds} rounds; load {before:.1f} before, {os.getloadavg()[0]:.1f} after')
    print(f'{"":24}{"wall ms":>9}{"cpu ms":>9}{"of oiiotool, cpu":>18}')
    for name in walls:
        ratio = works[name] / works['oiiotool --version']
        print(f'{name:24}{1000 * walls[name]:9.1f}{1000 * works[name]:9.1f}{ratio:18.2f}')
    first = walls['comp, a TIFF strip'] - walls['comp']
    others = walls['comp, four TIFF strips'] - walls['comp, a TIFF strip']
    bounds = [('kagefude passes', walls['kagefude passes'], 0.020),
              ('a one-frame EXR comp beyond its frame', beyond, 0.050),
              ('the first use of OpenImageIO', first, 0.300)]
    missed = False
    for what, seconds, most in bounds:
        missed |= seconds > most
        print(f'{what}: {1000 * seconds:.0f} ms of {1000 * most:.0f}'
              f'{"" if seconds <= most else ", MISSED"}')
    print(f'three more files of it: {1000 * others:.0f} ms')
    return 1 if check and missed else 0


if __name__ == '__main__':
    sys.exit(main())
