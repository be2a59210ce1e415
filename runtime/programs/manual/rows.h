// runtime/programs/manual/rows.h: rows of the language's tables in words, for the manual on
// the terminal and the pages of docs.
#pragma once

#include <string>
#include <vector>

#include "rsl/model/builtin.h"

namespace kinora {

// Forms of a built-in that differ only in one type are one: T abs(T), and what T may be.
struct BuiltinForm {
    std::string text;  // with T for the type of the result
    std::vector<std::string> types;
    std::string plain;  // with the first of the types

    std::string line() const;  // "T abs(T), T: float color", or the plain form
};
std::vector<BuiltinForm> builtin_forms(const rsl::Builtin& row);

// "traces rays", ...: what a call does or depends on beside its arguments.
std::vector<std::string> effect_texts(const rsl::Builtin& row);

// The shader kinds of a mask (rsl::LegalIn), in the order of rsl::ShaderKind.
std::vector<std::string> kind_names(uint32_t mask);

}  // namespace kinora
