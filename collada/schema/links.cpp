// collada/schema/links.cpp: the URIs of a document, by the element table.
#include "collada/schema/links.h"

#include <algorithm>

#include "collada/schema/element_types_p.h"

namespace kinora::collada {

namespace {

bool is_uri_type(const SimpleType& type) {
    return type.base && type.base->name == "anyURI";
}

class UriWalk {
  public:
    explicit UriWalk(Version version) : types_(ElementTypes::of(version)) {}

    // `type`: null where the table does not know the element.
    void visit(const Element& element, const ElementType* type) {
        for (const Attribute& a : element.attributes)
            if (is_uri(a, type) && a.name != "xml:base") values.push_back({&element, &a, a.value});
        if (type && type->rules().has_text && is_uri_type(type->rules().text))
            values.push_back({&element, nullptr, element.text});
        for (const Element& child : element.children()) visit(child, type_of(child, type));
    }

    std::vector<UriValue> values;

  private:
    static bool is_uri(const Attribute& a, const ElementType* type) {
        if (!type || type->rules().anything)
            return a.name == "url" || a.name == "source" || a.name == "target";
        const auto& rules = type->rules().attributes;
        return std::any_of(rules.begin(), rules.end(), [&](const AttributeType& rule) {
            return rule.name == a.name && is_uri_type(rule.type);
        });
    }

    const ElementType* type_of(const Element& child, const ElementType* parent) const {
        if (parent && !parent->rules().anything) {
            const ContentModel& content = parent->rules().content;
            if (uint16_t position = content.find(child.name))
                return content.positions[position].type;
        }
        return types_.global(child.name);
    }

    const ElementTypes& types_;
};

}  // namespace

std::vector<UriValue> uri_values(const Document& document) {
    UriWalk walk(document.version());
    walk.visit(document.root(), &ElementTypes::of(document.version()).root());
    return std::move(walk.values);
}

}  // namespace kinora::collada
