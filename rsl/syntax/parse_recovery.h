// rsl/syntax/recovery.h: what of the source the tree lacks after syntax errors. Names that may be
// declared in it are no news where they are used; everything else is checked as ever.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rsl/text/token.h"

namespace kinora::rsl {

// Tokens are meant by their index in the token stream. What skipped text declares is seen in the
// definition (a shader, or a function at file level) that it was skipped in.
class ParseRecovery {
  public:
    // Text was lost before it was parsed, as of a header that is missing: any name may be in it.
    void lose_everything() { everything_ = true; }
    // Any name may be declared in the definition that is being parsed.
    void lose_any_name() { add("", false); }

    // A definition at file level begins at the token, and the one before it ends.
    void begin_definition(uint32_t token) { definitions_.push_back({token, false}); }
    // Something of the definition was skipped.
    void break_definition() { definitions_.back().broken = true; }

    // The tokens [begin, end) were skipped. `declares`: they are parameters or variables whose type
    // may stand before; `whole_file`: what they declare is seen in all the file.
    void lose(const std::vector<Token>& tokens, uint32_t begin, uint32_t end, bool declares,
              bool whole_file);

    // Whether this very name may be declared in what was lost, for a use at the token.
    bool declares(std::string_view name, uint32_t token) const;
    // The same, or any name may.
    bool hides(std::string_view name, uint32_t token) const;
    // Whether the token stands in a definition of which something was skipped.
    bool touches(uint32_t token) const;

  private:
    static constexpr uint32_t kWholeFile = UINT32_MAX;
    struct Definition {
        uint32_t begin;
        bool broken;
    };
    void add(std::string_view name, bool whole_file);
    size_t definition_of(uint32_t token) const;

    bool everything_ = false;
    std::vector<Definition> definitions_;  // in order
    // Where a name may be declared: indices of definitions_. "" is any name.
    std::unordered_map<std::string_view, std::vector<uint32_t>> names_;
};

}  // namespace kinora::rsl
