// runtime/programs/render_options.cpp: kinora-render's command line.
#include "runtime/programs/render_options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <thread>

#include "runtime/programs/exit_codes.h"

namespace kinora {

namespace {

constexpr int kMostThreads = 1024;
constexpr double kMostSeconds = 1e9;
constexpr double kMostFilterWidth = 64;  // pixels
constexpr const char* kListKinds = "cameras, clips, materials, shaders, lights or all";

int parse_threads(const std::string& text) {
    int cores = std::max(1, int(std::thread::hardware_concurrency()));
    if (text == "all") return cores;
    int n = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc() || *end != 0 || n == 0)
        throw CLI::ValidationError("--threads", "takes a number, -N (all but N) or 'all'");
    if (n > kMostThreads)
        throw CLI::ValidationError("--threads", fmt::format("takes {} at most", kMostThreads));
    return n > 0 ? n : std::max(1, cores + n);
}

void parse_size(const std::string& text, RenderOptions& o) {
    char tail = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &o.width, &o.height, &tail) != 2 || o.width < 1 ||
        o.height < 1 || o.width > 65536 || o.height > 65536)
        throw CLI::ValidationError("--size", "takes WIDTHxHEIGHT, each 1 to 65536");
}

vec3 parse_color(const std::string& text) {
    vec3 c;
    char tail = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f%c", &c.x, &c.y, &c.z, &tail) != 3 ||
        !std::isfinite(c.x + c.y + c.z))
        throw CLI::ValidationError("--background", "takes R,G,B");
    return c;
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

// NaN is in no range.
void check_range(const char* option, double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high)) throw CLI::ValidationError(option, what);
}

void check_stages(const std::vector<std::string>& stages) {
    for (const std::string& stage : stages)
        if (stage != "ir" && stage != "asm" && !stage.starts_with("ir:"))
            throw CLI::ValidationError(
                "--dump", "takes ir, ir:PASS or asm; kinora-shade dump shows the earlier stages");
}

// An enumeration by name.
template <class T>
CLI::Validator names(std::initializer_list<std::pair<const std::string, T>> rows) {
    return CLI::CheckedTransformer(std::map<std::string, T>(rows), CLI::ignore_case)
        .description("");
}

// Options that take a name say so in the help, not what CLI11 calls its type.
void name_types(CLI::App& app) {
    for (CLI::Option* option : app.get_options()) {
        if (option->get_type_name() == "ENUM") option->type_name("NAME");
        if (option->get_type_name() == "BOOLEAN") option->type_name("NAME");
    }
}

// As they stand on the command line, where they are not yet what RenderOptions holds.
struct Given {
    std::string frames, fps, size, threads = "all", target, quality{kDefaultQuality}, background;
    std::optional<int> spp, rays, bounces;
    std::optional<jit::math::Tier> math;
    std::optional<bool> robust, rebuild;
    std::optional<DisplacementMode> displacement;
    std::optional<double> dice;
    std::optional<size_t> dice_limit;
    std::vector<std::string> shaders;
    bool overwrite = false;
    std::string stats = "none", progress;
};

// What is rendered, where to and by what.
void declare_input(CLI::App& app, Given& given, RenderOptions& o) {
    app.footer(kExitCodeHelp);
    app.set_version_flag("--version", "kinora-render " KINORA_VERSION);
    app.add_option("scene", o.scene, "the scene: .dae, .zae or .kmz")->required();
    app.add_option("-o,--output", o.output,
                   "file; with a frame token (#### or %04d) for several frames; .png or .exr");
    app.add_option("--frames", given.frames, "1-240, 1-240x2, 300, 10-1x-1, comma separated");
    app.add_option("--time", o.time, "one picture at this time, seconds");
    app.add_option("--fps", given.fps, "frames per second: 24, 23.976 or 24000/1001");
    app.add_option("--clip", o.clip, "play this clip's range");
    app.add_option("--size", given.size, "WIDTHxHEIGHT in pixels (640 x 640/aspect)");
    app.add_option("--camera", o.camera, "node path or id, else camera id");
    app.add_option("--threads", given.threads, "N, -N (all but N) or all");
    app.add_option("--target", given.target,
                   "avx512, avx2, neon or interp (the best this CPU has)");
}

