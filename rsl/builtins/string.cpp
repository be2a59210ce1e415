// rsl/builtins/string.cpp: strings and printing.
#include <fmt/format.h>
#include <regex.h>

#include <bit>
#include <locale>
#include <sstream>

#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/model/string_functions.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl {

namespace lower_string {

void check_count(LowerCall& c, size_t wanted) {
    if (wanted != c.args.size() - 1)
        c.context.report(Code::RSL_FORMAT_ARGUMENTS, c.where(), wanted, c.args.size() - 1);
}

void too_long(LowerCall& c) {
    if (!c.context.failed) c.context.error(Code::RSL_STRING_TOO_LONG, c.where(), kMostText);
}

// A service that makes a string; one that is too long is reported where the shader runs.
Value make_text(LowerCall& c, Service maker, std::span<const Value> args) {
    Value text = c.services.call(maker, args)[0];
    Value bad = c.b.op(jit::Op::IEq, text, c.b.i(intern(kTooLong)));
    c.b.fault(c.b.fault_site(c.where(), fmt::format("a string of more than {} bytes", kMostText)),
              c.b.logical_and(c.e.running, bad));
    return text;
}

Value join(LowerCall& c, Value a, Value b) {
    const std::string* first = c.e.constant_text(a);
    const std::string* second = c.e.constant_text(b);
    if (first && second) {
        if (first->size() + second->size() > kMostText) return too_long(c), a;
        return c.b.i(intern(*first + *second));
    }
    if (first && first->empty()) return b;
    if (second && second->empty()) return a;
    return make_text(c, Service::concat, std::array{a, b});
}

void concat(LowerCall& c) {
    Value all = c.args[0].c[0];
    for (size_t k = 1; k < c.args.size(); ++k) all = join(c, all, c.args[k].c[0]);
    c.set(all);
}

void match(LowerCall& c) {
    Value pattern = c.args[0].c[0], text = c.args[1].c[0];
    const std::string* known_pattern = c.e.constant_text(pattern);
    const std::string* known_text = c.e.constant_text(text);
    if (known_pattern && known_text)
        c.set(c.b.f(matches(*known_pattern, *known_text) ? 1.0f : 0.0f));
    else
        c.set(c.services.call(Service::match, std::array{pattern, text})[0]);
}

// A number that a string's text tells.
void number_of_text(LowerCall& c, Service service, float (*number)(std::string_view)) {
    const std::string* known = c.e.constant_text(c.f(0));
    c.set(known ? c.b.f(number(*known)) : c.services.call(service, std::array{c.f(0)})[0]);
}
void stof(LowerCall& c) {
    number_of_text(c, Service::stof, leading_number);
}
void strlen(LowerCall& c) {
    number_of_text(c, Service::strlen, [](std::string_view text) { return float(text.size()); });
}

// The numbers of a value as services take them: strings as ids bit for bit.
std::vector<Value> numbers(LowerCall& c, const Lowered& value) {
    if (value.type == BaseType::String) return {c.b.from_bits(value.c[0])};
    if (value.type == BaseType::Bool) return {c.e.flag(value.c[0])};
    return {value.c.begin(), value.c.begin() + value.size()};
}

// What a conversion asks for, of a value that may be of another kind: a float for %c is spread, a
// triple for %f gives three.
std::string fitting(const std::string& conversion, char letter, const Lowered& value) {
    std::string text = conversion;
    size_t wanted =
        letter == 'm'                                                                       ? 16
        : letter == 'c' || letter == 'p' || letter == 'v' || letter == 'n' || letter == 'h' ? 3
                                                                                            : 1;
    size_t given = value.type == BaseType::String ? 1 : size_t(component_count(value.type));
    if (value.type == BaseType::String) text.back() = 's';
    if (value.type != BaseType::String && letter == 's') wanted = 0;
    if (value.type != BaseType::String && wanted != given)
        text.back() = given == 16 ? 'm' : given == 3 ? 'p' : 'f';
    return text;
}

// A part of a format with the values it takes, no more than a service does.
struct Piece {
    std::string format;
    std::vector<Value> values;
};

// The format in pieces; values known when the shader is compiled become text.
std::vector<Piece> pieces_of(LowerCall& c, const std::string& format) {
    std::vector<Piece> pieces(1);
    size_t at = 0, length = 0;
    std::vector<Conversion> parts = conversions(format);
    for (size_t k = 0; k < parts.size(); ++k) {
        pieces.back().format += format.substr(at, parts[k].begin - at);
        std::string conversion = format.substr(parts[k].begin, parts[k].end - parts[k].begin);
        at = parts[k].end;
        if (k + 1 >= c.args.size()) {  // no value for it: it stands as it is written
            pieces.back().format += escape_format(conversion);
            continue;
        }
        const Lowered& value = c.args[k + 1];
        conversion = fitting(conversion, parts[k].letter, value);
        std::vector<Value> values = numbers(c, value);
        std::vector<float> known(values.size());
        bool all_known = true;
        for (size_t i = 0; i < values.size(); ++i) {
            int32_t id;
            bool string = value.type == BaseType::String && c.b.constant_i(value.c[0], &id);
            if (string) known[i] = jit::float_of(id);
            all_known = all_known && (string || c.b.constant_f(values[i], &known[i]));
        }
        if (all_known) {
            std::string text = escape_format(format_text(conversion, known));
            length += text.size();
            if (length > kMostText) {
                too_long(c);
                break;
            }
            pieces.back().format += text;
            continue;
        }
        if (pieces.back().values.size() + values.size() > size_t(kMostFormatValues))
            pieces.push_back({});
        pieces.back().format += conversion;
        pieces.back().values.insert(pieces.back().values.end(), values.begin(), values.end());
    }
    pieces.back().format += format.substr(at);
    return pieces;
}

// One piece, whose format is not known: it takes what it is given.
bool unknown_format(LowerCall& c, Piece& piece) {
    for (size_t k = 1; k < c.args.size(); ++k) {
        std::vector<Value> values = numbers(c, c.args[k]);
        piece.values.insert(piece.values.end(), values.begin(), values.end());
    }
    if (piece.values.size() <= size_t(kMostFormatValues)) return true;
    c.context.error(Code::RSL_PRINT_TOO_LONG, c.where(), piece.values.size());
    return false;
}

std::vector<Value> service_arguments(LowerCall& c, Value format, std::vector<Value> values) {
    values.insert(values.begin(), format);
    values.resize(1 + size_t(kMostFormatValues), c.b.f(0));
    return values;
}

void format(LowerCall& c) {
    const std::string* text = c.e.constant_text(c.args[0].c[0]);
    if (!text) {
        Piece all;
        if (unknown_format(c, all))
            c.set(make_text(c, Service::format, service_arguments(c, c.f(0), all.values)));
        return;
    }
    check_count(c, conversions(*text).size());
    Value result = c.b.i(0);
    for (const Piece& piece : pieces_of(c, *text)) {
        Value format = c.b.i(intern(piece.format));
        Value part = piece.values.empty() ? c.b.i(intern(format_text(piece.format, {})))
                                          : make_text(c, Service::format,
                                                      service_arguments(c, format, piece.values));
        result = join(c, result, part);
    }
    c.set(result);
}

// Kernels that only ask for opacity run beside the one that prints.
bool prints(LowerCall& c) {
    return c.context.kind() != ShaderKind::Surface || c.context.options.want_Ci;
}

void print(LowerCall& c) {
    if (!prints(c)) return;
    const std::string* text = c.e.constant_text(c.args[0].c[0]);
    if (!text) {
        Piece all;
        if (unknown_format(c, all))
            c.services.call(Service::print, service_arguments(c, c.f(0), all.values));
        return;
    }
    check_count(c, conversions(*text).size());
    for (const Piece& piece : pieces_of(c, *text)) {
        Value format = c.b.i(intern(piece.format));
        c.services.call(Service::print, service_arguments(c, format, piece.values));
    }
}

// debug(x): the source of the argument is not at hand, so its line is named.
void debug(LowerCall& c) {
    if (!prints(c)) return;
    BaseType type = c.args[0].type;
    const char* conversion = type == BaseType::String   ? "%s"
                             : type == BaseType::Matrix ? "%m"
                             : is_triple(type)          ? "%p"
                                                        : "%f";
    std::string text = "debug " + std::string(type_name(type)) + ": " + conversion + "\n";
    c.services.call(Service::print,
                    service_arguments(c, c.b.i(intern(text)), numbers(c, c.args[0])));
}

}  // namespace lower_string

