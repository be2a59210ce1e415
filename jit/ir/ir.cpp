// jit/ir/ir.cpp: the table of operations.
#include "jit/ir/ir.h"

#include "runtime/base/check.h"

namespace kinora::jit {

namespace {

constexpr int letters(const char* operands) {
    int count = 0;
    for (; *operands != 0; ++operands) count += *operands != '*';
    return count;
}

// ops.def writes result letters bare: F I M T 0.
#define RESULT_LETTER(result) (#result)[0]

}  // namespace

const OpInfo kOps[] = {
#define OP(name, operands, result, flags, meaning) \
    {#name, operands, RESULT_LETTER(result), flags, meaning, letters(operands)},
#include "jit/ir/ops.def"
#undef OP
};
static_assert(std::size(kOps) == static_cast<size_t>(Op::Count));

Type type_of_letter(char letter) {
    switch (letter) {
        case 'F':
            return Type::F;
        case 'I':
            return Type::I;
        case 'M':
            return Type::M;
        default:
            return Type::None;
    }
}

}  // namespace kinora::jit
