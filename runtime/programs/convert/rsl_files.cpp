// runtime/programs/convert/rsl_files.cpp: names of files in RSL.
#include "runtime/programs/convert/rsl_files_p.h"

#include "runtime/programs/convert/code_links_p.h"
#include "runtime/programs/convert/links_p.h"
#include "runtime/scene/description/rsl_literals.h"

namespace kinora {

using collada::Document;
using collada::Element;

namespace {

class Names {
  public:
    Names(const Document& document, std::string_view text) : document_(document), text_(text) {}

    void visit(const Element& e) {
        if (e.name == "code")
            for (LiteralRange range : string_literals(e.text))
                add(e, {uint32_t(range.begin), uint32_t(range.end)});
        if (e.name == "string" && !names_image(link_of(e.text))) add(e, trimmed(e.text));
        for (const Element& child : e.children()) visit(child);
    }

    std::vector<RslFileName> names;

  private:
    static collada::ByteRange trimmed(std::string_view text) {
        std::string_view link = link_of(text);
        uint32_t begin = link.empty() ? 0 : uint32_t(link.data() - text.data());
        return {begin, begin + uint32_t(link.size())};
    }

    // "id" or "id?words"
    bool names_image(std::string_view value) const {
        for (std::string_view id : {value, value.substr(0, value.find('?'))}) {
            const Element* e = document_.find(id);
            if (e && e->name == "image") return true;
        }
        return false;
    }

    void add(const Element& e, collada::ByteRange range) {
        std::string_view name = e.text.substr(range.begin, range.end - range.begin);
        if (!may_name_file(name)) return;
        Location where = document_.text_location(e, range.begin, range.end);
        bool section = in_section(text_, e, where.begin);
        names.push_back({std::string(name), {where.begin, where.end}, section});
    }

    const Document& document_;
    std::string_view text_;
};

}  // namespace

std::vector<RslFileName> rsl_file_names(const Document& document, std::string_view text) {
    Names names(document, text);
    names.visit(document.root());
    return std::move(names.names);
}

collada::Edit set_name(const RslFileName& name, const std::string& other) {
    return {name.bytes, code_text(other, name.in_section)};
}

}  // namespace kinora
