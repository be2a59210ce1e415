// runtime/load/override_shader.cpp: shaders from files on materials by glob.
#include "runtime/load/override_shader.h"

#include <fnmatch.h>

#include <algorithm>

#include "runtime/description/findings.h"
#include "runtime/description/shader_library.h"
#include "runtime/profile_rsl/findings.h"

namespace kinora {

namespace {

// A shader that the user gives may read what lies beside it.
void allow_beside(SceneDescription& description, const std::string& file) {
    std::string folder = file.substr(0, file.rfind('/') + 1);
    description.readable.add(folder);
    description.pictures.add(folder);
}

}  // namespace

bool override_shader(SceneDescription& description, const std::string& pattern,
                     const std::string& file, const std::vector<std::string>& include_directories,
                     Diagnostics& diagnostics) {
    rsl::CompileOptions options;
    options.include_directories = include_directories;
    auto shaders = rsl::compile_file(file, options, diagnostics);
    std::shared_ptr<const rsl::Shader> chosen;
    for (auto& shader : shaders)
        if (!chosen && (shader->kind == rsl::ShaderKind::Surface ||
                        shader->kind == rsl::ShaderKind::Displacement ||
                        shader->kind == rsl::ShaderKind::Transformation))
            chosen = std::move(shader);
    if (!chosen) {
        if (!shaders.empty())
            diagnostics.report(Code::RSL_SHADER_MISSING, Location{}, "surface", " in " + file);
        return false;
    }
    allow_beside(description, file);
    bool matched = false;
    for (MaterialDefinition& material : description.materials) {
        bool match = fnmatch(pattern.c_str(), material.id.c_str(), 0) == 0 ||
                     fnmatch(pattern.c_str(), material.name.c_str(), 0) == 0;
        if (!match) continue;
        matched = true;
        bool surface = chosen->kind == rsl::ShaderKind::Surface;
        bool transformation = chosen->kind == rsl::ShaderKind::Transformation;
        std::vector<ShaderUse>& stack = surface          ? material.surfaces
                                        : transformation ? material.transformations
                                                         : material.displacements;
        ShaderUse use;
        use.shader = chosen;
        for (const ShaderUse& old : stack)
            for (const ParamSource& source : old.params)
                if (std::any_of(chosen->parameters.begin(), chosen->parameters.end(),
                                [&](const auto& p) { return p.name == source.name; }))
                    use.params.push_back(source);
        stack.assign(1, use);
    }
    if (pattern == "*" && chosen->kind == rsl::ShaderKind::Surface) {
        description.default_surface = chosen;
        matched = true;
    }
    if (!matched) diagnostics.report(Code::MATERIAL_UNKNOWN, Location{}, pattern);
    return matched;
}

bool override_imager(SceneDescription& description, const std::string& name,
                     const std::vector<std::string>& include_directories,
                     Diagnostics& diagnostics) {
    ShaderUse use;
    if (name.find('.') == std::string::npos && name != "none") {
        use.shader = library_shader(name, diagnostics);
    } else if (name != "none") {
        rsl::CompileOptions options;
        options.include_directories = include_directories;
        for (auto& shader : rsl::compile_file(name, options, diagnostics))
            if (!use.shader && shader->kind == rsl::ShaderKind::Imager)
                use.shader = std::move(shader);
        allow_beside(description, name);
    }
    bool known = name == "none" || (use.shader && use.shader->kind == rsl::ShaderKind::Imager);
    if (!known) {
        diagnostics.report(Code::IMAGER_UNKNOWN, Location{}, name);
        return false;
    }
    for (CameraDefinition& camera : description.cameras) camera.picture.imagers.clear();
    description.picture.imagers.clear();
    if (use.shader) description.picture.imagers.push_back(std::move(use));
    return true;
}

}  // namespace kinora
