// `info`: what is in a file, in a few lines.

#include "core/files/file_info.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/standard_streams.hpp"

namespace grainfield::triaxial {

void add_info_command(CommandLine& line) {
    auto file = std::make_shared<std::string>();
    ArgumentParser command = line.add("info", "Says in a few lines what is in a file.",
                                      "grainfield info packing.h5", [file](Session& session) {
                                          note_unused_settings(session);
                                          write_result(core::describe_file(*file));
                                      });
    command.add("file", *file, "A file that any subcommand reads or writes").required();
}

}  // namespace grainfield::triaxial
