// runtime/programs/render/kinora_render.cpp: a scene to a sequence of pictures.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>

#include "runtime/base/parallel.h"
#include "runtime/build/build_scene.h"
#include "runtime/build/defaults.h"
#include "runtime/description/findings.h"
#include "runtime/description/play_range.h"
#include "runtime/frame/exposure.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/redice.h"
#include "runtime/load/import_scene.h"
#include "runtime/load/override_scene.h"
#include "runtime/load/override_shader.h"
#include "runtime/load/smooth_normals.h"
#include "runtime/programs/common/contact_sheet.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/finish.h"
#include "runtime/programs/common/list_scene.h"
#include "runtime/programs/render/fingerprint.h"
#include "runtime/programs/render/frames_to_render.h"
#include "runtime/programs/render/options.h"
#include "runtime/programs/render/stats.h"
#include "runtime/scene/camera.h"

namespace kinora {

namespace {

// Set by the first signal; the frame under way is dropped at its next rays. A second signal stops
// at once, and so does a shader that takes longer than this: no file is open while a frame is made.
constexpr unsigned kStopSeconds = 4;
std::atomic<int> g_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int number) {
    if (g_signal) _exit(128 + g_signal);
    g_signal = number;
    alarm(kStopSeconds);
}

class Render {
  public:
    explicit Render(const RenderOptions& options)
        : options_(options),
          printer_(options.findings, options.scene),
          progress_(options.progress, 1) {
        diagnostics_.judge(options.findings.judgement());
    }

    int run() {
        int code = load();
        printer_.summarize();
        if (code == kExitOk) code = printer_.exit_code(result());
        printer_.summarize();
        return code;
    }

  private:
    int result() {
        if (!options_.list.empty()) {
            std::fputs((options_.json ? list_scene_json(*scene_, options_.list)
                                      : list_scene(*scene_, options_.list))
                           .c_str(),
                       stdout);
            return kExitOk;
        }
        dump();
        if (options_.output.empty() && options_.contact_sheet.empty()) return kExitOk;
        int code = frames();
        if (options_.stats)
            print_stats(options_, {load_ms_, build_ms_, first_ray_ms_, scene_->dice}, records_);
        return code;
    }

    int load();
    int exit_code_of_findings(int otherwise) const;
    void flush_findings();
    void dump() const;
    int frames();
    int report_unreadable() const;
    int report_unwritable(const std::string& file, const std::string& error, int number);
    ptrdiff_t unwritable() const;
    int refuse_unwritable(const std::string& file);
    bool keep_existing(const std::string& file, const std::string& print);
    int one_frame(int64_t frame, double time, size_t index);
    bool picture(FrameRecord& record, double time, const raytrace::Progress& progress);
    void expose();
    SceneOptions scene_options() const;
    int scaled(double pixels) const {
        return int(std::clamp(std::round(pixels * options_.scale), 1.0, 65536.0));
    }

