// rsl/lower/lights.h: statements over lights: illuminance of surfaces, illuminate and solar of
// light shaders.
#pragma once

#include <vector>

#include "rsl/lower/context.h"
#include "rsl/lower/inputs.h"
#include "rsl/lower/loops.h"
#include "rsl/lower/records.h"
#include "rsl/lower/slots.h"
#include "rsl/lower/variables.h"

namespace kinora::rsl {

struct LightCone;

class Illuminance {
  public:
    Illuminance(Emitter& emitter, LoweringContext& context, Slots& slots, Regions& regions,
                Variables& variables, Loops& loops, LightRecords& records, TreeWalk& tree)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          slots_(slots),
          regions_(regions),
          variables_(variables),
          loops_(loops),
          records_(records),
          tree_(tree) {}

    void lower(const IlluminanceStmt& stmt);

  private:
    void light_body(const IlluminanceStmt& stmt, Value set, Value record, const LightCone& around,
                    const Lowered& position);
    Value set_of(const IlluminanceStmt& stmt, const Lowered& position);
    void light_pairs(const IlluminanceStmt& stmt);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Slots& slots_;
    Regions& regions_;
    Variables& variables_;
    Loops& loops_;
    LightRecords& records_;
    TreeWalk& tree_;
};

// The records that a light shader writes, one for each illuminate or solar statement.
class LightShader {
  public:
    LightShader(Emitter& emitter, LoweringContext& context, Slots& slots, Regions& regions,
                Globals& globals, Loops& loops, TreeWalk& tree)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          slots_(slots),
          regions_(regions),
          globals_(globals),
          loops_(loops),
          tree_(tree) {}

    void begin(const Changes& changes);
    void illuminate(const Stmt& stmt, const Expr* position, const Expr* axis, const Expr* angle,
                    const Stmt& body);
    void outputs();
    bool in_solar() const { return in_solar_; }

  private:
    struct Source {
        const Stmt* stmt;
        int L, Cl, Ol, lit;        // slots
        int spread;                // of solar
        Lowered left_Cl, left_Ol;  // as the statement left the globals
    };

    V3 sent_along(const Stmt& stmt, const V3& axis);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Slots& slots_;
    Regions& regions_;
    Globals& globals_;
    Loops& loops_;
    TreeWalk& tree_;
    std::vector<Source> sources_;
    bool in_solar_ = false;
};

}  // namespace kinora::rsl
