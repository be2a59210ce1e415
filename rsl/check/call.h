// rsl/check/call.h: binds calls to their functions, argument by argument.
#pragma once

#include <span>
#include <string>

#include "rsl/check/assignments.h"
#include "rsl/check/call_graph.h"
#include "rsl/check/overloads.h"
#include "rsl/check/scopes.h"
#include "rsl/check/tree_reporter.h"
#include "rsl/text/compile_options.h"

namespace kinora::rsl {

// What a function takes at one position; base Invalid takes any.
struct Parameter {
    Type type{BaseType::Invalid, -1};
    bool output = false;
};

// begin(), bind_argument() for each argument in order, end().
class CallBinder {
  public:
    CallBinder(Ast& ast, TreeReporter& reporter, const CompileOptions& options, Scopes& scopes,
               const OverloadResolution& overloads, Assignments& assignments, CallGraph& graph)
        : ast_(ast),
          reporter_(reporter),
          options_(options),
          scopes_(scopes),
          overloads_(overloads),
          assignments_(assignments),
          graph_(graph) {}

    // name[channel] as first argument of a built-in: the index of a string that is no array. Moves
    // it to e.channel, unchecked, and returns true.
    bool take_channel(CallExpr& e);

    // "source", p1, p2, p3, p4 among the arguments of shadow(): the points become one array, so
    // that pairs are pairs.
    void group_source(CallExpr& e);
    void split_channels(CallExpr& e);

    void begin(CallExpr& e, Callee callee);
    Parameter parameter(const CallExpr& e, size_t index) const;
    // Brings a checked argument to the parameter's type.
    void bind_argument(CallExpr& e, size_t index);
    void end(CallExpr& e);

    // No form of the functions, or of the built-in ones, takes `arguments`.
    void report_no_form(CallExpr& e, std::span<Function* const> functions,
                        const std::string& arguments);

  private:
    void end_builtin(CallExpr& e);
    void bind_output(Expr& argument, size_t index, Type type, std::string_view callee);

    Ast& ast_;
    TreeReporter& reporter_;
    const CompileOptions& options_;
    Scopes& scopes_;
    const OverloadResolution& overloads_;
    Assignments& assignments_;
    CallGraph& graph_;
};

}  // namespace kinora::rsl
