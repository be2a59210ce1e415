// runtime/programs/render/run.cpp: one run from the command line to its exit code.
#include "runtime/programs/render/run.h"

#include <cerrno>
#include <utility>

#include "runtime/base/memory/heap.h"
#include "runtime/base/parallel.h"
#include "runtime/picture/explain/explain.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/list_scene.h"
#include "runtime/programs/common/scene_exit_code.h"
#include "runtime/programs/render/stats.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/texture_store.h"

namespace kinora {

namespace {

// Whether scenes of other settings are built besides the one that is rendered.
bool measures(const RenderOptions& options) {
    return !options.tradeoff.empty() || options.frame_target.any();
}

}  // namespace

Render::Render(const RenderOptions& options, ReadWorld* world, FindingPrinter::Told* told)
    : options_(options),
      asked_(options),
      scene_(options, measures(options) ? OpenScene::Keep::Source : OpenScene::Keep::Nothing),
      world_(world),
      printer_(options.findings, options.scene),
      progress_(options.progress, 1) {
    if (told) printer_.share(told);
}

int Render::run() {
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

int Render::result() {
    if (!options_.list.empty()) {
        std::fputs((options_.json ? list_scene_json(scene_.scene(), options_.list)
                                  : list_scene(scene_.scene(), options_.list))
                       .c_str(),
                   stdout);
        return kExitOk;
    }
    dump();
    if (!options_.tradeoff.empty()) return tradeoff();
    bool pictures = !options_.output.empty() || !options_.contact_sheet.empty() || options_.discard;
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

}  // namespace kinora
