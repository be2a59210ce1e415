// runtime/scene/gltf/file/json_scan.cpp: a scanner of JSON (RFC 8259) that keeps byte positions.
#include "runtime/scene/gltf/file/json_scan.h"

#include <algorithm>
#include <charconv>

#include "runtime/scene/gltf/file/json_scanner_p.h"

namespace kinora {

namespace {

void append_utf8(std::string& out, uint32_t c) {
    if (c < 0x80) {
        out += char(c);
    } else if (c < 0x800) {
        out += char(0xc0 | c >> 6);
        out += char(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
        out += char(0xe0 | c >> 12);
        out += char(0x80 | (c >> 6 & 0x3f));
        out += char(0x80 | (c & 0x3f));
    } else {
        out += char(0xf0 | c >> 18);
        out += char(0x80 | (c >> 12 & 0x3f));
        out += char(0x80 | (c >> 6 & 0x3f));
        out += char(0x80 | (c & 0x3f));
    }
}

uint32_t hex4(std::string_view text, size_t at) {
    uint32_t value = 0;
    std::from_chars(text.data() + std::min(at, text.size()),
                    text.data() + std::min(at + 4, text.size()), value, 16);
    return value;
}

// One character or escape at `at`; how many bytes it took.
size_t decode_one(std::string_view text, size_t at, std::string& out) {
    if (text[at] != '\\' || at + 1 >= text.size()) {
        out += text[at];
        return 1;
    }
    constexpr std::string_view kEscapes = "bfnrt", kMeant = "\b\f\n\r\t";
    char c = text[at + 1];
    if (c != 'u') {
        size_t known = kEscapes.find(c);
        out += known == std::string_view::npos ? c : kMeant[known];
        return 2;
    }
    uint32_t code = hex4(text, at + 2);
    bool pair = code >= 0xd800 && code < 0xdc00 && at + 12 <= text.size() &&
                text.substr(at + 6, 2) == "\\u";
    uint32_t low = pair ? hex4(text, at + 8) : 0;
    pair = pair && low >= 0xdc00 && low < 0xe000;
    append_utf8(out, pair ? 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00) : code);
    return std::min<size_t>(pair ? 12 : 6, text.size() - at);
}

std::string plain_string(std::string_view text, JsonRange range) {
    SourceMap map;
    return json_string(text, range, kNoFile, map);
}

// "a~1b" of a pointer is the key "a/b".
std::string pointer_token(std::string_view token) {
    std::string key;
    for (size_t i = 0; i < token.size(); ++i) {
        bool escape = token[i] == '~' && i + 1 < token.size();
        key += escape ? (token[i + 1] == '1' ? '/' : '~') : token[i];
        i += escape;
    }
    return key;
}

// Stands before the member's value if there is one.
bool enter(JsonScanner& scanner, std::string_view text, const std::string& key) {
    if (scanner.take('{')) {
        while (std::optional<JsonRange> name = scanner.string()) {
            if (!scanner.take(':')) return false;
            if (plain_string(text, *name) == key) return true;
            if (!scanner.skip_value() || !scanner.take(',')) return false;
        }
        return false;
    }
    size_t index = 0;
    auto [rest, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    if (error != std::errc() || !scanner.take('[')) return false;
    for (; index > 0; --index)
        if (!scanner.skip_value() || !scanner.take(',')) return false;
    return scanner.peek() != ']' && scanner.peek() != '\0';
}

struct Found {
    std::optional<JsonRange> range;
    bool whole = false;  // the pointer's own value
};

Found find(std::string_view text, std::string_view pointer) {
    JsonScanner scanner(text);
    Found found;
    size_t begin = (scanner.peek(), scanner.at());
    found.whole = true;
    while (found.whole && !pointer.empty()) {
        pointer.remove_prefix(1);
        size_t slash = std::min(pointer.find('/'), pointer.size());
        JsonScanner inside = scanner;
        found.whole = enter(inside, text, pointer_token(pointer.substr(0, slash)));
        pointer.remove_prefix(slash);
        if (!found.whole) break;
        scanner = inside;
        begin = (scanner.peek(), scanner.at());
    }
    if (scanner.skip_value())
        found.range = JsonRange{uint32_t(begin), uint32_t(scanner.at())};
    else if (begin < text.size())
        found.range = JsonRange{uint32_t(begin), uint32_t(begin + 1)};
    return found;
}

}  // namespace

JsonShape json_shape(std::string_view text) {
    JsonShape shape;
    size_t depth = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        char c = text[i];
        if (c == '"') {
            for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
        } else if (c == '{' || c == '[') {
            ++shape.containers;
            shape.depth = std::max(shape.depth, ++depth);
        } else if ((c == '}' || c == ']') && depth > 0) {
            --depth;
        }
    }
    return shape;
}

std::optional<JsonRange> json_nearest(std::string_view text, std::string_view pointer) {
    return find(text, pointer).range;
}

std::optional<JsonRange> json_find(std::string_view text, std::string_view pointer) {
    Found found = find(text, pointer);
    return found.whole ? found.range : std::nullopt;
}

std::vector<JsonRange> json_elements(std::string_view text, std::string_view pointer) {
    std::vector<JsonRange> elements;
    std::optional<JsonRange> range = json_find(text, pointer);
    if (!range) return elements;
    std::string_view array = text.substr(range->begin, range->end - range->begin);
    JsonScanner scanner(array);
    if (!scanner.take('[')) return elements;
    while (scanner.peek() != ']' && scanner.peek() != '\0') {
        size_t begin = scanner.at();
        if (!scanner.skip_value()) break;
        elements.push_back({range->begin + uint32_t(begin), range->begin + uint32_t(scanner.at())});
        if (!scanner.take(',')) break;
    }
    return elements;
}

double json_number(std::string_view text, std::string_view pointer, double otherwise) {
    std::optional<JsonRange> range = json_find(text, pointer);
    if (range) std::from_chars(text.data() + range->begin, text.data() + range->end, otherwise);
    return otherwise;
}

std::vector<std::string> json_strings(std::string_view text, std::string_view pointer) {
    std::vector<std::string> strings;
    for (JsonRange element : json_elements(text, pointer))
        if (text[element.begin] == '"') strings.push_back(plain_string(text, element));
    return strings;
}

std::string json_string(std::string_view text, JsonRange range, FileId file, SourceMap& map) {
    map.file = file;
    std::string out;
    if (range.end < range.begin + 2 || text[range.begin] != '"') return out;
    std::string_view inside = text.substr(0, range.end - 1);
    size_t step = 0;  // bytes of the character before: a new segment where not in step with `out`
    for (size_t at = range.begin + 1; at < inside.size();) {
        size_t before = out.size();
        if (map.segments.empty() || step != 1)
            map.segments.push_back({uint32_t(before), uint32_t(at)});
        step = decode_one(inside, at, out);
        at += step;
    }
    return out;
}

}  // namespace kinora
