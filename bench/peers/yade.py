"""The sample in YADE with linear springs and local damping; SAMPLE and WALLS from the environment."""
import os
import time

from yade import *

grain = O.materials.append(
    FrictMat(young=4.5e8, poisson=0.1, frictionAngle=0.6, density=2600))
smooth = O.materials.append(
    FrictMat(young=4.5e8, poisson=0.1, frictionAngle=0, density=0))
for line in open(os.environ['SAMPLE']):
    if line.startswith('#') or not line.strip():
        continue
    x, y, z, r = (float(v) for v in line.split()[:4])
    O.bodies.append(utils.sphere((x, y, z), r, material=grain))
walls = [float(v) for v in os.environ['WALLS'].split()]
for axis in range(3):
    O.bodies.append(utils.wall(walls[axis], axis, sense=1, material=smooth))
    O.bodies.append(utils.wall(walls[3 + axis], axis, sense=-1, material=smooth))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.001),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.2, gravity=(0, 0, 0)),
]
O.dt = 5e-6
O.run(20, True)
start = time.time()
O.run(60, True)
print('YADE        %8.2f ms a step' % ((time.time() - start) / 60 * 1e3))
