// rsl/model/layer.h: one shader of a stack with its parameters bound.
#pragma once

#include <string>
#include <vector>

#include "rsl/model/shader.h"

namespace kinora::rsl {

// How a shader parameter reaches the kernel (docs/decisions.md#specialise-on-shape-only):
// specialised on shape only.
struct ParamBinding {
    enum class Kind {
        Frame,     // read from the frame block (default)
        Constant,  // a string, or a float that is exactly 0 or 1 and not animated, or one that
                   // reaches a condition or loop bound: folded into the code
        Varying,   // bound to a vertex input: a point-rate input
        Layer,     // what a layer below left in a parameter of its own
        Default    // not bound: the shader's own default expression, lowered
    };
    std::string name;
    Kind kind = Kind::Default;
    std::vector<float> constant;       // components (all elements of an array)
    std::vector<std::string> strings;  // for string parameters
    bool plain = false;                // Varying: what a displacement left, numbers of no space
    uint32_t below = 0;                // Layer: so many layers
    std::string variable = {};         // Layer: of that one
};

// One shader of a stack: displacements first (bottom first), then surfaces (bottom first).
struct Layer {
    const Shader* shader = nullptr;
    std::vector<ParamBinding> params;
    // The shader has run already, on the mesh's vertices: only its parameters are known here, for
    // displacement(); those it wrote come as Varying bindings.
    bool done = false;
    std::string space = {};  // the named one that "shader" means here; "": the object's
};

}  // namespace kinora::rsl
