"""Contact forces of two runs, contact by contact.

  forces.py WORK   reads what `run` left in WORK, writes forces.csv (one row a pair of runs and a
                   look) and scatter.csv (one row a contact) there

A difference is given over the RMS of the first run's forces: of the normal forces over that of the
normal forces, of the shear forces (as vectors) over that of the shear forces. A contact that only
one run has counts with zero in the other.
"""
import os
import sys

import numpy as np

import compression

COLUMNS = ('normal_force_N', 'shear_force_x_N', 'shear_force_y_N', 'shear_force_z_N')
RUNS = ('grainfield', 'yade', 'lammps', 'like', 'nudged', 'half')  # as `run` names them
PAIRS = (('grainfield', 'yade'), ('grainfield', 'lammps'), ('lammps', 'yade'),
         ('like', 'yade'), ('grainfield', 'half'), ('grainfield', 'nudged'))


def read(path):
    """Forces by (i, j): normal, shear on i."""
    with open(path, encoding='ascii') as file:
        names = file.readline().strip().split(',')
    columns = [names.index(c) for c in ('i', 'j', *COLUMNS)]
    table = np.loadtxt(path, delimiter=',', skiprows=1, usecols=columns)
    return {(int(row[0]), int(row[1])): row[2:] for row in table}


def path_of(work, test, run, steps):
    """Grainfield writes one folder a run, the others one file a look."""
    if run in ('yade', 'lammps', 'like'):
        return f'{work}/{test}-{run}-{steps}.csv'
    return f'{work}/{test}-{run}-{steps}/contacts.csv'


def matched(first, second):
    """Forces of all contacts that either run has, and how many both have."""
    nothing = np.zeros(4)
    keys = sorted(set(first) | set(second))
    return (np.array([first.get(k, nothing) for k in keys]),
            np.array([second.get(k, nothing) for k in keys]), len(set(first) & set(second)))


def rms(rows):
    return np.sqrt(np.mean(np.sum(np.atleast_2d(rows) ** 2, axis=-1)))


def compare(first, second):
    """One row of forces.csv."""
    a, b, common = matched(first, second)
    row = [len(first), len(second), common]
    for columns in (slice(0, 1), slice(1, 4)):
        scale = rms(a[:, columns])
        difference = a[:, columns] - b[:, columns]
        row += [scale, rms(difference) / scale,
                np.sqrt(np.max(np.sum(difference ** 2, axis=1))) / scale]
    row.append(np.mean(b[:, 0]) / np.mean(a[:, 0]) - 1)
    row.append(np.mean(np.linalg.norm(b[:, 1:], axis=1)) /
               np.mean(np.linalg.norm(a[:, 1:], axis=1)) - 1)
    return row


HEADER = ('test,first,second,steps,contacts_first,contacts_second,contacts_common,'
          'normal_rms_N,normal_difference,normal_largest,'
          'shear_rms_N,shear_difference,shear_largest,mean_normal_difference,mean_shear_difference')


def main(work):
    looks = [('compression', n) for n in compression.LOOKS]
    looks.append(('refined', compression.LOOKS[0] * compression.REFINEMENT))
    with open(work + '/forces.csv', 'w', encoding='ascii') as out:
        out.write(HEADER + '\n')
        for test, steps in looks:
            runs = {run: read(path) for run in RUNS
                    if os.path.exists(path := path_of(work, test, run, steps))}
            for first, second in PAIRS:
                if first in runs and second in runs:
                    row = compare(runs[first], runs[second])
                    out.write(f'{test},{first},{second},{steps},' +
                              ','.join(f'{v:.8g}' for v in row) + '\n')
    scatter(work)


def scatter(work):
    """Forces at the end for the picture: those of Grainfield, then of each peer (or nan)."""
    last = compression.LOOKS[-1]
    own = read(path_of(work, 'compression', 'grainfield', last))
    columns = [[f[0] for f in own.values()], [np.linalg.norm(f[1:]) for f in own.values()]]
    for run in ('yade', 'lammps'):
        path = path_of(work, 'compression', run, last)
        other = read(path) if os.path.exists(path) else {}
        forces = [other.get(key, np.full(4, np.nan)) for key in own]
        columns += [[f[0] for f in forces], [np.linalg.norm(f[1:]) for f in forces],
                    [np.linalg.norm(f[1:] - g[1:]) for f, g in zip(forces, own.values())]]
    np.savetxt(work + '/scatter.csv', np.transpose(columns), delimiter=',', fmt='%.6g', comments='',
               header='normal,shear,yade_normal,yade_shear,yade_shear_difference,'
                      'lammps_normal,lammps_shear,lammps_shear_difference')


if __name__ == '__main__':
    main(sys.argv[1])
