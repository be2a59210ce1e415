// runtime/scene/ri/state/graphics_state.h: options and attributes of the interface: what blocks
// save and restore (3.2, section 4).
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rsl/model/shader.h"
#include "runtime/base/diagnostic.h"
#include "runtime/base/math.h"
#include "runtime/scene/description/curved_surface.h"
#include "runtime/scene/description/file_picture.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/ri/calls/declaration.h"

namespace kinora::ri {

// A parameter that a request gives a shader.
struct ShaderArgument {
    std::string name;
    Type type = Type::Float;
    std::vector<double> numbers;
    std::vector<std::string> strings;
};

// A shader as a request binds it. Shared by the attributes of all that came after it.
struct ShaderBinding {
    std::shared_ptr<const rsl::Shader> shader;
    std::vector<ShaderArgument> arguments;
    dmat4 to_camera{1.0};  // from "shader" space: the transformation at the request
    Location where;
    std::string layer;             // its name as a layer; "": it has none
    std::vector<LayerLink> links;  // from layers below it
};
using Binding = std::shared_ptr<const ShaderBinding>;

// One that others find by its handle.
struct CoShader {
    std::string handle;
    Binding shader;
};

struct LightBinding {
    ShaderBinding shader;
    int number = 0;        // its handle's
    bool shadows = false;  // traced
    int samples = 0;       // of an area light; 0: not said
    bool area = false;     // of geometry, not of a place
};
using Light = std::shared_ptr<const LightBinding>;

struct Basis {
    dmat4 matrix{1.0};  // matrix[column][row]
    uint32_t step = 3;
};

struct Projection {
    bool perspective = false;
    double fov = 90;         // degrees, of the shorter side
    dmat4 from_camera{1.0};  // the transformation at the request
};

// What Option and Attribute were told, by "group:name"; shared by all blocks until one changes it.
struct ToldValue {
    std::vector<double> numbers;
    std::vector<std::string> strings;
};
using ToldValues = std::map<std::string, ToldValue, std::less<>>;

struct Options {
    std::shared_ptr<const ToldValues> told;  // null: nothing
    int width = 640, height = 480;
    double pixel_aspect = 1;
    std::optional<double> frame_aspect;
    std::optional<std::array<double, 4>> screen_window;  // left right bottom top
    std::array<double, 4> crop = {0, 1, 0, 1};           // xmin xmax ymin ymax
    Projection projection;
    double near = 1e-10, far = 1e38;
    std::vector<dvec4> planes;  // n . p + w > 0 is cut off; camera space
    double shutter_open = 0, shutter_close = 0;
    std::optional<std::array<double, 2>> samples;
    std::string filter;  // by its name; of the program's own: ""
    double filter_width = 2, filter_height = 2;
    std::vector<float> filter_values;  // FilePicture has it
    Exposure exposure;
    // By what they hold: "rgba", "z", or a variable that had its own.
    std::map<std::string, Quantization, std::less<>> quantizations = {{"z", {0, 0, 0}}};
    std::vector<FileDisplay> displays;
    std::vector<Binding> imagers;
    double relative_detail = 1;
    // 3 by n numbers to RGB, and their count; empty: colours are RGB.
    std::vector<double> to_rgb;
    std::map<std::string, std::vector<std::string>, std::less<>> search_paths;  // "shader"
};

struct Attributes {
    std::shared_ptr<const ToldValues> told;  // null: nothing
    dvec3 color{1.0}, opacity{1.0};
    std::array<double, 8> corners = {0, 0, 1, 0, 0, 1, 1, 1};
    std::vector<Binding> surfaces, displacements, deformations;  // bottom first
    std::vector<Binding> atmospheres, interiors, exteriors;
    std::vector<CoShader> co_shaders;  // that a shader can find which is bound now
    std::vector<Light> lights;         // that are on, in the order in which they came
    Light area_light;                  // what comes is geometry of it
    bool no_surface = false;           // Surface "null": what comes is black
    double shading_rate = 1;
    Visibility visibility;
    bool two_sided = true;
    // The orientation differs from the handedness of the transformation, so that surfaces are
    // turned inside out. A mirror changes both, and this not.
    bool inside_out = false;
    std::array<double, 6> detail_box{};
    bool has_detail = false, in_detail_range = true;
    Basis u, v;
    std::vector<TrimLoop> trims;
    bool trim_outside = false;
    std::string name;  // Attribute "identifier" "name"
    bool light_shadows = false;
    int light_samples = 0;
};

}  // namespace kinora::ri
