// rsl/model/kernel_keys.h: what kernel inputs and outputs are. Lowering makes the keys, a renderer
// looks them up; text() gives the names that dumps have:
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
//                light:k:L.x       in a light: L of statement k, a solar with an angle, where it is not 0
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
//                                  P of an imager is the pixel's position in the raster
// Kernel outputs: Ci.r.. Oi.r.. N.x.. P.x.. alpha (imagers) aov:NAME[.c]; of a light shader, for statement k:
//   light:k:L.x..   from Ps to the light, as a record has it (RSL's L inside illuminate, reversed)
//   light:k:Cl.r..  light:k:Ol.r..  light:k:lit (int, nonzero in the cone; else Cl and Ol are 0)
//   light:k:spread  the angle of solar's cone
//                   What is 0 at all points has no outputs; nor has a lit that is 1.
//   message:NAME[.c]  its parameters
// An ambient light has statement 0 alone, with L = 0 and lit = 1. In a light P is the origin of its
// "shader" space (no input of its own), N is Ns; on geometry (LowerOptions::area_light) P N Ng dPdu
// dPdv u v s t are inputs at a sample of the mesh.
// clang-format on
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "jit/ir/ir.h"
#include "rsl/model/globals.h"
#include "rsl/model/renderer_services.h"

namespace kinora::rsl {

enum class KeyKind : uint8_t {
    None,  // IR that no shader made
    Global,
    One,  // 1 everywhere
    Rng,
    CameraNear,
    CameraFar,
    Parameter,
    SpaceToCurrent,
    SpaceFromCurrent,
    LightRecord,
    Aov,
    Message,
};

// The number itself, or its change along u or v.
enum class Partial : uint8_t { None, Du, Dv };

// An input of a kernel, with or without inputs for its changes along u and v.
enum class Slopes : uint8_t { None, Given };

// What a number is a component of.
enum class ComponentForm : uint8_t { Single, Triple, Color, Matrix };
constexpr ComponentForm form_of(BaseType type) {
    return type == BaseType::Color    ? ComponentForm::Color
           : type == BaseType::Matrix ? ComponentForm::Matrix
           : is_triple(type)          ? ComponentForm::Triple
                                      : ComponentForm::Single;
}

// One number that a kernel takes or gives. Two keys are equal where their names are.
struct KernelKey {
    KeyKind kind = KeyKind::None;
    ComponentForm form = ComponentForm::Single;
    uint8_t component = 0;  // of the form; of a space, row * 4 + column
    Partial partial = Partial::None;
    uint32_t layer = 0;    // Parameter: the shader in its stack; LightRecord: the statement
    int32_t name = 0;      // Global: a Global; LightRecord: a LightColumn; else a name_id()
    int32_t element = -1;  // of an array; -1: it is none

    auto operator<=>(const KernelKey&) const = default;

    Global global() const { return Global(name); }
    LightColumn light_column() const { return LightColumn(name); }
    int row() const { return component / 4; }  // of a space's matrix on column vectors
    int column() const { return component % 4; }
    bool is_space() const {
        return kind == KeyKind::SpaceToCurrent || kind == KeyKind::SpaceFromCurrent;
    }
};

KernelKey global_key(Global id, int component = 0);
constexpr KernelKey plain_key(KeyKind kind) {  // One, Rng, CameraNear, CameraFar
    return {.kind = kind};
}
KernelKey parameter_key(uint32_t layer, std::string_view name, int element, ComponentForm form,
                        int component);
KernelKey space_key(std::string_view space, bool to_current, int row, int column);
KernelKey light_key(size_t statement, LightColumn column, int component = 0);
KernelKey aov_key(std::string_view name, int element, ComponentForm form, int component);
KernelKey message_key(std::string_view name, int element, ComponentForm form, int component);
// The input that holds a change of this one; None where it is 0. Globals and parameters only.
KernelKey partial_key(KernelKey key, Partial partial);

// The name in dumps: "P.x", "param:0:Kd"; "" for None.
std::string text(const KernelKey& key);

// Which number of its parameter it is, all elements counted.
int number_index(const KernelKey& key);

// Names of parameters and spaces by number. Process-wide; not the strings that shaders handle.
int32_t name_id(std::string_view name);
const std::string& name_of(const KernelKey& key);  // Parameter, Aov, Message and spaces

// As jit carries it.
inline jit::FrontEndKey packed(const KernelKey& key) {
    return std::bit_cast<jit::FrontEndKey>(key);
}
inline KernelKey key_of(const jit::InputInfo& input) {
    return std::bit_cast<KernelKey>(input.key);
}
inline KernelKey key_of(const jit::OutputInfo& output) {
    return std::bit_cast<KernelKey>(output.key);
}

}  // namespace kinora::rsl
