// runtime/scene/gltf/import/values.cpp: numbers added to a description's values.
#include "runtime/scene/gltf/import/values.h"

#include <algorithm>

namespace kinora {

uint32_t append_values(std::vector<double>& values, std::span<const double> numbers, size_t room) {
    uint32_t offset = uint32_t(values.size());
    values.insert(values.end(), numbers.begin(), numbers.end());
    values.resize(offset + std::max(numbers.size(), room), 0.0);
    return offset;
}

ValueSlot set_number(ShaderUse& use, const std::string& name, std::span<const double> numbers,
                     std::vector<double>& values) {
    ParamSource source;
    source.name = name;
    source.value = {append_values(values, numbers, numbers.size()), uint32_t(numbers.size())};
    use.params.push_back(std::move(source));
    return use.params.back().value;
}

void set_string(ShaderUse& use, const std::string& name, std::string text) {
    ParamSource source;
    source.name = name;
    source.strings = {std::move(text)};
    use.params.push_back(std::move(source));
}

}  // namespace kinora
