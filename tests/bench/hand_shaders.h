// tests/bench/hand_shaders.h: marble, plastic, wood, a ramp and lights as an engineer writes them
// with intrinsics, the measure of what the JIT makes of assets/shaders.
//
// The same mathematics: Kinora's noise (jit/math/noise_p.h), the fast tier's sine and power, RSL's
// rule that x / 0 is 0, one square root and one division a normalisation. The same shape: light
// functions fill records for all points, then the surface loops over points and records. The
// shaders' default parameters are constants, as they are in the compiled kernel.
#pragma once

#include <cstddef>

namespace kinora::hand {

// One array a component; all aligned to 64 bytes and padded to 16 points.
struct Inputs {
    const float *N[3], *Ng[3], *I[3], *P[3];
    const float* object[3][4];  // rows of object_from_current
};
struct Outputs {
    float *Ci[3], *Oi[3];
};

struct Record {
    bool ambient = false;
    float nondiffuse = 0, nonspecular = 0;
    float *L[3] = {}, *Cl[3] = {};
};

// A directional light's axis and color, an ambient light's color.
struct Light {
    float axis[3], color[3];
};

struct Shaders {
    void (*solar)(const Light& light, const Record& record, size_t count);
    void (*ambient)(const Light& light, const Record& record, size_t count);
    using Surface = void (*)(const Inputs& in, const Outputs& out, const Record* records,
                             size_t record_count, size_t count);
    Surface plastic, marble, wood, fbm_ramp;
};

// Null if this build's -march has not got the instructions.
const Shaders* avx2();
const Shaders* avx512();

}  // namespace kinora::hand
