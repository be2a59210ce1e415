// collada/extract/memory_budget_p.h: how much the links of hostile documents may unfold to.
#pragma once

#include <cstdint>
#include <string>

#include "collada/document/findings.h"
#include "runtime/base/diagnostic.h"

namespace kinora::collada {

// About what `made` or `target_of` hold for an element.
inline constexpr uint64_t kBookBytes = 64;

// Many elements may name one array, so what links multiply is counted against the documents' size.
class MemoryBudget {
  public:
    explicit MemoryBudget(Diagnostics& diag) : diag_(diag) {}

    void add_text(uint64_t bytes) { text_ += bytes; }
    // Counts what is made on from where `other` has come to.
    void resume(const MemoryBudget& other) {
        text_ = other.text_;
        made_ = other.made_;
    }
    bool is_spent() const { return spent_; }
    uint64_t most() const { return (16 << 20) + 8 * text_; }
    // To be asked before memory is taken for what a link leads to. False, and reported once, when
    // all of it would pass most(); leave the thing out.
    bool reserve(uint64_t bytes, Location where) { return within(made_, bytes, most(), where); }
    // The same for the time of parsing a text that other elements may name, too.
    bool reserve_parsing(uint64_t bytes, Location where) {
        return within(parsed_, bytes, (uint64_t(256) << 20) + 32 * text_, where);
    }

  private:
    bool within(uint64_t& used, uint64_t more, uint64_t limit, Location where) {
        if (spent_ || used + more > limit) {
            if (!spent_)
                diag_.report(Code::LINK_TOO_MANY, where,
                             std::string("what the links share unfolds to too much data"));
            spent_ = true;
            return false;
        }
        used += more;
        return true;
    }

    Diagnostics& diag_;
    uint64_t text_ = 0;    // of all documents
    uint64_t made_ = 0;    // of structs and lists
    uint64_t parsed_ = 0;  // of text, each time it is parsed
    bool spent_ = false;
};

}  // namespace kinora::collada
