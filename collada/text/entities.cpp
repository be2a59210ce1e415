// collada/text/entities.cpp: references of a text: to entities that its document type would have to
// explain, and ampersands that begin no reference.
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

// The first '&' from `at` on that is no part of markup that may hold any; npos: there is none.
size_t next_ampersand(std::string_view text, size_t at) {
    while ((at = text.find_first_of("<&", at)) != text.npos && text[at] == '<')
        at = behind_markup(text, at);
    return at;
}

// The name of an entity, or "#" and a number, behind an '&'; "" where no ';' ends one.
std::string_view reference_behind(std::string_view text, size_t at) {
    size_t end = text.find_first_of("; \t\r\n<>&\"'", at);
    return end == text.npos || text[end] != ';' ? std::string_view() : text.substr(at, end - at);
}

bool is_predefined(std::string_view name) {
    return std::find(std::begin(kPredefined), std::end(kPredefined), name) != std::end(kPredefined);
}

// "#38", "#x26" (XML 1.0, production 66).
bool is_character_reference(std::string_view name) {
    if (!name.starts_with('#')) return false;
    bool hexadecimal = name.starts_with("#x");
    name.remove_prefix(hexadecimal ? 2 : 1);
    std::string_view digits = hexadecimal ? "0123456789abcdefABCDEF" : "0123456789";
    return !name.empty() && name.find_first_not_of(digits) == name.npos;
}

}  // namespace

std::optional<ByteRange> find_entity_use(std::string_view text) {
    if (!has_document_type(text)) return std::nullopt;
    for (size_t at = 0; (at = next_ampersand(text, at)) != text.npos;) {
        std::string_view name = reference_behind(text, ++at);
        if (name.empty() || name.find('#') != name.npos || is_predefined(name)) continue;
        return ByteRange{uint32_t(at), uint32_t(at + name.size())};
    }
    return std::nullopt;
}

std::vector<uint32_t> bare_ampersands(std::string_view text) {
    bool declares = has_document_type(text);
    std::vector<uint32_t> bare;
    for (size_t at = 0; (at = next_ampersand(text, at)) != text.npos; ++at) {
        std::string_view name = reference_behind(text, at + 1);
        bool known = is_predefined(name) || is_character_reference(name);
        bool declared = declares && !name.empty() && name.find('#') == name.npos;
        if (!known && !declared) bare.push_back(uint32_t(at));
    }
    return bare;
}

std::string escape_ampersands(std::string_view text, const std::vector<uint32_t>& at) {
    constexpr std::string_view kEscaped = "&amp;";
    std::string out;
    out.reserve(text.size() + at.size() * kEscaped.size());
    size_t begin = 0;
    for (uint32_t byte : at) {
        out.append(text.substr(begin, byte - begin)).append(kEscaped);
        begin = byte + 1;
    }
    return out.append(text.substr(begin));
}

}  // namespace kinora::collada
