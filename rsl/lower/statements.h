// rsl/lower/statements.h: statements: branches, loops and jumps become Ifs, Loops and running
// masks.
#pragma once

#include <span>

#include "rsl/lower/context.h"
#include "rsl/lower/gather.h"
#include "rsl/lower/lights.h"
#include "rsl/lower/loops.h"
#include "rsl/lower/slots.h"
#include "rsl/lower/variables.h"

namespace kinora::rsl {

class Statements {
  public:
    Statements(Emitter& emitter, LoweringContext& context, Regions& regions, Variables& variables,
               Loops& loops, Illuminance& illuminance, LightShader& light_shader, Gather& gather,
               TreeWalk& tree)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          regions_(regions),
          variables_(variables),
          loops_(loops),
          illuminance_(illuminance),
          light_shader_(light_shader),
          gather_(gather),
          tree_(tree) {}

    void statement(const Stmt& stmt);
    void block(std::span<Stmt* const> body);

  private:
    void evaluate(const Expr& e);
    void branch(const IfStmt& stmt);
    void loop(const Stmt& stmt);
    // How often a loop turns that counts a variable up by 1, an int; none: not known.
    Value turns_of(const ForStmt& stmt);
    void run_statements(std::span<Stmt* const> body);
    void return_from(const ReturnStmt& stmt);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Regions& regions_;
    Variables& variables_;
    Loops& loops_;
    Illuminance& illuminance_;
    LightShader& light_shader_;
    Gather& gather_;
    TreeWalk& tree_;
};

}  // namespace kinora::rsl
