// runtime/shading/services.cpp: a scene's answers to its kernels.
#include "runtime/shading/scene_host.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "runtime/base/stage_clock.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/spaces.h"
#include "runtime/shading/bake.h"
#include "runtime/shading/light_records.h"
#include "runtime/shading/nested_rays.h"
#include "runtime/shading/print.h"
#include "runtime/shading/queries.h"
#include "runtime/shading/ray_services.h"

namespace kinora {

namespace {

// The handle of a record set, in all lanes.
void answer_handle(const jit::ServiceCall& call, int32_t handle) {
    std::fill_n(call.results, jit::kMaxLanes, jit::float_of(handle));
}

}  // namespace

TextureStore& SceneHost::textures() const {
    return *scene_.textures;
}

TextureFilter SceneHost::best_filter() const {
    return scene_.options.quality.texture_filter;
}
dmat4 SceneHost::current_from_space(std::string_view name, size_t) const {
    return kinora::current_from_space(scene_, pose_, name, look_.space_owner());
}
dmat4 SceneHost::world_from_current() const {
    return glm::inverse(kinora::current_from_space(scene_, pose_, "world", kNone));
}
void SceneHost::texture3d(const jit::ServiceCall& call) {
    look_up_points(scene_, pose_, call);
}
void SceneHost::photons(const jit::ServiceCall& call) {
    look_up_photons(scene_, pose_, call);
}

void UnlitHost::query(const jit::ServiceCall& call) {
    answer_query(scene_, pose_, look_, nullptr, call);
}

void FrameHost::print(const jit::ServiceCall& call) {
    printed_.add(call, 0);
}

dmat4 VertexHost::current_from_space(std::string_view name, size_t) const {
    return object_from_space(scene_, pose_, name, object_);
}
void VertexHost::print(const jit::ServiceCall& call) {
    for (int lane = 0; lane < call.lanes; ++lane)
        if (call.mask >> lane & 1) prints_.add(call, lane);
}

GridHost::GridHost(Grid& grid, const GridServices& services)
    : SceneHost(grid.scene, grid.pose, *grid.look), grid_(grid), services_(services) {}

// "shader" and "object" of a surface are those of the shape that wears it.
dmat4 GridHost::current_from_space(std::string_view name, size_t point) const {
    SpaceOwner owner = look_.space_owner();
    if (look_.kind == ShaderInstanceKind::Surface) {
        uint32_t hit = grid_.points[std::min(point, grid_.count() - 1)];
        owner.node = scene_.shapes[scene_.surfaces[grid_.hits.instance[hit]].shape].node;
    }
    return kinora::current_from_space(scene_, pose_, name, owner);
}
// While rays are only noted (RayCollector), nothing is printed, baked or lit.
void GridHost::print(const jit::ServiceCall& call) {
    if (is_noting(grid_)) return;
    services_.prints.add(grid_, call);
}
void GridHost::lights(const jit::ServiceCall& call) {
    StageScope stage(Stage::Lights);
    if (is_noting(grid_)) {
        grid_.record_sets[1] = {};
        answer_handle(call, 1);
        return;
    }
    answer_handle(call, services_.lights.at(grid_, call));
}
void GridHost::trace(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.trace(grid_, call);
}
void GridHost::transmission(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.transmission(grid_, call);
}
void GridHost::occlusion(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.occlusion(grid_, call);
}
void GridHost::indirectdiffuse(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.indirect_diffuse(grid_, call);
}
void GridHost::gather(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    answer_handle(call, services_.gathers.gather(grid_, call));
}
void GridHost::raylimit(const jit::ServiceCall& call) {
    end_loops(grid_, call);
}
void GridHost::query(const jit::ServiceCall& call) {
    answer_query(scene_, pose_, look_, &grid_, call);
}
void GridHost::bake3d(const jit::ServiceCall& call) {
    if (is_noting(grid_)) return;
    services_.bakes.add(grid_, call);
}

}  // namespace kinora
