"""Stress-strain curves of the triaxial test.

  curves.py WORK   reads what `run` left in WORK, writes curves.csv (all on one grid of strains) and
                   curve-results.csv (a row a run, then a row a code) there

Every run of a code starts from the sample with each coordinate moved by 1e-12 m or so. Runs of one
code part after a while, as those of any chaotic system do; what they then differ by is the noise
floor that differences between the codes are held against.
"""
import glob
import sys

import numpy as np

CODES = ('grainfield', 'yade', 'lammps')
GRID = np.arange(1, 301) * 1e-4  # axial strain [-]
EARLY = GRID <= 5e-3  # the rise of the curve, up to about half the strain at the peak


def read(path):
    """Strain, deviator stress, volumetric strain."""
    table = np.genfromtxt(path, delimiter=',', names=True)
    return (table['axial_strain'], table['deviator_stress_Pa'], table['volumetric_strain'])


def smooth(strain, values):
    """Mean over a bin of the grid around each of its points."""
    edges = np.concatenate([GRID - 5e-5, [GRID[-1] + 5e-5]])
    count, _ = np.histogram(strain, edges)
    total, _ = np.histogram(strain, edges, weights=values)
    return np.where(count > 0, total / np.maximum(count, 1), np.interp(GRID, strain, values))


def results(path):
    """Peak [Pa], strain there, E50 [Pa]: of the recorded points, as triaxial/realization/curve.cpp."""
    strain, q, _ = read(path)
    top = int(np.argmax(q))
    half = 0.5 * q[top]
    k = int(np.argmax(q >= half))
    if k == 0:
        return q[top], strain[top], half / strain[0]
    at = strain[k - 1] + (half - q[k - 1]) / (q[k] - q[k - 1]) * (strain[k] - strain[k - 1])
    return q[top], strain[top], half / at


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def main(work):
    paths = {code: sorted(glob.glob(f'{work}/triaxial-{code}-*/curve.csv')) for code in CODES}
    curves = {code: np.array([smooth(*read(p)[:2]) for p in paths[code]])
              for code in CODES if paths[code]}
    volumes = {code: np.array([smooth(read(p)[0], read(p)[2]) for p in paths[code]])
               for code in curves}
    own = curves['grainfield']
    mean, peak = own.mean(axis=0), own.mean(axis=0).max()
    with open(work + '/curve-results.csv', 'w', encoding='ascii') as out:
        out.write('code,run,peak_Pa,strain_at_peak,E50_Pa,difference,difference_early\n')
        for code in curves:
            rows = []
            for n, (path, curve) in enumerate(zip(paths[code], curves[code])):
                # A run of Grainfield against the mean of the others.
                others = np.delete(own, n, axis=0).mean(axis=0) if code == 'grainfield' else mean
                error = (curve - others) / peak
                rows.append([*results(path), rms(error), rms(error[EARLY])])
                out.write(f'{code},{n},' + ','.join(f'{v:.6g}' for v in rows[-1]) + '\n')
            error = (curves[code].mean(axis=0) - mean) / peak
            means = [*np.mean(rows, axis=0)[:3], rms(error), rms(error[EARLY])]
            out.write(f'{code},mean,' + ','.join(f'{v:.6g}' for v in means) + '\n')
    names, columns = ['axial_strain'], [GRID]
    for code in curves:
        for what, values in (('q', curves[code]), ('volumetric', volumes[code])):
            names += [f'{code}_{what}_{part}' for part in ('mean', 'least', 'most')]
            columns += [values.mean(axis=0), values.min(axis=0), values.max(axis=0)]
    np.savetxt(work + '/curves.csv', np.transpose(columns), delimiter=',', fmt='%.6g', comments='',
               header=','.join(names))


if __name__ == '__main__':
    main(sys.argv[1])
