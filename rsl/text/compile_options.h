// rsl/text/compile_options.h: a shader source, and what a command line says about compiling it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/base/allowed_paths.h"
#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

// Text to compile and where its bytes stand: a whole .sl file (identity map) or the decoded <code>
// of a .dae. The views need to live only during compile().
struct ShaderSource {
    std::string_view text;
    SourceMap map;  // map.file is registered in the Diagnostics given to compile()
};

struct CompileOptions {
    std::vector<std::string> include_directories;  // after the including file's own
    std::vector<std::pair<std::string, std::string>>
        defines;                         // -D NAME=VALUE ("1" when none given)
    std::vector<std::string> undefines;  // -U NAME
    int max_errors = 20;                 // then one "too many errors" and silence
    bool require_implemented = true;     // a built-in whose row has no lowering is an error
    // What the source may read. #include of a file elsewhere is an error, a literal that names a
    // point file elsewhere a warning (whoever runs the shader must refuse it).
    AllowedPaths files;
    AllowedPaths pictures;  // likewise for literals that name textures and maps
    // How many numbers or texts parameters are bound to: "T a[]" is that long. Linked shaders have
    // counts of their own (rsl/link.h).
    std::map<std::string, size_t, std::less<>> counts;
};

}  // namespace kinora::rsl
