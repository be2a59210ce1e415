// rsl/model/heuristics.h: how samples of lights and of materials are weighed against each other
// (E. Veach and L. Guibas 1995): by their densities to a power.
#pragma once

namespace kinora::rsl {

struct Heuristic {
    const char* name;  // as "heuristic" of directlighting() says it
    float power;
};
// The first is taken where nothing is said.
inline constexpr Heuristic kHeuristics[] = {{"veachpower2", 2}, {"power", 2}, {"balance", 1}};

}  // namespace kinora::rsl
