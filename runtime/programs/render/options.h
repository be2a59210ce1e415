// runtime/programs/render/options.h: what kinora-render was asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/kinora/scene_request.h"
#include "runtime/picture/trade/target.h"
#include "runtime/player/session/session.h"
#include "runtime/programs/common/finding_printer.h"
#include "runtime/programs/common/progress.h"
#include "runtime/programs/common/standard_streams.h"

namespace kinora {

struct RenderOptions : SceneRequest {
    RenderOptions() { print = print_to(stdout); }

    FindingOptions findings;
    std::string output;
    bool discard = false;  // -o null: pictures are rendered and not written
    ExrFormat exr;         // but for its depth, which is a setting of quality
    std::string owner;     // for the header
    bool stamp = false;    // the header has the time and the machine
    std::string contact_sheet;
    std::string tradeoff;  // folder
    double budget = 120;   // seconds
    std::vector<std::string> asserts;
    FrameTarget frame_target;  // what samples and settings are chosen by
    std::string measured;      // a tradeoff.json for that, or its folder
    std::optional<std::vector<int64_t>> frames;
    std::optional<double> time;  // seconds: one frame at that time
    bool skip_existing = false;
    bool keep_going = false;
    bool stats = false, stats_json = false;
    std::string explain;  // "text" or "json": what is modelled and what is left out
    std::string preset;   // the name that --quality gave, or the default
    ProgressStyle progress = ProgressStyle::Lines;
    std::string list;               // "cameras", ..., "all"; "" = render
    bool json = false;              // of the list
    std::vector<std::string> dump;  // stages: "ir", "ir:fold", "asm", ...
    // Read already: its options are among those above, with what the command line put over them.
    std::optional<Session> session;
};

// A program that takes the options of scenes and pictures, and some of its own.
struct OwnOption {
    const char* names;
    std::string* text;  // what is given; null: a flag
    bool* flag;
    const char* help;
};
struct SceneProgram {
    const char* name;
    const char* what;
    std::vector<OwnOption> own;
};
// As below, without the options that say which files are written and how.
std::optional<int> parse_scene_options(int argc, char** argv, const SceneProgram& program,
                                       RenderOptions& options);

// What the options of a session ask for, without any other. Nothing where it cannot be read.
std::optional<RenderOptions> options_of_session(const std::string& file, std::string& error);

// Reads the command line. Returns an exit code when there is nothing to render (help, usage error,
// which is printed), nothing otherwise.
std::optional<int> parse_render_options(int argc, char** argv, RenderOptions& options);

}  // namespace kinora
