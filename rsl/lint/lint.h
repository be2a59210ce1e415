// rsl/lint/lint.h: warnings about source that compiles and is most likely a slip.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rsl/model/shader.h"
#include "runtime/base/diagnostic.h"

namespace kinora::rsl {

struct LintOptions {
    FileId file = kNoFile;             // of the source: included files are not looked at
    std::vector<std::string> folders;  // where textures that are named in the source are sought
};

// The shaders of one source that compiled without an error.
void lint(std::span<const std::unique_ptr<Shader>> shaders, const LintOptions& options,
          Diagnostics& diagnostics);

// The name that switches a warning off, as in -Wno-unused-variable for RSL_UNUSED_VARIABLE.
std::string warning_name(const FindingInfo& info);
// The finding that -Wno-NAME means, by that name or its code; null where no warning has that name.
const FindingInfo* find_warning(std::string_view name);
std::vector<std::string> warning_names();

}  // namespace kinora::rsl
