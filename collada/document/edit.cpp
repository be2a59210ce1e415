// collada/document/edit.cpp: changes to the bytes of a document.
#include "collada/document/edit.h"

#include <algorithm>

#include "collada/text/encoding_p.h"
#include "runtime/base/check.h"

namespace kinora::collada {

namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_empty_tag(std::string_view original, const Element& element) {
    return element.start_tag.end >= 2 && original[element.start_tag.end - 2] == '/' &&
           element.bytes.end == element.start_tag.end;
}

// The '>' or the "/>" that ends the start tag, without the spaces before it.
uint32_t start_tag_close(std::string_view original, const Element& element) {
    uint32_t at = element.start_tag.end - 1;
    if (is_empty_tag(original, element)) --at;
    while (at > element.start_tag.begin && is_space(original[at - 1])) --at;
    return at;
}

struct Escape {
    char letter;
    std::string_view text;
    bool in_attributes_only;
};
constexpr Escape kEscapes[] = {{'&', "&amp;", false},  {'<', "&lt;", false},  {'>', "&gt;", false},
                               {'\r', "&#13;", false}, {'"', "&quot;", true}, {'\t', "&#9;", true},
                               {'\n', "&#10;", true}};

// How many bytes the character at `at` has if XML forbids it, else 0. The text is UTF-8 as
// valid_utf8 takes it, which lets surrogates and longer forms than needed pass.
size_t forbidden_length(std::string_view text, size_t at) {
    auto byte = [&](size_t k) { return uint8_t(text[at + k]); };
    uint8_t first = byte(0);
    if (first < 0x20) return first != '\t' && first != '\n' && first != '\r';
    if (first == 0xE0) return byte(1) < 0xA0 ? 3 : 0;
    if (first == 0xED) return byte(1) >= 0xA0 ? 3 : 0;                     // surrogates
    if (first == 0xEF) return byte(1) == 0xBF && byte(2) >= 0xBE ? 3 : 0;  // U+FFFE, U+FFFF
    if (first == 0xF0) return byte(1) < 0x90 ? 4 : 0;
    if (first == 0xF4) return byte(1) >= 0x90 ? 4 : 0;
    return 0;
}

std::string escape(std::string_view text, bool attribute) {
    std::string out;
    out.reserve(text.size());
    for (char c : xml_characters(text)) {
        const Escape* escape = nullptr;
        for (const Escape& e : kEscapes)
            if (e.letter == c && (attribute || !e.in_attributes_only)) escape = &e;
        if (escape)
            out += escape->text;
        else
            out += c;
    }
    return out;
}

}  // namespace

std::string apply_edits(std::string_view original, std::vector<Edit> edits, size_t* left_out) {
    for (const Edit& e : edits) {
        CHECK_LE(e.bytes.begin, e.bytes.end);
        CHECK_LE(e.bytes.end, original.size());
    }
    // An edit is in the way when its range, or its byte if it inserts, is inside an earlier one's.
    std::vector<const Edit*> made;
    auto before = [](const Edit* a, const Edit* b) { return a->bytes.begin < b->bytes.begin; };
    auto overlap = [](const Edit& a, const Edit& b) {
        bool a_inserts = a.bytes.begin == a.bytes.end, b_inserts = b.bytes.begin == b.bytes.end;
        if (a_inserts && b_inserts) return false;
        if (a_inserts) return a.bytes.begin > b.bytes.begin && a.bytes.begin < b.bytes.end;
        if (b_inserts) return b.bytes.begin > a.bytes.begin && b.bytes.begin < a.bytes.end;
        return a.bytes.begin < b.bytes.end && b.bytes.begin < a.bytes.end;
    };
    size_t dropped = 0;
    for (const Edit& e : edits) {
        // `made` is sorted and free of overlaps, so only neighbours by offset can be in the way.
        auto at = std::upper_bound(made.begin(), made.end(), &e, before);
        bool in_the_way = false;
        for (auto m = at; m != made.end() && (*m)->bytes.begin < e.bytes.end; ++m)
            in_the_way = in_the_way || overlap(**m, e);
        for (auto m = at; m != made.begin() && !in_the_way;) {
            --m;
            in_the_way = overlap(**m, e);
            bool inserts = (*m)->bytes.begin == (*m)->bytes.end;
            if (!inserts && (*m)->bytes.begin < e.bytes.begin) break;
        }
        if (in_the_way)
            ++dropped;
        else
            made.insert(at, &e);
    }
    // At one byte inserts come before the range that begins there.
    std::stable_sort(made.begin(), made.end(), [](const Edit* a, const Edit* b) {
        if (a->bytes.begin != b->bytes.begin) return a->bytes.begin < b->bytes.begin;
        return a->bytes.end == a->bytes.begin && b->bytes.end != b->bytes.begin;
    });
    std::string out;
    out.reserve(original.size() + 64 * made.size());
    size_t at = 0;
    for (const Edit* e : made) {
        out += original.substr(at, e->bytes.begin - at);
        out += e->text;
        at = e->bytes.end;
    }
    out += original.substr(at);
    if (left_out) *left_out = dropped;
    return out;
}

