// collada/schema/namespaces_p.h: whose an element is: COLLADA's or another maker's.
#pragma once

#include <string_view>
#include <unordered_map>

#include "collada/document/document.h"

namespace kinora::collada {

class Namespaces {
  public:
    // `text`, the document's, tells elements that have the root's prefix from those without.
    explicit Namespaces(const Element& root, std::string_view text = {});

    // The namespace of an element's name; "" if none is declared.
    std::string_view of(const Element& element);
    // Is the element in another namespace than COLLADA's? Without a prefix it is what its parent
    // is, unless it says otherwise itself; where the root has a prefix, of none.
    bool foreign(const Element& element);
    // The schema file that the element or one around it names for a namespace
    // (xsi:schemaLocation="namespace file namespace file"); "" if none.
    std::string_view schema(const Element& element, std::string_view name_space);

  private:
    const Attribute* declaration(const Element& element, std::string_view xmlns);
    using Files = std::unordered_map<std::string_view, std::string_view>;
    const Files& schemas_of(const Element& element);

    std::string_view text_;
    std::string_view name_space_;  // COLLADA's, as the root has it
    std::string_view xmlns_;       // the root's attribute that says so
    // Attributes by name of elements that have many; files by namespace.
    std::unordered_map<const Element*, std::unordered_map<std::string_view, const Attribute*>>
        attributes_;
    std::unordered_map<const Element*, Files> schemas_;
};

}  // namespace kinora::collada
