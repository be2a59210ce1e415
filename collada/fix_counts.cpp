// collada/fix_counts.cpp: count attributes set to what is there.
#include <algorithm>

#include "collada/fix_p.h"
#include "collada/numbers_p.h"

namespace kinora::collada {

namespace {

void set_count(FixContext& context, const Element& element, uint64_t count) {
    std::string text = std::to_string(count);
    if (element.value("count") != text)
        context.edits.push_back(set_attribute(context.text, element, "count", text));
}

uint64_t vertices_of(const Element& primitive) {
    uint64_t stride = 1, count = 0;
    for (const Element& child : primitive.children()) {
        uint64_t offset = 0;
        if (child.name == "input" && parse_count(child.value("offset"), offset) &&
            offset < (uint64_t(1) << 32))
            stride = std::max(stride, offset + 1);
        if (child.name == "p") count += split_words(child.text).size();
    }
    return count / stride;
}

uint64_t child_count(const Element& primitive, std::string_view a, std::string_view b) {
    uint64_t count = 0;
    for (const Element& child : primitive.children()) count += child.name == a || child.name == b;
    return count;
}

struct PrimitiveCount {
    std::string_view name;
    uint64_t (*count)(const Element&);
};
constexpr PrimitiveCount kPrimitives[] = {
    {"triangles", [](const Element& e) { return vertices_of(e) / 3; }},
    {"lines", [](const Element& e) { return vertices_of(e) / 2; }},
    {"polygons", [](const Element& e) { return child_count(e, "p", "ph"); }},
    {"tristrips", [](const Element& e) { return child_count(e, "p", "p"); }},
    {"trifans", [](const Element& e) { return child_count(e, "p", "p"); }},
    {"linestrips", [](const Element& e) { return child_count(e, "p", "p"); }},
    {"polylist",
     [](const Element& e) {
         const Element* vcount = e.child("vcount");
         return uint64_t(vcount ? split_words(vcount->text).size() : 0);
     }},
};

}  // namespace

void fix_array_count(FixContext& context) {
    for (const Finding* finding : context.findings) {
        const Element& array = context.elements.at(finding->where.begin);
        set_count(context, array, split_words(array.text).size());
    }
}

// To the entries that its array holds.
void fix_accessor_count(FixContext& context) {
    for (const Finding* finding : context.findings) {
        const Element& accessor = context.elements.at(finding->where.begin);
        std::string_view source = accessor.value("source");
        const Element* array =
            source.starts_with('#') ? context.document.find(source.substr(1)) : nullptr;
        uint64_t stride = 1, offset = 0;
        if (!array || (accessor.attribute("stride") &&
                       (!parse_count(accessor.value("stride"), stride) || stride == 0)))
            continue;
        parse_count(accessor.value("offset"), offset);
        uint64_t words = split_words(array->text).size();
        set_count(context, accessor, words > offset ? (words - offset) / stride : 0);
    }
}

void fix_primitive_count(FixContext& context) {
    for (const Finding* finding : context.findings) {
        const Element& primitive = context.elements.at(finding->where.begin);
        for (const PrimitiveCount& row : kPrimitives)
            if (row.name == primitive.name) set_count(context, primitive, row.count(primitive));
    }
}

}  // namespace kinora::collada
