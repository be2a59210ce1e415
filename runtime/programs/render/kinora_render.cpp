// runtime/programs/render/kinora_render.cpp: a scene to a sequence of pictures.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>

#include "raytrace/ray_tracer.h"
#include "runtime/base/files/temporary_file.h"
#include "runtime/base/memory/heap.h"
#include "runtime/base/parallel.h"
#include "runtime/kinora/kinora.h"
#include "runtime/picture/explain/explain.h"
#include "runtime/picture/trade/variants.h"
#include "runtime/programs/common/contact_sheet.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/list_scene.h"
#include "runtime/programs/common/run_program.h"
#include "runtime/programs/common/scene_exit_code.h"
#include "runtime/programs/common/standard_streams.h"
#include "runtime/programs/render/band_writer.h"
#include "runtime/programs/render/fingerprint.h"
#include "runtime/programs/render/frame_codes.h"
#include "runtime/programs/render/frame_writer.h"
#include "runtime/programs/render/frames_to_render.h"
#include "runtime/programs/render/options.h"
#include "runtime/programs/render/run_report.h"
#include "runtime/programs/render/stats.h"
#include "runtime/programs/render/targeted.h"
#include "runtime/programs/render/worlds.h"
#include "runtime/programs/tradeoff/asserts.h"
#include "runtime/programs/tradeoff/tradeoff.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {

namespace {

// Set by the first signal; the frame under way is dropped at its next rays. A second signal stops
// at once, and so does a shader that takes longer than this.
constexpr unsigned kStopSeconds = 4;
std::atomic<int> g_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int number) {
    const bool again = number == SIGXCPU || number == SIGXFSZ;  // sent until the process ends
    if (g_signal && again) return;
    if (g_signal) {
        unlink_temporaries();
        _exit(128 + g_signal);
    }
    g_signal = number;
    alarm(kStopSeconds);
}

// Whether scenes of other settings are built besides the one that is rendered.
bool measures(const RenderOptions& options) {
    return !options.tradeoff.empty() || options.frame_target.any();
}

class Render {
  public:
    // `world`, which the scene is instead of the file's, and `told` may be null.
    explicit Render(const RenderOptions& options, ReadWorld* world = nullptr,
                    FindingPrinter::Told* told = nullptr)
        : options_(options),
          asked_(options),
          scene_(options, measures(options) ? OpenScene::Keep::Source : OpenScene::Keep::Nothing),
          world_(world),
          printer_(options.findings, options.scene),
          progress_(options.progress, 1) {
        if (told) printer_.share(told);
    }

    int run() {
        set_thread_count(options_.threads);
        ready_heap(heap_of_scene(options_.scene));
        options_.color = encoding_of(options_);  // once: a look into the file
        int code = load();
        printer_.summarize();
        if (code == kExitOk) code = printer_.exit_code(result());
        printer_.summarize();
        tell_frames();
        return code;
    }

  private:
    int result() {
        if (!options_.list.empty()) {
            std::fputs((options_.json ? list_scene_json(scene_.scene(), options_.list)
                                      : list_scene(scene_.scene(), options_.list))
                           .c_str(),
                       stdout);
            return kExitOk;
        }
        dump();
        if (!options_.tradeoff.empty()) return tradeoff();
        bool pictures =
            !options_.output.empty() || !options_.contact_sheet.empty() || options_.discard;
        int code = pictures ? frames() : int(kExitOk);
        if (!options_.explain.empty()) print_explained();
        if (!pictures) return code;
        if (options_.stats)
            print_stats(options_,
                        {load_ms_, build_ms_, first_ray_ms_, scene_.scene().dice,
                         scene_.scene().textures ? scene_.scene().textures->decoded_bytes() : 0},
                        list_, records_);
        return code;
    }

    int load();
    SceneError read();
    void flush_findings();
    void dump() const;
    void print_explained();
    int frames();
    bool list_frames();
    bool all_frames();
    int write_sheet();
    int look_again(int code);
    void tell_frames() const;
    int tradeoff();
    std::string scene_fingerprint() const;
    void tell_target(const std::string& text) const;
    int choose_settings_for_target();
    FrameTimes frames_to_probe() const;
    bool choose_samples(int64_t frame, double time, const raytrace::Progress& progress);
    int report_unreadable() const;
    int report_unwritable(const std::string& file, const std::string& error, int number);
    ptrdiff_t unwritable() const;
    int refuse_unwritable(const std::string& file);
    int ready_folders();
    std::vector<DisplayFile> displays_of(const std::string& picture) const;
    Exposure exposure_of_file() const;
    bool keep_existing(const std::string& file, const std::string& print);
    void end_write();
    int end_bands(FrameRecord& record, bool whole);
    int one_frame(int64_t frame, double time, size_t index);
    bool picture(FrameRecord& record, double time, const raytrace::Progress& progress);
    void place_session_camera(double time);

