// rsl/lower/records.h: records of sets: lights as surfaces read them, and rays of gather.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rsl/lower/context.h"
#include "rsl/lower/services.h"

namespace kinora::rsl {

Value record_field(jit::Builder& b, Value set, Value record, int column,
                   jit::Type type = jit::Type::F);
V3 record_triple(jit::Builder& b, Value set, Value record, int column);
Value record_uniform(jit::Builder& b, Value set, Value record, int field, jit::Type type);

// Calls body(record) for each record of a set, inside a Loop whose counter agrees in all lanes;
// `carried` are plain values that body may replace.
template <class Body>
void for_each_record(jit::Builder& b, Value set, std::span<Value> carried, Location where,
                     Body&& body) {
    Value count = b.op(jit::Op::RecordCount, set);
    Value enter = b.op(jit::Op::ILt, b.i(0), count);
    int site = b.fault_site(where, "more lights than a loop may visit");
    b.begin_loop(enter, site);
    Value record = b.loop_var(b.i(0));
    std::vector<Value> vars, next;
    for (Value& v : carried) vars.push_back(v = b.loop_var(v));
    body(record);
    next.push_back(b.iadd(record, b.i(1)));
    next.insert(next.end(), carried.begin(), carried.end());
    b.end_loop(b.op(jit::Op::ILt, next[0], count), next);
    for (size_t i = 0; i < vars.size(); ++i) carried[i] = b.loop_out(vars[i]);
}

// The lights at a position, and the one whose turn of illuminance it is.
class LightRecords {
  public:
    LightRecords(Emitter& emitter, LoweringContext& context, Services& services)
        : e_(emitter), b_(emitter.b), context_(context), services_(services) {}

    Value set_at(const V3& position);
    // Notes that a loop over the set looks at lights within 90 degrees of the axis alone; null: at
    // all lights.
    void look_about(Value set, const V3* axis);
    // Notes that a loop looks at lights of any category: those with a direction, or ambient ones.
    void look_at_all(bool ambient) {
        (ambient ? context_.out.lit_by_ambient : context_.out.lit_by_all) = true;
    }
    // Whether the record is of the category, a string expression's value.
    Value category_matches(Value set, Value record, Value category, Location where);
    // The current light's parameter where it has one, else `before`; *known says where.
    std::vector<Lowered> message(const std::string& name, Type type,
                                 std::span<const Lowered> before, Value* known);

    // Inside illuminance; none outside.
    struct State {
        Value set = jit::kNone, record = jit::kNone;
    };
    const State& current() const { return state_; }
    bool any_current() const { return state_.record != jit::kNone; }
    State set_current(const State& next) { return std::exchange(state_, next); }
    State enter_function() { return std::exchange(state_, {}); }
    void leave_function(State&& outer) { state_ = outer; }

  private:
    int message_column(std::string_view name, Type type, int* index);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Services& services_;
    State state_;
};

}  // namespace kinora::rsl
