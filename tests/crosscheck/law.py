"""The spheres of the cross-check and the contact law that all three codes are given.

Three kinds of spheres of different size, stiffness and friction, so that both sides of Eq. (4) of
Tran et al. (docs/method.md) and the smaller of two friction angles are put to the test in every
contact between unlike spheres.
"""
import math

DENSITY = 2600.0  # kg/m3
STIFFNESS_RATIO = 0.1  # k_s/k_n
DAMPING = 0.2  # local, of force and moment
WALL_STIFFNESS = 9e8  # Pa, of a wall as a body; walls have no friction

# radius (m), k_n (Pa), friction angle (rad)
KINDS = ((0.008, 12e8, 0.5), (0.010, 9e8, 0.6), (0.012, 6e8, 0.7))
ALL = range(len(KINDS))


def pair_stiffness(a, b):
    """Eq. (4) of Tran et al.: K_n = r kA kB / (kA + kB), r the mean radius [N/m]."""
    (ra, ka, _), (rb, kb, _) = KINDS[a], KINDS[b]
    return 0.5 * (ra + rb) * ka * kb / (ka + kb)


def wall_stiffness(a):
    """The same against a wall, r the radius of the sphere [N/m]."""
    radius, k, _ = KINDS[a]
    return radius * k * WALL_STIFFNESS / (k + WALL_STIFFNESS)


def pair_friction(a, b):
    """Coefficient of friction: the tangent of the smaller angle [-]."""
    return math.tan(min(KINDS[a][2], KINDS[b][2]))


def kind_of(radius):
    """Which kind a sphere is of, by its radius."""
    return min(ALL, key=lambda a: abs(KINDS[a][0] - radius))
