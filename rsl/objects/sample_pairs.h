// rsl/objects/sample_pairs.h: optional parameters of generateSamplesEnv(), evaluateSamplesEnv().
#pragma once

#include "rsl/objects/units.h"
#include "rsl/syntax/ast.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// Those functions are a header's (prman_samples.h), so their "name", value pairs become arguments.
// Works on the unchecked tree, and on those of co-shaders.
void bind_sample_pairs(Ast& ast, Reporter& reporter, std::span<const Unit> units);

}  // namespace kinora::rsl
