// rsl/model/renderer_services.h: the contract between compiled shaders and a renderer: how kernel
// inputs and outputs are named, what light records hold, and what the values of services mean that
// services.def lists.
//
// clang-format off
// Kernel inputs (component suffixes: .x .y .z for point-like, .r .g .b for color, none for float):
//   point rate   P dPdu dPdv N Ng u v du dv s t I Cs Os dNdu dNdv dIdu dIdv dsdu dsdv dtdu dtdv
//                Ps Ns             light shaders
//                rng               int: hash of pixel, sample, path and frame seed
//                param:LAYER:NAME[.c]         a parameter bound to a vertex input, and its partial
//                param:LAYER:NAME[.c]:du :dv  derivatives; points, vectors and normals in "object".
//                                  LAYER: the shader's index in its stack, 0 in a light
//                1                 1 everywhere: the derivative of u by u and of v by v
//                Cs and Os only where a ParamBinding has that name (as param:LAYER:Cs.r), else 1
//   frame rate   E time dtime camera:near camera:far (clipping distances, for depth())
//                param:LAYER:NAME[.c]         a parameter; ints for strings (interned ids)
//                param:LAYER:NAME[k][.c]      an array parameter's element; the components of a
//                                  matrix are .0 to .15, row-major for row vectors as RSL has it
//   both         space:NAME:to_current:RC and space:NAME:from_current:RC, R row 0..2 (0..3 for
//                screen, NDC, raster), C column 0..3 of a matrix on column vectors. Point rate for
//                "object" and "shader" in surfaces, displacements and volumes (twelve inputs each,
//                gathered only where named); frame rate for all else. In a light, "shader" is the
//                light's own node, frame rate. "current" = camera space.
//                Ci Oi             volumes: of the surface behind; imagers: of the pixel, with alpha;
//                                  P of an imager is the pixel's place in the raster
// Kernel outputs: Ci.r.. Oi.r.. N.x.. P.x.. alpha (imagers) aov:NAME[.c]; of a light shader, for statement k:
//   light:k:L.x..   from Ps to the light, as a record has it (RSL's L inside illuminate, reversed)
//   light:k:Cl.r..  light:k:Ol.r..  light:k:lit (int, nonzero in the cone; else Cl and Ol are 0)
//                   Triples that are 0 at all points have no outputs; nor has a lit that is 1.
//   message:NAME[.c]  its parameters
// An ambient light has statement 0 alone, with L = 0 and lit = 1. In a light P is the origin of its
// "shader" space (no input of its own), N is Ns; on geometry (LowerOptions::area_light) P N Ng dPdu
// dPdv u v s t are inputs at a sample of the mesh.
// clang-format on
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rsl/model/services.h"

namespace kinora::rsl {

// Columns of a light record, as RecordField reads them. L points from the surface to the light,
// not normalised (solar: unit length). lit is an int. Messages the surface asks for follow; they
// are 0 where the light has no such parameter.
enum LightColumn { kLightL = 0, kLightCl = 3, kLightOl = 6, kLightLit = 9, kLightMessages = 10 };

// Uniforms of a light record, as RecordUniform reads them.
enum LightUniform {
    kLightKind = 0,         // int LightKind
    kLightCategories = 1,   // int: bit j set where the light matches LoweredShader::categories[j]
    kLightNondiffuse = 2,   // the light's __nondiffuse, 0 if it has none
    kLightNonspecular = 3,  // the light's __nonspecular, 0 if it has none
    kLightUniforms = 4      // then one int for each of LoweredShader::light_messages: nonzero
                            // where the light has that parameter
};

// An ambient record has no direction: it is seen by ambient() only, never by illuminance.
enum LightKind { kLightAmbient = 0, kLightIlluminate = 1, kLightSolar = 2 };

// A ray of a gather: columns of its record, then the wanted results in their order.
enum GatherColumn { kGatherState = 0, kGatherResults = 1 };
enum GatherState { kGatherMiss = 0, kGatherHit = 1, kGatherNone = 2 };  // None: no such sample here
enum GatherFlag { kGatherCosine = 1, kGatherNoRays = 2 };
inline constexpr int kGatherLevels = 8;  // gathers inside one another
// Numbers of one point of a point file.
inline constexpr int kPointFloats = service_argument(Service::bake3d, "values").count;

// What the service "query" looks in.
enum class QueryKind : int32_t {
    Attribute,
    Option,
    RendererInfo,
    RayInfo,
    Surface,  // parameters of other shaders
    Displacement,
    Atmosphere,
    Incident,
    Opposite,
    ShaderName  // the name asked for is the shader's kind
};
enum class PhotonKind : int32_t { Map, Caustic, Subsurface };

// The process-wide, thread-safe table of strings that shaders handle: id <-> text. Id 0 is "".
int32_t intern(std::string_view text);
const std::string& interned(int32_t id);
int32_t interned_count();

}  // namespace kinora::rsl
