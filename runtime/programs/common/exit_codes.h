// runtime/programs/common/exit_codes.h: what the programs' exit codes and environment mean; --help
// prints it.
#pragma once

namespace kinora {

enum ExitCode : int {
    kExitOk = 0,
    kExitSomeFailed = 1,  // some frames or files failed
    kExitUsage = 2,
    kExitUnreadable = 3,     // scene unreadable
    kExitShader = 4,         // shader error
    kExitMissingAsset = 5,   // under --strict
    kExitUnwritable = 6,     // output cannot be written
    kExitInternal = 70,      // a mistake of the program itself
    kExitRetry = 75,         // retry may help: disk full, out of memory
    kExitInterrupted = 130,  // SIGINT; others are 128 and the signal's number, too
    kExitTerminated = 143,   // SIGTERM
};

inline constexpr const char* kExitCodeHelp =
    "Exit codes: 0 ok; 1 some frames or files failed; 2 usage; 3 scene unreadable; 4 shader "
    "error;\n"
    "5 missing asset under --strict; 6 output cannot be written; 70 a mistake of the program\n"
    "itself; 75 retry may help (disk full, out of memory); 130/143 stopped by SIGINT/SIGTERM,\n"
    "finished frames kept (129 SIGHUP, 152 SIGXCPU, 153 SIGXFSZ).";

// jit/debug/code_tools.h reads these.
inline constexpr const char* kEnvironmentHelp =
    "Compiled shaders for other tools, by the environment: KINORA_PERF=1 (perf's map file),\n"
    "KINORA_JITDUMP=FOLDER (code and lines for perf inject --jit), KINORA_GDB=1.";

}  // namespace kinora
