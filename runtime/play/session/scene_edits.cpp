// runtime/play/session/scene_edits.cpp: edits put on a scene.
#include "runtime/play/session/scene_edits.h"

#include <algorithm>
#include <memory>

#include "rsl/link.h"
#include "runtime/description/shader_library.h"
#include "runtime/load/override_scene.h"
#include "runtime/load/override_shader.h"

namespace kinora {

namespace {

// The first surface of the text; where the material's was linked with co-shaders, the one of its
// name, linked again.
std::shared_ptr<const rsl::Shader> compiled_surface(const rsl::ShaderSource& source,
                                                    const rsl::Shader* before,
                                                    const rsl::CompileOptions& options,
                                                    Diagnostics& diagnostics) {
    if (before && !before->parts.empty())
        return rsl::link_again(*before, source, options, diagnostics);
    for (auto& shader : rsl::compile(source, options, diagnostics))
        if (shader->kind == rsl::ShaderKind::Surface) return std::move(shader);
    return nullptr;
}

// What can stand for the material's surface. It is compiled in any case, for its findings.
std::shared_ptr<const rsl::Shader> surface_of(const SceneEdits::Text& edit,
                                              const rsl::Shader* before,
                                              const SceneRequest& request, Diagnostics& diagnostics,
                                              const EditedShaders* known, EditedShaders& now) {
    rsl::CompileOptions options;
    options.include_directories = request.include_directories;
    rsl::ShaderSource source;
    source.map.file = diagnostics.files.add(edit.file, edit.text);
    source.text = edit.text;
    auto surface = compiled_surface(source, before, options, diagnostics);
    if (!surface) return nullptr;
    if (known)
        for (const EditedShaders::Row& row : known->rows)
            if (row.file == source.map.file && row.text.material == edit.material &&
                row.text.file == edit.file && row.text.text == edit.text)
                surface = row.shader;
    now.rows.push_back({edit, source.map.file, surface});
    return surface;
}

bool has_parameter(const rsl::Shader& shader, const std::string& name) {
    return std::ranges::any_of(shader.parameters,
                               [&](const rsl::ShaderParameter& p) { return p.name == name; });
}

// The last layer, which is seen, with the sources of parameters that the new text still has.
void replace_surface(MaterialDefinition& material, std::shared_ptr<const rsl::Shader> shader) {
    if (material.surfaces.empty()) material.surfaces.emplace_back();
    ShaderUse& use = material.surfaces.back();
    std::erase_if(use.params,
                  [&](const ParamSource& p) { return !has_parameter(*shader, p.name); });
    use.shader = std::move(shader);
}

// Materials whose shaders stand at one place of a file change together; those that wear one of ours
// do not.
bool shares_text(const rsl::Shader* a, const rsl::Shader* b) {
    if (!a || !b || !a->definition || !b->definition || a->name != b->name) return false;
    Location p = a->definition->span.where, q = b->definition->span.where;
    return p.file == q.file && p.begin == q.begin && library_shader_text(a->name).empty();
}

bool apply_text(SceneDescription& description, const SceneEdits::Text& edit,
                const SceneRequest& request, Diagnostics& diagnostics, const EditedShaders* known,
                EditedShaders& now) {
    std::shared_ptr<const rsl::Shader> before;
    for (const MaterialDefinition& material : description.materials)
        if (material.id == edit.material && shown_surface(material))
            before = material.surfaces.back().shader;
    auto shader = surface_of(edit, before.get(), request, diagnostics, known, now);
    if (!shader) return false;
    for (MaterialDefinition& material : description.materials)
        if (material.id == edit.material || shares_text(shown_surface(material), before.get()))
            replace_surface(material, shader);
    return true;
}

}  // namespace

const rsl::Shader* shown_surface(const MaterialDefinition& material) {
    return material.surfaces.empty() ? nullptr : material.surfaces.back().shader.get();
}

bool apply_edits(ImportedScene& imported, const SceneEdits& edits, const SceneRequest& request,
                 Diagnostics& diagnostics, EditedShaders* known) {
    bool good = true;
    EditedShaders now;
    for (const auto& [material, shader] : edits.shaders)
        good &= override_shader(imported.description, material,
                                {shader, request.include_directories}, diagnostics);
    for (const SceneEdits::Text& text : edits.texts)
        good &= apply_text(imported.description, text, request, diagnostics, known, now);
    if (known && good) *known = std::move(now);
    for (const auto& [target, value] : edits.params)
        good &= override_param(imported.description, target, value, diagnostics);
    if (!edits.hidden.empty()) {
        std::vector<std::string> hidden = request.hide;
        hidden.insert(hidden.end(), edits.hidden.begin(), edits.hidden.end());
        good &= override_visibility(imported.description, hidden, request.only, diagnostics);
    }
    return good;
}

}  // namespace kinora
