// rsl/text/macro_table.h: the macros that are defined, and what #define says of one.
#pragma once

#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rsl/text/reporter.h"
#include "rsl/text/token.h"

namespace kinora::rsl {

struct Macro {
    std::string_view name;
    Location definition;
    bool function_like = false;
    bool variadic = false;
    bool special = false;    // __FILE__, __LINE__
    bool standard = false;   // of a customary header of ours
    bool undefined = false;  // by #undef: the node stays, since expansions may point to it
    bool expanding = false;  // its replacement is being read: its name is no macro inside
    std::vector<std::string_view> parameters;
    TokenList replacement;
};

// Macros by name. A pointer to one lives as long as the table, whatever is defined or undefined.
class MacroTable {
  public:
    // Replaces a macro of the same name.
    void define(Macro macro);
    void undefine(std::string_view name);
    Macro* find(std::string_view name);  // null when no macro has the name
    bool is_defined(std::string_view name) { return find(name) != nullptr; }

  private:
    std::unordered_map<std::string_view, Macro> macros_;  // nodes do not move
};

// The macro of "#define" and the tokens after it. Nothing, and a finding, when they are malformed.
std::optional<Macro> read_macro(const Token& directive, const TokenList& line, Reporter& reporter);

}  // namespace kinora::rsl
