// collada/scene/effects.cpp: the types of parameters.
#include "collada/scene/effects.h"

#include <iterator>

namespace kinora::collada {

namespace {

struct TypeRow {
    const char* name;
    uint32_t components;
};
// In the order of ParamType; the names are those of the elements.
constexpr TypeRow kTypes[] = {{"float", 1},     {"float2", 2}, {"float3", 3}, {"float4", 4},
                              {"float4x4", 16}, {"int", 1},    {"bool", 1},   {"point", 3},
                              {"color", 3},     {"vector", 3}, {"normal", 3}, {"matrix", 16},
                              {"string", 1}};
static_assert(std::size(kTypes) == size_t(ParamType::Count));

}  // namespace

bool find_param_type(std::string_view name, ParamType& type) {
    for (size_t i = 0; i < std::size(kTypes); ++i)
        if (kTypes[i].name == name) {
            type = ParamType(i);
            return true;
        }
    return false;
}

uint32_t component_count(ParamType type) {
    return kTypes[size_t(type)].components;
}
const char* param_type_name(ParamType type) {
    return kTypes[size_t(type)].name;
}

}  // namespace kinora::collada
