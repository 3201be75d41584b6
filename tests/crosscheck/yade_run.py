"""One test of the cross-check in YADE. From the environment: TEST (compression, refined or
triaxial), SAMPLE (spheres, `x y z r` a line), BOX, OUT (the curve to write, or what the names of
the files of contacts begin with); this folder in PYTHONPATH."""
import os

from yade import *

from compression import read_box
from law import (ALL, DAMPING, DENSITY, KINDS, STIFFNESS_RATIO, kind_of, pair_stiffness,
                 wall_stiffness)
from programme import programme

box = read_box(os.environ['BOX'])
plan, O.dt = programme(os.environ['TEST'], box)

# Stiffnesses come from the tables below; young and poisson are not used. YADE takes the smaller of
# two friction angles.
material = [O.materials.append(FrictMat(young=k, poisson=STIFFNESS_RATIO, frictionAngle=angle,
                                        density=DENSITY)) for _, k, angle in KINDS]
smooth = O.materials.append(FrictMat(young=1, poisson=0, frictionAngle=0, density=0))
normal = [(material[a], material[b], pair_stiffness(a, b)) for a in ALL for b in ALL if a <= b]
normal += [(material[a], smooth, wall_stiffness(a)) for a in ALL]
tangential = [(a, b, STIFFNESS_RATIO * k) for a, b, k in normal]

kinds = []
for line in open(os.environ['SAMPLE'], encoding='ascii'):
    if line.startswith('#') or not line.strip():
        continue
    x, y, z, r = (float(v) for v in line.split()[:4])
    kinds.append(kind_of(r))
    O.bodies.append(utils.sphere((x, y, z), r, material=material[kinds[-1]]))
count = len(kinds)
for w in range(6):
    O.bodies.append(utils.wall(box[w], w // 2, sense=1 - 2 * (w % 2), material=smooth))


class Host:
    """What the programme asks of YADE."""
    stiffness_interval = 20  # steps; the walls' contacts change slowly

    def __init__(self):
        self.stiffness = [0.0] * 6
        self.age = 0

    def look(self):
        self.walls = [O.bodies[count + w].state.pos[w // 2] for w in range(6)]
        self.loads = [-O.forces.f(count + w)[w // 2] * (1 - 2 * (w % 2)) for w in range(6)]
        if self.age % self.stiffness_interval == 0:
            self.stiffness = [sum(i.phys.kn for i in O.bodies[count + w].intrs() if i.isReal)
                              for w in range(6)]
        self.age += 1

    def unbalanced(self):
        resultant = sum(O.forces.f(n).norm() for n in range(count)) / count
        pairs = [i.phys.normalForce.norm() for i in O.interactions if i.isReal]
        return resultant / (sum(pairs) / len(pairs))

    def scale(self, factor):
        for n in range(count):
            O.bodies[n].state.vel *= factor
            O.bodies[n].state.angVel *= factor

    def add_velocity(self, rate, zero):
        for n in range(count):
            p = O.bodies[n].state.pos
            O.bodies[n].state.vel += Vector3(*(rate[a] * (p[a] - zero[a]) for a in range(3)))

    def write_contacts(self, step):
        """Contacts with the columns of Grainfield's contacts.csv that are compared."""
        with open('%s-%d.csv' % (os.environ['OUT'], step), 'w', encoding='ascii') as out:
            out.write('i,j,normal_force_N,shear_force_x_N,shear_force_y_N,shear_force_z_N\n')
            for c in O.interactions:
                if not c.isReal:
                    continue
                # phys.shearForce acts on the second body.
                i, j, shear = c.id1, c.id2, -c.phys.shearForce
                if i > j:
                    i, j, shear = j, i, -shear
                if j >= count:
                    j = -1 - (j - count)
                out.write('%d,%d,%r,%r,%r,%r\n' % (i, j, c.phys.normalForce.norm(), *shear))


host = Host()


def steer():
    """Between forces and motion of a step."""
    host.look()
    for w, velocity in enumerate(plan.wall_velocities(host)):
        motion = Vector3(0, 0, 0)
        motion[w // 2] = velocity
        O.bodies[count + w].state.vel = motion
    if plan.ended:
        O.pause()


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.0005),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys(kn=MatchMaker(matches=normal),
                                                     ks=MatchMaker(matches=tangential))],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    PyRunner(command='steer()', iterPeriod=1, initRun=True),
    NewtonIntegrator(damping=DAMPING, gravity=(0, 0, 0)),
]
O.run(wait=True)

if os.environ['TEST'] == 'triaxial':
    plan.write(os.environ['OUT'])
    print('YADE: isotropic %d steps, shear %d steps, lateral stress within %.2e (RMS)' %
          (plan.isotropic_steps, plan.shear_steps, plan.lateral_rms_error()))
