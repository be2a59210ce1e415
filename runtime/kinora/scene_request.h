// runtime/kinora/scene_request.h: a scene and how it is to be seen. Each member is an option of
// kinora-render and kinora-play.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/kinora/frame_list.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/load/override_environment.h"
#include "runtime/scene/quality/quality.h"
#include "runtime/scene/scene_options.h"

namespace kinora {

struct SceneRequest {
    std::string scene;
    std::optional<FrameRate> fps;
    std::string clip;
    int width = 0, height = 0;  // 0: 640 x 640 / aspect
    double scale = 1;           // of width and height
    std::string camera;
    bool follow = false;
    std::optional<int> turntable;  // frames of a full turn
    double yfov = 0;               // degrees; 0: the camera's own
    std::optional<dvec3> look_from;
    std::string look_at;  // X,Y,Z or a node; "": nothing
    int threads = 0;      // 0: all
    const jit::Target* target = nullptr;
    std::string target_missing;   // asked for, not on this CPU
    Quality quality;              // a preset with single options put over it
    bool fixed_settings = false;  // quality was asked for: not what a file says of samples
    size_t dice_limit = 0;        // 0: the scene's own
    double filter_width = 0;
    uint32_t seed = 0;
    LightSet lights = LightSet::Auto;
    uint32_t gi = 0;  // bounces of indirect light, whatever shaders ask for
    EnvironmentGiven environment;
    double exposure = 0;  // stops
    bool auto_exposure = false;
    std::optional<vec3> background;
    raytrace::NanPolicy nan = raytrace::NanPolicy::Zero;
    std::optional<ColorEncoding> color;                        // nothing: encoding_of()
    std::vector<std::pair<std::string, std::string>> shaders;  // MATERIAL or LIGHT, SHADER
    std::vector<std::pair<std::string, std::string>> params;   // MATERIAL.NAME, VALUE
    std::vector<std::string> hide, only;                       // nodes
    std::string imager;      // one of ours by name, FILE.sl, "none"; "": the scene's own
    std::string atmosphere;  // likewise
    int world = -1;          // of the pictures in a RIB file; -1: the last
    std::shared_ptr<raytrace::KeptTrees> trees;  // SceneOptions::trees
    std::vector<std::string> aovs;               // NAME or NAME:FILTER: runtime/scene/aovs
    std::vector<std::string> light_groups;       // SceneOptions::light_groups
    bool displays = false;  // the displays that a file has besides its picture are wanted
    std::vector<std::string> include_directories;
    std::optional<UpAxis> up_axis;
    std::optional<double> meter;
    std::optional<double> smooth;  // ImportOptions
    TransparencyMode transparency = TransparencyMode::Auto;
    EmissionMode emission = EmissionMode::Auto;
    bool vertex_colors = true;
    bool ignore_required = false;
    std::vector<std::string> allow_external;  // folders
    bool confine = false;                     // pictures too
    bool strict = false;                      // what is missing or left out is an error
    PrintTo print;                            // of shaders
    std::vector<std::string> words;  // what was given of the scene's options, one word each

    Judgement judgement() const { return strict ? Judgement::Strict : Judgement::Rendering; }
};

// What --color says, else by the scene's format: RIB's pictures have no curve.
ColorEncoding encoding_of(const SceneRequest& request);

}  // namespace kinora