std::string utf8_text(std::string_view text) {
    return valid_utf8(text) ? std::string(text) : utf8_from_latin1(text);
}

std::string xml_characters(std::string_view text) {
    std::string characters = utf8_text(text), out;
    out.reserve(characters.size());
    for (size_t at = 0; at < characters.size();) {
        size_t forbidden = forbidden_length(characters, at);
        out += forbidden ? ' ' : characters[at];
        at += forbidden ? forbidden : 1;
    }
    return out;
}

std::string escape_text(std::string_view text) {
    return escape(text, false);
}

std::string escape_attribute(std::string_view value) {
    return escape(value, true);
}

std::string attribute_text(std::string_view name, std::string_view value) {
    return std::string(name) + "=\"" + escape_attribute(value) + "\"";
}

std::string cdata(std::string_view code) {
    std::string text = xml_characters(code), out = "<![CDATA[";
    for (size_t at = 0; at < text.size();) {
        size_t end = text.find("]]>", at);
        if (end == text.npos) {
            out += text.substr(at);
            break;
        }
        out += text.substr(at, end + 2 - at);
        out += "]]><![CDATA[";
        at = end + 2;
    }
    return out + "]]>";
}

std::string_view prefix_of(std::string_view original, const Element& element) {
    std::string_view name = original.substr(element.start_tag.begin + 1);
    name = name.substr(0, name.find_first_of(" \t\r\n/>"));
    size_t colon = name.find(':');
    return colon == name.npos ? std::string_view{} : name.substr(0, colon + 1);
}

std::string prefixed(std::string_view markup, std::string_view prefix) {
    constexpr std::pair<std::string_view, std::string_view> kVerbatim[] = {
        {"<![CDATA[", "]]>"}, {"<!--", "-->"}, {"<?", "?>"}};
    std::string out;
    while (!prefix.empty()) {
        size_t tag = markup.find('<');
        if (tag == markup.npos) break;
        out += markup.substr(0, tag);
        markup.remove_prefix(tag);
        size_t length = 0;
        for (auto [open, close] : kVerbatim)
            if (markup.starts_with(open))
                length = std::min(markup.find(close, open.size()), markup.size() - close.size()) +
                         close.size();
        if (length == 0) {
            length = markup.starts_with("</") ? 2 : 1;
            out += markup.substr(0, length);
            markup.remove_prefix(length);
            length = std::min(markup.find_first_of(" \t\r\n/>"), markup.size());
            if (markup.substr(0, length).find(':') == markup.npos) out += prefix;
        }
        out += markup.substr(0, length);
        markup.remove_prefix(length);
    }
    return out.append(markup);
}

std::string declared_utf8(std::string_view text) {
    std::string out(text);
    size_t end = text.starts_with("<?xml") ? text.find("?>") : text.npos;
    size_t at = end == text.npos ? text.npos : text.substr(0, end).find("encoding");
    if (at == text.npos) return out;
    size_t open = text.find_first_of("'\"", at);
    size_t close = open < end ? text.find(text[open], open + 1) : text.npos;
    if (close < end) out.replace(open + 1, close - open - 1, "utf-8");
    return out;
}

Edit erase_element(std::string_view original, const Element& element) {
    uint32_t begin = element.bytes.begin;
    while (begin > 0 && (original[begin - 1] == ' ' || original[begin - 1] == '\t')) --begin;
    if (begin > 0 && original[begin - 1] == '\n') {
        --begin;
        if (begin > 0 && original[begin - 1] == '\r') --begin;
    } else {
        begin = element.bytes.begin;  // it shares its line: keep what parts the others
    }
    return {{begin, element.bytes.end}, ""};
}

Edit set_attribute(std::string_view original, const Element& element, std::string_view name,
                   std::string_view value) {
    if (const Attribute* a = element.attribute(name)) {
        std::string text = escape_attribute(value);
        // Between single quotes those must be escaped too.
        if (a->value_bytes.begin > 0 && original[a->value_bytes.begin - 1] == '\'')
            for (size_t at = 0; (at = text.find('\'', at)) != text.npos; at += 6)
                text.replace(at, 1, "&apos;");
        return {a->value_bytes, std::move(text)};
    }
    uint32_t at = start_tag_close(original, element);
    return {{at, at}, " " + attribute_text(name, value)};
}

Edit append_child(std::string_view original, const Element& element, std::string_view markup) {
    if (is_empty_tag(original, element)) {
        std::string_view name = original.substr(element.start_tag.begin + 1);
        name = name.substr(0, name.find_first_of(" \t\r\n/>"));  // with its prefix
        return {{start_tag_close(original, element), element.start_tag.end},
                ">" + std::string(markup) + "</" + std::string(name) + ">"};
    }
    size_t at = original.rfind("</", element.bytes.end - 1);
    CHECK(at != original.npos && at >= element.start_tag.end);
    return {{uint32_t(at), uint32_t(at)}, std::string(markup)};
}

}  // namespace kinora::collada
