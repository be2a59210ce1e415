// runtime/programs/render/run_frames.cpp: the frames of a run, one after another, and their files.
#include "runtime/programs/render/run.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "runtime/base/files/temporary_file.h"
#include "runtime/base/parallel.h"
#include "runtime/kinora/aov_texts.h"
#include "runtime/kinora/frame_attributes.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/render/exr_options.h"
#include "runtime/programs/render/fingerprint.h"
#include "runtime/programs/render/stop_signal.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

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
        return std::ranges::count(scene_.scene().outputs, output, &OutputPlane::layer) > 0;
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

std::vector<ExrAttribute> Render::attributes(int64_t frame) {
    return frame_attributes(scene_.scene(), scene_.pose(), scene_.rate(), frame);
}

// With the checksum last, which a picture that lacks an asset goes without.
ImageTexts Render::header_texts(const std::string& print) const {
    ImageTexts texts{{"Software", "kinora " KINORA_VERSION}, {"kinora/fingerprint", print}};
    for (auto& text : stamp_texts(options_)) texts.push_back(std::move(text));
    for (auto& text : aov_texts(scene_.scene())) texts.push_back(std::move(text));
    texts.emplace_back(kChecksumText, "");
    return texts;
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
                          .format = exr_format(options_),
                          .texts = header_texts(print),
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
        to_write.format.attributes = attributes(frame);
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

bool Render::list_frames() {
    auto list = frames_to_render(options_, scene_.rate(), scene_.scene(), scene_.scene());
    if (!list) return false;
    list_ = std::move(*list);
    report_past(options_, scene_.rate(), scene_.scene(), list_, scene_.diagnostics());
    return true;
}

int Render::frames() {
    if (loses_digits(options_, scene_.scene())) {
        scene_.diagnostics().report(Code::AOV_LOSSY, Location{}, options_.exr.compression->name);
        flush_findings();
        return kExitUsage;
    }
    catch_signals();
    if (!list_frames()) return kExitUsage;
    if (int code = ready_folders()) return code;
    hash_scene();
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
        settings.on_band = [this](const raytrace::Film& band) {
            if (band.top == 0) bands_.describe(attributes(records_.back().frame));
            return bands_.take(band);
        };
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

}  // namespace kinora