namespace ref {
namespace {

template <class Real>
void concat(RefCall<Real>& c) {
    std::string all;
    for (size_t i = 0; i < c.args.size(); ++i) all = limited_text(all + c.text(i));
    c.set(Dual<Real>(Real(intern(all))));
}

// By the C library, whose code is none of ours. A pattern it refuses matches nothing.
bool posix_match(const std::string& pattern, const std::string& text) {
    regex_t compiled;
    if (regcomp(&compiled, pattern.c_str(), REG_EXTENDED | REG_NOSUB) != 0) return false;
    const bool found = regexec(&compiled, text.c_str(), 0, nullptr, 0) == 0;
    regfree(&compiled);
    return found;
}

template <class Real>
void match(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(posix_match(c.text(0), c.text(1)))));
}

template <class Real>
void format(RefCall<Real>& c) {
    std::vector<float> values;
    for (size_t i = 1; i < c.args.size(); ++i) {
        const RefValue<Real>& value = c.args[i];
        for (size_t k = 0; k < value.size(); ++k)
            values.push_back(value.type == BaseType::String
                                 ? std::bit_cast<float>(int32_t(value.c[k].x))
                                 : float(value.c[k].x));
    }
    c.set(Dual<Real>(Real(intern(limited_text(format_text(c.text(0), values))))));
}

