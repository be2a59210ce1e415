// runtime/programs/kinora_validate.cpp: checks COLLADA files: a command line to a batch of files.
#include "runtime/programs/kinora_validate.h"

#include <csignal>
#include <cstdio>
#include <new>

#include "runtime/programs/exit_codes.h"

int main(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away ends the report, not the process
    try {
        kinora::ValidateSettings settings;
        if (auto code = kinora::parse_validate_options(argc, argv, settings)) return *code;
        std::vector<std::string> files = kinora::expand_inputs(settings);
        return settings.fix ? kinora::fix_batch(settings, files)
                            : kinora::validate_batch(settings, files);
    } catch (const std::bad_alloc&) {
        std::fputs("kinora-validate: out of memory\n", stderr);
        return kinora::kExitRetry;
    }
}
