"""Scenes for `grainfield simulate`, written to stdout; each belongs beside its spheres.

  scene.py settle SPHERES BOX STRESS END  servo walls at a stress [Pa], until a time [s]
  scene.py compress SPHERES BOX           all walls move inwards, as compression.py says
"""
import os
import sys

import compression
from law import DAMPING, DENSITY, STIFFNESS_RATIO, WALL_STIFFNESS

def head(spheres, step, end):
    return f'''[particles]
file = "{os.path.basename(spheres)}"
[particle]
density = {DENSITY}
stiffness_ratio = {STIFFNESS_RATIO}
[damping]
force = {DAMPING}
moment = {DAMPING}
[time]
step = {step}
end = {end!r}
[output]
interval = {end!r}
'''


def wall(number, position, motion):
    axis = number // 2
    point = [0.0, 0.0, 0.0]
    normal = [0, 0, 0]
    point[axis] = position
    normal[axis] = 1 - 2 * (number % 2)
    return f'''[[wall]]
point = {point}
normal = {normal}
friction_angle = 0
normal_stiffness = {WALL_STIFFNESS}
{motion}
'''


def settle(spheres, box_file, stress, end):
    box = compression.read_box(box_file)
    walls = [wall(n, box[n], f'stress = {float(stress)}') for n in range(6)]
    return head(spheres, '"auto"', float(end)) + ''.join(walls)


def compress(spheres, box_file):
    box = compression.read_box(box_file)
    walls = []
    for n in range(6):
        velocity = [0.0, 0.0, 0.0]
        velocity[n // 2] = compression.wall_velocity(box, n)
        walls.append(wall(n, box[n], f'velocity = {velocity}'))
    step = compression.STEP
    return head(spheres, step, compression.LOOKS[-1] * step) + ''.join(walls)


if __name__ == '__main__':
    command, *arguments = sys.argv[1:]
    print({'settle': settle, 'compress': compress}[command](*arguments), end='')