    RenderOptions options_;      // with the settings that --target-ms and --target-error choose
    const RenderOptions asked_;  // without
    OpenScene scene_;
    ReadWorld* world_;
    FindingPrinter printer_;
    std::optional<TargetedFrames> targeted_;
    PlacedCamera placed_;
    raytrace::Film film_, spare_film_;
    ProgressReport progress_;
    ContactSheet sheet_;
    FrameTimes list_;                   // the frames to render
    std::vector<FrameRecord> records_;  // of those that were begun
    FrameWriter writer_;
    BandWriter bands_;
    FrameCodes codes_{options_.keep_going};
    Stopwatch since_start_;
    double load_ms_ = 0, build_ms_ = 0, first_ray_ms_ = 0;
    uint64_t scene_hash_ = 0;
};

void Render::flush_findings() {
    progress_.clear();
    printer_.print(scene_.diagnostics());
}

// A world of a film may be read in the midst of its file, whose texts are still needed.
SceneError Render::read() {
    if (!world_) return scene_.read();
    const SceneError unread = scene_.take(std::move(world_->scene), world_->found.files.fork());
    for (const Finding& finding : world_->found.findings())
        scene_.diagnostics().add(*finding.info, finding.where, finding.message) = finding;
    return unread;
}

int Render::load() {
    Stopwatch watch;
    const SceneError unread = read();
    if (unread == SceneError::Unreadable || unread == SceneError::Internal) {
        flush_findings();
        return unread == SceneError::Internal ? exit_code_of(unread) : report_unreadable();
    }
    load_ms_ = watch.restart() + (world_ ? world_->ms : 0);
    if (unread != SceneError::None) {
        flush_findings();
        std::fprintf(stderr, "kinora-render: no clip '%s'; --list clips shows them\n",
                     options_.clip.c_str());
        return kExitUsage;
    }
    ImportedScene& imported = *scene_.imported();
    imported.options.want_dumps = !options_.dump.empty();
    const bool good = !options_.session || apply_edits(imported, options_.session->edits, options_,
                                                       scene_.diagnostics());
    if (good) scene_.build();
    build_ms_ = watch.ms();
    flush_findings();
    int code = exit_code_of(forbidding_error(scene_.diagnostics()));
    if (code != kExitOk) return code;
    if (!scene_.is_built()) return report_unreadable();
    // An Error means that there is no picture; what --fail-on names besides comes with one.
    return printer_.exit_code_of_errors();
}

// An exit code that is not 0 has an error behind it.
int Render::report_unreadable() const {
    if (!scene_.diagnostics().has_errors())
        std::fprintf(stderr, "kinora-render: error: '%s' cannot be rendered\n",
                     options_.scene.c_str());
    return kExitUnreadable;
}

void Render::dump() const {
    for (const auto& [stage, text] : scene_.scene().options.dumps)
        for (const std::string& wanted : options_.dump)
            if (stage == wanted || stage.starts_with(wanted + ":"))
                std::printf("; stage %s\n%s\n", stage.c_str(), text.c_str());
}

void Render::print_explained() {
    auto rows = explain(scene_.scene(), scene_.pose(), options_.quality, options_.preset);
    std::string text = options_.explain == "json" ? explained_json(rows) : explained_text(rows);
    std::fputs(text.c_str(), stdout);
}

int Render::report_unwritable(const std::string& file, const std::string& error, int number) {
    scene_.diagnostics().report(Code::FRAME_UNWRITABLE, Location{}, file, error);
    flush_findings();
    bool full = number == ENOSPC || number == EDQUOT || number == ENOMEM;
    return full ? kExitRetry : kExitUnwritable;
}

