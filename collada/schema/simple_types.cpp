// collada/schema/simple_types.cpp: the types of values: what they are built from, and checks.
#include "collada/schema/simple_types_p.h"

#include <algorithm>

#include "collada/schema/schema_rows_p.h"
#include "collada/text/numbers_p.h"
#include "collada/text/words_p.h"
#include "runtime/base/check.h"

namespace kinora::collada {

namespace {

using Numbers = BaseType::Numbers;

bool is_real(std::string_view word) {
    return !word.empty() && word.find_first_of(" \t\r\n") == word.npos && is_real_list(word);
}

// A whole number within [-below, above]; `plus`: "+1" may be written.
bool is_whole(std::string_view word, uint64_t below, uint64_t above, bool plus, bool bounded) {
    bool minus = !word.empty() && word[0] == '-';
    if (!word.empty() && (minus || word[0] == '+')) {
        if (!plus) return false;
        word.remove_prefix(1);
    }
    if (word.empty() || word.find_first_not_of("0123456789") != word.npos) return false;
    word.remove_prefix(std::min(word.find_first_not_of('0'), word.size()));
    if (word.size() > 20) return !bounded && (!minus || below > 0);
    uint64_t value = 0;
    bool over = false;
    for (char c : word) {
        over = over || __builtin_mul_overflow(value, uint64_t(10), &value) ||
               __builtin_add_overflow(value, uint64_t(c - '0'), &value);
    }
    if (over) return !bounded && (!minus || below > 0);
    return value <= (minus ? below : above);
}

template <uint64_t below, uint64_t above, bool plus = true, bool bounded = true>
bool whole(std::string_view word) {
    return is_whole(word, below, above, plus, bounded);
}
constexpr uint64_t kAny = ~uint64_t(0);

bool is_positive(std::string_view word) {
    return whole<0, kAny, true, false>(word) && word.find_first_of("123456789") != word.npos;
}

bool is_boolean(std::string_view word) {
    return word == "true" || word == "false" || word == "1" || word == "0";
}

bool is_nmtoken(std::string_view word) {
    return !word.empty() && is_name("a" + std::string(word));
}

bool is_hex_binary(std::string_view word) {
    return word.size() % 2 == 0 && word.find_first_not_of("0123456789abcdefABCDEF") == word.npos;
}

bool is_fragment(std::string_view word) {
    return word.starts_with('#') && word.find('\r') == word.npos && word.find('\n') == word.npos;
}

// id, or one character, then "/sid"s; at the end (i) or (i)(j). A ".member" is part of the last
// sid.
bool is_sidref(std::string_view word) {
    for (int k = 0; k < 2 && word.ends_with(')'); ++k) {
        size_t open = word.rfind('(');
        if (open == word.npos || open + 2 == word.size()) return false;
        std::string_view index = word.substr(open + 1, word.size() - open - 2);
        if (index.find_first_not_of("0123456789") != index.npos) return false;
        word = word.substr(0, open);
    }
    size_t slash = word.find('/', word.starts_with('/') ? 1 : 0);
    if (slash == word.npos) return false;
    std::string_view id = word.substr(0, slash);
    if (id.size() != 1 && !is_ncname(id)) return false;
    while (slash != word.npos) {
        word.remove_prefix(slash + 1);
        slash = word.find('/');
        if (!is_ncname(word.substr(0, slash))) return false;
    }
    return true;
}

constexpr std::string_view kAtom = "!#$%&'*+-/=?^_`{|}~.";

// Dot-separated atoms, '@', dot-separated atoms. (The schema's class runs from # to ' and { to ~.)
bool is_email(std::string_view word) {
    size_t at = word.find('@');
    if (at == word.npos) return false;
    for (std::string_view half : {word.substr(0, at), word.substr(at + 1)}) {
        if (half.empty() || half.front() == '.' || half.back() == '.') return false;
        if (half.find("..") != half.npos) return false;
        for (char c : half) {
            bool plain = (c >= '0' && c <= '9') || ((c | 32) >= 'a' && (c | 32) <= 'z');
            if (!plain && kAtom.find(c) == kAtom.npos) return false;
        }
    }
    return true;
}

constexpr BaseType kBases[] = {
    {"string", nullptr, "text", Numbers::No, true},
    {"token", nullptr, "text"},
    {"NCName", is_ncname, "a name: letters, digits, '_', '-', '.', not starting with a digit"},
    {"ID", is_ncname, "a name: letters, digits, '_', '-', '.', not starting with a digit"},
    {"IDREF", is_ncname, "the id of an element"},
    {"Name", is_name, "a name"},
    {"NMTOKEN", is_nmtoken, "a word of letters, digits, '_', '-', '.', ':'"},
    {"anyURI", is_uri, "a URI"},
    {"boolean", is_boolean, "true or false"},
    {"double", is_real, "a number", Numbers::Real},
    {"float", is_real, "a number", Numbers::Real},
    {"integer", whole<kAny, kAny, true, false>, "a whole number", Numbers::Whole},
    {"nonNegativeInteger", whole<0, kAny, true, false>, "a whole number from 0", Numbers::Natural},
    {"positiveInteger", is_positive, "a whole number from 1"},
    {"long", whole<uint64_t(1) << 63, (uint64_t(1) << 63) - 1>, "a whole number", Numbers::Whole},
    {"int", whole<uint64_t(1) << 31, (uint64_t(1) << 31) - 1>, "a whole number of 32 bits"},
    {"short", whole<32768, 32767>, "a whole number from -32768 to 32767"},
    {"byte", whole<128, 127>, "a whole number from -128 to 127"},
    {"unsignedLong", whole<0, kAny, false>, "a whole number from 0", Numbers::Natural},
    {"unsignedInt", whole<0, 0xffffffff, false>, "a whole number from 0"},
    {"unsignedByte", whole<0, 255, false>, "a whole number from 0 to 255"},
    {"dateTime", is_date_time, "a date and time like 2008-03-01T12:00:00Z"},
    {"hexBinary", is_hex_binary, "pairs of hexadecimal digits"},
    {"fragment", is_fragment, "a link into this document: '#' and an id", Numbers::No, true,
     "string", "(#(.*))"},
    {"sidref", is_sidref, "an id (or '.') and sids, joined by '/'", Numbers::No, true, "string",
     "([\\i-[:]][\\c-[:]]*|.)(/[\\i-[:]][\\c-[:]]*)+(\\([0-9]+\\)){0,2}"},
    {"email", is_email, "an e-mail address", Numbers::No, true, "string",
     "[!#-'*+\\-/-9=?A-Z\\^_`a-z{-~]+(\\.[!#-'*+\\-/-9=?A-Z\\^_`a-z{-~]+)*@"
     "[!#-'*+\\-/-9=?A-Z\\^_`a-z{-~]+(\\.[!#-'*+\\-/-9=?A-Z\\^_`a-z{-~]+)*"},
};

// "A B C" are values; "low..high" a range.
void read_facets(std::string_view facets, SimpleType& type) {
    size_t dots = facets.find("..");
    if (dots == facets.npos) {
        type.values = split_words(facets);
        return;
    }
    type.has_low = parse_double(facets.substr(0, dots), type.low);
    type.has_high = parse_double(facets.substr(dots + 2), type.high);
    type.ranged = type.has_low || type.has_high;
}

bool in_range(const SimpleType& type, std::string_view word) {
    double value = 0;
    if (!parse_double(word, value)) return false;  // NaN and infinities
    return (!type.has_low || value >= type.low) && (!type.has_high || value <= type.high);
}

ValueFault check_word(const SimpleType& type, std::string_view word) {
    if (type.base->fits && !type.base->fits(word))
        return type.base->pattern.empty() ? ValueFault::Type : ValueFault::Pattern;
    if (!type.values.empty() &&
        std::find(type.values.begin(), type.values.end(), word) == type.values.end())
        return ValueFault::Value;
    if (type.ranged && !in_range(type, word)) return ValueFault::Range;
    return ValueFault::None;
}

bool is_number_list(const SimpleType& type, std::string_view text) {
    switch (type.base->numbers) {
        case Numbers::No:
            return false;
        case Numbers::Real:
            return is_real_list(text);
        case Numbers::Whole:
            return is_whole_list(text, true);
        case Numbers::Natural:
            return is_whole_list(text, false);
    }
    return false;
}

ValueCheck check_list(const SimpleType& type, std::string_view text) {
    if (!type.ranged && type.values.empty() && is_number_list(type, text)) {
        size_t words = type.length ? count_words(text) : 0;
        if (words == type.length) return {ValueFault::None, 0, 0, words};
        return {ValueFault::Length, 0, text.size(), words};
    }
    constexpr std::string_view kSpace = " \t\r\n";
    ValueCheck out;
    for (size_t at = text.find_first_not_of(kSpace); at < text.size(); ++out.words) {
        size_t end = std::min(text.find_first_of(kSpace, at), text.size());
        ValueFault fault = check_word(type, text.substr(at, end - at));
        if (fault != ValueFault::None) return {fault, at, end, out.words};
        at = text.find_first_not_of(kSpace, end);
    }
    if (type.length && out.words != type.length)
        out = {ValueFault::Length, 0, text.size(), out.words};
    return out;
}

}  // namespace

const BaseType* find_base(std::string_view name) {
    for (const BaseType& base : kBases)
        if (base.name == name) return &base;
    return nullptr;
}

SimpleType parse_simple(std::string_view cell, Version version) {
    SimpleType type;
    type.cell = cell;
    size_t bracket = cell.find('[');
    std::string_view name = cell.substr(0, bracket);
    if (bracket != cell.npos) {
        type.list = true;
        for (char c : cell.substr(bracket + 1))
            if (c >= '0' && c <= '9') type.length = type.length * 10 + uint32_t(c - '0');
    }
    for (const SimpleRow& row : simple_rows()) {
        if (row.name != name || !holds_for(row.versions, version)) continue;
        type.row = row.name;
        name = row.base;
        read_facets(row.facets, type);
        break;
    }
    type.base = find_base(name);
    CHECK(type.base);  // a cell that names a type without one
    return type;
}

ValueCheck check_value(const SimpleType& type, std::string_view text) {
    if (type.list) return check_list(type, text);
    if (type.base->keeps_space) return {check_word(type, text), 0, text.size(), 1};
    std::string_view word = trim(text);
    size_t begin = word.empty() ? 0 : size_t(word.data() - text.data());
    return {check_word(type, word), begin, begin + word.size(), 1};
}

std::string describe(const SimpleType& type) {
    std::string what(type.base->what);
    if (!type.values.empty()) {
        what = "one of";
        for (size_t i = 0; i < type.values.size() && i < 12; ++i)
            what += (i ? ", " : " ") + std::string(type.values[i]);
        if (type.values.size() > 12) what += ", ...";
    }
    if (!type.list) return what;
    std::string count = type.length ? std::to_string(type.length) + " values" : "a list of values";
    return count + ", each " + what;
}

}  // namespace kinora::collada
