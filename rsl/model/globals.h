// rsl/model/globals.h: the shader globals (P, N, Ci, ...): rows of rsl/model/globals.def.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "rsl/syntax/types.h"

namespace kinora::rsl {

// Where a global may be read or written: bits by ShaderKind (1 << kind).
constexpr uint8_t in_kind(ShaderKind kind) {
    return uint8_t(1u << int(kind));
}

// Dense ids: Global::P, Global::Ci ...
enum class Global : uint8_t {
#define GLOBAL(name, type, rate, readers, writers, doc) name,
#include "rsl/model/globals.def"
#undef GLOBAL
    Count,
};

struct GlobalInfo {
    std::string_view name;
    Global id;
    Type type;
    Rate rate;
    uint8_t readers;  // shader kinds that may read it
    uint8_t writers;  // shader kinds that may write it
    const char* doc;
};

std::span<const GlobalInfo> globals();
const GlobalInfo* find_global(std::string_view name);  // null: no such global
const GlobalInfo& global_info(Global id);

// How far a surface's point is from the camera's plane, as an output that every surface has.
inline constexpr std::string_view kDepthOutput = "z";
// The type of an output that every surface has without declaring it: z, or a varying global but for
// those of its lights.
std::optional<BaseType> global_output(std::string_view name);

}  // namespace kinora::rsl
