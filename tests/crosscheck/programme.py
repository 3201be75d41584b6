"""What the walls do, for YADE and LAMMPS: either the isotropic compression of compression.py or
the triaxial test, with servos like those of Grainfield (core/drive/servo.cpp) and in the same stages
(packing/isotropic.cpp, triaxial/realization/shear.cpp).

A code brings a `host` with
  walls        planes now: x low, x high, y low, y high, z low, z high [m]
  loads        compressive force of the spheres on each wall now [N]
  stiffness    sum of K_n over the contacts of each wall [N/m]
  unbalanced() mean resultant of the spheres over mean normal contact force [-]
  scale(factor)             multiplies all velocities and spins
  add_velocity(rate, zero)  adds rate * (x - zero) to the velocities, an axis at a time
  write_contacts(step)      the contact forces now, to a file
and calls `wall_velocities` once a step, with the forces of the present positions.
"""
import compression

INWARD = (1, -1, 1, -1, 1, -1)


class Compression:
    """Walls at constant speeds; `host.write_contacts(step)` where forces are compared."""

    def __init__(self, box, looks):
        self.looks = looks
        self.velocities = [compression.wall_velocity(box, w) for w in range(6)]
        self.steps = 0
        self.ended = False

    def wall_velocities(self, host):
        if self.steps in self.looks:
            host.write_contacts(self.steps)
        self.ended = self.steps == self.looks[-1]
        self.steps += 1
        return self.velocities


class Servo:
    """Integral servo of one wall, as core/drive/servo.hpp describes it."""
    GAIN, INTEGRAL = 0.8, 0.02

    def __init__(self, wall, stress, step):
        self.wall, self.stress, self.step = wall, stress, step
        self.steady = 0.0  # integral part, outwards [m/s]

    def velocity(self, host, area, cap):
        """Velocity along the axis [m/s]; keeps the relative error of the stress."""
        error = host.loads[self.wall] - self.stress * area
        self.error = error / (self.stress * area)
        speed = -cap
        if host.stiffness[self.wall] > 0:
            answer = error / host.stiffness[self.wall] / self.step
            grown = self.steady + self.INTEGRAL * answer
            wanted = self.GAIN * answer + grown
            speed = min(max(wanted, -cap), cap)
            if speed == wanted:
                self.steady = grown
        return -INWARD[self.wall] * speed


def area(size, wall):
    return size[(wall // 2 + 1) % 3] * size[(wall // 2 + 2) % 3]


def size_of(walls):
    return [walls[2 * a + 1] - walls[2 * a] for a in range(3)]


class Triaxial:
    """Isotropic compression to `stress`, then shear at `rate` to `strain`; fills `curve`."""
    POISSON = (1 - 0.1) / (4 + 0.1)  # of the affine start, for k_s/k_n = 0.1
    RECORDING = 5e-5  # of axial strain

    def __init__(self, box, step, stress, rate, strain):
        self.step, self.stress, self.rate, self.strain = step, stress, rate, strain
        self.servos = [Servo(w, stress, step) for w in range(6)]
        self.start = size_of(box)
        self.steps, self.reached, self.shearing, self.ended = 0, False, False, False
        self.curve = []  # axial strain, sigma_y, sigma_x, sigma_z, volumetric strain

    def wall_velocities(self, host):
        size = size_of(host.walls)
        self.steps += 1
        return self.shear(host, size) if self.shearing else self.compress(host, size)

    def compress(self, host, size):
        if self.reached:
            # Walls and spheres at once: spheres that move with the strain against walls that stand,
            # if only for one step, push q to -4.5 % of the confining stress.
            self.begin_shear(host, size)
            return self.shear(host, size)
        velocities = [s.velocity(host, area(size, s.wall), 0.25 * self.start[s.wall // 2])
                      for s in self.servos]
        worst = max(abs(s.error) for s in self.servos)
        if (self.steps - 1) % 20 == 0 and worst < 0.02:
            host.scale(0.85)
            self.reached = worst < 2e-3 and host.unbalanced() < 1e-3
        return velocities

    def begin_shear(self, host, size):
        self.isotropic_steps = self.steps - 1
        self.shearing, self.start = True, size
        lateral = self.POISSON * self.rate
        middle = [host.walls[2 * a] + 0.5 * size[a] for a in range(3)]
        middle[1] = host.walls[2]
        host.add_velocity((lateral, -self.rate, lateral), middle)
        self.servos = [Servo(w, self.stress, self.step) for w in (0, 1, 4, 5)]
        for servo in self.servos:
            servo.steady = 0.5 * lateral * size[servo.wall // 2]
        self.sums, self.count, self.next_strain = [0.0] * 3, 0, 0.0
        self.square_error, self.shear_steps = 0.0, 0

    def shear(self, host, size):
        velocities = [0.0] * 6
        velocities[3] = -self.rate * size[1]
        for s in self.servos:
            cap = 5 * self.rate * 0.5 * self.start[s.wall // 2]
            velocities[s.wall] = s.velocity(host, area(size, s.wall), cap)
        self.shear_steps += 1
        self.count += 1
        for axis in range(3):
            stress = 0.5 * (host.loads[2 * axis] + host.loads[2 * axis + 1]) / area(size, 2 * axis)
            self.sums[axis] += stress
            if axis != 1:
                self.square_error += 0.5 * (stress / self.stress - 1) ** 2
        strain = 1 - size[1] / self.start[1]
        if strain >= self.next_strain:
            self.record(size, strain)
        return velocities

    def record(self, size, strain):
        x, y, z = (s / self.count for s in self.sums)
        volume = [a / b for a, b in zip(size, self.start)]
        self.curve.append((strain, y - 0.5 * (x + z), y, x, z, 1 - volume[0] * volume[1] * volume[2]))
        self.sums, self.count = [0.0] * 3, 0
        self.next_strain += self.RECORDING
        self.ended = strain >= self.strain

    def lateral_rms_error(self):
        return (self.square_error / self.shear_steps) ** 0.5

    def write(self, path):
        """The curve with the columns of Grainfield's curve.csv that both have."""
        with open(path, 'w', encoding='ascii') as out:
            out.write('axial_strain,deviator_stress_Pa,axial_stress_Pa,lateral_stress_x_Pa,'
                      'lateral_stress_z_Pa,volumetric_strain\n')
            for point in self.curve:
                out.write(','.join(repr(float(v)) for v in point) + '\n')


STEP = 2e-5  # s, of the triaxial test; about 0.6 of the stability limit


def programme(test, box):
    """The programme of a test and its step [s]."""
    if test == 'compression':
        return Compression(box, compression.LOOKS), compression.STEP
    if test == 'refined':
        looks = [compression.LOOKS[0] * compression.REFINEMENT]
        return Compression(box, looks), compression.STEP / compression.REFINEMENT
    return Triaxial(box, STEP, stress=100e3, rate=0.1, strain=0.03), STEP
