// collada/text/encoding.cpp: from the bytes of a file to UTF-8 text.
#include <array>
#include <cctype>
#include <cstdint>
#include <numeric>
#include <span>

#include "collada/text/encoding_p.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"

namespace kinora::collada {

namespace {

// Where an encoding of one byte a character differs from Latin-1, whose bytes are the code points.
struct Override {
    uint8_t byte;
    uint16_t character;
};

// Windows' code page 1252 has letters for 0x80 to 0x9F, but for five that are free.
constexpr Override kWindows1252[] = {
    {0x80, 0x20AC}, {0x82, 0x201A}, {0x83, 0x0192}, {0x84, 0x201E}, {0x85, 0x2026}, {0x86, 0x2020},
    {0x87, 0x2021}, {0x88, 0x02C6}, {0x89, 0x2030}, {0x8A, 0x0160}, {0x8B, 0x2039}, {0x8C, 0x0152},
    {0x8E, 0x017D}, {0x91, 0x2018}, {0x92, 0x2019}, {0x93, 0x201C}, {0x94, 0x201D}, {0x95, 0x2022},
    {0x96, 0x2013}, {0x97, 0x2014}, {0x98, 0x02DC}, {0x99, 0x2122}, {0x9A, 0x0161}, {0x9B, 0x203A},
    {0x9C, 0x0153}, {0x9E, 0x017E}, {0x9F, 0x0178}};
// ISO 8859-15 (Latin-9): the euro and letters that Latin-1 lacks.
constexpr Override kLatin9[] = {{0xA4, 0x20AC}, {0xA6, 0x0160}, {0xA8, 0x0161}, {0xB4, 0x017D},
                                {0xB8, 0x017E}, {0xBC, 0x0152}, {0xBD, 0x0153}, {0xBE, 0x0178}};

struct SingleByte {
    std::string_view name;
    std::span<const Override> overrides;
};
constexpr SingleByte kSingleByte[] = {{"iso-8859-1", {}},
                                      {"latin1", {}},
                                      {"latin-1", {}},
                                      {"iso8859-1", {}},
                                      {"us-ascii", {}},
                                      {"iso-8859-15", kLatin9},
                                      {"windows-1252", kWindows1252},
                                      {"cp1252", kWindows1252}};

std::string utf8_from(std::string_view bytes, std::span<const Override> overrides) {
    std::array<uint16_t, 256> characters;
    std::iota(characters.begin(), characters.end(), uint16_t(0));
    for (Override o : overrides) characters[o.byte] = o.character;
    std::string out;
    out.reserve(bytes.size() + bytes.size() / 16);
    for (char b : bytes) append_utf8(out, characters[uint8_t(b)]);
    return out;
}

}  // namespace

std::string utf8_from_latin1(std::string_view bytes) {
    return utf8_from(bytes, {});
}

namespace {

// How many bytes the sequence starting with `lead` has; 0 for no start.
int sequence_length(uint8_t lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead < 0xE0) return 2;
    if (lead >= 0xE0 && lead < 0xF0) return 3;
    if (lead >= 0xF0 && lead < 0xF5) return 4;
    return 0;
}

}  // namespace

bool valid_utf8(std::string_view text) {
    for (size_t i = 0; i < text.size();) {
        int length = sequence_length(uint8_t(text[i]));
        if (length == 0 || i + size_t(length) > text.size()) return false;
        for (int k = 1; k < length; ++k)
            if ((uint8_t(text[i + size_t(k)]) & 0xC0) != 0x80) return false;
        i += size_t(length);
    }
    return true;
}

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // in UTF-8

// The encoding named in <?xml ... encoding="..."?>, in lower case; "" if none.
std::string declared_encoding(std::string_view text) {
    std::optional<ByteRange> range = xml_declaration(text);
    if (!range) return {};
    std::string_view declaration =
        text.substr(range->begin, std::min<size_t>(range->end - range->begin, 256));
    size_t at = declaration.find("encoding");
    if (at == std::string_view::npos) return {};
    size_t open = declaration.find_first_of("'\"", at);
    if (open == std::string_view::npos) return {};
    size_t close = declaration.find(declaration[open], open + 1);
    if (close == std::string_view::npos) return {};
    std::string name(declaration.substr(open + 1, close - open - 1));
    for (char& c : name) c = char(std::tolower(uint8_t(c)));
    return name;
}

struct Magic {
    std::string_view bytes;
    const char* what;
};

constexpr Magic kNotXml[] = {
    {"glTF", "it is a binary glTF"},
    {std::string_view("\xff\xfe\0\0", 4), "UTF-32 is not read"},
    {std::string_view("\0\0\xfe\xff", 4), "UTF-32 is not read"},
};

constexpr std::string_view kUnicode[] = {"", "utf-8", "utf8", "utf-16", "utf-16le", "utf-16be"};

template <size_t N>
bool contains(const std::string_view (&names)[N], std::string_view name) {
    for (std::string_view n : names)
        if (n == name) return true;
    return false;
}

}  // namespace

std::optional<ByteRange> xml_declaration(std::string_view text) {
    for (size_t at = 0; (at = text.find_first_not_of(" \t\r\n", at)) != text.npos;) {
        std::string_view rest = text.substr(at);
        size_t end = text.npos;
        if (rest.starts_with("<?xml") && rest.find_first_of(" \t\r\n") == 5) {
            end = text.find("?>", at);
            if (end == text.npos) return std::nullopt;
            return ByteRange{uint32_t(at), uint32_t(end + 2)};
        }
        if (rest.starts_with("<!--")) end = text.find("-->", at + 4);
        if (rest.starts_with(kByteOrderMark)) end = at;
        if (end == text.npos) break;
        at = end + 3;  // of "-->", or of the mark
    }
    return std::nullopt;
}

DecodedText decode_text(std::string bytes) {
    std::string_view view = bytes;
    if (const char* what = disguise_of(view)) return {{}, what, {}};
    for (const Magic& magic : kNotXml)
        if (view.starts_with(magic.bytes)) return {{}, magic.what, {}};
    if (view.starts_with("\xff\xfe")) return {utf8_from_utf16(view.substr(2), false), {}, {}};
    if (view.starts_with("\xfe\xff")) return {utf8_from_utf16(view.substr(2), true), {}, {}};
    if (view.starts_with(std::string_view("<\0", 2))) return {utf8_from_utf16(view, false), {}, {}};
    if (view.starts_with(std::string_view("\0<", 2))) return {utf8_from_utf16(view, true), {}, {}};
    if (view.starts_with(kByteOrderMark)) {
        bytes.erase(0, kByteOrderMark.size());
        return {std::move(bytes), {}, {}};
    }
    std::string encoding = declared_encoding(view);
    if (contains(kUnicode, encoding)) return {std::move(bytes), {}, {}};
    for (const SingleByte& row : kSingleByte)
        if (row.name == encoding) return {utf8_from(view, row.overrides), {}, {}};
    if (valid_utf8(view)) return {std::move(bytes), {}, {}};
    return {
        utf8_from_latin1(view), {}, "Latin-1, since the encoding '" + encoding + "' is unknown"};
}

}  // namespace kinora::collada
