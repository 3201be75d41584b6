// What the parts of the stability bench share.

#include <fmt/format.h>

#include <cstdio>

#include "bench/stability.hpp"
#include "core/files/atomic_file.hpp"
#include "core/kernel_choice.hpp"

namespace grainfield::bench {

const kernels::KernelTable& double_kernels() {
    return core::choose_kernels({core::Precision::double_, core::Isa::automatic});
}

std::vector<NamedKernels> compared_kernels() {
    return {{"reference", &kernels::reference_kernels()},
            {"double", &double_kernels()},
            {"mixed", &core::choose_kernels({core::Precision::mixed, core::Isa::automatic})}};
}

void say(std::string_view line) {
    fmt::print(stderr, "{}\n", line);
}

core::Simulation copy_of(const core::Simulation& simulation, const kernels::KernelTable& kernels,
                         const core::SimulationOptions& options) {
    core::Simulation copy(simulation.scene(), kernels, options);
    copy.compute_forces();  // finds the neighbours, without whom there is no shear force to set
    std::vector<core::ContactShear> contacts;
    for (const core::TouchingContact& contact : simulation.touching())
        contacts.push_back({contact.i, contact.j, contact.shear});
    copy.restore_shear(contacts);
    copy.compute_forces(true);
    return copy;
}

double kinetic_energy(const core::Simulation& simulation) {
    const core::ParticleStore& s = simulation.spheres();
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i)
        sum += 0.5 * s.mass[i] *
               (s.velocity[i].squaredNorm() +
                0.4 * s.radius[i] * s.radius[i] * s.spin[i].squaredNorm());
    return sum;
}

void write_results(const StabilityRun& run, std::string_view name, std::string_view csv,
                   triaxial::report::PictureSize size,
                   const triaxial::report::GnuplotVariables& variables) {
    const triaxial::report::Gnuplot gnuplot(gnuplot_templates());
    const std::string stem(name);
    core::write_file_atomically(run.folder / (stem + ".csv"), csv);
    core::write_file_atomically(run.folder / (stem + ".png"),
                                gnuplot.png(name, name, size, variables));
}

}  // namespace grainfield::bench