// The rows of a quality, one by one, and how pixels are sampled.
void declare_quality(CLI::App& app, Given& given, RenderOptions& o) {
    app.add_option("--quality", given.quality, "draft, preview, final or reference");
    app.add_option("--spp", given.spp, "samples per pixel")->check(CLI::Range(1, 1 << 20));
    app.add_option("--math", given.math, "precise (1 ULP) or fast (4 ULP)")
        ->transform(names<jit::math::Tier>(
            {{"precise", jit::math::Tier::Precise}, {"fast", jit::math::Tier::Fast}}));
    app.add_option("--robust", given.robust, "watertight traversal: on or off");
    app.add_option("--bvh", given.rebuild, "refit or rebuild each frame")
        ->transform(names<bool>({{"refit", false}, {"rebuild", true}}));
    app.add_option("--displacement", given.displacement, "true (vertices move) or bump (N bends)")
        ->transform(names<DisplacementMode>(
            {{"true", DisplacementMode::True}, {"bump", DisplacementMode::Bump}}));
    app.add_option("--dice", given.dice, "edge length of displaced surfaces, pixels");
    app.add_option("--dice-limit", given.dice_limit,
                   "most triangles of displaced surfaces (4000000)")
        ->check(CLI::Range(size_t(1), size_t(1) << 31));
    app.add_option("--filter", o.filter, "pixel filter: box, triangle or gaussian")
        ->check(CLI::Validator(
            [](std::string& name) {
                return raytrace::find_pixel_filter(name) ? "" : "no such filter";
            },
            "FILTER"));
    app.add_option("--filter-width", o.filter_width, "in pixels (the filter's own)");
    app.add_option("--seed", o.seed, "of all sampling");
    app.add_option("--rays", given.rays,
                   "rays that shaders may send one from the hit of another (16)")
        ->check(CLI::Range(0, 64));
    app.add_option("--bounces", given.bounces, "of these, of indirect diffuse light (1)")
        ->check(CLI::Range(0, 64));
}

