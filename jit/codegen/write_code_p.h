// jit/codegen/write_code_p.h: the walk over a function's instructions, and from each to the object
// of a target that writes it.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "jit/codegen/code_cursor_p.h"
#include "jit/codegen/module_code_p.h"

namespace kinora::jit {

// An object writes the op Add if it has a member op_Add().
#define OP(name, operands, result, flags, meaning) \
    template <class T>                             \
    concept Writes##name = requires(T & object) {  \
        object.op_##name();                        \
    };
#include "jit/ir/ops.def"
#undef OP

// The objects of a target that write code. Each op of ops.def has its member in exactly one of
// them; a target that leaves one out does not compile.
template <class... Objects>
class OpWriters {
  public:
    explicit OpWriters(Objects&... objects) : objects_(objects...) {}

    void write(Op op) { kWrite[static_cast<size_t>(op)](objects_); }

  private:
    using All = std::tuple<Objects&...>;

#define OP(name, operands, result, flags, meaning)                                     \
    static void write_##name(All& all) {                                               \
        constexpr int kWriters = (0 + ... + int{Writes##name<Objects>});               \
        static_assert(kWriters > 0, "no object of this target has op_" #name "()");    \
        static_assert(kWriters < 2, "two objects of this target have op_" #name "()"); \
        auto call = [](auto& object) {                                                 \
            if constexpr (Writes##name<decltype(object)>) object.op_##name();          \
        };                                                                             \
        std::apply([&](auto&... object) { (call(object), ...); }, all);                \
    }
#include "jit/ir/ops.def"
#undef OP

    static constexpr std::array kWrite = {
#define OP(name, operands, result, flags, meaning) &OpWriters::write_##name,
#include "jit/ir/ops.def"
#undef OP
    };

    All objects_;
};

// What no target writes: the derivatives pass leaves none.
struct GoneOps {
    void op_Du() {}
    void op_Dv() {}
    void op_WithSlope() {}
};

// Calls write() for each instruction that has code of its own, in order; before it load(v) for the
// inputs and constants that are loaded into their registers there.
template <class Assembler, class Load, class Write>
void write_instructions(CodeCursor& cursor, Assembler& a, bool listing,
                        std::vector<CodeLine>& lines, Load&& load, Write&& write) {
    const FunctionCode& code = cursor.code();
    const Allocation& allocation = code.allocation;
    for (cursor.start(); !cursor.is_done(); cursor.advance()) {
        Value at = cursor.at();
        bool fused = cursor.plan(at).fused;
        if (listing) a.commentf("; %s", text_of(code.function, at, fused).c_str());
        if (uint32_t where = cursor->where; where != 0)
            note_line(lines, a.offset(), code.module.locations[where]);
        for (Value v = allocation.load_at[at]; v != kNone; v = allocation.load_next[v])
            if (code.interval(v).in_reg(at)) load(v);
        if (!fused) write(cursor->op);
    }
}

}  // namespace kinora::jit
