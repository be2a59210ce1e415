// collada/validate/fix_order.cpp: children into the order of the schema; empty libraries taken
// away.
#include "collada/schema/schema.h"
#include "collada/validate/fix_p.h"

namespace kinora::collada {

namespace {

const Element* following(const Element& element) {
    if (element.first_child) return element.first_child;
    const Element* at = &element;
    while (at && !at->next) at = at->parent;
    return at ? at->next : nullptr;
}

bool only_space(std::string_view text) {
    return text.find_first_not_of(" \t\r\n") == text.npos;
}

// A child moves with what stands before it: its indentation and its comment.
Edit reordered(std::string_view text, const Element& parent,
               const std::vector<const Element*>& order) {
    std::vector<std::pair<const Element*, std::string_view>> blocks;
    uint32_t begin = parent.start_tag.end, at = begin;
    for (const Element& child : parent.children()) {
        blocks.emplace_back(&child, text.substr(at, child.bytes.end - at));
        at = child.bytes.end;
    }
    Edit edit{{begin, at}, {}};
    for (const Element* child : order)
        for (const auto& [element, block] : blocks)
            if (element == child) edit.text += block;
    return edit;
}

}  // namespace

void fix_order(FixContext& context) {
    const Element* skip_until = nullptr;
    for (const Element* e = &context.document.root(); e; e = following(*e)) {
        if (skip_until && e->bytes.begin < skip_until->bytes.end) continue;  // moves as it is
        if (!e->first_child || !e->first_child->next || !only_space(e->text)) continue;
        std::vector<const Element*> order = schema_order(context.document, *e);
        const Element* child = e->first_child;
        bool same = true;
        for (const Element* wanted : order) {
            same = same && wanted == child;
            child = child->next;
        }
        if (same) continue;
        context.edits.push_back(reordered(context.text, *e, order));
        skip_until = e;
    }
}

// One with an asset, an extra, a comment or an instruction says something: it stays.
void fix_empty_libraries(FixContext& context) {
    for (const Element& library : context.document.root().children()) {
        if (!library.name.starts_with("library_") || library.first_child) continue;
        std::string_view bytes =
            context.text.substr(library.start_tag.end, library.bytes.end - library.start_tag.end);
        size_t end = library.bytes.end == library.start_tag.end ? 0 : bytes.rfind("</");
        bool only_tags = bytes.substr(0, end).find('<') == bytes.npos;  // no comment, no <?...?>
        if (only_space(library.text) && only_tags)
            context.edits.push_back(erase_element(context.text, library));
    }
}

}  // namespace kinora::collada