template <class Real>
void stof(RefCall<Real>& c) {
    std::istringstream stream(c.text(0));
    stream.imbue(std::locale::classic());
    float number = 0;
    stream >> number;
    c.set(Dual<Real>(Real(number)));
}

template <class Real>
void strlen(RefCall<Real>& c) {
    c.set(Dual<Real>(Real(c.text(0).size())));
}

template <class Real>
void printf(RefCall<Real>&) {}  // what is printed is no value of the point

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_string;

const Builtin kRows[] = {
    {"concat", "s=sss*", lower::concat, KINORA_RSL_REF(ref::concat), kPure, 0,
     "Its arguments, one after the other. A string has 65536 bytes at most."},
    {"format", "s=s?*", lower::format, KINORA_RSL_REF(ref::format), kPure, 0,
     "Text with %f %d (floats) %c %p %v %n (triples) %m (matrices) %s (strings) replaced by the "
     "arguments. C's width and precision may stand after the %. A string has 65536 bytes at most."},
    {"sprintf", "s=s?*", lower::format, KINORA_RSL_REF(ref::format), kPure, 0,
     "PRMan's name of format()."},
    {"stof", "f=s", lower::stof, KINORA_RSL_REF(ref::stof), kPure, 0,
     "The number that the string begins with: stof(\"2.5 m\") is 2.5. Without one it is 0."},
    {"strlen", "f=s", lower::strlen, KINORA_RSL_REF(ref::strlen), kPure, 0, "Bytes of the string."},
    {"match", "f=ss", lower::match, KINORA_RSL_REF(ref::match), kPure, 0,
     "1 if the pattern, a regular expression, occurs in the string: match(pattern, string)."},
    {"printf", "x=s?*", lower::print, KINORA_RSL_REF(ref::printf), kPrints, 0,
     "Prints text as format() makes it: uniform values once a frame, varying ones for each point."},
    {"debug", "x=f x=c x=p x=v x=n x=m x=s", lower::debug, KINORA_RSL_REF(ref::printf), kPrints, 0,
     "Prints its argument on a line of its own."},
};

}  // namespace

std::span<const Builtin> builtins_string() {
    return kRows;
}

}  // namespace kinora::rsl
