"""The results as a page: `table.py WORK`, to stdout."""
import csv
import glob
import json
import re
import sys

import numpy as np

import compression
from law import DAMPING, KINDS, STIFFNESS_RATIO, WALL_STIFFNESS
from programme import STEP
from sample import read

NAMES = {'grainfield': 'Grainfield', 'yade': 'YADE', 'lammps': 'LAMMPS',
         'like': 'LAMMPS like YADE (README)', 'half': 'itself at half the step', 'nudged': 'itself, start moved by 1e-12 m'}


def rows_of(path):
    with open(path, encoding='ascii') as file:
        return list(csv.DictReader(file))


def wall_stress(contacts, box):
    """Mean stress on the six walls [Pa]; the moved box is within 0.2 % of this one in area."""
    table = np.genfromtxt(contacts, delimiter=',', names=True)
    force = table['normal_force_N'][table['j'] < 0].sum()
    a, b, c = (box[2 * axis + 1] - box[2 * axis] for axis in range(3))
    return force / (2 * (a * b + b * c + c * a))


def sample(work):
    spheres = read(work + '/sample.csv')
    box = compression.read_box(work + '/compression.box')
    volume = np.prod([box[2 * axis + 1] - box[2 * axis] for axis in range(3)])
    solid = sum(4 / 3 * np.pi * s[3] ** 3 for s in spheres)
    last = compression.LOOKS[-1]
    before = wall_stress(work + '/rest/contacts.csv', box)
    after = wall_stress(f'{work}/compression-grainfield-{last}/contacts.csv', box)
    kinds = '; '.join(f'{1e3 * r:g} mm, {k:.1e} Pa, {angle:g} rad' for r, k, angle in KINDS)
    return f'''## Sample and law

{len(spheres)} spheres, a third of them each of: {kinds} (radius, k_n, friction angle), in a box with
walls without friction (k_n = {WALL_STIFFNESS:.1e} Pa), porosity {1 - solid / volume:.4f}, made by
Grainfield without friction, at rest under {before / 1e3:.1f} kPa. K_n from Eq. (4) of
[docs/method.md](../../../docs/method.md) for each pair of kinds, K_s = {STIFFNESS_RATIO:g} K_n, friction of the smaller angle, local damping {DAMPING:g} of force and moment.

| | Grainfield | YADE | LAMMPS |
|---|---|---|---|
| version | {' | '.join(versions(work))} |
| contact | Eqs. (3)-(6), double precision | `Law2_ScGeom_FrictPhys_CundallStrack` | `pair_style granular hooke`, `linear_history`, no viscous damping |
| K_n, K_s | from k_n and radii | a value for each pair of materials (`MatchMaker`) | a value for each pair of types (`pair_coeff`) |
| walls | planes | `utils.wall`, the same law | `wall/gran/region`, the same law, one fix for each kind |
| local damping | built in | `NewtonIntegrator` | added by `fix python/invoke` |
| walls' motion, servos | its own | `programme.py` | `programme.py` |

In the compression the sample goes from {before / 1e3:.1f} to {after / 1e3:.1f} kPa (mean of the walls).
'''


def versions(work):
    with open(work + '/versions.txt', encoding='utf-8') as file:
        return [line.strip() or 'not installed' for line in file]


def forces(work):
    out = '''## Contact forces

All walls move inwards at the same constant speeds in all codes; no servo. Differences are over the
RMS force of their kind; a contact that one code lacks counts with zero there. The last two columns:
the mean forces of the second run over those of the first, less one.

| runs | steps of | steps | contacts | in both | normal, RMS | largest | shear, RMS | largest | mean normal | mean shear |
|---|---|---|---|---|---|---|---|---|---|---|
'''
    for row in rows_of(work + '/forces.csv'):
        step = compression.STEP
        if row['test'] == 'refined':
            step /= compression.REFINEMENT
        out += '| {}, {} | {:.4g} µs | {} | {}, {} | {} | {} | {} | {} | {} | {:+.1e} | {:+.1e} |\n'.format(
            NAMES[row['first']], NAMES[row['second']], 1e6 * step, row['steps'],
            row['contacts_first'], row['contacts_second'], row['contacts_common'],
            *('%.1e' % float(row[c]) for c in ('normal_difference', 'normal_largest',
                                               'shear_difference', 'shear_largest')),
            float(row['mean_normal_difference']), float(row['mean_shear_difference']))
    return out + '\n![Contact forces](forces.png)\n'


