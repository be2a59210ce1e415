// runtime/ri/render_session.cpp: calls to pictures.
#include <algorithm>
#include <utility>

#include "raytrace/film.h"
#include "raytrace/kept_trees.h"
#include "runtime/kinora/kinora.h"
#include "runtime/ri/display_files.h"
#include "runtime/ri/session.h"
#include "runtime/scene/quality/quality.h"
#include "runtime/scene/ri/import/interpretation.h"
#include "runtime/scene/ri/meshes/merge_meshes.h"

namespace kinora::ri {
namespace {

// The scene of a file that would stand where the program runs.
SceneRequest program_request() {
    SceneRequest request;
    request.scene = "program.rib";
    request.quality = *find_quality(kDefaultQuality);
    request.color = ColorEncoding::Linear;
    request.trees = std::make_shared<raytrace::KeptTrees>();
    request.displays = true;
    return request;
}

Diagnostics& judged(const SceneRequest& request, Diagnostics& diagnostics) {
    judge_by(request, diagnostics);
    return diagnostics;
}

class RenderSession : public Session {
  public:
    RenderSession()
        : request_(program_request()),
          calls_(request_.scene, import_options(request_), {}, judged(request_, diagnostics_),
                 [this](SceneDescription&& world) { return render(std::move(world)); }),
          files_(diagnostics_) {}

    Context& context() override { return calls_.context(); }
    void finish() override { calls_.finish(); }

  private:
    bool render(SceneDescription&& world);
    void take_findings(const OpenScene& scene);

    SceneRequest request_;
    Diagnostics diagnostics_;
    Interpretation calls_;
    DisplayFiles files_;
};

// Always true: a program that makes no more pictures would not say why.
bool RenderSession::render(SceneDescription&& world) {
    const FilePicture picture = world.file_picture.value();
    OpenScene scene(request_, OpenScene::Keep::Nothing);
    merge_meshes(world);
    SceneError error = scene.take(std::move(world), diagnostics_.files);
    if (error == SceneError::None) error = scene.build();
    raytrace::Film film;
    bool whole = false;
    if (error == SceneError::None) {
        scene.ready_frames();
        scene.settings().integrator.seed = frame_seed(request_, picture.number);
        whole = scene.render(scene.scene().options.start_time, film);
    }
    take_findings(scene);
    if (whole) files_.write(picture, film);
    return true;
}

void RenderSession::take_findings(const OpenScene& scene) {
    for (const Finding& finding : scene.diagnostics().findings())
        diagnostics_.add(*finding.info, finding.where, finding.message);
}

}  // namespace

std::unique_ptr<Session> render_session() {
    return std::make_unique<RenderSession>();
}

}  // namespace kinora::ri
