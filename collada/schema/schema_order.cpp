// collada/schema/schema_order.cpp: the children of an element in the order of the element table.
#include <algorithm>

#include "collada/schema/element_types_p.h"
#include "collada/schema/schema.h"

namespace kinora::collada {

std::vector<const Element*> schema_order(const Document& document, const Element& parent) {
    std::vector<const Element*> children;
    for (const Element& child : parent.children()) children.push_back(&child);
    const ElementType* type = ElementTypes::of(document.version()).of_element(parent);
    if (!type) return children;
    const ContentModel& model = type->rules().content;
    std::vector<std::pair<uint16_t, const Element*>> ranked;
    uint16_t rank = 0;  // what the table does not know stays behind what it stands behind
    for (const Element* child : children) {
        if (uint16_t position = model.find(child->name)) rank = model.positions[position].rank;
        ranked.emplace_back(rank, child);
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t i = 0; i < ranked.size(); ++i) children[i] = ranked[i].second;
    return children;
}

}  // namespace kinora::collada
