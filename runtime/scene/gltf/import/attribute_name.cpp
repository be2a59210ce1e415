// runtime/scene/gltf/import/attribute_name.cpp: names of vertex attributes as semantics and sets.
#include "runtime/scene/gltf/import/attribute_name.h"

namespace kinora {

AttributeName numbered_attribute(const std::string& semantic) {
    size_t bar = semantic.rfind('_');
    bool short_enough = bar != std::string::npos && bar > 0 && semantic.size() - bar <= 4 &&
                        bar + 1 < semantic.size();
    if (!short_enough) return {};
    uint32_t set = 0;
    for (char c : semantic.substr(bar + 1)) {
        if (c < '0' || c > '9') return {};
        set = set * 10 + uint32_t(c - '0');
    }
    return {semantic.substr(0, bar), set};
}

AttributeName own_attribute(const std::string& name) {
    AttributeName own = numbered_attribute(name.substr(1));
    bool has_set = own.name == "COLOR" || own.name == "TEXCOORD";
    return has_set ? own : AttributeName{name.substr(1), 0};
}

}  // namespace kinora
