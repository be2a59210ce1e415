// collada/schema/simple_types_p.h: the types of attribute values and texts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "collada/document/document.h"

namespace kinora::collada {

// What XML Schema, or COLLADA by a pattern, calls one word of a value.
struct BaseType {
    std::string_view name;                // "unsignedLong"
    bool (*fits)(std::string_view word);  // null: any text
    std::string_view what;                // "a whole number from 0"
    enum class Numbers : uint8_t { No, Real, Whole, Natural } numbers = Numbers::No;
    bool keeps_space = false;                  // string: white space around the value counts
    std::string_view base = {}, pattern = {};  // of an XSD, where it is not one of XML Schema's
};
const BaseType* find_base(std::string_view name);

struct SimpleType {
    std::string_view cell;  // as the table writes it: "double[3]"
    std::string_view row;   // the named row it stands on, or ""
    const BaseType* base = nullptr;
    bool list = false;
    uint32_t length = 0;  // 0: any
    std::vector<std::string_view> values;
    bool ranged = false;
    double low = 0, high = 0;
    bool has_low = false, has_high = false;
};

// CHECKs that the cell names a base or a row.
SimpleType parse_simple(std::string_view cell, Version version);

enum class ValueFault : uint8_t { None, Type, Value, Range, Length, Pattern };
struct ValueCheck {
    ValueFault fault = ValueFault::None;
    size_t begin = 0, end = 0;  // the word at fault
    size_t words = 0;           // counted where the length is fixed
};
// Large lists of numbers take one pass at memory speed.
ValueCheck check_value(const SimpleType& type, std::string_view text);

// "3 numbers", "one of A, B", "a whole number from 0".
std::string describe(const SimpleType& type);

}  // namespace kinora::collada