// How many files could not be written so far; those that shaders bake too.
ptrdiff_t Render::unwritable() const {
    const std::vector<Finding>& findings = scene_.diagnostics().findings();
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

// Once: a folder that is removed while frames are made is not made again.
int Render::ready_folders() {
    for (const std::string& file : {options_.contact_sheet, options_.output}) {
        if (file.empty()) continue;
        if (int number = make_folder_of(file))
            return report_unwritable(file, std::strerror(number), number);
        remove_old_temporaries(file);
    }
    return options_.contact_sheet.empty() ? int(kExitOk)
                                          : refuse_unwritable(options_.contact_sheet);
}

// What the scene's file shows besides its picture.
std::vector<DisplayFile> Render::displays_of(const std::string& picture) const {
    const std::optional<FilePicture>& own = scene_.scene().description->file_picture;
    if (picture.empty() || !own) return {};
    NumberedDisplays numbered{OutputName(options_.output).number(own->number), {}};
    if (world_) numbered.stems = world_->shared_stems;
    std::vector<DisplayFile> files = displays_beside(picture, own->displays, numbered);
    auto is_there = [&](const std::string& output) {
        return std::ranges::count(scene_.scene().outputs, output, &OutputPlane::parameter) > 0;
    };
    std::erase_if(files,
                  [&](const DisplayFile& file) { return !has_outputs(file.display, is_there); });
    return files;
}

Exposure Render::exposure_of_file() const {
    const std::optional<FilePicture>& own = scene_.scene().description->file_picture;
    return own ? own->exposure : Exposure();
}

// Whether the file is that picture already; the contact sheet shows it, too. A picture that lacked
// an asset when it was made has no checksum.
bool Render::keep_existing(const std::string& file, const std::string& print) {
    if (read_image_text(file, "kinora/fingerprint") != print) return false;
    if (!has_intact_pixels(file)) return false;
    for (const DisplayFile& beside : displays_of(file))
        if (read_image_text(beside.path, "kinora/fingerprint") != print) return false;
    if (options_.contact_sheet.empty()) return true;
    std::optional<Image8> image = read_image(file, encoding_of(options_));
    if (image) sheet_.add(*image);
    return image.has_value();
}

int Render::one_frame(int64_t frame, double time, size_t index) {
    const size_t number = records_.size();
    FrameRecord& record = records_.emplace_back();
    record.frame = frame;
    record.index = index;
    record.pixels = size_t(scene_.settings().width) * size_t(scene_.settings().height);
    if (!options_.output.empty()) record.file = OutputName(options_.output).file(frame);
    std::string print = fingerprint(asked_, scene_hash_, scene_.settings().width,
                                    scene_.settings().height, scene_.rate().value(), time);
    bool wants_file = !record.file.empty();
    if (wants_file && options_.skip_existing) end_write();  // pictures of a sheet come in order
    if (wants_file && options_.skip_existing && keep_existing(record.file, print)) {
        record.state = FrameState::Kept;
        progress_.frame_skipped(frame, index, record.file);
        return kExitOk;
    }
    const std::vector<DisplayFile> displays = displays_of(record.file);
    if (wants_file)
        if (int code = refuse_unwritable(record.file)) return code;
    for (const DisplayFile& beside : displays)
        if (int code = refuse_unwritable(beside.path)) return code;
    scene_.settings().integrator.seed = frame_seed(options_, frame);
    auto on_tile = [&](int done, int total) {
        progress_.tile(frame, index, done, total);
        return g_signal == 0;
    };
    raytrace::Progress progress(on_tile);
    if (first_ray_ms_ == 0) first_ray_ms_ = since_start_.ms();
    ptrdiff_t unwritten = unwritable();
    WrittenFrame to_write{.record = number,
                          .file = record.file,
                          .color = encoding_of(options_),
                          .depth = options_.quality.depth,
                          .texts = {{"Software", "kinora " KINORA_VERSION},
                                    {"kinora/fingerprint", print},
                                    {kChecksumText, ""}},
                          .film = {},
                          .displays = displays,
                          .exposed = exposure_of_file()};
    const bool in_bands = scene_.settings().band_rows > 0;
    if (in_bands) bands_.start(to_write, scene_.settings().height);
    bool whole =
        (!targeted_ || choose_samples(frame, time, progress)) && picture(record, time, progress);
    bool baked = unwritable() == unwritten;  // point files
    end_write();
    if (g_signal) return 128 + g_signal;
    if (codes_.ended()) return codes_.code();
    flush_findings();
    if (in_bands)
        if (int code = end_bands(record, whole)) return code;
    if (!whole) return kExitSomeFailed;
    if (world_ && world_->keep) world_->keep(film_);
    record.samples = scene_.settings().integrator.samples_per_pixel;
    if (targeted_) targeted_->took(record.samples, record.stats.total);
    if (printer_.lacks_assets()) return kExitMissingAsset;  // textures are read when seen
    if (wants_file && !in_bands) {
        if (printer_.misses_assets()) to_write.texts.pop_back();
        to_write.film = std::exchange(film_, std::move(spare_film_));
        writer_.start(std::move(to_write), thread_count() > 1);
        if (thread_count() == 1) end_write();
    } else {
        Stopwatch watch;
        if (!options_.contact_sheet.empty()) sheet_.add(to_8_bit(film_, encoding_of(options_)));
        record.write_ms += watch.ms();
        record.state = FrameState::Done;
        progress_.frame_done(frame, index, record.file, record.stats.total + record.write_ms);
    }
    return baked ? kExitOk : kExitSomeFailed;
}

// Of a frame in bands: its file, if all of them came.
int Render::end_bands(FrameRecord& record, bool whole) {
    const WrittenFrame written = bands_.finish(whole, !printer_.misses_assets());
    record.write_ms = written.ms;
    if (written.error.empty()) return kExitOk;
    return report_unwritable(written.file, written.error, written.number);
}

// Waits for the frame that is being written, if any.
void Render::end_write() {
    std::optional<WrittenFrame> written = writer_.finish();
    if (!written) return;
    FrameRecord& record = records_[written->record];
    if (!written->error.empty()) {
        record.state = FrameState::Failed;
        codes_.go_on_after(report_unwritable(written->file, written->error, written->number));
    } else {
        Stopwatch watch;
        if (!options_.contact_sheet.empty())
            sheet_.add(to_8_bit(written->film, encoding_of(options_)));
        record.write_ms = written->ms + watch.ms();
        if (record.state == FrameState::Aborted) record.state = FrameState::Done;
        progress_.frame_done(record.frame, record.index, record.file,
                             record.stats.total + record.write_ms);
    }
    spare_film_ = std::move(written->film);
}

void Render::place_session_camera(double time) {
    if (!options_.session || !options_.session->camera.own) return;
    const SessionCamera& camera = options_.session->camera;
    placed_ = placed_camera(scene_.scene(), scene_.pose(), *camera.own, camera.follow, time);
    scene_.settings().camera = &placed_;
}

bool Render::picture(FrameRecord& record, double time, const raytrace::Progress& progress) {
    place_session_camera(time);
    RenderedFrame cost;
    const bool whole = scene_.render(time, film_, &cost, &progress);
    record.stats = cost.stats;
    record.dice_error = cost.dice_error;
    record.redice_ms = cost.redice_ms;
    return whole;
}

// From here on a signal lets go of the frame under way; before, it just ends the process.
void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    for (int number : {SIGINT, SIGTERM, SIGALRM}) sigaction(number, &action, nullptr);
    // What the caller has ignored (nohup) stays so.
    for (int number : {SIGHUP, SIGXCPU, SIGXFSZ}) {
        struct sigaction before {};
        sigaction(number, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
    }
}

bool Render::list_frames() {
    auto list = frames_to_render(options_, scene_.rate(), scene_.scene(), scene_.scene());
    if (!list) return false;
    list_ = std::move(*list);
    report_past(options_, scene_.rate(), scene_.scene(), list_, scene_.diagnostics());
    return true;
}

int Render::frames() {
    catch_signals();
    if (!list_frames()) return kExitUsage;
    if (int code = ready_folders()) return code;
    scene_hash_ =
        hash_inputs(scene_.diagnostics().files, *scene_.scene().description, options_.scene);
    if (options_.frame_target.any())
        if (int code = choose_settings_for_target()) return code;
    if (!world_) scene_.diagnostics().files.cut_long_lines();
    scene_.ready_frames(&g_signal);
    FrameSettings& settings = scene_.settings();
    if (const auto& session = options_.session) {
        choose_camera(scene_.scene(), scene_.pose(), session->camera);
        settings.gain *= std::exp2(session->exposure);
        if (session->width > 0) settings.width = session->width;
        if (session->height > 0) settings.height = session->height;
    }
    // A contact sheet, displays, maps and settings for a target take whole pictures.
    const bool kept = world_ && world_->keep;
    if (options_.contact_sheet.empty() && !options_.frame_target.any() && !kept &&
        displays_of(options_.output).empty()) {
        settings.band_rows = band_rows(settings.width, settings.height, settings.integrator.tile);
        settings.on_band = [this](const raytrace::Film& band) { return bands_.take(band); };
    }
    progress_ = ProgressReport(options_.progress, list_.size());
    const bool all = all_frames();
    progress_.clear();
    if (all) tell_target(targeted_ ? targeted_->end_text() : "");
    const int code = all ? write_sheet() : codes_.code();
    const bool stopped = g_signal && (!all || code != kExitOk);
    return look_again(stopped ? 128 + g_signal : code);
}

// False where the run ends before its last frame.
bool Render::all_frames() {
    for (size_t i = 0; i < list_.size(); ++i) {
        const int code = one_frame(list_[i].first, list_[i].second, i);
        const bool stopped = g_signal || codes_.ended();
        if (code != kExitOk)
            records_.back().state = stopped ? FrameState::Aborted : FrameState::Failed;
        if (code != kExitOk || i + 1 == list_.size()) end_write();
        if (g_signal && code != kExitOk) return false;
        if (!codes_.go_on_after(code)) return false;
    }
    return true;
}

// The exit code of the run, which the sheet may change.
int Render::write_sheet() {
    if (options_.contact_sheet.empty()) return codes_.code();
    int number = 0;
    std::string error = write_png(options_.contact_sheet, sheet_.picture(), {}, &number);
    if (error.empty()) return codes_.code();
    const int code = report_unwritable(options_.contact_sheet, error, number);
    return codes_.code() == kExitRetry ? codes_.code() : code;
}

// A frame that was reported as done may have gone since, alone or with its folder.
int Render::look_again(int code) {
    const std::vector<std::string> lost = mark_lost_frames(records_);
    for (const std::string& file : lost)
        scene_.diagnostics().report(Code::FRAME_GONE, Location{}, file);
    flush_findings();
    const bool gone = !lost.empty() || !folder_is_there(options_.output);
    const bool worse = code == kExitOk || code == kExitSomeFailed;
    return worse && gone ? int(kExitUnwritable) : code;
}

// The last line on stderr. One frame that is there says enough.
void Render::tell_frames() const {
    const bool brief = options_.findings.quiet || list_.size() <= 1;
    if (brief && all_frames_there(list_, records_)) return;
    std::fprintf(stderr, "%s\n", frames_text(list_, records_).c_str());
}

void Render::tell_target(const std::string& text) const {
    if (!text.empty() && !options_.findings.quiet)
        std::fprintf(stderr, "kinora-render: %s\n", text.c_str());
}

// An error's settings are those of the shot, so that a frame has the same ones in each part of it.
FrameTimes Render::frames_to_probe() const {
    if (options_.frame_target.ms > 0) return list_;
    const SceneOptions& played = scene_.scene().options;
    FrameTimes middle = middle_of_shot(options_, scene_.rate(), played.start_time, played.end_time);
    if (!middle.empty()) return middle;
    tell_target(target_text(options_.frame_target) +
                ": the scene plays without end, so the frames given here choose the settings; "
                "give all frames of the shot, or --quality");
    return list_;
}

// Chooses settings and builds the scene with them, where it was built with others.
int Render::choose_settings_for_target() {
    std::string why_not;
    const FrameTimes probed = frames_to_probe();
    auto chosen = choose_settings({.scene = options_,
                                   .imported = *scene_.imported(),
                                   .frames = probed,
                                   .target = options_.frame_target,
                                   .fixed = options_.fixed_settings,
                                   .measured = options_.measured,
                                   .fingerprint = scene_fingerprint(),
                                   .stop = &g_signal},
                                  scene_.diagnostics(), why_not);
    flush_findings();
    if (g_signal) return 128 + g_signal;
    if (!chosen) {
        std::fprintf(stderr, "kinora-render: error: %s: %s\n",
                     target_text(options_.frame_target).c_str(), why_not.c_str());
        return kExitSomeFailed;
    }
    targeted_.emplace(options_.frame_target, *chosen);
    tell_target(targeted_->begin_text());
    options_.quality = chosen->quality;
    scene_.set_quality(options_.quality);
    if (scene_key(asked_.quality) == scene_key(options_.quality)) return kExitOk;
    scene_.keep(OpenScene::Keep::Nothing);
    const size_t known = scene_.diagnostics().findings().size();
    scene_.build();
    scene_.diagnostics().drop_repeats(known);
    return scene_.is_built() ? int(kExitOk) : report_unreadable();
}

bool Render::choose_samples(int64_t frame, double time, const raytrace::Progress& progress) {
    SceneRequest seeded = options_;
    auto pass = [&](int samples, uint32_t seed, raytrace::Film& film) {
        FrameSettings settings = scene_.settings();
        settings.integrator.samples_per_pixel = samples;
        seeded.seed = options_.seed + seed;
        settings.integrator.seed = frame_seed(seeded, frame);
        settings.most_dice_error = 0;
        FrameStats stats;
        const size_t known = scene_.diagnostics().findings().size();
        bool whole = render_frame(scene_.scene(), scene_.pose(), time, settings, film, stats,
                                  scene_.diagnostics(), &progress);
        scene_.diagnostics().drop_repeats(known);
        return whole;
    };
    scene_.settings().integrator.samples_per_pixel = targeted_->samples(pass);
    return scene_.settings().integrator.samples_per_pixel > 0;
}

// Of the scene and what its pictures depend on besides knobs and frames.
std::string Render::scene_fingerprint() const {
    RenderOptions plain = asked_;
    plain.quality = *find_quality(kDefaultQuality);
    plain.frame_target = {};
    return fingerprint(plain, scene_hash_, options_.width, options_.height, scene_.rate().value(),
                       0);
}

int Render::tradeoff() {
    std::vector<TradeAssert> asserts;
    for (const std::string& text : options_.asserts) {
        std::string error;
        std::optional<TradeAssert> parsed = parse_trade_assert(text, error);
        if (!parsed) {
            std::fprintf(stderr, "kinora-render: --assert: %s\n", error.c_str());
            return kExitUsage;
        }
        asserts.push_back(std::move(*parsed));
    }
    if (int code = try_tradeoff_folder(options_.tradeoff)) return code;
    catch_signals();
    if (!list_frames()) return kExitUsage;
    scene_hash_ =
        hash_inputs(scene_.diagnostics().files, *scene_.scene().description, options_.scene);
    std::string print = scene_fingerprint();
    scene_.close();  // its memory is for the scenes to come
    TradeResults results;
    bool measured = measure_tradeoff({.scene = options_,
                                      .imported = *scene_.imported(),
                                      .frames = std::exchange(list_, {}),
                                      .fingerprint = std::move(print),
                                      .budget_s = options_.budget,
                                      .tell = !options_.findings.quiet,
                                      .stop = &g_signal},
                                     scene_.diagnostics(), results);
    flush_findings();
    if (g_signal) return 128 + g_signal;
    if (!measured) return kExitSomeFailed;
    std::fputs(tradeoff_text(results).c_str(), stdout);
    if (int code = write_tradeoff(results, options_.tradeoff)) return code;
    std::vector<std::string> broken = broken_asserts(results, asserts);
    for (const std::string& text : broken)
        std::fprintf(stderr, "kinora-render: error: --assert %s\n", text.c_str());
    return broken.empty() ? kExitOk : kExitSomeFailed;
}

// Of a word of the command line.
bool names_file(const char* word) {
    std::error_code code;
    return std::filesystem::is_regular_file(word, code);
}

}  // namespace

