// runtime/kinora/kinora.cpp: the steps from a request to a picture.
#include "runtime/kinora/kinora.h"

#include <utility>

#include "runtime/base/check.h"
#include "runtime/base/raise_findings.h"
#include "runtime/base/stats.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/load/override_scene.h"
#include "runtime/scene/load/override_shader.h"

namespace kinora {

// What `body` returns; where a check of ourselves fails, a finding, and `otherwise`.
template <class Body, class Result>
Result OpenScene::checked(Result otherwise, const Body& body) {
    try {
        return body();
    } catch (const CheckFailed& mistake) {
        ++internal_checks_;
        diagnostics_.report(Code::INTERNAL_CHECK, Location{}, mistake.what());
        return otherwise;
    }
}

OpenScene::OpenScene(SceneRequest request, Keep keep) : request_(std::move(request)), keep_(keep) {
    judge_by(request_, diagnostics_);
}

SceneError OpenScene::read(const std::optional<std::string_view>& bytes) {
    return checked(SceneError::Internal, [&] { return read_source(bytes); });
}

SceneError OpenScene::take(SceneDescription made, const SourceFiles& files) {
    return checked(SceneError::Internal, [&] {
        built_ = {};
        diagnostics_.files = files;
        imported_ = import_made(request_, std::move(made), diagnostics_);
        return take_imported();
    });
}

SceneError OpenScene::build() {
    return checked(SceneError::Internal, [&] { return build_source(); });
}

// A pose that a failed check left halfway begins anew, since its memory of frames may be torn. What
// it is seen by stays. Without a scene nothing is done.
template <class Body>
bool OpenScene::in_pose(const Body& body) {
    if (!is_built()) return false;
    const size_t before = internal_checks_;
    const bool done = checked(false, body);
    if (internal_checks_ != before) {
        const uint32_t camera = built_.pose->camera;
        built_.pose = std::make_unique<Pose>(*built_.scene);
        built_.pose->camera = camera;
    }
    return done;
}

bool OpenScene::pose(double seconds) {
    return in_pose([&] { return pose_at(seconds); });
}

void OpenScene::ready_frames(const std::atomic<int>* stop) {
    in_pose([&] {
        settings_ = frame_settings(request_, scene(), pose(), diagnostics_, stop);
        frames_ready_ = true;
        return true;
    });
}

bool OpenScene::render(double seconds, raytrace::Film& film, RenderedFrame* cost,
                       const raytrace::Progress* progress) {
    RenderedFrame own;
    return in_pose([&] { return render_at(seconds, film, cost ? *cost : own, progress); });
}

SceneError OpenScene::read_source(const std::optional<std::string_view>& bytes) {
    built_ = {};
    imported_ = import_requested(request_, diagnostics_, bytes);
    if (!imported_) {
        raise_findings(diagnostics_, "XML_");
        return SceneError::Unreadable;
    }
    return take_imported();
}

SceneError OpenScene::take_imported() {
    rate_ = imported_->rate;
    return imported_->clip_known ? SceneError::None : SceneError::Request;
}

SceneError OpenScene::build_source() {
    built_ = {};
    frames_ready_ = false;
    if (!imported_) return SceneError::Unreadable;
    if (keep_ == Keep::Source) {
        built_ = build_imported(*imported_, diagnostics_);
    } else {
        built_ = build_imported(std::move(*imported_), diagnostics_);
        imported_.reset();
    }
    return forbidding_error(diagnostics_, built_.scene ? SceneError::None : SceneError::Unreadable);
}

SceneError OpenScene::open(const std::optional<std::string_view>& bytes) {
    const SceneError error = read(bytes);
    return error == SceneError::None ? build() : error;
}

bool OpenScene::set_shader(const std::string& pattern, const std::string& shader) {
    return imported_ && checked(false, [&] {
               return override_shader(imported_->description, pattern,
                                      {shader, request_.include_directories}, diagnostics_);
           });
}

bool OpenScene::set_param(const std::string& target, const std::string& value) {
    return imported_ && checked(false, [&] {
               return override_param(imported_->description, target, value, diagnostics_);
           });
}

void OpenScene::set_camera(const std::string& name) {
    request_.camera = name;
    if (imported_) imported_->options.camera = name;
}

void OpenScene::set_quality(const Quality& quality) {
    request_.quality = quality;
    if (imported_) imported_->options.quality = quality;
}

bool OpenScene::pose_at(double seconds) {
    if (!frames_ready_) ready_frames();
    if (!frames_ready_) return false;
    FrameStats stats;
    settings_.most_dice_error = 0;
    return pose_frame(scene(), pose(), seconds, settings_, stats, diagnostics_);
}

bool OpenScene::render_at(double seconds, raytrace::Film& film, RenderedFrame& c,
                          const raytrace::Progress* progress) {
    if (!frames_ready_) ready_frames();
    if (!frames_ready_) return false;
    auto render = [&](const Scene& scene, Pose& pose, double most_dice_error) {
        settings_.most_dice_error = most_dice_error;
        return render_frame(scene, pose, seconds, settings_, film, c.stats, diagnostics_, progress);
    };
    bool whole = render(scene(), pose(), built_.redicer ? kMostDiceError : 0);
    c.dice_error = c.stats.dice_error;
    if (!c.stats.too_coarse) return whole;
    // A scene diced for this frame too. Where the limit of triangles leaves that no finer, the
    // first one makes the picture after all.
    Stopwatch watch;
    diagnostics_.report(Code::DICE_AGAIN, Location{}, seconds, c.dice_error);
    CloserView view{seconds, {}};
    if (settings_.camera) view.camera = pose().view;
    PosedScene closer = built_.redicer->make(view, diagnostics_);
    if (closer) closer.pose->camera = pose().camera;
    c.redice_ms = watch.ms();
    if (settings_.stop && *settings_.stop != 0) return false;
    if (closer) {
        const double pixels = c.dice_error * scene().dice.pixels;
        const size_t known = diagnostics_.findings().size();
        whole = render(*closer.scene, *closer.pose, pixels / closer.scene->dice.pixels);
        diagnostics_.drop_repeats(known);  // a scene tells some things in its first frame
    }
    return closer && !c.stats.too_coarse ? whole : render(scene(), pose(), 0);
}

}  // namespace kinora
