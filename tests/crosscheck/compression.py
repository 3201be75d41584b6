"""The isotropic compression that all three codes run with the same walls, step by step.

Every wall moves inwards at a constant speed: no servo, nothing that one code could do otherwise.
"""
RATE = 0.05  # 1/s, of each dimension; 3,000 steps take the sample from 10 to 130 kPa
STEP = 5e-6  # s
# Contact forces are compared after so many steps; the last ends the compression.
LOOKS = (100, 300, 1000, 3000)
# The first look again at a step this much smaller: what is left of a difference is not the step's.
REFINEMENT = 8


def read_box(path):
    """Planes of the walls: x low, x high, y low, y high, z low, z high [m]."""
    with open(path, encoding='ascii') as file:
        return [float(word) for word in file.read().split()]


def wall_velocity(box, wall):
    """Velocity of a wall along its axis [m/s]."""
    axis = wall // 2
    inward = 1 - 2 * (wall % 2)
    return inward * 0.5 * RATE * (box[2 * axis + 1] - box[2 * axis])
