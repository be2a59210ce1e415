// runtime/picture/frame/redice.cpp: scenes built again, here or in the background.
#include "runtime/picture/frame/redice.h"

#include <algorithm>
#include <utility>

#include "runtime/base/parallel.h"
#include "runtime/picture/frame/frame.h"
#include "runtime/scene/build/build_scene.h"
#include "runtime/scene/description/displacements.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

bool may_dice(const SceneDescription& description, const SceneOptions& options) {
    return options.quality.displacement == DisplacementMode::True &&
           std::ranges::any_of(description.materials, displaces);
}

Redicer::Redicer(SceneDescription description, const SceneOptions& options)
    : description_(std::move(description)), options_(options) {
    options_.want_dumps = false;
}

Redicer::~Redicer() {
    give_up();
}

void Redicer::share(const Scene& first, const SourceFiles& texts) {
    textures_ = first.textures;
    points_ = first.points;
    texts_ = texts;
    options_.lights = first.options.lights;
}

PosedScene Redicer::build(const CloserView& view, Diagnostics& diagnostics,
                          const std::atomic<bool>* stop) const {
    BuildAgain again{view, textures_, stop};
    PosedScene made;
    made.scene = build_scene(std::make_shared<SceneDescription>(description_), options_,
                             diagnostics, &again);
    if (made) made.pose = std::make_unique<Pose>(*made.scene);
    return made;
}

PosedScene Redicer::make(const CloserView& view, Diagnostics& diagnostics) {
    size_t known = diagnostics.findings().size();
    PosedScene made = build(view, diagnostics, nullptr);
    diagnostics.drop_repeats(known);
    if (made) made.scene->points = points_;
    return made;
}

void Redicer::start(const CloserView& view) {
    give_up();
    findings_ = std::make_unique<Diagnostics>();
    findings_->files = texts_;
    thread_ = std::thread([this, view] {
        SerialScope serial;
        try {
            made_ = build(view, *findings_, &stop_);
            if (made_ && !stop_) {
                FrameSettings settings;
                settings.width = made_.scene->start.view.width;
                settings.height = made_.scene->start.view.height;
                FrameStats stats;
                pose_frame(*made_.scene, *made_.pose, view.time, settings, stats, *findings_);
            }
        } catch (...) {
            failure_ = std::current_exception();
        }
        done_ = true;
    });
}

void Redicer::give_up() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    stop_ = done_ = false;
    made_ = {};
    failure_ = nullptr;
}

PosedScene Redicer::take(Diagnostics& diagnostics) {
    if (!thread_.joinable()) return {};
    thread_.join();
    PosedScene made = std::move(made_);
    std::exception_ptr failure = failure_;
    give_up();
    if (failure) std::rethrow_exception(failure);
    size_t known = diagnostics.findings().size();
    auto limit = [](const Finding& f) { return f.info == &Code::DICE_LIMIT; };
    bool limit_told = std::ranges::any_of(diagnostics.findings(), limit);
    for (const Finding& finding : findings_->findings()) {
        if (limit_told && limit(finding)) continue;
        Finding& told = diagnostics.add(*finding.info, finding.where, finding.message);
        told.id_path = finding.id_path;
        told.help = finding.help;
        told.notes = finding.notes;
    }
    diagnostics.drop_repeats(known);
    if (made) made.scene->points = points_;  // from here on no other scene looks anything up
    return made;
}

}  // namespace kinora
