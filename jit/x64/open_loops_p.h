// jit/x64/open_loops_p.h: the loops around the instruction in work, and what counts their rounds.
#pragma once

#include <vector>

#include "jit/codegen/code_cursor_p.h"
#include "jit/x64/registers_p.h"

namespace kinora::jit::x64 {

struct OpenLoop {
    Value begin;
    Label header, exit;
    x86::Gp counter;  // invalid: in memory
};

class OpenLoops {
  public:
    OpenLoops(x86::Assembler& a, const CodeCursor& cursor) : a_(a), cursor_(cursor) {}

    void open(Value begin);
    void close() { loops_.pop_back(); }
    const OpenLoop& innermost() const { return loops_.back(); }

    // Of the innermost loop: a known number of rounds, or the budget.
    void set_counter();
    void count_down();  // leaves flags: zero if that was the last round

    // The loop whose counter counts this value, or null; and that value, some rounds ahead.
    const OpenLoop* counted_by(Value index) const;
    void counted_index(const x86::Gp& to, const OpenLoop& loop, int32_t ahead);

  private:
    x86::Mem counter_slot() const;

    x86::Assembler& a_;
    const CodeCursor& cursor_;
    std::vector<OpenLoop> loops_;
};

}  // namespace kinora::jit::x64
