// runtime/programs/validate/budget.cpp: how much of what a scene may hold.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/programs/validate/escaped_text.h"
#include "runtime/programs/validate/kinora_validate.h"
#include "runtime/programs/validate/rules.h"

namespace kinora {

namespace {

struct Budget {
    std::string_view name;
    const char* noun;
    size_t (*amount)(const DocumentInfo&);
};

size_t largest_texture(const DocumentInfo& info) {
    size_t most = 0;
    for (const TextureInfo& texture : info.textures)
        most = std::max({most, size_t(texture.width), size_t(texture.height)});
    return most;
}

constexpr Budget kBudgets[] = {
    {"triangles", "triangles", [](const DocumentInfo& i) { return i.triangles; }},
    {"vertices", "vertices", [](const DocumentInfo& i) { return i.vertices; }},
    {"joints", "joints", [](const DocumentInfo& i) { return i.joints; }},
    {"joints_per_skin", "joints in one skin",
     [](const DocumentInfo& i) { return i.joints_per_skin; }},
    {"influences", "influences on one vertex", [](const DocumentInfo& i) { return i.influences; }},
    {"uv_sets", "uv sets on one mesh", [](const DocumentInfo& i) { return i.uv_sets; }},
    {"nodes", "nodes", [](const DocumentInfo& i) { return i.nodes; }},
    {"meshes", "mesh instances", [](const DocumentInfo& i) { return i.mesh_instances; }},
    {"materials", "materials", [](const DocumentInfo& i) { return i.materials.size(); }},
    {"textures", "textures", [](const DocumentInfo& i) { return i.textures.size(); }},
    {"texture_size", "pixels along a texture's side", largest_texture},
    {"lights", "lights", [](const DocumentInfo& i) { return i.lights; }},
    {"clips", "clips", [](const DocumentInfo& i) { return i.clips.size(); }},
};

}  // namespace

void check_budgets(const DocumentInfo& info, const ValidateSettings& settings, Location where,
                   Diagnostics& diagnostics) {
    for (const auto& [name, most] : settings.budgets)
        for (const Budget& budget : kBudgets)
            if (budget.name == name && double(budget.amount(info)) > most)
                diagnostics.report(Code::BUDGET_EXCEEDED, where, budget.amount(info), budget.noun,
                                   json_number(most));
}

bool is_budget_name(std::string_view name) {
    for (const Budget& budget : kBudgets)
        if (budget.name == name) return true;
    return false;
}

std::string budget_names() {
    std::string names;
    for (const Budget& budget : kBudgets)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", budget.name);
    return names;
}

}  // namespace kinora
