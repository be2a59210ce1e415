// runtime/scene/ri/state/branches.h: which branch of IfBegin, ElseIf, Else and IfEnd is read.
#pragma once

#include <vector>

#include "runtime/scene/ri/state/conditions.h"
#include "runtime/scene/ri/state/state.h"

namespace kinora::ri {

class Branches {
  public:
    Branches(State& state, StateReport& report) : state_(state), report_(report) {}

    // Whether the call stands in a branch that is not read. Those that end it do not.
    bool leave_out(const Call& call);
    // False: the request is none of these.
    bool call(const Call& call);
    // The file's end: a finding for what is open, which then is closed.
    void finish();

  private:
    struct Open {
        Location where;
        bool read = false;  // one of its branches was
    };
    void begin(const Call& call);
    void next(const Call& call);
    void end(const Call& call);
    bool holds(const Call& call);
    std::optional<ConditionValue> look_up(const Call& call, std::string_view name) const;

    State& state_;
    StateReport& report_;
    std::vector<Open> open_;
    bool skipping_ = false;  // the branch of the last open one
    int inner_ = 0;          // IfBegin within that
};

}  // namespace kinora::ri
