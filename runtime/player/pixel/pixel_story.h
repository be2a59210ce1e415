// runtime/player/pixel/pixel_story.h: how a pixel came by its color: each shading point of one of
// its samples, every variable after every statement.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/kinora/disassembly/disassembly.h"

namespace kinora {

struct FrameSettings;
struct Pose;
struct Scene;
class SourceFiles;

// A variable after a statement.
struct StoryVariable {
    std::string name, type;     // "Ci", "color"
    bool varying = false;       // else one value for all points
    bool text = false;          // its values are `texts`
    std::vector<float> values;  // components of all elements
    std::vector<std::string> texts;
    bool nan = false;
};

// What a statement changed, in the order they ran. A shader begins with a step that lists its
// parameters and the globals that it reads; a turn of illuminance with L, Cl and Ol.
struct StoryStep {
    std::string inside;  // "surface matte", "function blend"
    std::string file;
    int line = 0;                // from 1; 0: of no file
    std::string source;          // the line, without its margin
    std::vector<int32_t> turns;  // of the loops around it, from 0
    std::string light;           // of the turn of illuminance
    std::vector<StoryVariable> changes;
};

// Does the reference evaluator come to the kernel's result?
enum class Agreement : uint8_t {
    Agrees,
    Differs,
    Undecided,    // rounding turns a branch there
    Unexplained,  // something was not recorded, has no meaning in the reference, or is too long
};

struct PointStory {
    std::string material, shader;
    std::array<float, 3> Ci{}, Oi{};                 // of the kernel
    std::array<float, 3> reference_Ci{}, allowed{};  // and how far they may be apart
    Agreement agreement = Agreement::Unexplained;
    std::string why;  // where it does not agree; one sentence
    std::vector<StoryStep> steps;
    bool cut = false;              // more steps than are kept
    std::string target;            // "avx512"
    std::vector<MachineRun> code;  // of its kernel, a run for each stretch of one line
    std::string no_code;           // why there is none
    std::string nan_file;          // where the first NaN arose, ""  nowhere
    int nan_line = 0, nan_column = 0;
};

// A ray that was shot for the sample: by the camera, a shader, or the tests whether a light is
// seen.
struct StoryRay {
    enum class Kind : uint8_t { Eye, Traced, Shadow };
    Kind kind;
    dvec3 from, to;  // world
    bool hit;        // a surface ends it; of Shadow: it blocks the light
};

struct PixelStory {
    int x = 0, y = 0, sample = 0;
    double frame = 0;
    vec4 color{0.0f};                // of the sample: linear, associated, without the imager
    std::vector<PointStory> points;  // that the camera's ray met, the nearest first
    std::vector<StoryRay> rays;      // in the order they were shot
    bool rays_cut = false;           // more than are kept
};

// Before the first frame of a program in which stories are told while frames are under way.
void prepare_stories();

// Runs sample `sample` of the pixel at that time again, as render_frame() with these settings. The
// pose stands at the time afterwards, prints nothing and bakes nothing. Other poses may be rendered
// meanwhile. `files`: that the shaders' locations speak of. Without points where nothing is there
// or the camera makes no picture.
PixelStory pixel_story(const Scene& scene, Pose& pose, double time, const FrameSettings& settings,
                       const SourceFiles& files, int x, int y, int sample);

std::string to_json(const PixelStory& story);
// A text in quotation marks, as JSON has it.
std::string json_text(std::string_view text);

// The variable after the last step at that line that changed it; null: none.
const StoryVariable* find_variable(const PixelStory& story, std::string_view name, int line);

// "eye", "traced", "shadow".
std::string_view ray_text(StoryRay::Kind kind);
std::string_view agreement_text(Agreement agreement);

}  // namespace kinora
