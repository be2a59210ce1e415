// collada/schema/schema_rows_p.h: the rows of elements.def, simple_types.def and
// global_elements.def.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "collada/document/document.h"

namespace kinora::collada {

enum class Versions : uint8_t { All, V14, V15 };
enum class Use : uint8_t { Rendered, Kept, Unsupported };

struct ElementRow {
    std::string_view type;
    Versions versions;
    Use use;
    std::string_view attributes, content, text;
};

// A named part of content models, or a list of global elements.
struct ContentRow {
    std::string_view name;
    Versions versions;
    std::string_view content;
};

struct SimpleRow {
    std::string_view name;
    Versions versions;
    std::string_view base;
    std::string_view facets;  // "A B C" or "low..high"
};

std::span<const ElementRow> element_rows();
std::span<const ContentRow> group_rows();
std::span<const SimpleRow> simple_rows();
std::span<const ContentRow> global_rows();

inline bool is_15(Version version) {
    return version == Version::V1_5_0;
}
inline bool holds_for(Versions versions, Version version) {
    return versions == Versions::All || (versions == Versions::V15) == is_15(version);
}

}  // namespace kinora::collada
