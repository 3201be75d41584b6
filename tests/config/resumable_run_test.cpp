// Going on from a checkpoint: with its config and kernels, or a message that says what differs.

#include "triaxial/cli/resumable_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/message_of.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/config/write_config.hpp"

namespace grainfield::triaxial {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Settings = std::vector<std::string>;

core::FoundCheckpoint checkpoint_of(const Settings& settings) {
    core::FoundCheckpoint found;
    found.file = "run/checkpoint.bin";
    const nlohmann::json identity = {{"command", "triaxial"},
                                     {"isa", "avx2"},
                                     {"precision", "mixed"},
                                     {"config", write_config(load_config(std::nullopt, settings))}};
    found.identity = identity.dump();
    return found;
}

TEST(ResumedRun, HasTheConfigOfItsCheckpoint) {
    const Settings settings{"packing.seed=7", "field.variable=friction"};
    const core::FoundCheckpoint found = checkpoint_of(settings);
    for (const Settings& here : {Settings{}, settings}) {
        const Config config = resumed_config(found, std::nullopt, here);
        EXPECT_EQ(config.packing.seed, 7u);
        EXPECT_EQ(config.field.variable, randomfield::Variable::friction);
    }
}

TEST(ResumedRun, NamesTheFirstKeyThatDiffers) {
    const core::FoundCheckpoint found = checkpoint_of({"packing.seed=7"});
    EXPECT_THAT(message_of<InputError>(
                    [&] { resumed_config(found, std::nullopt, Settings{"packing.seed=8"}); }),
                AllOf(HasSubstr("--resume: run/checkpoint.bin is of another config"),
                      HasSubstr("here [packing] seed = 8; the checkpoint has seed = 7")));
}

TEST(ResumedRun, HasTheKernelsOfItsCheckpointUnlessOthersAreAskedFor) {
    const core::FoundCheckpoint found = checkpoint_of({});
    EXPECT_EQ(resumed_solver(found, "triaxial", {}).isa, kernels::InstructionSet::avx2);
    EXPECT_EQ(resumed_solver(found, "triaxial", {.isa = kernels::InstructionSet::scalar}).isa,
              kernels::InstructionSet::scalar);
    EXPECT_EQ(message_of<InputError>([&] { resumed_solver(found, "simulate", {}); }),
              "--resume: run/checkpoint.bin is a checkpoint of `triaxial`");
}

}  // namespace
}  // namespace grainfield::triaxial
