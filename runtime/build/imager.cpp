// runtime/build/imager.cpp: the planes that surfaces' output parameters fill, and the imager that
// reads them.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/build/scene_p.h"
#include "runtime/description/findings.h"

namespace kinora {

namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// The output parameter of that name of the topmost layer that has one.
const rsl::ShaderParameter* find_output(const ShaderInstance& look, std::string_view name) {
    for (auto layer = look.layers.rbegin(); layer != look.layers.rend(); ++layer)
        for (const rsl::ShaderParameter& p : layer->shader->parameters) {
            bool numbers = !p.type.is_array() && p.type.base != rsl::BaseType::String &&
                           p.type.base != rsl::BaseType::Matrix;
            if (p.output && numbers && p.name == name) return &p;
        }
    return nullptr;
}

std::string plane_name(std::string_view name, rsl::BaseType type, int component) {
    if (rsl::component_count(type) == 1) return std::string(name);
    const char* letters = type == rsl::BaseType::Color ? "RGB" : "XYZ";
    return fmt::format("{}.{}", name, letters[component]);
}

const std::vector<ShaderUse>& imagers_of(const SceneDescription& description,
                                         const CameraSource& camera) {
    const auto& own = description.cameras[camera.definition].picture.imagers;
    return own.empty() ? description.picture.imagers : own;
}

}  // namespace

// Those that were asked for, then those that the imager has parameters of.
void SceneBuilder::add_outputs() {
    Scene& scene = *scene_;
    auto add = [&](const std::string& name, bool in_file) {
        if (contains(output_names_, name)) return true;
        const rsl::ShaderParameter* found = nullptr;
        for (const auto& look : scene.looks)
            if (look->kind == ShaderInstanceKind::Surface && !found)
                found = find_output(*look, name);
        if (!found) return false;
        output_names_.push_back(name);
        for (int c = 0; c < rsl::component_count(found->type.base); ++c)
            scene.outputs.push_back(
                {plane_name(name, found->type.base, c), name, uint32_t(c), in_file});
        return true;
    };
    for (const std::string& name : scene.options.aovs)
        if (!add(name, true)) diagnostics_.report(Code::AOV_UNKNOWN, Location{}, name);
    for (const ShaderUse& use : imagers_of(description_, scene.cameras[scene.camera]))
        for (const rsl::ShaderParameter& p : use.shader->parameters)
            if (!p.type.is_array() && p.type.base != rsl::BaseType::String)
                add(std::string(p.name), false);
}

// Where a surface has the parameter as a float and others as a colour, all components take it.
void SceneBuilder::bind_outputs(ShaderInstance& look) const {
    if (look.kind != ShaderInstanceKind::Surface) return;
    for (const OutputPlane& plane : scene_->outputs) {
        int& output = look.aovs.emplace_back(-1);
        std::string wanted = "aov:" + plane.parameter;
        const auto& outputs = look.full.kernel().outputs;
        for (size_t o = 0; o < outputs.size(); ++o) {
            const std::string& name = outputs[o].name;
            bool component =
                name.size() == wanted.size() + 2 && name.starts_with(wanted + ".") &&
                (name.back() == "rgb"[plane.component] || name.back() == "xyz"[plane.component]);
            if (name == wanted || component) output = int(o);
        }
    }
}

// The camera's; else the scene's. Its parameters that are named like planes are read from them.
void SceneBuilder::add_imager() {
    Scene& scene = *scene_;
    const CameraSource& camera = scene.cameras[scene.camera];
    const auto& layers = imagers_of(description_, camera);
    if (layers.empty()) return;
    auto look = std::make_unique<ShaderInstance>();
    look->kind = ShaderInstanceKind::Imager;
    look->name = "imager";
    look->layers = layers;
    look->node =
        description_.cameras[camera.definition].picture.imagers.empty() ? kNone : camera.node;
    for (uint32_t l = 0; l < layers.size(); ++l)
        for (const rsl::ShaderParameter& p : layers[l].shader->parameters) {
            if (!contains(output_names_, p.name)) continue;
            VaryingParam varying;
            varying.name = varying.semantic = p.name;
            varying.layer = l;
            varying.components = uint32_t(rsl::component_count(p.type.base));
            look->varying.push_back(std::move(varying));
        }
    scene.imager = uint32_t(scene.looks.size());
    scene.looks.push_back(std::move(look));
}

}  // namespace kinora
