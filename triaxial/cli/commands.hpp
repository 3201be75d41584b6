#pragma once
// The subcommands, one source file each.

#include "triaxial/cli/command_line.hpp"

namespace grainfield::triaxial {

void add_pack_command(CommandLine& line);
void add_field_command(CommandLine& line);
void add_triaxial_command(CommandLine& line);
void add_montecarlo_command(CommandLine& line);
void add_report_command(CommandLine& line);
void add_simulate_command(CommandLine& line);
void add_convert_command(CommandLine& line);
void add_info_command(CommandLine& line);

/// For subcommands that read no config: checks what --set says and notes that it has no effect.
void note_unused_settings(const Session& session);

}  // namespace grainfield::triaxial
