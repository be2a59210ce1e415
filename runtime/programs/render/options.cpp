// runtime/programs/render/options.cpp: kinora-render's command line.
#include "runtime/programs/render/options.h"

#include <unistd.h>

#include <cmath>

#include "runtime/base/file_extension.h"
#include "runtime/base/numbers.h"
#include "runtime/base/regular_file.h"
#include "runtime/kinora/open_scene.h"
#include "runtime/programs/common/command_line.h"
#include "runtime/programs/common/list_scene.h"
#include "runtime/programs/render/exr_options.h"
#include "runtime/programs/render/quality_options.h"
#include "runtime/programs/render/session_words.h"
#include "runtime/programs/render/trade_options.h"
#include "runtime/scene/build/views.h"

namespace kinora {

namespace {

constexpr double kMostSeconds = 1e9;
constexpr double kMostFilterWidth = 64;  // pixels

// Of those that every program with a scene takes.
constexpr std::string_view kNotOfThePicture[] = {"scene",  "--session", "--frames",  "--time",
                                                 "--help", "--version", "--threads", "--target"};
void parse_size(const std::string& text, RenderOptions& o) {
    int size[2];
    if (!read_numbers<int>(text, 'x', size) || size[0] < 1 || size[1] < 1 || size[0] > 65536 ||
        size[1] > 65536)
        throw CLI::ValidationError("--size", "takes WIDTHxHEIGHT, each 1 to 65536");
    o.width = size[0], o.height = size[1];
}

vec3 parse_color(const std::string& text) {
    float c[3];
    if (!read_numbers<float>(text, ',', c) || !std::isfinite(c[0] + c[1] + c[2]))
        throw CLI::ValidationError("--background", "takes R,G,B");
    return {c[0], c[1], c[2]};
}

void choose_target(const std::string& name, RenderOptions& o) {
    const jit::Target* target = jit::find_target(name);
    if (!target) {
        std::string names;
        for (const jit::Target& t : jit::targets()) names += fmt::format(" {}", t.name);
        throw CLI::ValidationError("--target", "knows" + names);
    }
    if (target->supported())
        o.target = target;
    else
        o.target_missing = name;
}

void check_stages(const std::vector<std::string>& stages) {
    for (const std::string& stage : stages)
        if (stage != "ir" && stage != "asm" && !stage.starts_with("ir:"))
            throw CLI::ValidationError(
                "--dump", "takes ir, ir:PASS or asm; kinora-shade dump shows the earlier stages");
}

// "50%" or "0.5".
double parse_scale(const std::string& text) {
    bool percent = text.ends_with('%');
    double scale = 0;
    const char* last = text.data() + text.size() - (percent ? 1 : 0);
    auto [end, error] = std::from_chars(text.data(), last, scale);
    if (percent) scale *= 0.01;
    if (error != std::errc() || end != last || !(scale > 0 && scale <= 100))
        throw CLI::ValidationError("--scale", "takes 50% or 0.5, not '" + text + "'");
    return scale;
}

std::vector<std::string_view> words_of_views() {
    std::vector<std::string_view> words;
    for (const ViewWord& view : view_words()) words.push_back(view.word);
    return words;
}

// "-1.5" or "auto".
void parse_exposure(const std::string& text, RenderOptions& o) {
    constexpr double kMostStops = 60;
    o.auto_exposure = text == "auto";
    if (o.auto_exposure) return;
    const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* last = text.data() + text.size();
    auto [end, error] = std::from_chars(first, last, o.exposure);
    if (error != std::errc() || end != last || !(std::abs(o.exposure) <= kMostStops))
        throw CLI::ValidationError("--exposure",
                                   "takes stops (1.5, -2) or auto, not '" + text + "'");
}

// As they stand on the command line, where they are not yet what RenderOptions holds.
struct Given {
    std::string frames, fps, size, scale, look_from, threads = "all", target, background, exposure;
    QualityGiven quality;
    std::vector<std::string> shaders, params;
    bool overwrite = false;
    std::string stats, progress, session;
    TradeGiven trade;
    ExrGiven exr;
};

// Which pictures are written.
void declare_output(CLI::App& app, Given& given, RenderOptions& o) {
    app.add_option("-o,--output", o.output,
                   "file; with a frame token (#### or %04d) for several frames; .png or .exr; null "
                   "renders and writes nothing");
    declare_exr(app, given.exr, o);
}

// What is rendered and by what.
void declare_input(CLI::App& app, Given& given, RenderOptions& o) {
    app.footer(std::string(kExitCodeHelp) + "\n" + kEnvironmentHelp);
    app.set_version_flag("--version", app.get_name() + " " KINORA_VERSION);
    app.add_option("scene", o.scene,
                   "the scene: .dae, .zae, .kmz, .gltf, .glb or .rib; or a session");
    app.add_option("--session", given.session,
                   "FILE.kinora of kinora-play: its scene, camera, time and edits; other options "
                   "go before its own");
    auto* frames =
        app.add_option("--frames", given.frames,
                       "1-240, 1-240x2, 300, 10-1x-1, comma separated (what is animated)");
    app.add_option("--time", o.time, "one picture at this time, seconds")->excludes(frames);
    app.add_option("--fps", given.fps, "frames per second: 24, 23.976 or 24000/1001 (the file's)");
    app.add_option("--clip", o.clip, "play this clip: its range, and in glTF its motion alone");
    app.add_option("--size", given.size, "WIDTHxHEIGHT in pixels (640 x 640/aspect)");
    app.add_option("--scale", given.scale, "of the size: 50% or 0.5");
    app.add_option(
        "--camera", o.camera,
        "auto, front, back, left, right, top, iso, or a node path or id, else a camera id "
        "(the first; auto where that sees next to nothing)");
    app.add_flag("--camera-follow", o.follow, "the added camera moves with the scene's centre");
    app.add_option("--turntable", o.turntable, "frames in which an added camera goes round once")
        ->check(CLI::Range(1, int(kMostFrames)));
    app.add_option("--fov", o.yfov, "height of the camera's view in degrees (its own, else 37)");
    app.add_option("--look-from", given.look_from, "X,Y,Z: where an added camera stands");
    app.add_option("--look-at", o.look_at, "X,Y,Z or NODE: what it looks at (the scene's centre)");
    app.add_option("--threads", given.threads, "N, -N (all but N) or all (all)");
    app.add_option("--target", given.target,
                   "avx512, avx2, neon or interp (the best this CPU has)");
}

// What the picture shows of the scene, and how.
void declare_look(CLI::App& app, Given& given, RenderOptions& o) {
    add_choice<LightSet>(
        app, "--lights", o.lights,
        {{"auto", LightSet::Auto},
         {"scene", LightSet::Scene},
         {"default", LightSet::Default},
         {"both", LightSet::Both}},
        "scene, default, both or auto (the scene's; default where these show nothing)");
    app.add_option("--gi", o.gi,
                   "bounces of indirect light in every scene, whatever its shaders ask for (0)")
        ->check(CLI::Range(0, 64));
    app.add_option("--environment", o.environment.what,
                   "what lies around the scene and lights it: a picture FILE.hdr, .exr or .tx, a "
                   "color R,G,B, a light of ours such as sunsky, FILE.sl, or none (the scene's)");
    app.add_option("--environment-rotation", o.environment.rotation,
                   "degrees by which it is turned about the up axis (0)")
        ->check(CLI::Range(-1e6, 1e6));
    app.add_option("--environment-brightness", o.environment.brightness,
                   "what its light is multiplied by (1)")
        ->check(CLI::Range(0.0, 1e9));
    app.add_flag("--environment-hidden", o.environment.hidden,
                 "it lights and is mirrored, but is not seen behind the picture");
    app.add_option("--exposure", given.exposure,
                   "stops brighter (1 doubles) or darker, or auto: by the scene's whole range (0)");
    app.add_option("--background", given.background, "R,G,B instead of transparent");
    add_choice<raytrace::NanPolicy>(app, "--nan", o.nan,
                                    {{"zero", raytrace::NanPolicy::Zero},
                                     {"magenta", raytrace::NanPolicy::Magenta},
                                     {"keep", raytrace::NanPolicy::Keep}},
                                    "non-finite results become zero, magenta or keep");
    add_choice<ColorEncoding>(
        app, "--color", o.color, {{"srgb", ColorEncoding::Srgb}, {"legacy", ColorEncoding::Linear}},
        "srgb, or legacy: colours, textures and PNG neither decoded nor encoded");
    app.add_option("--imager", o.imager, "FILE.sl, the name of one of ours, or none");
    app.add_option("--atmosphere", o.atmosphere,
                   "a volume: FILE.sl, the name of one of ours, or none");
    add_list(
        app, "--aov", o.aovs,
        "NAME or NAME:FILTER: channels of the EXR: P, N, Z, ..., output parameters of surfaces, "
        "or all; --list aovs shows them",
        ',');
    add_list(app, "--light-group", o.light_groups,
             "NAME=GLOB,...: an AOV of what these lights add; may be given again");
    add_choice<UpAxis>(app, "--up", o.up_axis,
                       {{"X", UpAxis::X}, {"Y", UpAxis::Y}, {"Z", UpAxis::Z}},
                       "X, Y or Z instead of the file's up axis");
    app.add_option("--unit", o.meter, "metres per unit instead of the file's");
    add_choice<TransparencyMode>(
        app, "--transparency", o.transparency,
        {{"auto", TransparencyMode::Auto}, {"spec", TransparencyMode::Spec}},
        "auto: what the formula makes invisible everywhere is opaque; or spec");
    add_choice<EmissionMode>(
        app, "--emission", o.emission, {{"auto", EmissionMode::Auto}, {"spec", EmissionMode::Spec}},
        "auto: a factor of the diffuse color where Blender before 2.80 wrote it; or spec");
    app.add_flag("--ignore-required", o.ignore_required,
                 "show a glTF file without the extensions that it requires and Kinora lacks");
    add_choice<bool>(app, "--vertex-colors", o.vertex_colors, {{"tint", true}, {"off", false}},
                     "tint materials that are no RSL of the scene; or off");
}

// What is tried on the scene without editing it. MATERIAL and NODE are ids, names or globs.
void declare_changes(CLI::App& app, Given& given, RenderOptions& o) {
    add_list(app, "--shader", given.shaders,
             "MATERIAL=FILE.sl, LIGHT=FILE.sl: try a shader, or one of ours by name: '*=plastic' "
             "(repeatable, as those below)");
    add_list(app, "--param", given.params,
             "MATERIAL.NAME=VALUE: a shader parameter, also of lights: 0.5, 1,0,0 or a text");
    add_list(app, "--hide", o.hide,
             "NODE: without its meshes and lights and those below it; also a default light by its "
             "name");
    add_list(app, "--only", o.only, "NODE: without the meshes that are not below it");
    app.add_option(
           "--smooth", o.smooth,
           "DEGREES: normals for meshes without any, creases where faces turn by more: 0 is flat, "
           "180 smooth (40; glTF 0)")
        ->check(CLI::Range(0.0, 180.0));
    add_list(app, "-I", o.include_directories, "DIR: where shaders find #include files");
    add_list(app, "--allow-external", o.allow_external,
             "DIR: a folder that the scene may read besides its own")
        ->check(CLI::ExistingDirectory);
    app.add_flag("--confine", o.confine,
                 "read pictures too only there; else they may lie anywhere");
}

// What is told, and what of it is an error.
void declare_findings(CLI::App& app, RenderOptions& o) {
    app.add_flag("--strict", o.findings.strict,
                 "what is missing, refused or left out is an error, and there is no picture");
    add_fail_on(app, o.findings.fail_on);
    app.add_flag("-v,--verbose", o.findings.verbose, "say everything");
    app.add_flag("-q,--quiet", o.findings.quiet, "say only errors");
}

// Frames that exist or fail, and what is printed.
void declare_run(CLI::App& app, Given& given, RenderOptions& o) {
    auto* skip = app.add_flag("--skip-existing", o.skip_existing,
                              "keep whole files of the same scene and options");
    app.add_flag("--overwrite", given.overwrite, "write every frame (the default)")->excludes(skip);
    app.add_flag("--keep-going", o.keep_going, "go on after a frame that failed");
    app.add_option("--stats", given.stats, "[=json]: what each stage took, per frame, on stdout")
        ->check(one_of({"text", "json", "none"}));
    app.add_option("--explain", o.explain,
                   "[=json]: what is modelled, what is left out and why, on stdout")
        ->check(one_of({"text", "json"}));
    app.add_option("--progress", given.progress,
                   "bar, lines or none (bar on a terminal, none with -q)")
        ->check(one_of({"bar", "lines", "none"}));
    auto* list = app.add_option("--list", o.list, fmt::format("{}", fmt::join(list_kinds(), ", ")))
                     ->check(one_of(list_kinds()));
    app.add_flag("--json", o.json, "the list as JSON")->needs(list);
    add_list(app, "--dump", o.dump, "stages of each kernel: ir, ir:PASS, asm", ',');
    app.add_option("--contact-sheet", o.contact_sheet, "all frames on one PNG");
    declare_trade(app, given.trade, o);
}

void interpret_changes(const Given& given, RenderOptions& o) {
    for (const std::string& shader : given.shaders)
        o.shaders.push_back(split_pair(shader, "--shader", "MATERIAL=FILE.sl or MATERIAL=NAME"));
    for (const std::string& text : given.params) {
        o.params.push_back(split_pair(text, "--param", "MATERIAL.NAME=VALUE"));
        const std::string& target = o.params.back().first;
        size_t dot = target.rfind('.');
        if (dot == std::string::npos || dot == 0 || dot + 1 == target.size())
            throw CLI::ValidationError("--param", "takes MATERIAL.NAME=VALUE, not '" + text + "'");
    }
}

void interpret_output(const Given& given, RenderOptions& o) {
    interpret_trade(given.trade, o);
    interpret_exr(given.exr, o);
    bool nothing = o.list.empty() && o.output.empty() && o.contact_sheet.empty() &&
                   o.dump.empty() && o.explain.empty() && o.tradeoff.empty();
    if (nothing && is_regular_file(o.scene))  // else what is wrong with the scene is told
        throw CLI::RequiredError("-o FILE (or --list, --explain, --dump)");
    o.discard = o.output == "null";
    if (o.discard) o.output.clear();
    o.displays = !o.output.empty();
    if (!o.output.empty() && !is_image_path(o.output))
        throw CLI::ValidationError("-o", "takes a name that ends in .png or .exr");
    if (!o.contact_sheet.empty() && !has_extension(o.contact_sheet, {".png"}))
        throw CLI::ValidationError("--contact-sheet", "takes a name that ends in .png");
    bool pictures = !o.output.empty() || !o.contact_sheet.empty();
    if (!(o.aovs.empty() && o.light_groups.empty()) && pictures &&
        !has_extension(o.output, {".exr"}))
        throw CLI::ValidationError("--aov", "needs -o FILE.exr: only EXR holds further channels");
    o.stats = !given.stats.empty() && given.stats != "none";
    o.stats_json = given.stats == "json";
    o.progress = o.findings.quiet        ? ProgressStyle::None
                 : isatty(STDERR_FILENO) ? ProgressStyle::Bar
                                         : ProgressStyle::Lines;
    if (given.progress == "bar") o.progress = ProgressStyle::Bar;
    if (given.progress == "lines") o.progress = ProgressStyle::Lines;
    if (given.progress == "none") o.progress = ProgressStyle::None;
}

// What only cameras that are added obey.
void interpret_view(const Given& given, RenderOptions& o) {
    if (o.yfov != 0) check_range("--fov", o.yfov, 0.01, 170, "takes 0.01 to 170 degrees");
    if (!given.look_from.empty() && !(o.look_from = parse_point(given.look_from)))
        throw CLI::ValidationError("--look-from", "takes X,Y,Z, not '" + given.look_from + "'");
    if (o.look_from && o.look_from == parse_point(o.look_at))
        throw CLI::ValidationError("--look-at", "is where --look-from is");
    bool added = o.follow || o.turntable || o.look_from || !o.look_at.empty();
    if (added && !o.camera.empty() && !find_view(o.camera))
        throw CLI::ValidationError(
            "--camera", fmt::format("--camera-follow, --turntable, --look-from and --look-at move "
                                    "cameras that are added, not '{}': leave --camera out, or "
                                    "take one of {}",
                                    o.camera, fmt::join(words_of_views(), ", ")));
    if (o.look_from && !o.camera.empty())
        throw CLI::ValidationError("--look-from", "says where the camera is; so does --camera");
}

void interpret(const Given& given, RenderOptions& o) {
    std::string error;
    if (!given.frames.empty()) {
        o.frames = parse_frames(given.frames, error);
        if (!o.frames) throw CLI::ValidationError("--frames", error);
    }
    if (!given.fps.empty() && !(o.fps = parse_frame_rate(given.fps)))
        throw CLI::ValidationError("--fps", "takes a positive number or a fraction");
    if (!given.size.empty()) parse_size(given.size, o);
    if (!given.scale.empty()) o.scale = parse_scale(given.scale);
    if (!given.exposure.empty()) parse_exposure(given.exposure, o);
    if (!given.background.empty()) o.background = parse_color(given.background);
    o.threads = parse_threads(given.threads);
    if (o.time)
        check_range("--time", *o.time, -kMostSeconds, kMostSeconds, "takes up to 1e9 seconds");
    check_range("--filter-width", o.filter_width, 0, kMostFilterWidth,
                "takes 0 (the filter's own) to 64 pixels");
    if (o.meter) check_range("--unit", *o.meter, 1e-15, 1e15, "takes metres, more than 0");
    check_stages(o.dump);
    if (!given.target.empty()) choose_target(given.target, o);
    o.environment.include_directories = o.include_directories;
    interpret_view(given, o);
    interpret_quality(given.quality, o);
    interpret_changes(given, o);
}

// The options that a picture depends on.
std::vector<const CLI::Option*> declare_scene(CLI::App& app, Given& given, RenderOptions& o) {
    declare_input(app, given, o);
    declare_quality(app, given.quality, o);
    declare_look(app, given, o);
    declare_changes(app, given, o);
    std::vector<const CLI::Option*> options;
    for (const CLI::Option* option : std::as_const(app).get_options()) {
        std::string name = option->get_name();
        if (std::ranges::find(kNotOfThePicture, name) == std::end(kNotOfThePicture))
            options.push_back(option);
    }
    declare_findings(app, o);
    return options;
}

void interpret_scene(RenderOptions& o) {
    o.strict = o.findings.strict;
    if (o.scene.empty() && o.session) o.scene = o.session->scene;
    if (o.session) o.session->scene = o.scene;
}

std::optional<int> refuse_session(const std::string& program, const std::string& error) {
    std::fprintf(stderr, "%s: error: %s\n", program.c_str(), error.c_str());
    return kExitUnreadable;
}

}  // namespace

std::optional<int> parse_render_options(int argc, char** argv, RenderOptions& o) {
    CLI::App app("kinora-render: COLLADA scenes with RSL shaders to pictures", "kinora-render");
    Given given;
    declare_output(app, given, o);
    declare_scene(app, given, o);
    declare_run(app, given, o);
    std::vector<std::string> words = words_of(argc, argv);
    if (std::string error = read_session_of(words, o); !error.empty())
        return refuse_session(app.get_name(), error);
    return parse_command_line(
        app, std::move(words),
        {{"--stats", "text"}, {"--list", "all"}, {"--knobs", "text"}, {"--explain", "text"}}, [&] {
            interpret(given, o);
            interpret_scene(o);
            if (o.scene.empty()) throw CLI::RequiredError("scene");
            interpret_output(given, o);
        });
}

std::optional<int> parse_scene_options(int argc, char** argv, const SceneProgram& program,
                                       RenderOptions& o) {
    CLI::App app(std::string(program.name) + ": " + program.what, program.name);
    Given given;
    auto of_scene = declare_scene(app, given, o);
    for (const OwnOption& own : program.own) {
        if (own.text)
            app.add_option(own.names, *own.text, own.help);
        else
            app.add_flag(own.names, *own.flag, own.help);
    }
    std::vector<std::string> words = words_of(argc, argv);
    if (std::string error = read_session_of(words, o); !error.empty())
        return refuse_session(app.get_name(), error);
    return parse_command_line(app, std::move(words), {}, [&] {
        interpret(given, o);
        interpret_scene(o);
        o.words = given_words(of_scene);
    });
}

std::optional<RenderOptions> options_of_session(const std::string& file, std::string& error) {
    CLI::App app("a session");
    Given given;
    RenderOptions o;
    auto of_scene = declare_scene(app, given, o);
    std::vector<std::string> words{file};
    error = read_session_of(words, o);
    if (!error.empty()) return std::nullopt;
    try {
        std::ranges::reverse(words);
        app.parse(words);
        interpret(given, o);
        interpret_scene(o);
        o.words = given_words(of_scene);
        return o;
    } catch (const CLI::ParseError& bad) {
        error = fmt::format("'{}': {}", file, bad.what());
        return std::nullopt;
    }
}

}  // namespace kinora
