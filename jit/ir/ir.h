// jit/ir/ir.h: the IR: a flat, structured SSA stream of masked float and int lanes.
//
// A Function is one vector of instructions. An instruction gives at most one value, named by its
// index. Values are defined before use; a value defined inside If..EndIf or Loop..EndLoop is not
// seen outside but through Merge and LoopOut. All meanings are per lane (ops.def): each lane
// behaves as a scalar program of its own, so no result depends on which points share a group.
// Masks appear where lanes differ: as operands of If, Loop, Select and of effects; lowering keeps
// the running mask as an ordinary value and hands it to every effect.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora::jit {

enum class Type : uint8_t { None, F, I, M };

// How often a value must be computed; a value takes the highest rate of its operands.
enum class Rate : uint8_t { Constant, Frame, Point };

enum class Op : uint8_t {
#define OP(name, operands, result, flags, meaning) name,
#include "jit/ir/ops.def"
#undef OP
    Count
};

enum OpFlags : uint8_t { kPure = 1, kCommutative = 2, kRead = 4, kEffect = 8, kControl = 16 };

// One row of ops.def.
struct OpInfo {
    const char* name;
    const char* operands;  // "MTT"
    char result;           // 'F' 'I' 'M' 'T', or '0'
    uint8_t flags;
    const char* meaning;
    int operand_count;  // letters in operands, '*' not counted
};
extern const OpInfo kOps[static_cast<size_t>(Op::Count)];
inline const OpInfo& op_info(Op op) {
    return kOps[static_cast<size_t>(op)];
}
inline bool is_pure(Op op) {
    return (op_info(op).flags & kPure) != 0;
}
// Type of a row's letter: F I M; None for '0' and for T.
Type type_of_letter(char letter);

// Index of the defining instruction in its function.
using Value = uint32_t;
inline constexpr Value kNone = ~0u;

struct Inst {
    Op op;
    Type type = Type::None;  // of the value; None if there is none
    uint16_t arg_count = 0;  // '*' operands: Function::args[args .. args + arg_count)
    Value a = kNone;
    Value b = kNone;
    Value c = kNone;
    int32_t imm = 0;
    int32_t imm2 = 0;
    uint32_t args = 0;
    uint32_t where = 0;  // index into Module::locations, 0 = unknown
};
static_assert(sizeof(Inst) == 32);

// A local array of `length` elements for each lane. Where the function is entered the first
// `cleared` are 0; others hold anything until they are stored.
struct ArrayInfo {
    std::string name;
    Type type;
    int32_t length;
    int32_t cleared = length;
};

struct Function {
    std::string name;
    std::vector<Type> params;
    std::vector<Type> results;
    std::vector<Inst> insts;
    std::vector<Value> args;
    std::vector<ArrayInfo> arrays;

    std::span<const Value> args_of(const Inst& inst) const {
        return {args.data() + inst.args, inst.arg_count};
    }
};

// What an input or output is to the front end, which packs it as it likes
// (rsl/model/kernel_keys.h). Passes keep it and never look into it; names alone tell inputs apart.
// All 0 in IR read from text.
struct FrontEndKey {
    uint64_t words[2] = {};
    bool operator==(const FrontEndKey&) const = default;
};

// A value the kernel's caller provides. Point inputs are arrays over the grid; frame inputs are
// read by the frame kernel only (after hoist none is left in a point kernel).
struct InputInfo {
    std::string name;  // "P.x", for dumps
    Type type = Type::F;
    Rate rate = Rate::Point;
    std::string du, dv;  // names of the inputs that hold its partial derivatives, "" = zero
    FrontEndKey key = {}, du_key = {}, dv_key = {};
};

struct OutputInfo {
    std::string name;  // "Ci.r", for dumps
    Type type = Type::F;
    FrontEndKey key = {};
};

// A C++ function that generated code calls; the slot is its index in Module::services.
struct ServiceInfo {
    std::string name;  // "texture": rsl/model/services.def lists them
    std::vector<Type> params;
    std::vector<Type> results;
    bool pure = false;  // same arguments, same results, no effect: may be merged, hoisted, dropped
};

// A point where a kernel may report at run time (loop budget, array index), by KernelArgs::fault.
struct FaultSite {
    Location where;
    std::string message;
};

struct Module {
    std::string name;
    std::vector<Function> functions;  // functions[0] is the kernel: no params; Return = outputs
    std::vector<InputInfo> inputs;
    std::vector<OutputInfo> outputs;
    std::vector<ServiceInfo> services;
    std::vector<FaultSite> fault_sites;
    std::vector<Location> locations = {Location{}};
    std::vector<float> table;         // constants that Lookup reads
    int32_t frame_slots = 0;          // size of the frame block that FrameLoad reads
    int32_t loop_budget = 1'000'000;  // iterations per entry of a loop before it ends with a fault
    // Scratch memory holds this many activations at once of functions that call each other in a
    // circle; the code itself must count them. 0: no call is cyclic.
    int32_t call_depth = 0;

    Function& kernel() { return functions[0]; }
    const Function& kernel() const { return functions[0]; }
};

inline float float_of(int32_t bits) {
    return std::bit_cast<float>(bits);
}
inline int32_t bits_of(float value) {
    return std::bit_cast<int32_t>(value);
}

// The IR as text, one instruction a line, `%7 = fma %1, %2, %3 ; file.sl:12`; parse_module reads it
// back to an equal module (locations apart). Errors are findings in `diagnostics` at line:column of
// the text; the result is then empty (no functions).
std::string print(const Module& module);
std::string print(const Module& module, const Function& function);
Module parse_module(std::string_view text, std::string_view name, Diagnostics& diagnostics);

// Checks everything that a well-formed module promises (types, scopes, structure, ranges of
// immediates, Results after calls, Merges after EndIf, call graph). Returns the first fault as
// text, "" if there is none.
std::string verify(const Module& module);

}  // namespace kinora::jit
