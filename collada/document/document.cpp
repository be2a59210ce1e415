// collada/document/document.cpp: questions a document answers.
#include "collada/document/document.h"

namespace kinora::collada {

namespace {

// Most names that differ do so in their length or first letter.
bool same(std::string_view a, std::string_view b) {
    return a.size() == b.size() && (a.empty() || a[0] == b[0]) && a == b;
}

}  // namespace

const Element* Element::child(std::string_view child_name) const {
    const Element* e = first_child;
    while (e && !same(e->name, child_name)) e = e->next;
    return e;
}

const Element* Element::next_named(std::string_view sibling_name) const {
    const Element* e = next;
    while (e && !same(e->name, sibling_name)) e = e->next;
    return e;
}

const Attribute* Element::attribute(std::string_view attribute_name) const {
    for (const Attribute& a : attributes)
        if (same(a.name, attribute_name)) return &a;
    return nullptr;
}

std::string_view Element::value(std::string_view attribute_name) const {
    const Attribute* a = attribute(attribute_name);
    return a ? a->value : std::string_view{};
}

const Element* Document::find(std::string_view id) const {
    auto found = ids_.find(id);
    return found == ids_.end() ? nullptr : found->second;
}

Location Document::location(const Element& element) const {
    return {file_, element.start_tag.begin, element.start_tag.end};
}

Location Document::location(const Element& element, std::string_view attribute_name) const {
    const Attribute* a = element.attribute(attribute_name);
    return a ? Location{file_, a->value_bytes.begin, a->value_bytes.end} : location(element);
}

SourceMap Document::source_map(const Element& element) const {
    return {file_, {element.text_map.begin(), element.text_map.end()}};
}

Location Document::text_location(const Element& element, size_t begin, size_t end) const {
    if (element.text_map.empty()) return location(element);
    auto offset = [&](size_t at) {
        size_t low = 0, high = element.text_map.size();  // the last segment at or before `at`
        while (high - low > 1) {
            size_t middle = (low + high) / 2;
            (element.text_map[middle].text_offset <= at ? low : high) = middle;
        }
        const SourceMap::Segment& s = element.text_map[low];
        return uint32_t(s.file_offset + (at - s.text_offset));
    };
    uint32_t first = offset(begin);
    return {file_, first, end > begin ? std::max(first, offset(end - 1) + 1) : first};
}

Location Document::text_location(const Element& element) const {
    constexpr std::string_view kSpace = " \t\r\n";
    size_t begin = element.text.find_first_not_of(kSpace);
    if (begin == std::string_view::npos) return location(element);
    return text_location(element, begin, element.text.find_last_not_of(kSpace) + 1);
}

}  // namespace kinora::collada
