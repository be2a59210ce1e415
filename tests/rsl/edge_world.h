// tests/rsl/edge_world.h: points, parameters, lights and services with anything that a float can
// be, for comparing targets bit for bit. The reference promises nothing there.
#pragma once

#include "tests/rsl/differential.h"

namespace kinora::rsl {

// Points by turns: random; some, then all numbers wild (Random::wild); places that coincide;
// vectors of length 0; degenerate derivatives; huge; denormal.
Columns edge_points(uint64_t seed, size_t points);

// One component at `points` points, of the same turns.
std::vector<float> edge_column(Random& random, size_t points);

// Binds every parameter that is no string, by its rate, to numbers of which half are wild. As it
// is named in kernels, layer 0.
void bind_edges(const Shader& shader, Random& random, size_t points,
                std::vector<ParamBinding>& params, Columns& columns);

// What else the kernels read (matrices of spaces, E, clipping distances, slopes of parameters),
// four lights that differ from point to point, and services whose answers are pure functions of
// their arguments' bits: half of them wild. Call it before kernels of other targets are compiled.
void add_edge_world(RunShader& run, uint64_t seed, size_t points);

}  // namespace kinora::rsl
