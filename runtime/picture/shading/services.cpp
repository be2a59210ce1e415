// runtime/picture/shading/services.cpp: a scene's answers to its kernels at the points of a grid.
#include "runtime/picture/shading/grid_host.h"

#include <algorithm>

#include "runtime/base/stage_clock.h"
#include "runtime/picture/shading/bake.h"
#include "runtime/picture/shading/light_records.h"
#include "runtime/picture/shading/nested_rays.h"
#include "runtime/picture/shading/print.h"
#include "runtime/picture/shading/ray_services.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/shaders/queries.h"
#include "runtime/scene/spaces.h"

namespace kinora {

namespace {

// The handle of a record set, in all lanes.
void answer_handle(const jit::ServiceCall& call, int32_t handle) {
    std::fill_n(call.results, jit::kMaxLanes, jit::float_of(handle));
}

}  // namespace

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
