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

    // Of the innermost loop: a known number of rounds, or the budget; of these its first slice.
    void set_counter();
    void count_down();  // leaves flags: zero if that was the last round of a slice
    // Goes on with the next slice, or to the loop's exit if the kernel shall stop. Code behind is
    // reached after the last slice.
    void begin_next_slice();

    // The loop whose counter counts this value, or null; and that value, some rounds ahead.
    const OpenLoop* counted_by(Value index) const;
    void counted_index(const x86::Gp& to, const OpenLoop& loop, int32_t ahead);

  private:
    x86::Mem slot(int32_t first) const;  // by depth
    x86::Mem counter_slot() const { return slot(cursor_.code().layout.counters); }
    x86::Mem slices_left() const { return slot(cursor_.code().layout.slices_left); }
    void write_counter(int32_t rounds);

    x86::Assembler& a_;
    const CodeCursor& cursor_;
    std::vector<OpenLoop> loops_;
};

}  // namespace kinora::jit::x64