// What the picture shows of the scene, and how.
void declare_look(CLI::App& app, Given& given, RenderOptions& o) {
    app.add_option("--shadows", o.shadows, "auto, explicit or off")
        ->transform(names<ShadowMode>({{"auto", ShadowMode::Auto},
                                       {"explicit", ShadowMode::Explicit},
                                       {"off", ShadowMode::Off}}));
    app.add_option("--background", given.background, "R,G,B instead of transparent");
    app.add_option("--nan", o.nan, "non-finite results become zero, magenta or keep")
        ->transform(names<raytrace::NanPolicy>({{"zero", raytrace::NanPolicy::Zero},
                                                {"magenta", raytrace::NanPolicy::Magenta},
                                                {"keep", raytrace::NanPolicy::Keep}}));
    app.add_option("--color", o.color, "srgb (PNG encoded) or legacy (as computed)")
        ->transform(names<ColorEncoding>(
            {{"srgb", ColorEncoding::Srgb}, {"legacy", ColorEncoding::Linear}}));
    app.add_option("--shader", given.shaders,
                   "MATERIAL=FILE.sl: try a shader; MATERIAL may be a glob");
    app.add_option("--light-samples", o.light_samples, "of each area light (the file's, else 16)")
        ->check(CLI::Range(1, 4096));
    app.add_option("--imager", o.imager, "a standard imager's name, FILE.sl or none");
    app.add_option("--aov", o.aovs, "output parameters of surfaces: channels of the EXR")
        ->delimiter(',');
    app.add_option("-I", o.include_directories, "where shaders find #include files");
    app.add_option("--up", o.up_axis, "X, Y or Z instead of the file's up axis")
        ->transform(names<UpAxis>({{"X", UpAxis::X}, {"Y", UpAxis::Y}, {"Z", UpAxis::Z}}));
    app.add_option("--unit", o.meter, "metres per unit instead of the file's");
    app.add_option("--transparency", o.transparency,
                   "spec, or auto: what the formula makes invisible everywhere is shown opaque")
        ->transform(names<TransparencyMode>(
            {{"spec", TransparencyMode::Spec}, {"auto", TransparencyMode::Auto}}));
    app.add_option("--allow-external", o.allow_external,
                   "a folder that the scene may read besides its own (repeatable)")
        ->check(CLI::ExistingDirectory)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

// Frames that exist or fail, and what is told.
void declare_run(CLI::App& app, Given& given, RenderOptions& o) {
    auto* skip = app.add_flag("--skip-existing", o.skip_existing,
                              "keep whole files of the same scene and options");
    app.add_flag("--overwrite", given.overwrite, "write every frame (the default)")->excludes(skip);
    app.add_flag("--keep-going", o.keep_going, "go on after a frame that failed");
    app.add_flag("--strict", o.strict, "missing assets are errors");
    app.add_option("--stats", given.stats, "what each stage took, per frame: text or json")
        ->expected(0, 1)
        ->default_str("text")
        ->check(CLI::IsMember({"text", "json", "none"}));
    app.add_option("--progress", given.progress, "bar, lines or none")
        ->check(CLI::IsMember({"bar", "lines", "none"}));
    app.add_option("--list", o.list, kListKinds)
        ->expected(0, 1)
        ->default_str("all")
        ->check(CLI::IsMember({"cameras", "clips", "materials", "shaders", "lights", "all"}));
    app.add_option("--dump", o.dump, "stages of each kernel: ir, ir:PASS, asm")->delimiter(',');
    app.add_option("--contact-sheet", o.contact_sheet, "all frames on one PNG");
    app.add_flag("-v,--verbose", o.verbose, "say more");
    app.add_flag("-q,--quiet", o.quiet, "say only errors");
}

void interpret_quality(const Given& given, RenderOptions& o) {
    const Quality* row = find_quality(given.quality);
    if (!row) throw CLI::ValidationError("--quality", "knows draft, preview, final and reference");
    o.quality = *row;
    if (given.spp) o.quality.samples_per_pixel = *given.spp;
    if (given.math) o.quality.math = *given.math;
    if (given.robust) o.quality.robust = *given.robust;
    if (given.rebuild) o.quality.always_rebuild = *given.rebuild;
    if (given.rays) o.quality.ray_depth = *given.rays;
    if (given.bounces) o.quality.diffuse_depth = *given.bounces;
    if (given.displacement) o.quality.displacement = *given.displacement;
    if (given.dice) {
        check_range("--dice", *given.dice, 0.01, 1e6, "takes 0.01 to 1e6 pixels");
        o.quality.dice = *given.dice;
    }
    o.dice_limit = given.dice_limit.value_or(0);
}

void interpret_output(const CLI::App& app, const Given& given, RenderOptions& o) {
    bool listing = app.count("--list") > 0;
    if (listing && o.list.empty()) o.list = "all";
    if (!listing && o.output.empty() && o.contact_sheet.empty() && o.dump.empty())
        throw CLI::RequiredError("-o FILE (or --list, --dump)");
    if (!o.output.empty() && !is_image_path(o.output))
        throw CLI::ValidationError("-o", "takes a name that ends in .png or .exr");
    if (app.count("--stats")) {
        o.stats = given.stats != "none";
        o.stats_json = given.stats == "json";
    }
    o.progress = isatty(STDERR_FILENO) ? ProgressStyle::Bar : ProgressStyle::Lines;
    if (given.progress == "bar") o.progress = ProgressStyle::Bar;
    if (given.progress == "lines") o.progress = ProgressStyle::Lines;
    if (given.progress == "none" || o.quiet) o.progress = ProgressStyle::None;
}

void interpret(const CLI::App& app, const Given& given, RenderOptions& o) {
    std::string error;
    if (!given.frames.empty()) {
        o.frames = parse_frames(given.frames, error);
        if (!o.frames) throw CLI::ValidationError("--frames", error);
    }
    if (!given.fps.empty() && !(o.fps = parse_frame_rate(given.fps)))
        throw CLI::ValidationError("--fps", "takes a positive number or a fraction");
    if (!given.size.empty()) parse_size(given.size, o);
    if (!given.background.empty()) o.background = parse_color(given.background);
    o.threads = parse_threads(given.threads);
    if (o.time)
        check_range("--time", *o.time, -kMostSeconds, kMostSeconds, "takes up to 1e9 seconds");
    check_range("--filter-width", o.filter_width, 0, kMostFilterWidth,
                "takes 0 (the filter's own) to 64 pixels");
    if (o.meter) check_range("--unit", *o.meter, 1e-15, 1e15, "takes metres, more than 0");
    check_stages(o.dump);
    if (!given.target.empty()) choose_target(given.target, o);
    interpret_quality(given, o);
    for (const std::string& shader : given.shaders) {
        size_t equals = shader.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == shader.size())
            throw CLI::ValidationError("--shader", "takes MATERIAL=FILE.sl");
        o.shaders.emplace_back(shader.substr(0, equals), shader.substr(equals + 1));
    }
    interpret_output(app, given, o);
}

}  // namespace

std::optional<int> parse_render_options(int argc, char** argv, RenderOptions& o) {
    CLI::App app("kinora-render: COLLADA scenes with RSL shaders to pictures", "kinora-render");
    Given given;
    declare_input(app, given, o);
    declare_quality(app, given, o);
    declare_look(app, given, o);
    declare_run(app, given, o);
    name_types(app);
    try {
        app.parse(argc, argv);
        interpret(app, given, o);
    } catch (const CLI::ParseError& error) {
        int code = app.exit(error);
        return code == 0 ? kExitOk : kExitUsage;
    }
    return std::nullopt;
}

}  // namespace kinora
