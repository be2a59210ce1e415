// runtime/kinora/open_scene.cpp: import, what the options change, and the build.
#include "runtime/kinora/open_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "runtime/base/numbers.h"
#include "runtime/base/parallel.h"
#include "runtime/kinora/scene_error.h"
#include "runtime/picture/frame/exposure.h"
#include "runtime/picture/frame/own_lights.h"
#include "runtime/scene/build/build_scene.h"
#include "runtime/scene/build/defaults.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/play_range.h"
#include "runtime/scene/load/import_scene.h"
#include "runtime/scene/load/override_environment.h"
#include "runtime/scene/load/override_scene.h"
#include "runtime/scene/load/override_shader.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {

namespace {

constexpr double kMostCurveError = 1;  // of curves that are as coarse as --dice says

int scaled(const SceneRequest& request, double pixels) {
    return int(std::clamp(std::round(pixels * request.scale), 1.0, 65536.0));
}

SceneOptions scene_options(const SceneRequest& request) {
    SceneOptions o;
    o.quality = request.quality;
    o.camera = request.camera;
    o.view.follow = request.follow;
    o.view.yfov = request.yfov;
    o.view.from = request.look_from;
    o.view.at = parse_point(request.look_at);
    if (!o.view.at) o.view.at_node = request.look_at;
    o.target = request.target;
    o.lights = request.lights;
    o.indirect = request.gi;
    o.quality.diffuse_depth = std::max(o.quality.diffuse_depth, request.gi);
    o.background_rebuilds = false;  // a frame depends on its time alone
    o.decode_textures = encoding_of(request) == ColorEncoding::Srgb;
    o.aovs = request.aovs;
    o.light_groups = request.light_groups;
    o.trees = request.trees;
    o.displays = request.displays;
    o.print = request.print;
    if (request.dice_limit) o.dice_limit = request.dice_limit;
    o.width = scaled(request, request.width ? request.width : 640);
    o.height = request.height ? scaled(request, request.height) : 0;
    return o;
}

void check_target(const SceneRequest& request, Diagnostics& diagnostics) {
    if (!request.target_missing.empty())
        diagnostics.report(Code::TARGET_UNAVAILABLE, Location{}, request.target_missing,
                           jit::best_target().name);
    else if (!request.target && jit::best_target().name == std::string_view("interp"))
        diagnostics.report(Code::TARGET_INTERPRETED, Location{});
}

void change(SceneDescription& description, const SceneRequest& request, Diagnostics& diagnostics) {
    if (!request.shaders.empty() || !request.params.empty()) {  // which may name these lights
        description.default_lights = default_lights(description.values);
        description.animated.resize(description.values.size(), false);
    }
    for (const auto& [pattern, file] : request.shaders)
        override_shader(description, pattern, {file, request.include_directories}, diagnostics);
    override_environment(description, request.environment, diagnostics);
    if (!request.atmosphere.empty())
        override_atmosphere(description, {request.atmosphere, request.include_directories},
                            diagnostics);
    if (!request.imager.empty())
        override_imager(description, {request.imager, request.include_directories}, diagnostics);
    for (const auto& [target, value] : request.params)
        override_param(description, target, value, diagnostics);
    override_visibility(description, request.hide, request.only, diagnostics);
}

void set_range(ImportedScene& imported, const SceneRequest& request) {
    PlayRange range = play_range(imported.description);
    imported.rate = request.fps.value_or(frame_rate_of(range.rate));
    if (!request.clip.empty()) {
        const ClipDefinition* clip = find_clip(imported.description, request.clip);
        imported.clip_known = clip != nullptr;
        if (!clip) return;
        range.start = clip->start;
        range.end = clip->end;
        play_clip(imported.description, *clip);
    }
    imported.options.frame_rate = imported.rate.value();
    imported.options.start_time = range.start;
    imported.options.end_time = range.end;
    if (!request.turntable) return;
    imported.options.view.turn_seconds = *request.turntable / imported.rate.value();
    imported.options.view.turn_start = imported.rate.time(first_frame(imported.rate, range.start));
}

ImportedScene with_changes(const SceneRequest& request, SceneDescription description,
                           Diagnostics& diagnostics) {
    change(description, request, diagnostics);
    ImportedScene imported{std::move(description), scene_options(request), {}};
    set_range(imported, request);
    return imported;
}

}  // namespace

std::optional<dvec3> parse_point(const std::string& text) {
    double p[3];
    if (!read_numbers<double>(text, ',', p) || !std::isfinite(p[0] + p[1] + p[2]))
        return std::nullopt;
    return dvec3(p[0], p[1], p[2]);
}

int64_t first_frame(FrameRate rate, double start) {
    double frame = std::round(start * rate.value());
    return std::abs(frame) < kFurthestFrame ? int64_t(frame) : 0;
}

void judge_by(const SceneRequest& request, Diagnostics& diagnostics) {
    diagnostics.judge(request.judgement());
    if (request.strict) diagnostics.set_severity("RSL_SPACE_UNKNOWN", Severity::Error);
}

