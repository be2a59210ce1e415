// collada/schema/check_elements_p.h: the walk that holds a document against the element table.
#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "collada/document/findings.h"
#include "collada/schema/element_types_p.h"
#include "collada/schema/namespaces_p.h"

namespace kinora::collada {

// Each kind of finding once per element type and name: a file repeats its habits.
class ElementChecker {
  public:
    ElementChecker(const Document& document, Diagnostics& diag, Version version);
    void run();

  private:
    // `kept`: inside what is not rendered as a whole, where nothing more is said about that.
    void check(const Element& element, const ElementType& type, bool kept);
    void report_unsupported(const Element& element, const ElementType& type);

    // check_values.cpp
    void check_attributes(const Element& element, const ElementType& type);
    void check_attribute(const Element& element, const ElementType& type, const Attribute& a,
                         const AttributeType& rule);
    void check_id(const Element& element, const Attribute& id);
    void unknown_attribute(const Element& element, const ElementType& type, const Attribute& a);
    void check_text(const Element& element, const ElementType& type);
    void report_value(const Element& element, const ElementType& type, const Attribute* a,
                      const SimpleType& simple, const ValueCheck& check, std::string_view value,
                      Location where);

    // check_children.cpp
    void check_children(const Element& element, const ElementType& type, bool kept);
    uint16_t step(const ContentModel& model, uint16_t at, const Element& child);
    // A child that may not stand where it does: reports it, checks what is inside. Returns where in
    // the model to go on.
    uint16_t misplaced(const Element& element, const ElementType& type, uint16_t at,
                       const Element& child, bool kept);
    void unknown_child(const Element& element, const ElementType& type, uint16_t at,
                       const Element& child, bool kept);
    void disordered_child(const Element& element, const ElementType& type, const Element& child);
    void missing_children(const Element& element, const ElementType& type, uint16_t at);
    void check_any(const Element& child, bool kept);

    bool foreign(const Element& child) { return namespaces_.foreign(child); }
    // "did you mean" of the first names only: the search takes longer than all other checks.
    bool may_suggest() { return ++suggestions_ <= 1000; }
    void report_foreign(const Element& child);
    // COLLADA 1.5's where the document is of 1.4, and the other way round.
    const ElementTypes& other_version() const;

    bool first(const FindingInfo& code, const void* type, std::string_view name) {
        return seen_.emplace(&code, type, name).second;
    }

    const Document& document_;
    Diagnostics& diag_;
    const ElementTypes& types_;
    Namespaces namespaces_;
    std::unordered_map<std::string_view, const Element*> shared_ids_;  // of those used twice
    // Whether so many children of that name stood in wrong positions that all has been said of
    // them.
    bool misplaced_often(const ElementType& type, const Element& child);

    size_t suggestions_ = 0;
    std::map<std::pair<const void*, std::string_view>, uint32_t> misplaced_;
    std::set<std::tuple<const FindingInfo*, const void*, std::string_view>> seen_;
};

// For a message: not longer than a line.
std::string shortened(std::string_view value);

}  // namespace kinora::collada
