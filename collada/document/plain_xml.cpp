// collada/document/plain_xml.cpp: the fast way through documents of plain XML.
#include "collada/document/plain_xml_p.h"

#include <array>
#include <bit>
#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "runtime/base/text_encoding.h"

namespace kinora::collada {

namespace {

constexpr size_t kMaxToken =
    64 << 10;                          // of tags; longer ones have limits that expat's reader knows
constexpr size_t kMaxAttributes = 32;  // they are held against each other one by one

// What a byte may be part of. Bytes of characters beyond ASCII are nothing here.
enum : uint8_t { kNameStart = 1, kName = 2, kTextRun = 4, kValueRun = 8 };

constexpr auto kBytes = [] {
    std::array<uint8_t, 256> t{};
    for (int c = 0x20; c < 0x80; ++c) t[size_t(c)] = kTextRun | kValueRun;
    t['\t'] = t['\n'] = kTextRun;
    for (char c : {'<', '&', ']'}) t[size_t(c)] &= uint8_t(~kTextRun);
    for (char c : {'<', '&', '"', '\''}) t[size_t(c)] &= uint8_t(~kValueRun);
    for (int c = 'a'; c <= 'z'; ++c) t[size_t(c)] |= kNameStart | kName;
    for (int c = 'A'; c <= 'Z'; ++c) t[size_t(c)] |= kNameStart | kName;
    for (int c = '0'; c <= '9'; ++c) t[size_t(c)] |= kName;
    for (char c : {':', '.', '-'}) t[size_t(c)] |= kName;
    t['_'] |= kNameStart | kName;
    return t;
}();

bool is(char c, uint8_t kind) {
    return kBytes[uint8_t(c)] & kind;
}

// The first byte from p on that is no kTextRun.
const char* text_run(const char* p, const char* end) {
#ifdef __SSE2__
    const __m128i less = _mm_set1_epi8('<'), amp = _mm_set1_epi8('&'), bracket = _mm_set1_epi8(']'),
                  space = _mm_set1_epi8(' '), tab = _mm_set1_epi8('\t'),
                  newline = _mm_set1_epi8('\n');
    for (; end - p >= 16; p += 16) {
        __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
        __m128i markup = _mm_or_si128(_mm_or_si128(_mm_cmpeq_epi8(b, less), _mm_cmpeq_epi8(b, amp)),
                                      _mm_cmpeq_epi8(b, bracket));
        __m128i low = _mm_cmplt_epi8(b, space);  // bytes with the top bit too
        __m128i gap = _mm_or_si128(_mm_cmpeq_epi8(b, tab), _mm_cmpeq_epi8(b, newline));
        int stop = _mm_movemask_epi8(_mm_or_si128(markup, _mm_andnot_si128(gap, low)));
        if (stop) return p + std::countr_zero(unsigned(stop));
    }
#endif
    while (p < end && is(*p, kTextRun)) ++p;
    return p;
}

// The bytes of the character beyond ASCII at p; 0 where there is none that XML allows. Looks no
// further than the first byte that cannot go on.
size_t wide_character(const char* p) {
    auto byte = [&](int i) { return uint8_t(p[i]); };
    auto follows = [&](int i, int least = 0x80, int most = 0xBF) {
        return byte(i) >= least && byte(i) <= most;
    };
    uint8_t lead = byte(0);
    if (lead >= 0xC2 && lead < 0xE0) return follows(1) ? 2 : 0;
    if (lead >= 0xE0 && lead < 0xF0) {  // without surrogates, U+FFFE and U+FFFF
        if (!follows(1, lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF)) return 0;
        return follows(2) && (lead != 0xEF || byte(1) != 0xBF || byte(2) < 0xBE) ? 3 : 0;
    }
    if (lead < 0xF0 || lead > 0xF4) return 0;
    bool second = follows(1, lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF);
    return second && follows(2) && follows(3) ? 4 : 0;
}

bool is_xml_character(uint32_t c) {
    return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c < 0xD800) ||
           (c >= 0xE000 && c < 0xFFFE) || (c >= 0x10000 && c < 0x110000);
}

struct Entity {
    std::string_view name;
    char character;
};
constexpr Entity kEntities[] = {
    {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};

// "#65" or "#x41"; 0 for nothing of the sort.
uint32_t character_number(std::string_view name) {
    bool hex = name.starts_with("#x");
    name.remove_prefix(hex ? 2 : 1);
    uint32_t c = 0;
    for (char digit : name) {
        bool letter = hex && (digit | 32) >= 'a' && (digit | 32) <= 'f';
        if (!letter && (digit < '0' || digit > '9')) return 0;
        c = c * (hex ? 16 : 10) + uint32_t(letter ? (digit | 32) - 'a' + 10 : digit - '0');
        if (c > 0x10FFFF) return 0;
    }
    return is_xml_character(c) ? c : 0;
}

class PlainXml {
  public:
    PlainXml(std::string_view text, DocumentBuilder& builder)
        : begin_(text.data()), p_(begin_), end_(begin_ + text.size()), builder_(builder) {}

    bool read() {
        if (!declaration()) return false;
        while (true) {
            if (builder_.open().empty() ? !skip_space() : !text()) return false;
            if (p_ == end_) return builder_.root() && builder_.open().empty();
            if (*p_ != '<' || !markup()) return false;
        }
    }

  private:
    uint32_t offset(const char* p) const { return uint32_t(p - begin_); }
    bool at(std::string_view what) const {
        return size_t(end_ - p_) >= what.size() && !std::memcmp(p_, what.data(), what.size());
    }
    bool take(std::string_view what) {
        bool there = at(what);
        if (there) p_ += what.size();
        return there;
    }
    bool skip_space() {
        while (is_xml_space(*p_)) ++p_;
        return true;
    }
    bool take_name() {
        if (!is(*p_, kNameStart)) return false;
        while (is(*p_, kName)) ++p_;
        return true;
    }
    // The character behind the next `what`; null where there is none.
    const char* behind(std::string_view what) const {
        size_t found = std::string_view(p_, size_t(end_ - p_)).find(what);
        return found == std::string_view::npos ? nullptr : p_ + found + what.size();
    }

    bool declaration();
    bool pseudo_attribute(std::string_view name, std::string_view& value);
    bool markup();
    bool start_tag();
    bool attribute();
    bool decode_value(std::string_view& value);
    bool end_tag();
    bool comment();
    bool cdata();
    bool text();
    bool text_break(const char*& run, bool references);
    bool add_text(const char* run, const char* stop);
    bool add_decoded(const char* from, std::string_view text);
    bool reference(std::string& out);

    const char *begin_, *p_, *end_;
    DocumentBuilder& builder_;
    std::vector<Attribute> attributes_;
    std::string decoded_;
};

// name="value" behind white space, in a declaration. True without a value: it is not there.
bool PlainXml::pseudo_attribute(std::string_view name, std::string_view& value) {
    const char* start = p_;
    if (!is_xml_space(*p_) || !skip_space() || !take(name)) {
        p_ = start;
        return true;
    }
    if (!skip_space() || !take("=") || !skip_space()) return false;
    char quote = *p_;
    if (quote != '"' && quote != '\'') return false;
    const char* from = ++p_;
    while (is(*p_, kName)) ++p_;
    value = {from, size_t(p_ - from)};
    return *p_++ == quote;
}

bool PlainXml::declaration() {
    if (!take("<?xml")) return true;
    std::string_view version, encoding, standalone;
    if (!pseudo_attribute("version", version) || version != "1.0") return false;
    if (!pseudo_attribute("encoding", encoding)) return false;
    if (!encoding.empty() && (!is(encoding[0], kNameStart) || encoding[0] == '_')) return false;
    if (encoding.find(':') != encoding.npos) return false;
    if (encoding.data() && encoding.empty()) return false;
    if (!pseudo_attribute("standalone", standalone)) return false;
    if (standalone.data() && standalone != "yes" && standalone != "no") return false;
    return skip_space() && take("?>");
}

bool PlainXml::markup() {
    if (p_[1] == '/') return end_tag();
    if (p_[1] != '!') return start_tag();
    return at("<!--") ? comment() : cdata();
}

bool PlainXml::start_tag() {
    if (builder_.open().empty() && builder_.root()) return false;
    const char* tag = p_++;
    const char* name = p_;
    if (!take_name()) return false;
    std::string_view file_name(name, size_t(p_ - name));
    attributes_.clear();
    while (true) {
        bool gap = is_xml_space(*p_);
        skip_space();
        if (*p_ == '>' || *p_ == '/') break;
        if (!gap || attributes_.size() == kMaxAttributes || !attribute()) return false;
    }
    bool empty = *p_ == '/';
    p_ += empty;
    if (*p_ != '>' || size_t(++p_ - tag) > kMaxToken) return false;
    if (builder_.room() != Room::Enough) return false;
    builder_.start_element({offset(tag), offset(p_)}, file_name, attributes_);
    if (empty) builder_.end_element(offset(p_));
    return true;
}

bool PlainXml::attribute() {
    const char* name = p_;
    if (!take_name()) return false;
    std::string_view file_name(name, size_t(p_ - name));
    for (const Attribute& other : attributes_)
        if (other.name == file_name) return false;
    skip_space();
    if (*p_++ != '=') return false;
    skip_space();
    char quote = *p_;
    if (quote != '"' && quote != '\'') return false;
    const char* value = ++p_;
    bool plain = true;
    while (true) {
        while (is(*p_, kValueRun)) ++p_;
        if (*p_ == quote) break;
        if (*p_ == '"' || *p_ == '\'') {
            ++p_;
        } else if (*p_ == '&' || is_xml_space(*p_)) {
            plain = false;
            ++p_;
        } else {
            size_t bytes = wide_character(p_);
            if (bytes == 0) return false;
            p_ += bytes;
        }
    }
    std::string_view decoded(value, size_t(p_ - value));
    ByteRange value_bytes{offset(value), offset(p_)};
    if (!plain && !decode_value(decoded)) return false;
    ++p_;
    attributes_.push_back({file_name, decoded, {offset(name), offset(p_)}, value_bytes});
    return true;
}

// White space becomes spaces (XML 1.0, 3.3.3), references what they stand for. p_ stays.
bool PlainXml::decode_value(std::string_view& value) {
    const char* stop = p_;
    decoded_.clear();
    for (p_ = value.data(); p_ < stop;) {
        if (*p_ == '&') {
            if (!reference(decoded_) || p_ > stop) return false;
        } else {
            char c = *p_++;
            if (c == '\r' && *p_ == '\n') ++p_;
            decoded_ += is_xml_space(c) ? ' ' : c;
        }
    }
    value = builder_.pool().copy(std::string_view(decoded_));
    return true;
}

bool PlainXml::end_tag() {
    if (builder_.open().empty()) return false;
    p_ += 2;
    if (!take(builder_.open().back().file_name)) return false;
    skip_space();
    if (*p_++ != '>') return false;
    builder_.end_element(offset(p_));
    return true;
}

bool PlainXml::comment() {
    p_ += 4;
    const char* stop = behind("--");
    if (!stop || *stop != '>' || size_t(stop - p_) > kMaxToken) return false;
    while (p_ < stop) {
        p_ = text_run(p_, stop);
        bool known = p_ == stop || *p_ == '<' || *p_ == '&' || *p_ == ']' || *p_ == '\r';
        size_t bytes = known ? 1 : wide_character(p_);
        if (bytes == 0) return false;
        p_ += bytes;
    }
    p_ = stop + 1;
    return true;
}

bool PlainXml::cdata() {
    if (builder_.open().empty() || !take("<![CDATA[")) return false;
    const char* stop = behind("]]>");
    if (!stop) return false;
    stop -= 3;
    const char* run = p_;
    while (true) {
        p_ = text_run(p_, stop);
        if (p_ == stop) break;
        if (*p_ == '<' || *p_ == '&' || *p_ == ']')
            ++p_;
        else if (!text_break(run, false))
            return false;
    }
    if (!add_text(run, p_)) return false;
    p_ += 3;
    return true;
}

// Up to the next '<'.
bool PlainXml::text() {
    const char* run = p_;
    while (true) {
        p_ = text_run(p_, end_);
        if (*p_ == '<') return add_text(run, p_);
        if (*p_ == ']') {
            if (at("]]>")) return false;
            ++p_;
        } else if (!text_break(run, true)) {
            return false;
        }
    }
}

// At a byte that ends a run of text, or at a character that goes on with it.
bool PlainXml::text_break(const char*& run, bool references) {
    const char* from = p_;
    if (*p_ == '\r') {  // line ends become newlines (XML 1.0, 2.11)
        if (!add_text(run, from)) return false;
        p_ += p_[1] == '\n' ? 2 : 1;
        if (!add_decoded(from, "\n")) return false;
        run = p_;
        return true;
    }
    if (*p_ == '&' && references) {
        decoded_.clear();
        if (!add_text(run, from) || !reference(decoded_)) return false;
        run = p_;
        return add_decoded(from, decoded_);
    }
    size_t bytes = wide_character(p_);
    p_ += bytes;
    return bytes > 0;
}

bool PlainXml::add_text(const char* run, const char* stop) {
    return run == stop || add_decoded(run, {run, size_t(stop - run)});
}

// Which parts of text beside elements are dropped depends on how it is cut: left to expat.
bool PlainXml::add_decoded(const char* from, std::string_view text) {
    if (!builder_.open().back().last_child) {
        builder_.add_text(offset(from), text);
        return true;
    }
    return is_xml_space(text);
}

bool PlainXml::reference(std::string& out) {
    constexpr size_t kLongest = 16;
    std::string_view rest(p_ + 1, std::min(size_t(end_ - p_) - 1, kLongest));
    size_t length = rest.find(';');
    if (length == rest.npos || length == 0) return false;
    std::string_view name = rest.substr(0, length);
    p_ += length + 2;
    if (name[0] == '#') {
        uint32_t c = character_number(name);
        if (c) append_utf8(out, c);
        return c != 0;
    }
    for (const Entity& entity : kEntities) {
        if (entity.name != name) continue;
        out += entity.character;
        return true;
    }
    return false;
}

}  // namespace

bool read_plain_xml(std::string_view text, DocumentBuilder& builder) {
    return PlainXml(text, builder).read();
}

}  // namespace kinora::collada
