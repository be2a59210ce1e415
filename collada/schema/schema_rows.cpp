// collada/schema/schema_rows.cpp: the element table's rows as arrays.
#include "collada/schema/schema_rows_p.h"

namespace kinora::collada {

namespace {

#define ELEMENT(type, versions, use, attributes, content, text) \
    {#type, Versions::versions, Use::use, attributes, content, text},
#define GROUP(name, versions, content)
constexpr ElementRow kElements[] = {
#include "collada/generated/elements.def"
};
#undef ELEMENT
#undef GROUP

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
    return kElements;
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
