// rsl/lower/services.h: what a kernel gets from outside: inputs by their keys, answers of
// RendererServices, random numbers.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "rsl/lower/context.h"
#include "rsl/lower/math.h"
#include "rsl/lower/spaces.h"
#include "rsl/model/kernel_keys.h"
#include "rsl/model/services.h"

namespace kinora::rsl {

// One number of a kernel's inputs.
jit::InputInfo input_info(const KernelKey& key, jit::Type type, jit::Rate rate, Slopes slopes);
Value scalar_input(jit::Builder& b, const KernelKey& key, jit::Type type, jit::Rate rate);
// All components of the input that a global is.
Lowered global_input(jit::Builder& b, Global input, jit::Rate rate, Slopes slopes = Slopes::None);
// The int that differs from point to point, and from frame to frame.
Value rng_input(jit::Builder& b);
// Is v exactly the global's unmodified input?
bool is_input(jit::Builder& b, const V3& v, Global input);

// A service of rsl/model/services.def, in the kernel's "current".
std::vector<Value> kernel_service(Emitter& e, Service service, std::span<const Value> args);

// Calls of services, in the layer's "current".
class Services {
  public:
    Services(Emitter& emitter, LoweringContext& context, Spaces& spaces)
        : e_(emitter), context_(context), spaces_(spaces) {}
    std::vector<Value> call(Service service, std::span<const Value> args);

  private:
    Emitter& e_;
    LoweringContext& context_;
    Spaces& spaces_;
};

// What seeds the samples of a call: the point, the call's site, the functions it stands in and the
// turns of the loops around it.
class SampleSeeds {
  public:
    SampleSeeds(Emitter& emitter, LoweringContext& context) : b_(emitter.b), context_(context) {}

    // Number of this call of random().
    Value random01(const CallExpr& call, int component);
    // The ints that seed a call's samples: the point's, and this site's with its loop iterations.
    std::array<Value, 2> sample(uint32_t site);

    // Inside a sample method: calls of random() in a row are the two numbers of a sample, and the
    // turns of the loop around them its samples.
    bool stratifies() const { return state_.stratifies; }
    struct Draw {
        Value sequence, index, count;
        bool second;
    };
    Draw draw(uint32_t site);

    void enter_layer() { state_.path = state_.path * 31 + 7; }
    // `turns`: how often the loop turns; none: not known.
    void push_counter(Value counter, Value turns = jit::kNone) {
        state_.counters.push_back(counter);
        state_.turns.push_back(turns);
    }
    void pop_counter() { state_.counters.pop_back(), state_.turns.pop_back(); }
    Value counter() const { return state_.counters.back(); }

    // The functions inlined around here, kept and restored around a body.
    struct Path {
        uint32_t path, factor;
        bool stratifies;
    };
    Path enter_call(uint32_t site, bool samples);
    void leave_call(const Path& outer) {
        state_.path = outer.path, state_.factor = outer.factor;
        state_.stratifies = outer.stratifies;
    }
    // For a function of the IR called at this site: the path with the loop iterations in it.
    Value path_into(uint32_t site);

    // `path`, or handed_in * factor + path inside a function of the IR.
    struct State {
        std::vector<Value> counters, turns;
        uint32_t path = 0, factor = 1;
        bool stratifies = false;
        // The first call of a pair that has no second yet, and where it stands.
        bool open = false;
        uint32_t first_site = 0, first_path = 0;
        Value first_counter = jit::kNone;
        Value handed_in = jit::kNone;
    };
    State enter_function() { return std::exchange(state_, {}); }
    void leave_function(State&& outer) { state_ = std::move(outer); }
    void hand_in(Value path) { state_.handed_in = path; }

  private:
    Value path_value();

    jit::Builder& b_;
    LoweringContext& context_;
    State state_;
};

}  // namespace kinora::rsl
