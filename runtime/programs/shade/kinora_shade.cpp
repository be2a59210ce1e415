// runtime/programs/shade/kinora_shade.cpp: the shader writer's tool: a command line to its command.
#include "runtime/programs/shade/kinora_shade.h"

#include <cstdio>
#include <string_view>

#include "runtime/base/memory/heap.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/run_program.h"
#include "runtime/programs/common/standard_streams.h"

namespace kinora {

namespace {

struct Command {
    std::string_view name;
    int (*run)(const ShadeOptions&);
};
constexpr Command kCommands[] = {
    {"check", shade_check},   {"info", shade_info},   {"run", shade_run},
    {"dump", shade_dump},     {"bench", shade_bench}, {"tradeoff", shade_tradeoff},
    {"manual", shade_manual},
};

}  // namespace

}  // namespace kinora

int main(int argc, char** argv) {
    kinora::ready_standard_streams();
    kinora::ready_heap(kinora::kHeapOfStart);
    return kinora::run_program("kinora-shade", [&]() -> int {
        kinora::ShadeOptions options;
        if (std::optional<int> code = kinora::parse_shade_options(argc, argv, options))
            return *code;
        for (const kinora::Command& command : kinora::kCommands)
            if (command.name == options.command) return command.run(options);
        return kinora::kExitUsage;
    });
}