ImportOptions import_options(const SceneRequest& request) {
    ImportOptions import;
    import.allow_external = request.allow_external;
    import.confine = request.confine;
    import.up_axis = request.up_axis;
    import.meter = request.meter;
    import.transparency = request.transparency;
    import.emission = request.emission;
    import.vertex_colors = request.vertex_colors;
    import.ignore_required = request.ignore_required;
    import.smooth = request.smooth;
    import.decode_colors = encoding_of(request) == ColorEncoding::Srgb;
    import.world = request.world;
    import.width = request.width;
    import.height = request.height;
    import.scale = request.scale;
    import.curve_error = std::min(kCurveError * request.quality.dice, kMostCurveError);
    import.include_directories = request.include_directories;
    return import;
}

std::optional<ImportedScene> import_requested(const SceneRequest& request, Diagnostics& diagnostics,
                                              const std::optional<std::string_view>& bytes) {
    check_target(request, diagnostics);
    SceneSource source = request.scene;
    source.bytes = bytes;
    auto description = import_scene(source, import_options(request), diagnostics);
    if (!description) {
        auto no_scene = [](const Finding& f) {
            return f.info->code == std::string_view("SCENE_NONE");
        };
        if (std::ranges::any_of(diagnostics.findings(), no_scene))
            diagnostics.report(Code::SCENE_EMPTY, Location{});
        return std::nullopt;
    }
    return with_changes(request, std::move(*description), diagnostics);
}

ImportedScene import_made(const SceneRequest& request, SceneDescription made,
                          Diagnostics& diagnostics) {
    check_target(request, diagnostics);
    return with_changes(request, std::move(made), diagnostics);
}

BuiltScene build_imported(ImportedScene imported, Diagnostics& diagnostics,
                          const BuildAgain* again) {
    BuiltScene built;
    if (may_dice(imported.description, imported.options))
        built.redicer = std::make_unique<Redicer>(imported.description, imported.options);
    if (forbidding_error(diagnostics) == SceneError::None)
        built.scene =
            build_scene(std::make_shared<SceneDescription>(std::move(imported.description)),
                        imported.options, diagnostics, again);
    if (built.scene) built.pose = std::make_unique<Pose>(*built.scene);
    if (built.scene && !light_black_scene(*built.scene, *built.pose, diagnostics)) {
        built.pose.reset();
        built.scene.reset();
    }
    if (!built.scene || !built.scene->dice.triangles) built.redicer.reset();
    if (built.redicer) built.redicer->share(*built.scene, diagnostics.files);
    return built;
}

void set_sampling(raytrace::IntegratorSettings& settings, const Quality& quality) {
    settings.samples_per_pixel = quality.samples_per_pixel;
    settings.filter = &raytrace::pixel_filters()[size_t(quality.filter)];
}

namespace {

void sample_as(const FilePicture& own, raytrace::IntegratorSettings& settings) {
    if (own.samples) settings.samples_per_pixel = own.samples;
    if (const auto* filter = raytrace::find_pixel_filter(own.filter)) {
        settings.filter = filter;
        settings.filter_width = own.filter_width;
    }
    if (!own.filter_values.empty())
        settings.filter_grid = std::make_shared<raytrace::FilterGrid>(
            own.filter_values, own.filter_width, own.filter_height);
}

}  // namespace

ColorEncoding encoding_of(const SceneRequest& request) {
    if (request.color) return *request.color;
    return is_rib(request.scene) ? ColorEncoding::Linear : ColorEncoding::Srgb;
}

FrameSettings frame_settings(const SceneRequest& request, const Scene& scene, Pose& pose,
                             Diagnostics& diagnostics, const std::atomic<int>* stop) {
    FrameSettings settings;
    double aspect = camera_aspect(scene).value_or(16.0 / 9.0);
    const std::optional<FilePicture>& own = scene.description->file_picture;
    bool as_file = own && !request.width && !request.height;
    double width = as_file ? own->width : request.width ? request.width : 640;
    double height = as_file ? own->height : request.height ? request.height : width / aspect;
    settings.width = scaled(request, width);
    settings.height = scaled(request, height);
    set_sampling(settings.integrator, request.quality);
    settings.integrator.filter_width = request.filter_width;
    if (own && !request.fixed_settings) sample_as(*own, settings.integrator);
    settings.integrator.background = request.background;
    settings.integrator.nan = request.nan;
    settings.stop = stop;
    double stops = request.exposure;
    if (request.auto_exposure) {
        stops = auto_exposure(scene, scene.options, pose, settings, diagnostics);
        diagnostics.report(Code::EXPOSURE_AUTO, Location{}, stops);
    }
    settings.gain = std::exp2(stops) * (own ? own->exposure.gain : 1);
    settings.gamma = own ? own->exposure.gamma : 1;
    return settings;
}

uint32_t frame_seed(const SceneRequest& request, int64_t frame) {
    return request.seed * 0x9e3779b9u + uint32_t(frame);
}

double seconds_of(FrameRate rate, double frame) {
    double whole = std::round(frame);
    return frame == whole ? rate.time(int64_t(whole)) : frame / rate.value();
}

}  // namespace kinora
