// collada/schema/schema_rows.cpp: the element table's rows as arrays.
#include "collada/schema/schema_rows_p.h"

#include <iterator>
#include <vector>

namespace kinora::collada {

namespace {

// The rows' texts one after the other: an array of views would be relocated at each start of each
// program, twelve pages of it.
#define GROUP(name, versions, content)
#define ELEMENT(type, versions, use, attributes, content, text) \
#type "\0" attributes "\0" content "\0" text "\0"
constexpr char kElementTexts[] =
#include "collada/generated/elements.def"
    ;
#undef ELEMENT

struct ElementKind {
    Versions versions;
    Use use;
};
#define ELEMENT(type, versions, use, attributes, content, text) {Versions::versions, Use::use},
constexpr ElementKind kElementKinds[] = {
#include "collada/generated/elements.def"
};
#undef ELEMENT
#undef GROUP

std::vector<ElementRow> make_element_rows() {
    std::vector<ElementRow> rows;
    rows.reserve(std::size(kElementKinds));
    const char* at = kElementTexts;
    auto next = [&] {
        const std::string_view text = at;
        at += text.size() + 1;
        return text;
    };
    for (const ElementKind& kind : kElementKinds) {
        ElementRow& row = rows.emplace_back();
        row.type = next();
        row.versions = kind.versions;
        row.use = kind.use;
        row.attributes = next();
        row.content = next();
        row.text = next();
    }
    return rows;
}

#define ELEMENT(type, versions, use, attributes, content, text)
#define GROUP(name, versions, content) {#name, Versions::versions, content},
constexpr ContentRow kGroups[] = {
#include "collada/generated/elements.def"
};
#undef ELEMENT
#undef GROUP

#define SIMPLE_TYPE(name, versions, base, facets) {#name, Versions::versions, #base, facets},
constexpr SimpleRow kSimple[] = {
#include "collada/generated/simple_types.def"
};
#undef SIMPLE_TYPE

#define GLOBAL_ELEMENTS(versions, names) {"", Versions::versions, names},
constexpr ContentRow kGlobals[] = {
#include "collada/generated/global_elements.def"
};
#undef GLOBAL_ELEMENTS

}  // namespace

std::span<const ElementRow> element_rows() {
    static const std::vector<ElementRow> rows = make_element_rows();
    return rows;
}

std::span<const ContentRow> group_rows() {
    return kGroups;
}

std::span<const SimpleRow> simple_rows() {
    return kSimple;
}

std::span<const ContentRow> global_rows() {
    return kGlobals;
}

}  // namespace kinora::collada
