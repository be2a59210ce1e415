// rsl/model/string_functions.cpp: formats, and the services that handle strings at run time.
#include "rsl/model/string_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "rsl/model/renderer_services.h"
#include "runtime/base/numbers.h"

namespace kinora::rsl {

float leading_number(std::string_view text) {
    size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    if (begin < text.size() && text[begin] == '+') ++begin;
    float value = 0;
    auto [end, error] = std::from_chars(text.data() + begin, text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) {
        double wide = 0;
        std::from_chars(text.data() + begin, end, wide);
        return float(wide);
    }
    return std::isfinite(value) ? value : 0;  // "inf" and "nan" are no decimals
}

// ---- formats ------------------------------------------------------------------------------------

int Conversion::values() const {
    switch (letter) {
        case 'f':
        case 'g':
        case 'e':
        case 'd':
        case 'i':
        case 's':
            return 1;
        case 'c':
        case 'p':
        case 'v':
        case 'n':
        case 'h':
            return 3;
        case 'm':
            return 16;
    }
    return 0;
}

std::vector<Conversion> conversions(std::string_view format) {
    std::vector<Conversion> result;
    for (size_t k = 0; k + 1 < format.size(); ++k) {
        if (format[k] != '%') continue;
        size_t end = format.find_first_not_of("0123456789.-+ #", k + 1);
        if (end == std::string_view::npos) break;
        Conversion conversion{k, end + 1, format[end]};
        if (conversion.values() > 0) result.push_back(conversion);
        k = end;
    }
    return result;
}

std::string escape_format(std::string_view text) {
    std::string escaped;
    for (char c : text) escaped += c == '%' ? "%%" : std::string(1, c);
    return escaped;
}

namespace {

// Room for a number in any format that a shader may ask for.
constexpr int kMostDigits = 64;

// A width or precision beyond any use would only fill memory.
std::string limited(std::string_view flags) {
    std::string result;
    int digits = 0;
    for (char c : flags) {
        digits = c >= '0' && c <= '9' ? digits + 1 : 0;
        if (digits <= 2) result += c;
    }
    return result;
}

// While it lives, this thread writes a point before decimals, whatever the process's locale is.
class InPlainLocale {
  public:
    InPlainLocale() : before_(uselocale(plain())) {}
    ~InPlainLocale() { uselocale(before_); }
    InPlainLocale(const InPlainLocale&) = delete;

  private:
    static locale_t plain() {
        static const locale_t locale = newlocale(LC_ALL_MASK, "C", locale_t());
        return locale;
    }