    const RenderOptions& options_;
    Diagnostics diagnostics_;
    FindingPrinter printer_;
    std::unique_ptr<Scene> scene_;
    std::unique_ptr<Redicer> redicer_;  // null where nothing is diced
    FrameSettings settings_;
    raytrace::Film film_;
    ProgressReport progress_;
    ContactSheet sheet_;
    std::vector<FrameRecord> records_;
    FrameRate rate_;
    Stopwatch since_start_;
    double load_ms_ = 0, build_ms_ = 0, first_ray_ms_ = 0;
    uint64_t scene_hash_ = 0;
};

int Render::exit_code_of_findings(int otherwise) const {
    for (const Finding& finding : diagnostics_.findings()) {
        if (finding.severity != Severity::Error) continue;
        if (std::string_view(finding.info->code).starts_with("RSL_")) return kExitShader;
        for (const FindingInfo* usage :
             {&Code::CAMERA_UNKNOWN, &Code::MATERIAL_UNKNOWN, &Code::SHADER_UNKNOWN,
              &Code::SHADER_OF_OTHER_KIND, &Code::PARAM_UNKNOWN, &Code::PARAM_VALUE,
              &Code::NODE_UNKNOWN, &Code::AOV_UNKNOWN, &Code::CAMERA_PARALLEL})
            if (finding.info == usage) return kExitUsage;
    }
    return otherwise;
}

void Render::flush_findings() {
    progress_.clear();
    printer_.print(diagnostics_);
}

SceneOptions Render::scene_options() const {
    SceneOptions o;
    o.camera = options_.camera;
    o.view.follow = options_.follow;
    o.view.yfov = options_.yfov;
    o.view.from = options_.look_from;
    o.view.at = parse_point(options_.look_at);
    if (!o.view.at) o.view.at_node = options_.look_at;
    o.math = options_.quality.math;
    o.target = options_.target;
    o.shadows = options_.shadows;
    o.lights = options_.lights;
    o.ray_depth = options_.quality.ray_depth;
    o.diffuse_depth = options_.quality.diffuse_depth;
    o.split = options_.quality.split;
    o.ray_limit = options_.ray_limit;
    o.accel.robust = options_.quality.robust;
    o.accel.always_rebuild = options_.quality.always_rebuild;
    o.accel.background = false;  // a frame depends on its time alone
    o.decode_textures = options_.color == ColorEncoding::Srgb;
    o.light_samples = options_.light_samples;
    o.aovs = options_.aovs;
    o.want_dumps = !options_.dump.empty();
    o.displacement = options_.quality.displacement;
    o.dice = options_.quality.dice;
    if (options_.dice_limit) o.dice_limit = options_.dice_limit;
    o.width = scaled(options_.width ? options_.width : 640);
    o.height = options_.height ? scaled(options_.height) : 0;
    return o;
}

int Render::load() {
    set_thread_count(options_.threads);
    if (options_.findings.strict) diagnostics_.set_severity("RSL_SPACE_UNKNOWN", Severity::Error);
    if (!options_.target_missing.empty())
        diagnostics_.report(Code::TARGET_UNAVAILABLE, Location{}, options_.target_missing,
                            jit::best_target().name);
    else if (!options_.target && jit::best_target().name == std::string_view("interp"))
        diagnostics_.report(Code::TARGET_INTERPRETED, Location{});
    Stopwatch watch;
    ImportOptions import;
    import.allow_external = options_.allow_external;
    import.confine = options_.confine;
    import.up_axis = options_.up_axis;
    import.meter = options_.meter;
    import.transparency = options_.transparency;
    import.decode_colors = options_.color == ColorEncoding::Srgb;
    import.include_directories = options_.include_directories;
    std::optional<SceneDescription> description =
        import_scene(options_.scene, import, diagnostics_);
    if (!description) {
        auto no_scene = [](const Finding& f) {
            return f.info->code == std::string_view("SCENE_NONE");
        };
        if (std::ranges::any_of(diagnostics_.findings(), no_scene))
            diagnostics_.report(Code::SCENE_EMPTY, Location{});
        flush_findings();
        return report_unreadable();
    }
    if (!options_.shaders.empty() || !options_.params.empty()) {  // which may name these lights
        description->default_lights = default_lights(description->values, diagnostics_);
        description->animated.resize(description->values.size(), false);
    }
    for (const auto& [pattern, file] : options_.shaders)
        override_shader(*description, pattern, {file, options_.include_directories}, diagnostics_);
    if (!options_.atmosphere.empty())
        override_atmosphere(*description, {options_.atmosphere, options_.include_directories},
                            diagnostics_);
    if (!options_.imager.empty())
        override_imager(*description, {options_.imager, options_.include_directories},
                        diagnostics_);
    for (const auto& [target, value] : options_.params)
        override_param(*description, target, value, diagnostics_);
    override_visibility(*description, options_.hide, options_.only, diagnostics_);
    if (options_.smooth) smooth_normals(*description, *options_.smooth);
    load_ms_ = watch.restart();
    SceneOptions scene_options = this->scene_options();
    PlayRange range = play_range(*description);
    rate_ = options_.fps.value_or(frame_rate_of(range.rate));
    if (!options_.clip.empty()) {
        const ClipDefinition* clip = find_clip(*description, options_.clip);
        if (!clip) {
            flush_findings();
            std::fprintf(stderr, "kinora-render: no clip '%s'; --list clips shows them\n",
                         options_.clip.c_str());
            return kExitUsage;
        }
        range.start = clip->start;
        range.end = clip->end;
        play_clip(*description, *clip);
    }
    scene_options.frame_rate = rate_.value();
    scene_options.start_time = range.start;
    scene_options.end_time = range.end;
    if (options_.turntable) {
        scene_options.view.turn_seconds = *options_.turntable / rate_.value();
        scene_options.view.turn_start = rate_.time(first_frame(rate_, range.start));
    }
    if (may_dice(*description, scene_options))
        redicer_ = std::make_unique<Redicer>(*description, scene_options);
    if (exit_code_of_findings(0) == 0)
        scene_ = build_scene(std::make_shared<SceneDescription>(std::move(*description)),
                             scene_options, diagnostics_);
    if (!scene_ || !scene_->dice.triangles) redicer_.reset();
    if (redicer_) redicer_->share(*scene_, diagnostics_.files);
    build_ms_ = watch.ms();
    flush_findings();
    int code = exit_code_of_findings(kExitOk);
    if (code != kExitOk) return code;
    if (!scene_) return report_unreadable();
    // An Error means that there is no picture; what --fail-on names besides comes with one.
    return printer_.exit_code_of_errors();
}

// An exit code that is not 0 has an error behind it.
int Render::report_unreadable() const {
    if (!diagnostics_.has_errors())
        std::fprintf(stderr, "kinora-render: error: '%s' cannot be rendered\n",
                     options_.scene.c_str());
    return kExitUnreadable;
}

void Render::dump() const {
    for (const auto& [stage, text] : scene_->options.dumps)
        for (const std::string& wanted : options_.dump)
            if (stage == wanted || stage.starts_with(wanted + ":"))
                std::printf("; stage %s\n%s\n", stage.c_str(), text.c_str());
}

int Render::report_unwritable(const std::string& file, const std::string& error, int number) {
    diagnostics_.report(Code::FRAME_UNWRITABLE, Location{}, file, error);
    flush_findings();
    bool full = number == ENOSPC || number == EDQUOT || number == ENOMEM;
    return full ? kExitRetry : kExitUnwritable;
}

// How many files could not be written so far; those that shaders bake too.
ptrdiff_t Render::unwritable() const {
    const std::vector<Finding>& findings = diagnostics_.findings();
    return std::count_if(findings.begin(), findings.end(), [](const Finding& finding) {
        return finding.info == &Code::FRAME_UNWRITABLE;
    });
}

// Before a frame is rendered, not after.
int Render::refuse_unwritable(const std::string& file) {
    int number = 0;
    std::string error = try_image_path(file, &number);
    return error.empty() ? int(kExitOk) : report_unwritable(file, error, number);
}

// Whether the file is that picture already; the contact sheet shows it, too.
bool Render::keep_existing(const std::string& file, const std::string& print) {
    if (read_image_text(file, "kinora/fingerprint") != print) return false;
    if (options_.contact_sheet.empty()) return true;
    std::optional<Image8> image = read_image(file, options_.color);
    if (image) sheet_.add(*image);
    return image.has_value();
}

int Render::one_frame(int64_t frame, double time, size_t index) {
    FrameRecord& record = records_.emplace_back();
    record.frame = frame;
    if (!options_.output.empty()) record.file = OutputName(options_.output).file(frame);
    std::string print =
        fingerprint(options_, scene_hash_, settings_.width, settings_.height, rate_.value(), time);
    bool wants_file = !record.file.empty();
    if (wants_file && options_.skip_existing && keep_existing(record.file, print)) {
        record.skipped = true;
        progress_.frame_skipped(frame, index, record.file);
        return kExitOk;
    }
    if (wants_file)
        if (int code = refuse_unwritable(record.file)) return code;
    settings_.integrator.seed = options_.seed * 0x9e3779b9u + uint32_t(frame);
    auto on_tile = [&](int done, int total) {
        progress_.tile(frame, index, done, total);
        return g_signal == 0;
    };
    raytrace::Progress progress(on_tile);
    if (first_ray_ms_ == 0) first_ray_ms_ = since_start_.ms();
    ptrdiff_t unwritten = unwritable();
    bool whole = picture(record, time, progress);
    bool baked = unwritable() == unwritten;  // point files
    if (g_signal) return 128 + g_signal;
    flush_findings();
    if (!whole) return kExitSomeFailed;
    if (printer_.lacks_assets()) return kExitMissingAsset;  // textures are read when seen
    Stopwatch watch;
    if (wants_file) {
        int number = 0;
        std::string error = write_image(
            record.file, film_, options_.color,
            {{"Software", "kinora " KINORA_VERSION}, {"kinora/fingerprint", print}}, &number);
        if (!error.empty()) return report_unwritable(record.file, error, number);
    }
    if (!options_.contact_sheet.empty()) sheet_.add(to_8_bit(film_, options_.color));
    record.write_ms = watch.ms();
    progress_.frame_done(frame, index, record.file, record.stats.total + record.write_ms);
    return baked ? kExitOk : kExitSomeFailed;
}

// By the scene as loaded; where its displaced meshes are too coarse for the frame, by one diced for
// it too, so that a picture depends on its frame alone, not on those before. Where the limit of
// triangles leaves that no finer, by the first after all.
bool Render::picture(FrameRecord& record, double time, const raytrace::Progress& progress) {
    auto render = [&](Scene& scene, double most_dice_error) {
        settings_.most_dice_error = most_dice_error;
        return render_frame(scene, time, settings_, film_, record.stats, diagnostics_, &progress);
    };
    bool whole = render(*scene_, redicer_ ? kMostDiceError : 0);
    record.dice_error = record.stats.dice_error;
    if (!record.stats.too_coarse) return whole;
    Stopwatch watch;
    diagnostics_.report(Code::DICE_AGAIN, Location{}, time, record.dice_error);
    std::unique_ptr<Scene> closer = redicer_->make({time, {}}, diagnostics_);
    record.redice_ms = watch.ms();
    if (g_signal) return false;
    if (closer) {
        double pixels = record.dice_error * scene_->dice.pixels;
        size_t known = diagnostics_.findings().size();
        whole = render(*closer, pixels / closer->dice.pixels);
        diagnostics_.drop_repeats(known);  // a scene tells some things in its first frame
    }
    return closer && !record.stats.too_coarse ? whole : render(*scene_, 0);
}

void Render::expose() {
    double stops = options_.exposure;
    settings_.stop = &g_signal;
    if (options_.auto_exposure) {
        stops = auto_exposure(*scene_, settings_, diagnostics_);
        diagnostics_.report(Code::EXPOSURE_AUTO, Location{}, stops);
    }
    settings_.gain = std::exp2(stops);
}

// From here on a signal lets go of the frame under way; before, it just ends the process.
void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGALRM, &action, nullptr);
}

