// rsl/lower/spaces.h: coordinate systems: those that a shader names, and that of the layer.
#pragma once

#include <string>

#include "rsl/lower/context.h"
#include "rsl/lower/math.h"

namespace kinora::rsl {

// A matrix of four rows for row vectors; `to_current` or `from_current`.
struct Space {
    bool identity = true;
    Lowered to_current, from_current;
};

class Spaces {
  public:
    Spaces(Emitter& emitter, LoweringContext& context)
        : e_(emitter), b_(emitter.b), context_(context) {}

    Space space(Value name, Location where);
    // Out of the space into current, or the other way, as the type of x does it.
    Lowered to_current(const Lowered& x, const Space& from);
    Lowered from_current(const Lowered& x, const Space& to);

    Lowered into_layer(const Lowered& x);  // the kernel's current -> the layer's
    Lowered out_of_layer(const Lowered& x);
    Lowered from_object(const Lowered& x);  // what the mesh brings, in the layer's current

  private:
    // What a written name means: one that nobody knows is "shader", which is said once.
    bool has_own_space(std::string_view name) const;
    std::string meant_space(const std::string& name, Location where);
    Space kernel_space(Value name, const std::string* meant);  // in terms of the kernel's current
    Space input_space(const std::string& name);
    Space variable_space(Value name);
    void unknown_space(const std::string& name, Location where);
    void hint_at_near_name(const std::string& name, Location where);
    Lowered change_space(const Lowered& x, bool identity, const Lowered& m, const Lowered& inverse);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
};

}  // namespace kinora::rsl
