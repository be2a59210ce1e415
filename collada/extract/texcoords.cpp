// collada/extract/texcoords.cpp: from the names by which textures are looked up to sets of the
// mesh.
#include <algorithm>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

// The number at the end of "UVSET0" or "CHANNEL1"; kNone if there is none.
uint32_t number_in(std::string_view name) {
    size_t digits = 0;
    while (digits < name.size() && std::isdigit(uint8_t(name[name.size() - 1 - digits]))) ++digits;
    uint64_t number = 0;
    bool good = digits > 0 && digits < 9 && parse_count(name.substr(name.size() - digits), number);
    return good ? uint32_t(number) : kNone;
}

// The sets that a group has of a semantic, sorted.
const std::vector<uint32_t>& sets_of(GeometrySymbols& symbols, uint32_t number,
                                     const PrimitiveGroup& group, const std::string& semantic) {
    auto [at, fresh] = symbols.sets.try_emplace({number, semantic});
    std::vector<uint32_t>& sets = at->second;
    if (!fresh) return sets;
    for (const VertexInput& input : group.inputs)
        if (input.semantic == semantic) sets.push_back(input.set);
    std::sort(sets.begin(), sets.end());
    return sets;
}

// Names of texture coordinates that the effect's textures ask for, each once.
std::vector<std::string_view> texcoords_of(const Effect& effect) {
    std::vector<std::string_view> names;
    for (const CommonValue& value : effect.common->slots) {
        if (value.source != SlotSource::Texture || value.texcoord.empty()) continue;
        if (std::find(names.begin(), names.end(), value.texcoord) == names.end())
            names.push_back(value.texcoord);
    }
    return names;
}

// Binds the name to a set that the group has: the one that is written, else the lowest of TEXCOORD.
void bind_texcoord(Extraction& x, GeometrySymbols& symbols, uint32_t number,
                   const PrimitiveGroup& group, std::string_view name, const std::string& material,
                   MaterialBinding& binding) {
    auto bound = std::find_if(binding.vertex_inputs.begin(), binding.vertex_inputs.end(),
                              [&](const VertexInputBinding& b) { return b.semantic == name; });
    bool is_bound = bound != binding.vertex_inputs.end();
    std::string semantic = is_bound ? bound->input_semantic : "TEXCOORD";
    uint32_t wanted = is_bound ? bound->input_set : number_in(name);
    const std::vector<uint32_t>* sets = &sets_of(symbols, number, group, semantic);
    bool has = std::binary_search(sets->begin(), sets->end(), wanted);
    if (sets->empty() || (is_bound && wanted != kNone && !has)) {
        std::string missing =
            sets->empty() ? semantic : fmt::format("{} of set {}", semantic, wanted);
        if (sets->empty()) sets = &sets_of(symbols, number, group, semantic = "TEXCOORD");
        x.diag.report(Code::TEX_SET_MISSING, is_bound ? bound->where : binding.where, missing,
                      material,
                      sets->empty() ? std::string("none is used")
                                    : fmt::format("set {} is used", sets->front()));
    } else if (!is_bound) {
        x.diag.report(Code::TEX_NO_BVI, binding.where, material, name);
    }
    if (sets->empty()) return;
    uint32_t set = has ? wanted : sets->front();
    if (is_bound)
        bound->input_semantic = semantic, bound->input_set = set;
    else
        binding.vertex_inputs.push_back({std::string(name), semantic, set, binding.where});
}

}  // namespace

void bind_texcoords(Extraction& x, uint32_t geometry, MaterialBinding& binding) {
    if (binding.material == kNone) return;
    const Material& material = x.scene.materials[binding.material];
    if (material.effect == kNone) return;
    const Effect& effect = x.scene.effects[material.effect];
    if (!effect.common || effect.rsl) return;
    GeometrySymbols& symbols = symbols_of(x, geometry);
    auto first = symbols.first_group.find(binding.symbol);
    if (first == symbols.first_group.end()) return;
    const PrimitiveGroup& group = x.scene.geometries[geometry].groups[first->second];
    for (std::string_view name : texcoords_of(effect))
        bind_texcoord(x, symbols, first->second, group, name, material.id, binding);
}

}  // namespace kinora::collada
