// tests/rsl/shader_difference.h: one shader source through the reference, the interpreter and every
// target: do they agree?
#pragma once

#include <string>

#include "tests/rsl/run_shader.h"

namespace kinora::rsl {

// Values of outputs at points, by how they were judged. Nothing is left out silently.
struct DifferenceCounts {
    size_t shaders = 0;
    size_t rejected = 0;      // sources that did not compile
    size_t values = 0;        // interp against the reference
    size_t undecided = 0;     // float and double branch, floor or hash differently
    size_t extreme = 0;       // not finite, or beyond float
    size_t unstable = 0;      // float arithmetic alone loses more than the answer's size there
    size_t no_reference = 0;  // a row without reference meaning was called
    size_t bits = 0;          // values of targets against interp, bit for bit
    uint64_t digest = 0;      // of interp's values: the same on every machine (scripts/same_bits)
    std::string first_rejection;
};

// Sources of co-shaders stand behind a line "//// HANDLE" each: the shader before them is linked
// with them.
//
// Compiles and runs the last shader of the source on the world of `world`; a surface together with
// the displacements before it, if the source has nothing else. "" if all agree; else what differs.
// Parameters frame_* and vary_* are bound to frame and point inputs.
//
// The stated error of interp against the double reference: 16 times the largest that rounding the
// inputs, or computing in float, moves the reference at that point (11 samples), plus 2e-5 of 1 +
// the value. Where that moves a branch or a whole number, and where a row is asked for more than it
// promises (mod() of 2^24 turns, fresnel() of vectors not of length 1: Reference::no_promise), the
// point is undecided. Lowering folds x * 0 to 0 (docs/decisions.md#specialise-on-shape-only), the
// reference does not: that can only matter where x is not finite; the reference's own answer then
// is not either (extreme), unless a comparison swallows the NaN, which would be reported as a
// difference.
std::string shader_difference(const std::string& source, uint64_t world, DifferenceCounts& counts);

// Every target of this CPU against interp, bit for bit, on the inputs that `run` has (its kernels
// are interp's, then those of the last target). "" or what differs; values are counted as bits.
std::string target_difference(RunShader& run, size_t points, DifferenceCounts& counts);

// "" if emitting the shader's kernels twice gives the same bytes on every target.
std::string emission_difference(const jit::Module& lowered);

}  // namespace kinora::rsl
