// rsl/link.h: a shader and its co-shaders, compiled as one shader.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rsl/compile.h"

namespace kinora::rsl {

struct LinkedSource {
    std::string handle;  // "" of the shader itself
    ShaderSource source;
    std::string shader;  // its name; "": the first of the source
    LinkTexts texts;     // what decides which shaders are called
    LinkCounts counts = {};
};

// The first is the shader itself, the others are its co-shaders, whose parameters it gets as
// "handle.name". Those that it cannot come to are left out. Null after an error.
std::unique_ptr<Shader> compile_linked(const std::vector<LinkedSource>& sources,
                                       const CompileOptions& options, Diagnostics& diagnostics);

// What the parts of a linked shader were; views of them.
std::vector<LinkedSource> sources_of(const std::vector<LinkedPart>& parts);

// The shader again, with `edited` in place of the text that it stands in, and of all parts that
// stood in that text and do now. Null after an error.
std::unique_ptr<Shader> link_again(const Shader& linked, const ShaderSource& edited,
                                   const CompileOptions& options, Diagnostics& diagnostics);

// Whether a parameter of open length, "T a[]", is another length than that bound to it.
bool other_lengths(const Shader& shader, const LinkCounts& counts);

// Whether its source speaks of other shaders, so that linking it can change it.
bool knows_co_shaders(const Shader& shader);

// Whether its source can mean the co-shader of this handle: by its name, by a category, or by a
// text that is known only when it runs.
bool may_mean(const Shader& shader, std::string_view handle);

// The parameter of this name, if it holds handles of co-shaders; null: it does not.
const Symbol* find_handle_parameter(const Shader& shader, std::string_view name);

// The handles in texts given to such a parameter: commas divide them, "" and "null" are none.
std::vector<std::string> handles_in(const std::vector<std::string>& texts);

// The shader itself and the co-shaders that a copy of it needs: those that it uses, and those that
// stand in its text. Numbers of parts.
std::vector<size_t> parts_to_keep(const Shader& linked);

// The text of a shader, or of a part of a linked one, for other documents: includes and macros are
// expanded. Structs and classes are as they were written.
std::string portable_text(const Shader& shader, size_t part = 0);

}  // namespace kinora::rsl
