// rsl/model/globals.cpp: the rows of globals.def.
#include "rsl/model/globals.h"

#include <algorithm>

namespace kinora::rsl {

namespace {

// "SDL" to bits of shader kinds, in the order of ShaderKind.
constexpr uint8_t kinds(std::string_view letters) {
    constexpr std::string_view kLetters = "SDLVIT";
    uint8_t bits = 0;
    for (size_t i = 0; i < kLetters.size(); ++i)
        if (letters.find(kLetters[i]) != std::string_view::npos) bits |= uint8_t(1u << i);
    return bits;
}

constexpr GlobalInfo kGlobals[] = {
#define GLOBAL(name, type, rate, readers, writers, doc) \
    {#name, Global::name, {BaseType::type, -1}, Rate::rate, kinds(readers), kinds(writers), doc},
#include "rsl/model/globals.def"
#undef GLOBAL
};

}  // namespace

std::span<const GlobalInfo> globals() {
    return kGlobals;
}

const GlobalInfo* find_global(std::string_view name) {
    for (const GlobalInfo& row : kGlobals)
        if (row.name == name) return &row;
    return nullptr;
}

const GlobalInfo& global_info(Global id) {
    return kGlobals[size_t(id)];
}

std::optional<BaseType> global_output(std::string_view name) {
    constexpr Global kOfLights[] = {Global::L, Global::Cl, Global::Ol, Global::Ps, Global::Ns};
    if (name == kDepthOutput) return BaseType::Float;
    const GlobalInfo* found = find_global(name);
    const bool of_surfaces = found && found->readers & kinds("S") && found->rate == Rate::Varying;
    if (!of_surfaces || std::ranges::count(kOfLights, found->id)) return {};
    return found->type.base;
}

}  // namespace kinora::rsl
