// rsl/check/usage.h: what a checked shader uses: globals read and written, functions reached; and
// whether its kind of shader may.
#pragma once

#include <unordered_set>
#include <vector>

#include "rsl/model/shader.h"
#include "rsl/syntax/parse_recovery.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// Fills shader.globals_read, globals_written and functions, and reports what its kind must not use,
// and literals that name no color space or spline. The tree may hold what could not be typed; in
// what `recovery` touches, nothing is said that a lost brace would explain. `reported` holds the
// nodes that have a finding already: functions are walked once for each shader.
void find_usage(Shader& shader, Ast& ast, Reporter& reporter, const ParseRecovery& recovery,
                std::unordered_set<const void*>& reported);

// The value of a checked expression that needs no running; empty when it does.
std::optional<ConstantValue> fold_constant(const Expr& expr);
ConstantValue zero_constant(Type type);

// Infers the rates of all checked shaders (those with errors as well, as far as they are known):
// fills Expr::rate and Symbol::varying (joined over calls and shaders), and reports varying values
// that meet uniform variables.
void infer_rates(Ast& ast, Reporter& reporter);

}  // namespace kinora::rsl
