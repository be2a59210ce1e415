// rsl/builtins/source_p.h: a light's surface as rays sample it: what of it is hidden from a point.
#pragma once

#include <array>
#include <vector>

#include "rsl/lower/builtin_call.h"

namespace kinora::rsl::lower_source {

// A parallelogram from its corner, or with `twist` any other quadrilateral:
// corner + across x + up y + twist x y.
struct Source {
    V3 corner, across, up;
    const V3* twist = nullptr;
};

// The share of each color that does not come through from `side` by `side` jittered cells.
inline V3 hidden_share(LowerCall& c, const V3& P, const Source& source, int side) {
    auto& e = c.e;
    Value sum[3] = {e.f(0), e.f(0), e.f(0)};
    for (int k = 0; k < side * side; ++k) {
        auto offset = [&](int cell, int component) {
            Value jitter = c.seeds.random01(c.call, 2 * k + component);
            return e.mul(c.b.add(e.f(float(cell)), jitter), e.f(1.0f / float(side)));
        };
        Value x = offset(k % side, 0), y = offset(k / side, 1);
        V3 Q = e.fma(source.across, x, e.fma(source.up, y, source.corner));
        if (source.twist) Q = e.fma(*source.twist, e.mul(x, y), Q);
        auto seed = c.seeds.sample(c.call.site + uint32_t(k) * 7919u);
        std::vector<Value> through = c.services.call(
            Service::transmission, std::array{seed[0], seed[1], P[0], P[1], P[2], Q[0], Q[1], Q[2],
                                              e.f(1), e.f(0), c.pair("bias", -1)});
        for (size_t i = 0; i < 3; ++i) sum[i] = c.b.add(sum[i], through[i]);
    }
    V3 hidden;
    for (size_t i = 0; i < 3; ++i)
        hidden[i] = e.fma(sum[i], e.f(-1.0f / float(side * side)), e.f(1));
    return hidden;
}

}  // namespace kinora::rsl::lower_source
