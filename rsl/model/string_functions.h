// rsl/model/string_functions.h: what concat, format, match and printf mean, for values that are
// known when a shader is compiled and for those that are not.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jit/ir/kernel.h"
#include "rsl/model/services.h"

namespace kinora::rsl {

// One %-conversion of a format: %f %d a float, %c %p %v %n a triple, %m a matrix, %s a string; with
// C's flags, width and precision between. "%%" is a percent sign and no conversion.
struct Conversion {
    size_t begin, end;  // in the format
    char letter;
    int values() const;  // numbers that it takes; 0 for an unknown letter, which is text
};
std::vector<Conversion> conversions(std::string_view format);

// The most numbers that the services "format" and "print" take.
inline constexpr int kMostFormatValues = service_argument(Service::print, "values").count;

// The format with its conversions replaced, a float at a time; strings are interned ids bit for
// bit, missing values 0. A float without precision is the shortest decimal that reads back; %d
// truncates. No longer than kMostText by more than one value: then it ends.
std::string format_text(std::string_view format, std::span<const float> values);

// The most bytes of a string that a shader makes, and what stands for longer ones.
inline constexpr size_t kMostText = 64 * 1024;
inline constexpr std::string_view kTooLong = "(a string of more than 65536 bytes)";
inline std::string_view limited_text(std::string_view text) {
    return text.size() <= kMostText ? text : kTooLong;
}

// The decimal number that the text begins with, behind blanks; 0 if there is none. What is larger
// than a float is infinite.
float leading_number(std::string_view text);

// What all strings of the process take (rsl/model/renderer_services.h, intern).
size_t interned_bytes();

// The text as part of a format.
std::string escape_format(std::string_view text);

// Does the regular expression match some part of the text? POSIX's extended syntax: . [] * + ? | ()
// ^ $ and \ before a character to be taken as it is. Takes time of the order of both lengths'
// product at most.
bool matches(std::string_view pattern, std::string_view text);

// The string services of services.def, the same for every renderer; null for the others. Each does
// its work once for each distinct set of arguments of a call. Once a million strings or 256 MB of
// them exist no new ones are made: the result is "". A string of more than kMostText bytes is not
// made: the result is kTooLong instead, which lowered code reports.
jit::ServiceFn string_service(Service service);

}  // namespace kinora::rsl