// One picture after another; the run ends with the first that fails, unless --keep-going is given.
static int render_worlds(const RenderOptions& options) {
    const std::optional<ChosenWorlds> worlds = worlds_to_render(options);
    if (!worlds) return kExitUsage;
    if (worlds->wanted.empty()) return Render(options).run();  // which says why
    FrameCodes codes(options.keep_going);
    FindingPrinter::Told told;
    Diagnostics found;
    const bool read = read_worlds(options, *worlds, found, [&](ReadWorld world) {
        return codes.go_on_after(Render(world.options, &world, &told).run());
    });
    if (read) return codes.code();
    FindingPrinter(options.findings, options.scene).print(found);
    return kExitUnreadable;
}

}  // namespace kinora

int main(int argc, char** argv) {
    kinora::ready_standard_streams();
    kinora::ready_heap(kinora::kHeapOfStart);
    return kinora::run_program("kinora-render", [&]() -> int {
        // Where a file is named a scene will be traced: not for --version.
        std::jthread opening;
        if (std::any_of(argv + std::min(argc, 1), argv + argc, kinora::names_file))
            opening = kinora::raytrace::open_ray_tracer_early();
        kinora::RenderOptions options;
        if (std::optional<int> code = kinora::parse_render_options(argc, argv, options))
            return *code;
        if (!kinora::is_rib(options.scene)) return kinora::Render(options).run();
        return kinora::render_worlds(options);
    });
}
