// collada/schema/namespaces.cpp: xmlns attributes and xsi:schemaLocation, inside out.
#include "collada/schema/namespaces_p.h"

#include <string>

#include "collada/document/edit.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

Namespaces::Namespaces(const Element& root, std::string_view text) {
    if (!text.empty() && !prefix_of(text, root).empty()) text_ = text;
    for (const Attribute& a : root.attributes) {
        bool declares = a.name == "xmlns" || a.name.starts_with("xmlns:");
        if (!declares || a.value.find("collada.org") == a.value.npos) continue;
        xmlns_ = a.name;
        name_space_ = a.value;
        if (a.name == "xmlns") break;  // elements without a prefix speak of this one
    }
    if (xmlns_.empty()) name_space_ = root.value("xmlns");
}

// element.attribute(xmlns), of elements that are asked often.
const Attribute* Namespaces::declaration(const Element& element, std::string_view xmlns) {
    constexpr size_t kMany = 16;
    if (element.attributes.size() <= kMany) return element.attribute(xmlns);
    auto [table, fresh] = attributes_.try_emplace(&element);
    if (fresh)
        for (const Attribute& a : element.attributes) table->second.try_emplace(a.name, &a);
    auto found = table->second.find(xmlns);
    return found == table->second.end() ? nullptr : found->second;
}

std::string_view Namespaces::of(const Element& element) {
    size_t colon = element.name.find(':');
    std::string wanted = "xmlns";
    if (colon != element.name.npos) wanted += ":" + std::string(element.name.substr(0, colon));
    for (const Element* e = &element; e; e = e->parent)
        if (const Attribute* a = declaration(*e, wanted)) return a->value;
    return {};
}

bool Namespaces::foreign(const Element& element) {
    if (element.name.find(':') != element.name.npos) return of(element) != name_space_;
    if (!text_.empty() && prefix_of(text_, element).empty()) return of(element) != name_space_;
    for (const Attribute& a : element.attributes)
        if (a.name == xmlns_) return a.value != name_space_;
    return false;
}

const Namespaces::Files& Namespaces::schemas_of(const Element& element) {
    auto [at, fresh] = schemas_.try_emplace(&element);
    if (!fresh) return at->second;
    for (const Attribute& a : element.attributes) {
        if (!a.name.ends_with(":schemaLocation")) continue;
        std::vector<std::string_view> words = split_words(a.value);
        for (size_t i = 0; i + 1 < words.size(); i += 2)
            at->second.try_emplace(words[i], words[i + 1]);
    }
    return at->second;
}

std::string_view Namespaces::schema(const Element& element, std::string_view name_space) {
    for (const Element* e = &element; e; e = e->parent) {
        if (e->attributes.empty()) continue;
        const Files& files = schemas_of(*e);
        auto found = files.find(name_space);
        if (found != files.end()) return found->second;
    }
    return {};
}

}  // namespace kinora::collada
