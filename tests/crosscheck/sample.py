"""Spheres of the cross-check, as CSV files that Grainfield reads.

  sample.py loose OUT BOX         spheres without contact or friction, drawn at random
  sample.py end RUN IN OUT BOX    where a `simulate` run of IN ended, at rest, and where its walls
                                  stood; still without friction
  sample.py rough IN OUT          the same spheres with the friction of their kinds
  sample.py nudged IN SEED OUT    the same spheres, each coordinate moved by 1e-12 m or so; seed 0
                                  moves nothing
  sample.py box IN OUT            planes through their outermost points, as `triaxial` takes them
"""
import csv
import sys

import numpy as np

from law import KINDS, kind_of

COUNT = 6000
LOOSE_BOX = np.array([0.38, 0.57, 0.38])  # m; a third of it is solid
SEED = 1


def loose():
    """Drawn one by one, the largest first; a place that is taken is drawn again."""
    rng = np.random.default_rng(SEED)
    largest = max(r for r, _, _ in KINDS)
    cell = 2 * largest
    taken = {}
    spheres = []
    for n in range(COUNT):
        radius = sorted(KINDS)[::-1][n * len(KINDS) // COUNT][0]
        while True:
            place = radius + rng.random(3) * (LOOSE_BOX - 2 * radius)
            home = tuple((place // cell).astype(int))
            around = [s for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)
                      for s in taken.get((home[0] + i, home[1] + j, home[2] + k), ())]
            if all(np.sum((place - x) ** 2) > (radius + r) ** 2 for x, r in around):
                break
        taken.setdefault(home, []).append((place, radius))
        spheres.append((*place, radius))
    order = rng.permutation(COUNT)  # ids say nothing of the kind
    return [spheres[n] for n in order]


def write(path, spheres, friction=None):
    """Columns of a sphere file; numbers as the shortest text that reads back as the same."""
    with open(path, 'w', encoding='ascii') as out:
        out.write('x,y,z,radius,normal_stiffness,friction_angle\n')
        for x, y, z, radius in spheres:
            _, stiffness, angle = KINDS[kind_of(radius)]
            angle = angle if friction is None else friction
            values = (x, y, z, radius, stiffness, angle)
            out.write(','.join(repr(float(v)) for v in values) + '\n')


def read(path):
    """x, y, z, radius of each sphere."""
    with open(path, encoding='ascii') as rows:
        return [tuple(float(row[c]) for c in ('x', 'y', 'z', 'radius'))
                for row in csv.DictReader(rows)]


def end_of(run, start):
    """The last positions of a run and its walls, whose places follow from the contacts with them."""
    radius = [s[3] for s in read(start)]
    table = np.genfromtxt(run + '/trajectory.csv', delimiter=',', names=True)
    last = table[table['time_s'] == table['time_s'][-1]]
    place = np.empty((len(radius), 3))
    for axis, name in enumerate('xyz'):
        place[last['id'].astype(int), axis] = last[name]
    contacts = np.genfromtxt(run + '/contacts.csv', delimiter=',', names=True)
    box = []
    for wall in range(6):
        touching = contacts[contacts['j'] == -1 - wall]
        inward = 1 - 2 * (wall % 2)
        planes = [place[int(c['i']), wall // 2] - inward * (radius[int(c['i'])] - c['overlap_m'])
                  for c in touching]
        box.append(float(np.mean(planes)))
    return [(*p, r) for p, r in zip(place, radius)], box


def write_box(path, box):
    with open(path, 'w', encoding='ascii') as file:
        file.write(' '.join(repr(p) for p in box) + '\n')


def main():
    command, *arguments = sys.argv[1:]
    if command == 'loose':
        out, box_file = arguments
        write(out, loose(), friction=0.0)
        write_box(box_file, [p for length in LOOSE_BOX for p in (0.0, float(length))])
    elif command == 'end':
        run, start, out, box_file = arguments
        spheres, box = end_of(run, start)
        write(out, spheres, friction=0.0)
        write_box(box_file, box)
    elif command == 'rough':
        source, out = arguments
        write(out, read(source))
    elif command == 'nudged':
        source, seed, out = arguments
        rng = np.random.default_rng(int(seed))
        size = 1e-12 if int(seed) > 0 else 0.0  # m
        write(out, [(*(np.array(s[:3]) + size * rng.standard_normal(3)), s[3])
                    for s in read(source)])
    elif command == 'box':
        source, out = arguments
        spheres = read(source)
        write_box(out, [end(s[axis] + side * s[3] for s in spheres)
                        for axis in range(3) for end, side in ((min, -1), (max, 1))])
    else:
        sys.exit(__doc__)


if __name__ == '__main__':
    main()
