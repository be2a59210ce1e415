// rsl/model/renderer_services.h: the contract between compiled shaders and a renderer: what light
// records hold, and what the values of services mean that services.def lists. kernel_keys.h says
// what kernel inputs and outputs are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rsl/model/services.h"

namespace kinora::rsl {

// Columns of a light record, as RecordField reads them. L points from the surface to the light,
// not normalised (solar: unit length). lit is an int. Messages the surface asks for follow; they
// are 0 where the light has no such parameter.
enum LightColumn {
    kLightL = 0,
    kLightCl = 3,
    kLightOl = 6,
    kLightLit = 9,
    // Of a sample of a light: how dense its light's samples are about L, by solid angle: their
    // number times the pdf. 0 where there is no sample, and in all other records.
    kLightDensity = 10,
    kLightBare = 11,  // Cl before shadow rays, where the surface reads it
    // int, of renderers: the light's number and 1, where points have different lights. No shader
    // reads it; null elsewhere.
    kLightLamp = 14,
    kLightMessages = 15,
    // No column of a record, but an output of light kernels: the angle, radians, between the axis
    // of solar and the side of the cone that light comes from.
    kLightSpread = 255
};

// Uniforms of a light record, as RecordUniform reads them.
enum LightUniform {
    kLightKind = 0,         // int LightKind
    kLightCategories = 1,   // int: bit j set where the light matches LoweredShader::categories[j]
    kLightNondiffuse = 2,   // the light's __nondiffuse, 0 if it has none
    kLightNonspecular = 3,  // the light's __nonspecular, 0 if it has none
    kLightNumber = 4,       // int: which light it is, for QueryKind::Light
    kLightHandle = 5,       // int: the first record of the light in set 0, which is its handle
    kLightSampled = 6,      // int: not 0 where the record is one of several samples of the light
    kLightUniforms = 7      // then one int for each of LoweredShader::light_messages: nonzero
                            // where the light has that parameter
};

// What a light with sample methods is asked for (the service "samplewish").
enum class SampleWish : int32_t { Generate = 0, Evaluate = 1 };

// An ambient record has no direction: it is seen by ambient() only, never by illuminance.
enum LightKind { kLightAmbient = 0, kLightIlluminate = 1, kLightSolar = 2 };

// A ray of a gather: columns of its record, then the wanted results in their order.
enum GatherColumn { kGatherState = 0, kGatherResults = 1 };
enum GatherState { kGatherMiss = 0, kGatherHit = 1, kGatherNone = 2 };  // None: no such sample here
enum GatherFlag { kGatherCosine = 1, kGatherNoRays = 2, kGatherHitsOnly = 4 };  // HitsOnly: no else
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
    Light,      // a parameter as it is bound, of the light whose record has the number `point`
    ShaderName  // the name asked for is the shader's kind
};
// In place of an element: how many the array has that is asked about, as the first number.
inline constexpr int32_t kQueryLength = -2;
enum class PhotonKind : int32_t { Map, Caustic, Subsurface };

// The process-wide, thread-safe table of strings that shaders handle: id <-> text. Id 0 is "".
int32_t intern(std::string_view text);
const std::string& interned(int32_t id);
int32_t interned_count();

}  // namespace kinora::rsl