def curves(work):
    rows = rows_of(work + '/curve-results.csv')
    own = [row for row in rows if row['code'] == 'grainfield' and row['run'] != 'mean']
    floor, early = (float(np.sqrt(np.mean([float(row[c]) ** 2 for row in own])))
                    for c in ('difference', 'difference_early'))
    out = f'''## Triaxial test

100 kPa, 0.1/s, to 3 % of axial strain, steps of {1e6 * STEP:g} µs; each code brings the sample to the
isotropic stress and shears it, with its own servo. Runs of one code start from positions that differ by
1e-12 m. Differences are RMS over the curve, from the mean of Grainfield's runs (of a run of
Grainfield: from the mean of its other runs), over the peak of that mean; "rise": up to 0.5 % of strain;
"scatter": the difference to expect of so many runs from the scatter of Grainfield's alone.

**Noise floor** (one run of Grainfield): {100 * floor:.2f} %, rise {100 * early:.2f} %.

| code | run | peak (kPa) | at strain (%) | E50 (MPa) | difference (%) | scatter (%) | rise (%) |
|---|---|---|---|---|---|---|---|
'''
    one = floor / np.sqrt(1 + 1 / (len(own) - 1))  # deviation of a run from the true mean
    for row in rows:
        values = [float(row[c]) for c in ('peak_Pa', 'strain_at_peak', 'E50_Pa', 'difference',
                                          'difference_early')]
        runs = 1 if row['run'] != 'mean' else sum(r['code'] == row['code'] for r in rows) - 1
        expected = f'{100 * one * np.sqrt(1 / runs + 1 / len(own)):.2f}'
        if row['code'] == 'grainfield':
            expected = '' if row['run'] == 'mean' else f'{100 * floor:.2f}'
        mark = '**' if row['run'] == 'mean' else ''
        cells = [NAMES[row['code']], row['run'], f'{values[0] / 1e3:.1f}', f'{100 * values[1]:.2f}',
                 f'{values[2] / 1e6:.2f}', f'{100 * values[3]:.2f}', expected,
                 f'{100 * values[4]:.2f}']
        out += '| ' + ' | '.join(mark + cell + mark if cell else '' for cell in cells) + ' |\n'
    return out + '\n' + stages(work) + '\n![Curves](curves.png)\n'


def stages(work):
    """Steps of the stages and the hold of the servos, of run 0 of each code."""
    lines = []
    for path in sorted(glob.glob(work + '/triaxial-grainfield-0/summary.json')):
        with open(path, encoding='utf-8') as file:
            s = json.load(file)
        lines.append('Grainfield: isotropic %d steps, shear %d steps, lateral stress within %.2e '
                     '(RMS)' % (s['isotropic_steps'], s['shear_steps'],
                                s['lateral_stress_rms_error']))
    for code in ('yade', 'lammps'):
        for path in glob.glob(f'{work}/{code}-triaxial-0.log'):
            with open(path, encoding='utf-8', errors='replace') as file:
                lines += re.findall('^(?:YADE|LAMMPS): isotropic.*', file.read(), re.M)
    return ''.join(f'- {line}\n' for line in lines)


def main(work):
    print('# Grainfield against YADE and LAMMPS\n\nWritten by `./dev crosscheck`.\n')
    print(sample(work))
    print(forces(work))
    print(curves(work), end='')


if __name__ == '__main__':
    main(sys.argv[1])
