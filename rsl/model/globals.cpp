// rsl/model/globals.cpp: the rows of globals.def.
#include "rsl/model/globals.h"

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

}  // namespace kinora::rsl
