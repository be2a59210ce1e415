// rsl/directions/direction.h: values of the IR that point along N, told by the instructions that
// compute them.
#pragma once

#include <array>
#include <cstdint>

#include "jit/ir/builder.h"

namespace kinora::rsl {

// The globals that directions are told by.
enum class Base : uint8_t { None, N, Ng, I };

// A positive multiple of a global, or of its opposite.
struct Direction {
    Base base = Base::None;  // None: not known
    bool opposite = false;
    Base faced = Base::None;  // of N and -N the one that faces against I, by this global
    bool operator==(const Direction&) const = default;
};

// The direction of a vector: N, normalize(N), -N, faceforward(N, I) and what is written like them.
Direction direction_of(jit::Builder& b, const std::array<jit::Value, 3>& v);

}  // namespace kinora::rsl
