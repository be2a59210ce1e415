// collada/check_elements.cpp: a document against the table of elements.
#include <set>

#include "collada/document.h"
#include "collada/findings.h"
#include "collada/numbers_p.h"
#include "runtime/base/check.h"

namespace kinora::collada {

namespace {

enum class Versions : uint8_t { All, V14, V15 };
enum class Use : uint8_t { Rendered, Kept, Unsupported };

struct ElementRow {
    std::string_view type;
    Versions versions;
    Use use;
    std::string_view attributes, children;
};

constexpr ElementRow kElements[] = {
#define ELEMENT(type, versions, use, attributes, children) \
    {#type, Versions::versions, Use::use, attributes, children},
#include "collada/elements.def"
#undef ELEMENT
};

// A row with its lists split; built once.
struct ElementType {
    const ElementRow* row = nullptr;
    bool any_child = false, any_attribute = false;
    std::vector<std::string_view> attributes;  // without the "!"
    std::vector<std::string_view> required;
    std::unordered_map<std::string_view, const ElementType*> children;
};

class ElementTable {
  public:
    ElementTable() {
        for (const ElementRow& row : kElements) types_[row.type].row = &row;
        for (auto& [name, type] : types_) link(type);
    }
    const ElementType* root() const { return find("COLLADA"); }
    const ElementType* find(std::string_view type) const {
        auto found = types_.find(type);
        return found == types_.end() ? nullptr : &found->second;
    }

  private:
    void link(ElementType& type) {
        for (std::string_view word : split_words(type.row->attributes)) {
            if (word == "*") type.any_attribute = true;
            bool must = word.starts_with('!');
            if (must) word.remove_prefix(1);
            type.attributes.push_back(word);
            if (must) type.required.push_back(word);
        }
        for (std::string_view word : split_words(type.row->children)) {
            if (word == "*") type.any_child = true;
            size_t colon = word.find(':');
            std::string_view name = word.substr(0, colon);
            const ElementType* child = find(colon == word.npos ? word : word.substr(colon + 1));
            CHECK(child || word == "*");  // a row that names a type without one
            type.children[name] = child;
        }
    }
    std::unordered_map<std::string_view, ElementType> types_;
};

const ElementTable& table() {
    static const ElementTable kTable;
    return kTable;
}

bool contains(const std::vector<std::string_view>& list, std::string_view word) {
    for (std::string_view w : list)
        if (w == word) return true;
    return false;
}

// Each kind of finding once per element type and name: a file repeats its habits.
class Checker {
  public:
    Checker(const Document& document, Diagnostics& diag) : document_(document), diag_(diag) {}

    void check(const Element& element, const ElementType& type) {
        check_version(element, type);
        check_attributes(element, type);
        if (type.row->use == Use::Unsupported) {
            if (first(Kind::Unsupported, type, element.name))
                diag_.report(Code::INFO_UNSUPPORTED, document_.location(element), element.name);
            return;
        }
        if (type.row->use == Use::Kept || type.any_child) return;
        for (const Element& child : element.children()) {
            auto known = type.children.find(child.name);
            if (known != type.children.end())
                check(child, *known->second);  // as deep as the document may be
            else if (first(Kind::Child, type, child.name))
                diag_.report(Code::SCHEMA_UNKNOWN_ELEMENT, document_.location(child), child.name,
                             element.name);
        }
    }

  private:
    enum class Kind : uint8_t { Child, Attribute, Missing, Unsupported, Version };

    void check_version(const Element& element, const ElementType& type) {
        bool is_15 = document_.version() == Version::V1_5_0;
        bool wrong = (type.row->versions == Versions::V14 && is_15) ||
                     (type.row->versions == Versions::V15 && !is_15);
        if (wrong && first(Kind::Version, type, element.name))
            diag_.report(Code::SCHEMA_VERSION, document_.location(element), element.name,
                         is_15 ? "1.5" : "1.4");
    }

    void check_attributes(const Element& element, const ElementType& type) {
        for (const Attribute& a : element.attributes) {
            if (type.any_attribute || contains(type.attributes, a.name)) continue;
            if (a.name.starts_with("xmlns") || a.name.find(':') != a.name.npos) continue;
            if (first(Kind::Attribute, type, a.name))
                diag_.report(Code::SCHEMA_UNKNOWN_ATTRIBUTE,
                             Location{document_.file(), a.bytes.begin, a.bytes.end}, element.name,
                             a.name);
        }
        for (std::string_view name : type.required)
            if (!element.attribute(name) && first(Kind::Missing, type, name))
                diag_.report(Code::SCHEMA_MISSING_ATTRIBUTE, document_.location(element),
                             element.name, name);
    }

    bool first(Kind kind, const ElementType& type, std::string_view name) {
        return seen_.emplace(kind, &type, name).second;
    }

    const Document& document_;
    Diagnostics& diag_;
    std::set<std::tuple<Kind, const ElementType*, std::string_view>> seen_;
};

}  // namespace

void check_elements(const Document& document, Diagnostics& diag) {
    Checker(document, diag).check(document.root(), *table().root());
}

}  // namespace kinora::collada
