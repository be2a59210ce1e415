// runtime/programs/shade/kinora_shade.h: what kinora-shade was asked for, and the commands that do
// it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jit/math/math.h"
#include "jit/target.h"
#include "rsl/compile.h"

namespace kinora {

struct ShadeOptions {
    std::string command;
    std::string source;  // FILE.sl, SCENE.dae#effect or - for stdin; for `manual` a name
    std::vector<std::string> sources;         // check: several
    std::string shader;                       // which of the source; "": the first
    rsl::CompileOptions compile;              // a scene's shader is held to the scene's folder
    std::vector<std::string> allow_external;  // and to these
    bool preprocess_only = false;             // -E
    bool warnings_fail = false;               // -Werror, --fail-on warning
    bool strict = false;                      // what a scene leaves out is an error
    bool json = false;                        // check, info, bench
    bool quiet = false, verbose = false;
    bool silent = false;                                          // findings are told otherwise
    std::vector<std::pair<std::string, std::string>> params;      // NAME, VALUE
    std::vector<std::pair<std::string, std::string>> co_shaders;  // HANDLE, FILE
    int width = 256, height = 256;                                // of the grid of points
    bool sphere = false;
    bool flip = false;  // a light shines along -z of its space
    std::string output = "Ci";
    const jit::Target* target = nullptr;  // null: run: the best; bench: all this CPU supports
    jit::math::Tier math = jit::math::Tier::Precise;
    int iterations = 0;                 // 0: the command's own
    std::string compare;                // "", "interp", "reference"
    std::string points;                 // --points
    std::string file;                   // -o
    std::vector<std::string> stages;    // dump
    std::string markdown;               // manual: a name of manual_pages.h; "": for the terminal
    std::vector<std::string> unwarned;  // -Wno-NAME: codes of findings that are left out
};

// Reads the command line. Returns an exit code when there is nothing to do (help, usage error,
// which is printed), nothing otherwise.
std::optional<int> parse_shade_options(int argc, char** argv, ShadeOptions& options);

// The commands; each returns an exit code.
int shade_check(const ShadeOptions& options);     // check.cpp
int shade_info(const ShadeOptions& options);      // info.cpp
int shade_run(const ShadeOptions& options);       // run.cpp
int shade_points(const ShadeOptions& options);    // points_run.cpp: run --points
int shade_dump(const ShadeOptions& options);      // dump.cpp
int shade_bench(const ShadeOptions& options);     // bench.cpp
int shade_tradeoff(const ShadeOptions& options);  // tradeoff.cpp
int shade_manual(const ShadeOptions& options);    // manual.cpp

}  // namespace kinora
