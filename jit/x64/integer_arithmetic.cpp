// jit/x64/integer_arithmetic.cpp: arithmetic of integers, and conversions from and to floats.
#include "jit/x64/arithmetic_p.h"

#include "jit/ir/planted_fault.h"

namespace kinora::jit::x64 {

void IntegerArithmetic::op_IAdd() {
    plain_.binary(Id::kIdVpaddd, true);
}
void IntegerArithmetic::op_ISub() {
    plain_.binary(Id::kIdVpsubd, false);
}
void IntegerArithmetic::op_IMul() {
    plain_.binary(Id::kIdVpmulld, true);
}
void IntegerArithmetic::op_IAnd() {
    plain_.binary(isa_.wide ? Id::kIdVpandd : Id::kIdVpand, true);
}
void IntegerArithmetic::op_IOr() {
    plain_.binary(isa_.wide ? Id::kIdVpord : Id::kIdVpor, true);
}
void IntegerArithmetic::op_IXor() {
    plain_.binary(isa_.wide ? Id::kIdVpxord : Id::kIdVpxor, true);
}
void IntegerArithmetic::op_IMin() {
    plain_.binary(Id::kIdVpminsd, true);
}
void IntegerArithmetic::op_IMax() {
    plain_.binary(Id::kIdVpmaxsd, true);
}
void IntegerArithmetic::op_IShl() {
    plain_.shift(Id::kIdVpslld);
}
void IntegerArithmetic::op_IShr() {
    plain_.shift(Id::kIdVpsrld);
}
void IntegerArithmetic::op_ISar() {
    plain_.shift(planted(PlantedFault::WrongShift) ? Id::kIdVpsrld : Id::kIdVpsrad);
}

void IntegerArithmetic::op_FToI() {
    plain_.unary(Id::kIdVcvttps2dq);
}
void IntegerArithmetic::op_IToF() {
    plain_.unary(Id::kIdVcvtdq2ps);
}
void IntegerArithmetic::op_BitsFI() {
    x86::Vec to = operands_.target();
    operands_.load(to, cursor_->a);
    operands_.finish(to);
}
void IntegerArithmetic::op_BitsIF() {
    op_BitsFI();
}

}  // namespace kinora::jit::x64