int Render::frames() {
    catch_signals();
    double aspect = camera_aspect(*scene_).value_or(16.0 / 9.0);
    double width = options_.width ? options_.width : 640;
    settings_.width = scaled(width);
    settings_.height = scaled(options_.height ? options_.height : width / aspect);
    settings_.integrator.samples_per_pixel = options_.quality.samples_per_pixel;
    settings_.integrator.filter = raytrace::find_pixel_filter(options_.filter);
    settings_.integrator.filter_width = options_.filter_width;
    settings_.integrator.background = options_.background;
    settings_.integrator.nan = options_.nan;
    const SceneOptions& played = scene_->options;
    auto list = frames_to_render(options_, rate_, played.start_time, played.end_time);
    if (!list) return kExitUsage;
    if (!options_.contact_sheet.empty())
        if (int code = refuse_unwritable(options_.contact_sheet)) return code;
    if (!options_.output.empty()) remove_stale_images(options_.output);
    scene_hash_ = hash_inputs(diagnostics_.files, *scene_->description);
    expose();
    progress_ = ProgressReport(options_.progress, list->size());
    int result = kExitOk;
    for (size_t i = 0; i < list->size(); ++i) {
        int code = one_frame((*list)[i].first, (*list)[i].second, i);
        if (code == kExitOk) continue;
        if (g_signal) {
            progress_.clear();
            return code;
        }
        if (!options_.keep_going) return code;
        // What a retry may help comes before what it cannot.
        if (result != kExitRetry) result = code == kExitRetry ? code : int(kExitSomeFailed);
    }
    progress_.clear();
    if (!options_.contact_sheet.empty()) {
        int number = 0;
        std::string error = write_png(options_.contact_sheet, sheet_.picture(), {}, &number);
        if (!error.empty()) {
            int code = report_unwritable(options_.contact_sheet, error, number);
            return result == kExitRetry ? result : code;
        }
    }
    return result;
}

}  // namespace

}  // namespace kinora

int main(int argc, char** argv) {
    kinora::RenderOptions options;
    if (std::optional<int> code = kinora::parse_render_options(argc, argv, options))
        return kinora::finish(*code, "kinora-render");
    std::signal(SIGPIPE, SIG_IGN);
    try {
        return kinora::finish(kinora::Render(options).run(), "kinora-render");
    } catch (const std::bad_alloc&) {
        std::fputs("kinora-render: out of memory\n", stderr);
        return kinora::kExitRetry;
    }
}
