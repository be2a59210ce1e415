// runtime/programs/render/run.h: a scene read, built and rendered to a sequence of pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/base/stats.h"
#include "runtime/kinora/kinora.h"
#include "runtime/programs/common/contact_sheet.h"
#include "runtime/programs/common/finding_printer.h"
#include "runtime/programs/common/progress.h"
#include "runtime/programs/render/band_writer.h"
#include "runtime/programs/render/frame_codes.h"
#include "runtime/programs/render/frame_writer.h"
#include "runtime/programs/render/frames_to_render.h"
#include "runtime/programs/render/options.h"
#include "runtime/programs/render/run_report.h"
#include "runtime/programs/render/targeted.h"
#include "runtime/programs/render/worlds.h"

namespace kinora {

class Render {
  public:
    // `world`, which the scene is instead of the file's, and `told` may be null.
    explicit Render(const RenderOptions& options, ReadWorld* world = nullptr,
                    FindingPrinter::Told* told = nullptr);
    int run();

  private:
    int result();
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
    void hash_scene();
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
    std::vector<ExrAttribute> attributes(int64_t frame);
    ImageTexts header_texts(const std::string& print) const;
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

}  // namespace kinora
