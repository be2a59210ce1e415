// collada/validate/fix_counts.cpp: count attributes set to what is there.
#include <algorithm>

#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/fix_p.h"

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

// The array that an accessor reads; null where its stride cannot be told.
struct AccessorView {
    const Element* array = nullptr;
    uint64_t stride = 1;  // as written
    uint64_t room = 0;    // numbers behind the offset
};

AccessorView view_of(const Document& document, const Element& accessor) {
    std::string_view source = accessor.value("source");
    AccessorView view;
    if (accessor.attribute("stride") &&
        (!parse_count(accessor.value("stride"), view.stride) || view.stride == 0))
        return view;
    view.array = source.starts_with('#') ? document.find(source.substr(1)) : nullptr;
    uint64_t offset = 0;
    parse_count(accessor.value("offset"), offset);
    uint64_t words = view.array ? split_words(view.array->text).size() : 0;
    view.room = words > offset ? words - offset : 0;
    return view;
}

}  // namespace

void fix_array_count(FixContext& context) {
    for (const Finding* finding : context.findings) {
        const Element& array = context.elements.at(finding->where.begin);
        set_count(context, array, split_words(array.text).size());
    }
}

// Where stride and count do not agree with the array, the <param>s are right.
void fix_accessor_stride(FixContext& context) {
    for (const Finding* finding : context.findings) {
        const Element& accessor = context.elements.at(finding->where.begin);
        if (accessor.name != "accessor") continue;
        AccessorView view = view_of(context.document, accessor);
        uint64_t width = accessor_width(accessor), count = 0;
        parse_count(accessor.value("count"), count);
        bool agree = view.room % view.stride == 0 && count == view.room / view.stride;
        if (!view.array || view.stride >= width || agree) continue;
        context.edits.push_back(
            set_attribute(context.text, accessor, "stride", std::to_string(width)));
    }
}

// To the entries that its array holds.
void fix_accessor_count(FixContext& context) {
    for (const Finding* finding : context.findings) {
        const Element& accessor = context.elements.at(finding->where.begin);
        AccessorView view = view_of(context.document, accessor);
        if (view.array)
            set_count(context, accessor,
                      view.room / std::max(view.stride, accessor_width(accessor)));
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