    const locale_t before_;
};

std::string number_text(std::string_view flags, char letter, float x) {
    if (letter == 'd' || letter == 'i') {
        if (std::isnan(x)) return "nan";
        long long whole = static_cast<long long>(std::clamp(double(x), -9e18, 9e18));
        if (flags.empty()) return std::to_string(whole);
        char buffer[128];
        std::snprintf(buffer, sizeof buffer, ("%" + limited(flags) + "lld").c_str(), whole);
        return buffer;
    }
    bool fixed = letter == 'g' || letter == 'e';
    if (flags.empty() && !fixed) return fmt::format("{}", x);
    char buffer[kMostDigits + 128];
    std::string format = "%" + limited(flags) + (fixed ? letter : 'f');
    const InPlainLocale plain;
    std::snprintf(buffer, sizeof buffer, format.c_str(), double(x));
    return buffer;
}

std::string string_text(std::string_view flags, int32_t id) {
    const std::string& text = interned(id);
    if (flags.empty()) return text;
    bool left = flags[0] == '-';
    std::string_view width_text = flags;
    size_t width = size_t(std::min(std::abs(take_number<int>(width_text).value_or(0)), 255));
    std::string padding(width > text.size() ? width - text.size() : 0, ' ');
    return left ? text + padding : padding + text;
}

// The text between conversions: "%%" is one sign.
void append_plain(std::string& out, std::string_view text) {
    for (size_t k = 0; k < text.size(); ++k) {
        out += text[k];
        if (text[k] == '%' && k + 1 < text.size() && text[k + 1] == '%') ++k;
    }
}

}  // namespace

std::string format_text(std::string_view format, std::span<const float> values) {
    std::string out;
    size_t at = 0, next = 0;
    auto value = [&] { return next < values.size() ? values[next++] : 0.0f; };
    for (const Conversion& c : conversions(format)) {
        if (out.size() > kMostText) return out;
        append_plain(out, format.substr(at, c.begin - at));
        std::string_view flags = format.substr(c.begin + 1, c.end - c.begin - 2);
        at = c.end;
        if (c.letter == 's') {
            out += string_text(flags, std::bit_cast<int32_t>(value()));
            continue;
        }
        for (int k = 0; k < c.values(); ++k)
            out += (k > 0 ? " " : "") + number_text(flags, c.letter, value());
    }
    append_plain(out, format.substr(at));
    return out;
}

// ---- services -----------------------------------------------------------------------------------

namespace {

constexpr int kLanes = jit::kMaxLanes;
constexpr int32_t kMostStrings = 1 << 20;
constexpr size_t kMostBytes = 256 << 20;  // of all strings

int32_t intern_result(const std::string& text) {
    bool room = interned_count() < kMostStrings && interned_bytes() < kMostBytes;
    return room ? intern(limited_text(text)) : 0;
}

int32_t id_of(const jit::ServiceCall& call, int argument, int lane) {
    return jit::bits_of(call.args[argument * kLanes + lane]);
}

bool same_arguments(const jit::ServiceCall& call, int arguments, int a, int b) {
    for (int k = 0; k < arguments; ++k)
        if (id_of(call, k, a) != id_of(call, k, b)) return false;
    return true;
}

// result(lane) for the first lane of each distinct set of `arguments`.
template <class Result>
void for_distinct(const jit::ServiceCall& call, int arguments, Result&& result) {
    for (int i = 0; i < kLanes; ++i) {
        if (!(call.mask >> i & 1)) continue;
        int first = 0;
        while (!(call.mask >> first & 1) || !same_arguments(call, arguments, first, i)) ++first;
        call.results[i] = first == i ? result(i) : call.results[first];
    }
}

void concat(const jit::ServiceCall& call) {
    for_distinct(call, 2, [&](int i) {
        std::string all = interned(id_of(call, 0, i)) + interned(id_of(call, 1, i));
        return jit::float_of(intern_result(all));
    });
}

void format(const jit::ServiceCall& call) {
    for_distinct(call, 1 + kMostFormatValues, [&](int i) {
        float values[kMostFormatValues];
        for (int k = 0; k < kMostFormatValues; ++k) values[k] = call.args[(1 + k) * kLanes + i];
        return jit::float_of(intern_result(format_text(interned(id_of(call, 0, i)), values)));
    });
}

void match(const jit::ServiceCall& call) {
    for_distinct(call, 2, [&](int i) {
        return matches(interned(id_of(call, 0, i)), interned(id_of(call, 1, i))) ? 1.0f : 0.0f;
    });
}

void stof(const jit::ServiceCall& call) {
    for_distinct(call, 1, [&](int i) { return leading_number(interned(id_of(call, 0, i))); });
}

void strlen(const jit::ServiceCall& call) {
    for_distinct(call, 1, [&](int i) { return float(interned(id_of(call, 0, i)).size()); });
}

}  // namespace

jit::ServiceFn string_service(Service service) {
    switch (service) {
#define SERVICE(name, arguments, results, effects, doc) \
    case Service::name:                                 \
        return nullptr;
#define STRING_SERVICE(name, arguments, results, effects, doc) \
    case Service::name:                                        \
        return name;
#include "rsl/model/services.def"
    }
    return nullptr;
}

}  // namespace kinora::rsl
