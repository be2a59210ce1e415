// rsl/builtins_string.cpp: rows of the built-in table: strings and printing.
#include "rsl/builtin.h"

namespace kinora::rsl {

namespace {

const Builtin kRows[] = {
    {"concat", "s=sss*", nullptr, {}, kPure, 0, "Its arguments, one after the other."},
    {"format",
     "s=s?*",
     nullptr,
     {},
     kPure,
     0,
     "Text with %f %c %p %m %s replaced by the arguments."},
    {"match",
     "f=ss",
     nullptr,
     {},
     kPure,
     0,
     "1 if the pattern (a regular expression) occurs in the string: match(pattern, string)."},
    {"printf",
     "x=s?*",
     nullptr,
     {},
     kPrints,
     0,
     "Prints text with %f %c %p %m %s replaced by the arguments."},
};

}  // namespace

std::span<const Builtin> builtins_string() {
    return kRows;
}

}  // namespace kinora::rsl
