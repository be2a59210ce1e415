// rsl/lower/gather.h: gather: all rays of the statement are shot by one service, then its body is
// replayed once for each (docs/decisions.md#lights-run-once).
#pragma once

#include "rsl/lower/context.h"
#include "rsl/lower/loops.h"
#include "rsl/lower/services.h"
#include "rsl/lower/slots.h"
#include "rsl/lower/variables.h"

namespace kinora::rsl {

class Gather {
  public:
    Gather(Emitter& emitter, LoweringContext& context, Services& services, SampleSeeds& seeds,
           Regions& regions, Variables& variables, Loops& loops, TreeWalk& tree)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          services_(services),
          seeds_(seeds),
          regions_(regions),
          variables_(variables),
          loops_(loops),
          tree_(tree) {}

    void lower(const GatherStmt& stmt);

  private:
    struct Results;
    void turn(const GatherStmt& stmt, Value set, Value record, Results& results, bool only_body);
    void branch(const GatherStmt& stmt, Value set, Value record, Results& results, bool hit);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Services& services_;
    SampleSeeds& seeds_;
    Regions& regions_;
    Variables& variables_;
    Loops& loops_;
    TreeWalk& tree_;
    int depth_ = 0;
};

}  // namespace kinora::rsl
