// rsl/builtins_string.cpp: rows of the built-in table: strings and printing.
#include <algorithm>
#include <cstdio>

#include "rsl/builtin.h"
#include "rsl/lower_p.h"
#include "rsl/reference_builtins.h"

namespace kinora::rsl {

namespace lower_string {

// One %-conversion of a format and how many numbers it takes.
struct Conversion {
    size_t begin, end;  // in the format
    char letter;
};

std::vector<Conversion> conversions(const std::string& format) {
    std::vector<Conversion> result;
    for (size_t k = 0; k + 1 < format.size(); ++k) {
        if (format[k] != '%') continue;
        size_t end = k + 1;
        while (end < format.size() &&
               std::string_view("0123456789.-+ #").find(format[end]) != std::string_view::npos)
            ++end;
        if (end < format.size() && format[end] != '%') result.push_back({k, end + 1, format[end]});
        k = end;
    }
    return result;
}

bool count_matches(LowerCall& c, size_t wanted) {
    if (wanted == c.args.size() - 1) return true;
    c.low.error(Code::RSL_FORMAT_ARGUMENTS, c.where(), wanted, c.args.size() - 1);
    return false;
}

void set_text(LowerCall& c, std::string_view text) {
    c.set(c.b.i(intern(text)));
}

void concat(LowerCall& c) {
    std::string all;
    for (size_t k = 0; k < c.args.size(); ++k) {
        const std::string* part = c.text(int(k));
        if (!part) return;
        all += *part;
    }
    set_text(c, all);
}

// The text of a constant value, by the conversion.
bool constant_text(LowerCall& c, const Lowered& value, const std::string& conversion,
                   std::string& out) {
    if (value.type == BaseType::String) {
        const std::string* text = c.low.constant_text(value.c[0]);
        if (text) out += *text;
        return text != nullptr;
    }
    std::string number = conversion;
    char letter = number.back();
    number.back() = 'f';
    for (int k = 0; k < value.size(); ++k) {
        float x;
        if (!c.b.constant_f(value.c[size_t(k)], &x)) return false;
        char buffer[128];
        if (letter == 'd')
            std::snprintf(buffer, sizeof buffer, "%d", int(std::clamp(x, -2e9f, 2e9f)));
        else
            std::snprintf(buffer, sizeof buffer, number.c_str(), double(x));
        out += (k > 0 ? " " : "") + std::string(buffer);
    }
    return true;
}

void format(LowerCall& c) {
    const std::string* text = c.text(0);
    if (!text) return;
    auto parts = conversions(*text);
    if (!count_matches(c, parts.size())) return;
    std::string out;
    size_t at = 0;
    for (size_t k = 0; k < parts.size(); ++k) {
        out += text->substr(at, parts[k].begin - at);
        std::string conversion = text->substr(parts[k].begin, parts[k].end - parts[k].begin);
        at = parts[k].end;
        if (constant_text(c, c.args[k + 1], conversion, out)) continue;
        return c.low.error(Code::RSL_STRING_NOT_CONSTANT, c.where(), "format");
    }
    set_text(c, out + text->substr(at));
}

// A small regular expression: ^ $ . * and literals, found anywhere; as grep's basics.
bool matches_here(const char* pattern, const char* text) {
    if (*pattern == 0) return true;
    if (pattern[0] == '$' && pattern[1] == 0) return *text == 0;
    auto fits = [&](const char* at) { return *at && (*pattern == '.' || *pattern == *at); };
    if (pattern[1] == '*') {
        for (;; ++text) {
            if (matches_here(pattern + 2, text)) return true;
            if (!fits(text)) return false;
        }
    }
    return fits(text) && matches_here(pattern + 1, text + 1);
}
bool matches(const std::string& pattern, const std::string& text) {
    if (!pattern.empty() && pattern[0] == '^')
        return matches_here(pattern.c_str() + 1, text.c_str());
    for (const char* at = text.c_str();; ++at) {
        if (matches_here(pattern.c_str(), at)) return true;
        if (!*at) return false;
    }
}

void match(LowerCall& c) {
    const std::string* pattern = c.text(0);
    const std::string* text = c.text(1);
    if (!pattern || !text) return;
    c.set(c.b.f(matches(*pattern, *text) ? 1.0f : 0.0f));
}

void print(LowerCall& c) {
    constexpr size_t kMost = 16;  // as rsl/renderer_services.h says
    const std::string* text = c.text(0);
    if (!text || !count_matches(c, conversions(*text).size())) return;
    std::vector<Value> values = {c.b.i(intern(*text))};
    for (size_t k = 1; k < c.args.size(); ++k) {
        const Lowered& arg = c.args[k];
        if (arg.type == BaseType::String)
            values.push_back(c.b.from_bits(arg.c[0]));
        else if (arg.type == BaseType::Bool)
            values.push_back(c.low.flag(arg.c[0]));
        else
            values.insert(values.end(), arg.c.begin(), arg.c.begin() + arg.size());
    }
    if (values.size() - 1 > kMost)
        return c.low.error(Code::RSL_PRINT_TOO_LONG, c.where(), values.size() - 1);
    values.resize(1 + kMost, c.b.f(0));
    c.low.service("print", values);
}

}  // namespace lower_string

namespace {

namespace lower = lower_string;

const Builtin kRows[] = {
    {"concat", "s=sss*", lower::concat, KINORA_RSL_REF(ref::concat), kPure, 0,
     "Its arguments, one after the other."},
    {"format",
     "s=s?*",
     lower::format,
     {},
     kPure,
     0,
     "Text with %f %c %p %m %s replaced by the arguments."},
    {"match", "f=ss", lower::match, KINORA_RSL_REF(ref::match), kPure, 0,
     "1 if the pattern (a regular expression) occurs in the string: match(pattern, string)."},
    {"printf", "x=s?*", lower::print, KINORA_RSL_REF(ref::printf), kPrints, 0,
     "Prints text with %f %c %p %m %s replaced by the arguments."},
};

}  // namespace

std::span<const Builtin> builtins_string() {
    return kRows;
}

}  // namespace kinora::rsl
