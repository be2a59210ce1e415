// runtime/programs/validate/kinora_validate.cpp: checks COLLADA files: a command line to a batch of
// files.
#include "runtime/programs/validate/kinora_validate.h"

#include <cstdio>

#include "runtime/base/memory/heap.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/run_program.h"
#include "runtime/programs/common/standard_streams.h"

int main(int argc, char** argv) {
    kinora::ready_standard_streams();
    // A file's memory serves the next one: else a batch takes a tenth longer.
    kinora::ready_heap(kinora::kHeapOfStart);
    return kinora::run_program("kinora-validate", [&]() -> int {
        kinora::ValidateSettings settings;
        if (auto code = kinora::parse_validate_options(argc, argv, settings)) return *code;
        std::vector<std::string> files = kinora::expand_inputs(settings);
        return settings.fix ? kinora::fix_batch(settings, files)
                            : kinora::validate_batch(settings, files);
    });
}
