// runtime/scene/gltf/export/looks.cpp: what a primitive wears, and which vertex attributes are
// written.
#include "runtime/scene/gltf/export/looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runtime/scene/description/picture_rules.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/gltf/export/params.h"
#include "runtime/scene/gltf/export/surfaces.h"

namespace kinora {

namespace {

// What import_gltf makes of COLOR_0 and TANGENT.
constexpr const char* kDerived[] = {"vertex_alpha", "tangent_u", "tangent_v", "tangent_flip"};

bool is_derived(const std::string& semantic) {
    return std::find(std::begin(kDerived), std::end(kDerived), semantic) != std::end(kDerived);
}

// ShaderUse::linear_inputs of what is seen.
const VertexAttribute* read_by(const GltfLook& look, const PrimitiveGroup& group,
                               const VertexAttribute& a) {
    const std::vector<ShaderUse>& surfaces = look.definition.surfaces;
    bool linear = surfaces.empty() || surfaces.back().linear_inputs;
    for (const VertexAttribute& other : group.attributes)
        if (linear && a.semantic == "COLOR" && other.semantic == kLinearColor && other.set == a.set)
            return &other;
    return &a;
}

bool reads(const std::vector<ShaderUse>& layers, const std::string& semantic) {
    for (const ShaderUse& layer : layers)
        for (const rsl::ShaderParameter& p : layer.shader->parameters)
            if (p.name == semantic) return true;
    return false;
}

// Whether a shader sees it: a parameter is bound to it, or named like it.
bool is_read(const GltfLook& look, const VertexAttribute& a) {
    for (const VertexBinding& b : look.bound.vertex_bindings)
        if (b.semantic == a.semantic && (b.set == kNone || b.set == a.set)) return true;
    const MaterialDefinition& m = look.definition;
    return reads(m.surfaces, a.semantic) || reads(m.displacements, a.semantic) ||
           reads(m.transformations, a.semantic) || reads(m.interior, a.semantic) ||
           reads(m.exterior, a.semantic);
}

}  // namespace

GltfLook GltfLooks::look_of(const MeshUse& use, const PrimitiveGroup& group) {
    const MaterialUse* bound = nullptr;
    for (const MaterialUse& m : use.materials)
        if (m.symbol == group.symbol) bound = &m;
    // What has no material wears default_surface, which glTF's own default (a metal) is far from.
    if (plain_.surfaces.empty()) {
        const auto& own = description_.default_surface;
        ShaderUse& surface = plain_.surfaces.emplace_back();
        surface.shader = own ? own : library_shader("default_surface");
        surface.linear_inputs = !own;
    }
    bool is_plain = !bound || bound->material == kNone;
    GltfLook look{is_plain ? plain_ : description_.materials[bound->material],
                  bound ? *bound : unbound_, is_plain, false, false};
    const std::vector<ShaderUse>& surfaces = look.definition.surfaces;
    look.is_gltf = !surfaces.empty() && (is_library_shader(surfaces.back(), "gltf_pbr") ||
                                         is_library_shader(surfaces.back(), "gltf_unlit"));
    look.tinted = !surfaces.empty() && !surfaces.back().untinted &&
                  (is_common_surface(surfaces.back()) ||
                   is_library_shader(surfaces.back(), "default_surface"));
    return look;
}

std::vector<GltfAttribute> attributes_of(const GltfLook& look, const PrimitiveGroup& group,
                                         LossReport& losses) {
    std::vector<const VertexAttribute*> sorted;
    for (const VertexAttribute& a : group.attributes) sorted.push_back(&a);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](auto* a, auto* b) { return a->set < b->set; });
    std::vector<GltfAttribute> result;
    std::map<std::string, uint32_t> seen;  // of each semantic
    for (const VertexAttribute* a : sorted) {
        bool texcoord = a->semantic == "TEXCOORD", color = a->semantic == "COLOR";
        bool wide_enough = texcoord ? a->stride >= 2 : !color || a->stride >= 3;
        bool own = !texcoord && !color;
        if (a->semantic == "NORMAL" || a->semantic == "POSITION") continue;
        if (look.is_gltf && is_derived(a->semantic)) continue;
        bool tangent = look.is_gltf && a->semantic == "TANGENT" && a->stride == 4;
        if (own && !tangent && !is_read(look, *a)) continue;
        if (!wide_enough || a->stride == 0 || (a->stride > 4 && !texcoord)) {
            if (is_read(look, *a))
                losses.lost(
                    fmt::format("material '{}'", look.definition.id),
                    fmt::format("its vertex input '{}' of {} numbers", a->semantic, a->stride));
            continue;
        }
        uint32_t index = seen[a->semantic]++;
        std::string name = a->semantic;
        if (!own || index > 0) name += fmt::format("_{}", index);
        if (!texcoord && !tangent && !(color && (look.is_gltf || look.tinted))) name = "_" + name;
        uint32_t width = texcoord ? 2 : color && look.tinted ? 3 : a->stride;
        result.push_back({std::move(name), a, width, read_by(look, group, *a)});
    }
    return result;
}

uint32_t texcoord_index(const std::string& name, const MaterialUse& use,
                        const PrimitiveGroup& group) {
    const VertexAttribute* read = texture_coordinates(group, &use, name);
    uint32_t index = 0;  // of those that attributes_of writes, in the order of their sets
    for (const VertexAttribute& a : group.attributes)
        index += read && a.semantic == "TEXCOORD" && a.stride >= 2 && a.set < read->set;
    return index;
}

}  // namespace kinora
