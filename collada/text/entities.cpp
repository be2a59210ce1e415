// collada/text/entities.cpp: where a text uses an entity that its document type would have to
// explain.
#include "collada/text/entities_p.h"

#include <algorithm>

namespace kinora::collada {

namespace {

constexpr std::string_view kPredefined[] = {"lt", "gt", "amp", "quot", "apos"};

// What holds '&' without meaning a reference, and how it ends.
struct OpaqueMarkup {
    std::string_view opens, closes;
};
constexpr OpaqueMarkup kOpaque[] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
// Declarations, whose literals may hold anything; <!DOCTYPE ends where its subset begins.
constexpr std::string_view kDeclarations[] = {"<!ENTITY", "<!NOTATION", "<!DOCTYPE"};

size_t behind(std::string_view text, std::string_view what, size_t from) {
    size_t at = text.find(what, from);
    return at == text.npos ? text.size() : at + what.size();
}

size_t behind_declaration(std::string_view text, size_t at) {
    while (at < text.size()) {
        at = text.find_first_of("\"'[>", at);
        if (at == text.npos) break;
        char c = text[at++];
        if (c == '[' || c == '>') return at;
        at = behind(text, {&c, 1}, at);
    }
    return text.size();
}

// Behind markup that may hold '&', or `at` + 1.
size_t behind_markup(std::string_view text, size_t at) {
    std::string_view rest = text.substr(at);
    for (const OpaqueMarkup& o : kOpaque)
        if (rest.starts_with(o.opens)) return behind(text, o.closes, at + o.opens.size());
    for (std::string_view declaration : kDeclarations)
        if (rest.starts_with(declaration)) return behind_declaration(text, at + declaration.size());
    return at + 1;
}

bool has_document_type(std::string_view text) {
    for (size_t at = 0;;) {
        at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
        std::string_view rest = text.substr(at);
        if (rest.starts_with("<!DOCTYPE")) return true;
        if (!rest.starts_with("<!--") && !rest.starts_with("<?")) return false;
        at = behind_markup(text, at);
    }
}

}  // namespace

std::optional<ByteRange> find_entity_use(std::string_view text) {
    if (!has_document_type(text)) return std::nullopt;
    for (size_t at = 0; (at = text.find_first_of("<&", at)) != text.npos;) {
        if (text[at] == '<') {
            at = behind_markup(text, at);
            continue;
        }
        size_t end = text.find_first_of("; \t\r\n<>&\"'#", ++at);
        if (end == text.npos || text[end] != ';' || end == at) continue;
        std::string_view name = text.substr(at, end - at);
        if (std::find(std::begin(kPredefined), std::end(kPredefined), name) ==
            std::end(kPredefined))
            return ByteRange{uint32_t(at), uint32_t(end)};
    }
    return std::nullopt;
}

}  // namespace kinora::collada
