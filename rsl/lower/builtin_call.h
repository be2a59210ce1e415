// rsl/lower/builtin_call.h: a call of a built-in: what its row's `lower` function sees.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rsl/lower/context.h"
#include "rsl/lower/inputs.h"
#include "rsl/lower/lights.h"
#include "rsl/lower/messages.h"
#include "rsl/lower/records.h"
#include "rsl/lower/services.h"
#include "rsl/lower/spaces.h"
#include "rsl/lower/values.h"
#include "rsl/lower/variables.h"
#include "rsl/model/builtin.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

// The parts of lowering that rows work with.
struct BuiltinTools {
    Emitter& e;                // arithmetic
    LoweringContext& context;  // options, layers, findings
    Spaces& spaces;
    Services& services;
    SampleSeeds& seeds;
    Globals& globals;
    Variables& variables;  // that arguments name
    LightRecords& lights;
    const LightShader& light_shader;
    Messages& messages;
    TreeWalk& tree;
};

// It sets `result` (of the type that the overload says) and the outputs.
struct LowerCall : BuiltinTools {
    LowerCall(const BuiltinTools& tools, const CallExpr& expr);

    jit::Builder& b;
    const CallExpr& call;
    std::vector<Lowered> args;    // values; of outputs, before the call; pairs are not among them
    std::vector<LValue> targets;  // of output arguments
    std::vector<std::pair<std::string, Lowered>> pairs;
    std::vector<std::pair<std::string, LValue>> output_pairs;  // variables that pairs name
    Lowered result;

    int overload() const { return call.signature->overload; }
    BaseType result_type() const { return call.type.base; }
    Value f(int i) const { return args[size_t(i)].c[0]; }
    V3 v3(int i) const { return args[size_t(i)].v3(); }
    void set_output(int i, const Lowered& value);
    void set(Value x) { result = lowered(result_type(), x); }
    void set(const V3& v) { result = lowered(result_type(), v); }
    // The text of a string argument, or null if it is not known at compile time (then reported).
    const std::string* text(int i) const;
    bool has_pair(std::string_view name) const;
    // The value of a pair that the callee's row of optional parameters has (rsl/model/pairs.h).
    Value pair(std::string_view name, float otherwise) const;
    // The largest component of a pair that is a float or a color.
    Value largest_pair(std::string_view name, float otherwise) const;
    Value text_pair(std::string_view name) const;  // its string id, that of "" if absent
    // Reports pairs that the callee does not know (rsl/model/pairs.h): they have no effect.
    void report_unknown_pairs() const;
    LValue* output_pair(std::string_view name);  // null if absent
    const Location& where() const { return call.span.where; }
};

// Evaluates the arguments and runs the row.
Lowered lower_builtin(const BuiltinTools& tools, const CallExpr& e);

// Says so where an optional parameter is known and changes nothing.
void report_idle_pair(Emitter& e, LoweringContext& context, std::string_view callee,
                      std::string_view name, const Lowered& value, Location where);

}  // namespace kinora::rsl
