// rsl/syntax/types.cpp: names of types, details and rates.
#include "rsl/syntax/types.h"

#include <iterator>

namespace kinora::rsl {

namespace {
constexpr const char* kTypeNames[] = {"float",  "color",  "point", "vector",    "normal",
                                      "matrix", "string", "void",  "condition", "invalid"};
constexpr int kWritable = int(BaseType::Void) + 1;  // types that source text can name
}  // namespace

const char* type_name(BaseType base) {
    return kTypeNames[int(base)];
}

std::string type_name(Type type) {
    std::string name = type_name(type.base);
    if (type.array_length > 0) name += "[" + std::to_string(type.array_length) + "]";
    if (type.array_length == 0) name += "[]";
    return name;
}

const char* detail_name(Detail detail) {
    constexpr const char* kNames[] = {"", "uniform", "varying"};
    return kNames[int(detail)];
}

const char* rate_name(Rate rate) {
    constexpr const char* kNames[] = {"constant", "uniform", "varying"};
    return kNames[int(rate)];
}

BaseType type_from_name(std::string_view word) {
    for (int i = 0; i < kWritable; ++i)
        if (word == kTypeNames[i]) return BaseType(i);
    return BaseType::Invalid;
}

}  // namespace kinora::rsl
