// collada/schema/element_types_p.h: the element table of one version, each row parsed when first
// asked for.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "collada/schema/content_model_p.h"
#include "collada/schema/schema_rows_p.h"
#include "collada/schema/simple_types_p.h"

namespace kinora::collada {

class ElementTypes;

struct AttributeType {
    std::string_view name;
    SimpleType type;
    bool required = false;
    bool has_default = false;
    std::string_view default_value;
};

// What a row says.
struct ElementRules {
    std::vector<AttributeType> attributes;
    ContentModel content;
    bool has_text = false;
    SimpleType text;
    bool has_default = false;  // the text may be missing
    std::string_view default_text;
    bool anything = false;     // any attributes, elements and text
    bool foreign_xml = false;  // attributes of the xml: namespace may stand here
};

struct ElementType {
    std::string_view name;  // of the row; "=double[3]" for one that is only text
    const ElementRow* row = nullptr;
    Use use = Use::Kept;

    const ElementRules& rules() const;  // parsed at the first call; thread-safe

  private:
    friend class ElementTypes;
    const ElementTypes* types_ = nullptr;
    mutable std::once_flag once_;
    mutable std::unique_ptr<const ElementRules> rules_;
};

class ElementTypes {
  public:
    static const ElementTypes& of(Version version);  // made at the first call

    Version version() const { return version_; }
    const ElementType& root() const { return *find("COLLADA"); }
    const ElementType* find(std::string_view type) const;  // "=simple" too; null if there is none
    // Of an element that is known by name alone, where anything may stand; or null.
    const ElementType* global(std::string_view element) const;
    // The type of an element by the way from the root; null where the table does not know it.
    const ElementType* of_element(const Element& element) const;
    // Is there any element of this name in this version?
    bool has_element(std::string_view name) const;
    // The known element name most like this one, or "".
    std::string_view nearest(std::string_view name) const;

  private:
    explicit ElementTypes(Version version);
    ElementRules parse(const ElementType& type) const;
    const std::vector<std::string_view>& element_names() const;

    Version version_;
    std::deque<ElementType> rows_;
    std::unordered_map<std::string_view, const ElementType*> by_name_;
    std::unordered_map<std::string_view, const ElementType*> globals_;
    mutable std::mutex mutex_;
    mutable std::deque<ElementType> texts_;  // "=simple", made when first asked for
    mutable std::unordered_map<std::string_view, const ElementType*> texts_by_name_;
    mutable std::once_flag names_once_;
    mutable std::vector<std::string_view> names_;
    friend struct ElementType;
};

}  // namespace kinora::collada
