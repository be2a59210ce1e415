// runtime/scene/load/override_shader.h: shaders tried on without editing the scene: --shader,
// --atmosphere, --imager. A shader is given as FILE.sl or as the name of one of ours
// (library_shader_names()).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/description/shader_library.h"

namespace kinora {

// A shader given as FILE.sl, not as the name of one of ours.
bool names_shader_file(std::string_view shader);

// The shader of ours with that name; null after SHADER_UNKNOWN.
std::shared_ptr<const rsl::Shader> named_shader(const std::string& name, Diagnostics& diagnostics);

// What all of these take besides the scene.
struct ShaderGiven {
    std::string shader;  // FILE.sl or a name
    std::vector<std::string> include_directories;
};

// --shader PATTERN=SHADER: the first shader of the file that is no imager. A surface, displacement,
// transformation or volume (as an interior) goes on every material whose id or name matches the
// glob; a light on every light that matches or, where none does, on materials, whose geometry it
// makes an area light. It takes the place of the others of its stage, and parameters of the same
// name keep their sources. "*" reaches the default material too. False after an error, which is a
// finding: no such shader, nothing that matches.
bool override_shader(SceneDescription& description, const std::string& pattern,
                     const ShaderGiven& given, Diagnostics& diagnostics);

// --atmosphere: a volume in place of the scene's atmosphere, or "none".
bool override_atmosphere(SceneDescription& description, const ShaderGiven& given,
                         Diagnostics& diagnostics);

// --environment: a light with sample methods; null after an error.
std::shared_ptr<const rsl::Shader> find_environment_shader(SceneDescription& description,
                                                           const ShaderGiven& given,
                                                           Diagnostics& diagnostics);

// --imager: the picture is run through that imager instead of the scene's, or through none
// ("none").
bool override_imager(SceneDescription& description, const ShaderGiven& given,
                     Diagnostics& diagnostics);

}  // namespace kinora
