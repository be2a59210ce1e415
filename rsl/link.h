// rsl/link.h: a shader and its co-shaders, compiled as one shader.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rsl/compile.h"

namespace kinora::rsl {

// Texts that a parameter is bound to: of a string, or handles for one of type shader.
using LinkTexts = std::map<std::string, std::vector<std::string>, std::less<>>;

struct LinkedSource {
    std::string handle;  // "" of the shader itself
    ShaderSource source;
    std::string shader;  // its name; "": the first of the source
    LinkTexts texts;     // what decides which shaders are called
};

// The first is the shader itself, the others are its co-shaders, whose parameters it gets as
// "handle.name". Those that it cannot come to are left out. Null after an error.
std::unique_ptr<Shader> compile_linked(const std::vector<LinkedSource>& sources,
                                       const CompileOptions& options, Diagnostics& diagnostics);

}  // namespace kinora::rsl
