// tests/rsl/differential.h: random points for the tests of lowered code against the reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "rsl/reference/reference.h"
#include "tests/rsl/run_shader.h"

namespace kinora::rsl {

struct Random {
    uint64_t state;
    uint32_t next() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return uint32_t(state >> 32);
    }
    float uniform(float lo, float hi) { return lo + (hi - lo) * float(next() * 0x1p-32); }
    // Anything that a float can be.
    float wild() {
        static const float kEdges[] = {
            0,     -0.0f,       1e-40f,       -1e-45f,       1.17549435e-38f, 3.4e38f, -3.4e38f,
            1e30f, -1e30f,      1e-30f,       HUGE_VALF,     -HUGE_VALF,      NAN,     0.5f,
            1,     16777216.0f, 2147483648.f, -2147483648.f, 8388607.5f,      -7};
        if (next() % 2) return kEdges[next() % std::size(kEdges)];
        return next() % 2 ? uniform(-4, 4) : std::bit_cast<float>(next());
    }
    float argument(bool moderate) {
        if (moderate) return uniform(-2, 2);
        static const float kEdges[] = {0,    -0.0f, 1,     -1,          0.5f,      -0.5f,
                                       2,    3,     1e-7f, 1e-30f,      1e-40f,    100,
                                       1e9f, -3e9f, 1e20f, 0.99999994f, 1.0000001f};
        switch (next() % 8) {
            case 0:
                return kEdges[next() % std::size(kEdges)];
            case 1:
            case 2:
                return uniform(0, 1);
            case 3:
                return uniform(-100, 100);
            default:
                return uniform(-2, 2);
        }
    }
};

// Columns by input name, and what the reference sees at one point of them.
using Columns = std::map<std::string, std::vector<float>>;

inline ReferenceInputs at_point(const Columns& columns, const std::set<std::string>& ints,
                                size_t i) {
    ReferenceInputs inputs;
    for (auto& [name, values] : columns) {
        float x = values[values.size() == 1 ? 0 : i];
        inputs.values[name] = ints.count(name) ? double(std::bit_cast<int32_t>(x)) : double(x);
    }
    return inputs;
}

inline double ulp(double exact) {
    int exponent = exact == 0 ? -126 : std::max(std::ilogb(exact), -126);
    return std::ldexp(1.0, exponent - 23);
}

}  // namespace kinora::rsl
