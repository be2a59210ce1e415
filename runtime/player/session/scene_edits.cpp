// runtime/player/session/scene_edits.cpp: edits put on a scene.
#include "runtime/player/session/scene_edits.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>

#include "rsl/link.h"
#include "runtime/player/files/shader_source.h"
#include "runtime/player/session/shader_places.h"
#include "runtime/player/session/world_edits.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/given_globals.h"
#include "runtime/scene/load/override_scene.h"
#include "runtime/scene/load/override_shader.h"

namespace kinora {

namespace {

using Shaders = std::vector<std::shared_ptr<const rsl::Shader>>;

// All of the text; where the one before was linked with co-shaders, the one of its name, linked
// again.
Shaders compiled(const rsl::ShaderSource& source, const rsl::Shader* before,
                 const rsl::CompileOptions& options, Diagnostics& diagnostics) {
    if (before && !before->parts.empty()) {
        auto shader = rsl::link_again(*before, source, options, diagnostics);
        return shader ? Shaders{std::move(shader)} : Shaders{};
    }
    auto shaders = rsl::compile(source, options, diagnostics);
    return {std::make_move_iterator(shaders.begin()), std::make_move_iterator(shaders.end())};
}

// They are compiled in any case, for their findings.
Shaders shaders_of(const SceneEdits::Text& edit, const rsl::Shader* before,
                   const SceneRequest& request, Diagnostics& diagnostics,
                   const EditedShaders* known, EditedShaders& now) {
    rsl::CompileOptions options;
    options.include_directories = request.include_directories;
    rsl::ShaderSource source;
    source.map.file = diagnostics.files.add(edit.file, edit.text);
    source.text = edit.text;
    Shaders shaders = compiled(source, before, options, diagnostics);
    if (shaders.empty()) return shaders;
    if (known)
        for (const EditedShaders::Row& row : known->rows)
            if (row.file == source.map.file && row.text.material == edit.material &&
                row.text.file == edit.file && row.text.text == edit.text)
                shaders = row.shaders;
    now.rows.push_back({edit, source.map.file, shaders});
    return shaders;
}

std::shared_ptr<const rsl::Shader> of_name(const Shaders& shaders, rsl::ShaderKind kind,
                                           std::string_view name) {
    for (const auto& shader : shaders)
        if (shader->kind == kind && shader->name == name) return shader;
    return nullptr;
}

// The one of that name; else, as it may have another by now, the first of the kind.
std::shared_ptr<const rsl::Shader> chosen(const Shaders& shaders, rsl::ShaderKind kind,
                                          std::string_view name) {
    if (auto same = of_name(shaders, kind, name)) return same;
    for (const auto& shader : shaders)
        if (shader->kind == kind) return shader;
    return nullptr;
}

bool has_parameter(const rsl::Shader& shader, const std::string& name) {
    return std::ranges::any_of(shader.parameters,
                               [&](const rsl::ShaderParameter& p) { return p.name == name; });
}

// With the sources of parameters that the new text still has.
void put_on(ShaderUse& use, std::shared_ptr<const rsl::Shader> shader) {
    std::erase_if(use.params, [&](const ParamSource& p) {
        return !has_parameter(*shader, p.name) && !is_given_global(p.name);
    });
    use.shader = std::move(shader);
}

ShaderUse* changeable(SceneDescription& description, const ShaderUse* wanted) {
    ShaderUse* found = nullptr;
    for_each_shader_use(description, [&](ShaderUse& use) {
        if (&use == wanted) found = &use;
    });
    return found;
}

// A material that wears none yet.
void dress(SceneDescription& description, const std::string& id,
           const std::shared_ptr<const rsl::Shader>& shader) {
    for (MaterialDefinition& material : description.materials)
        if (material.id == id && material.surfaces.empty())
            material.surfaces.push_back({shader, {}});
}

// On its place, and on all that wear a shader of the same text.
bool apply_text(SceneDescription& description, const SceneEdits::Text& edit,
                const SceneRequest& request, Diagnostics& diagnostics, const EditedShaders* known,
                EditedShaders& now) {
    const std::vector<ShaderPlace> places = shader_places(description);
    std::shared_ptr<const rsl::Shader> before;
    for (const ShaderPlace& place : places)
        if (place.id == edit.material && place.use) before = place.use->shader;
    const TextRange text = before ? text_range(*before, diagnostics.files) : TextRange{};
    const Shaders shaders = shaders_of(edit, before.get(), request, diagnostics, known, now);
    if (shaders.empty()) return false;
    const auto kind = before ? before->kind : rsl::ShaderKind::Surface;
    const std::string_view name = before ? std::string_view(before->name) : "";
    const auto shader = chosen(shaders, kind, name);
    if (!shader) {
        diagnostics.report(Code::SHADER_OF_OTHER_KIND, Location{now.rows.back().file, 0, 0},
                           edit.file, rsl::shader_kind_name(kind));
        return false;
    }
    for (const ShaderPlace& place : places) {
        if (!place.use || !place.use->shader) continue;
        const rsl::Shader& worn = *place.use->shader;
        const bool edited = place.id == edit.material;
        if (!edited &&
            (edit.alone || text.file == kNoFile || !(text_range(worn, diagnostics.files) == text)))
            continue;
        const bool same = edited || (worn.kind == kind && worn.name == name);
        if (auto next = same ? shader : of_name(shaders, worn.kind, worn.name))
            put_on(*changeable(description, place.use), std::move(next));
    }
    dress(description, edit.material, shader);
    return true;
}

}  // namespace

const rsl::Shader* shown_surface(const MaterialDefinition& material) {
    return material.surfaces.empty() ? nullptr : material.surfaces.back().shader.get();
}

bool apply_edits(ImportedScene& imported, const SceneEdits& all, const SceneRequest& request,
                 Diagnostics& diagnostics, EditedShaders* known) {
    // Edits may be of another picture of the film.
    const bool in_film = imported.description.file_picture.has_value();
    const SceneEdits edits = in_film ? edits_of_world(all, imported.description) : all;
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
