// jit/a64/branches.cpp: conditional branches, which reach 1 MiB only, over functions of any size.
#include "jit/a64/branches_p.h"

namespace kinora::jit::a64 {

namespace {

// An instruction of the IR becomes at most this many bytes, an argument of its list included; tests
// over every op hold it (a conditional branch must reach over a whole function or be made far).
constexpr size_t kMostBytes = 400;
constexpr size_t kBranchReach = 1u << 20;

}  // namespace

Branches::Branches(arm::Assembler& a, const FunctionCode& code)
    : a_(a),
      far_((code.function.insts.size() + code.function.args.size()) * kMostBytes > kBranchReach) {}

void Branches::if_zero(const Gp& condition, const Label& to) {
    if (!far_) return void(a_.cbz(condition, to));
    Label on = a_.newLabel();
    a_.cbnz(condition, on);
    a_.b(to);
    a_.bind(on);
}

void Branches::if_not_zero(const Gp& condition, const Label& to) {
    if (!far_) return void(a_.cbnz(condition, to));
    Label on = a_.newLabel();
    a_.cbz(condition, on);
    a_.b(to);
    a_.bind(on);
}

}  // namespace kinora::jit::a64
