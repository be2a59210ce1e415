// rsl/lower/inputs.h: the kernel's inputs: parameters as they are bound, globals.
#pragma once

#include <string>
#include <string_view>

#include "rsl/lower/context.h"
#include "rsl/lower/math.h"
#include "rsl/lower/messages.h"
#include "rsl/lower/slots.h"
#include "rsl/lower/spaces.h"

namespace kinora::rsl {

// Parameters by their bindings.
class BoundParameters {
  public:
    BoundParameters(Emitter& emitter, LoweringContext& context, Spaces& spaces,
                    const Messages& messages)
        : e_(emitter), b_(emitter.b), context_(context), spaces_(spaces), messages_(messages) {}

    // A binding's value, in the layer's current; `element` of an array type.
    Lowered bound_value(const ParamBinding& bound, std::string_view name, Type type, int element);
    jit::InputInfo element_input(std::string_view name, BaseType type, const ParamBinding& bound,
                                 int element, int component);

  private:
    Lowered bound_input(const ParamBinding& bound, std::string_view name, Type type, int element);
    Lowered left_by_layer(const ParamBinding& bound, Type type, int element);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Spaces& spaces_;
    const Messages& messages_;
};

// Shader globals: inputs of the kernel until the shader writes them.
class Globals {
  public:
    Globals(Emitter& emitter, LoweringContext& context, Spaces& spaces, BoundParameters& parameters,
            Slots& slots)
        : e_(emitter),
          b_(emitter.b),
          context_(context),
          spaces_(spaces),
          parameters_(parameters),
          slots_(slots) {}

    Lowered read(Global id);
    void write(Global id, const Lowered& value) { slots_.write(int(id), value); }
    bool written(Global id) const { return slots_.live(int(id)); }
    void forget(Global id) { slots_.kill(int(id)); }
    Lowered input(Global id);  // its first value, in the layer's "current"

    Lowered smooth_P(const Lowered& N);
    V3 normal_of(const V3& p);  // Du(p) ^ Dv(p), oriented as Ng; slopes as those of N

  private:
    Lowered kernel_input(Global id);
    Lowered light_global(const GlobalInfo& info);

    Emitter& e_;
    jit::Builder& b_;
    LoweringContext& context_;
    Spaces& spaces_;
    BoundParameters& parameters_;
    Slots& slots_;
};

}  // namespace kinora::rsl
