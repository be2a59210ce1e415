// runtime/picture/shading/services.cpp: a scene's answers to its kernels at the points of a grid.
#include "runtime/picture/shading/grid_host.h"

#include <algorithm>

#include "raytrace/hits.h"
#include "runtime/base/stage_clock.h"
#include "runtime/picture/shading/bake.h"
#include "runtime/picture/shading/lighting/chosen_directions.h"
#include "runtime/picture/shading/lighting/light_records.h"
#include "runtime/picture/shading/print.h"
#include "runtime/picture/shading/ray_queue.h"
#include "runtime/picture/shading/ray_services.h"
#include "runtime/scene/kernels/stratified.h"
#include "runtime/scene/shaders/queries.h"
#include "runtime/scene/spaces.h"

namespace kinora {

namespace {

// The handle of a record set, in all lanes.
void answer_handle(const jit::ServiceCall& call, int32_t handle) {
    std::fill_n(call.results, jit::kMaxLanes, jit::float_of(handle));
}

}  // namespace

PictureHost::PictureHost(Grid& grid, const GridServices& services)
    : SceneHost(grid.frame.scene, grid.pose, *grid.look), grid_(grid), services_(services) {}

// "shader" and "object" of a surface are those of the shape that wears it.
dmat4 PictureHost::current_from_space(std::string_view name, size_t point) const {
    SpaceOwner owner = look_.space_owner();
    if (look_.kind == ShaderInstanceKind::Surface) {
        uint32_t hit = grid_.points[std::min(point, grid_.count() - 1)];
        const SceneShapes& scene = grid_.frame.shapes;
        owner.node = scene.shapes[scene.surfaces[grid_.hits.instance[hit]].shape].node;
    }
    return kinora::current_from_space(grid_.frame.nodes, pose_, name, owner);
}
void PictureHost::trace(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.trace(grid_, call);
}
void PictureHost::transmission(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.transmission(grid_, call);
}
void PictureHost::occlusion(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.occlusion(grid_, call);
}
void PictureHost::indirectdiffuse(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    services_.rays.indirect_diffuse(grid_, call);
}
void PictureHost::gather(const jit::ServiceCall& call) {
    StageScope stage(Stage::Nested);
    answer_handle(call, services_.gathers.gather(grid_, call));
}
void PictureHost::raylimit(const jit::ServiceCall& call) {
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        const bool asks = call.mask >> lane & 1;
        const bool ends = asks && ends_loops(budget_of(grid_, size_t(call.first + lane)));
        call.results[lane] = jit::float_of(int32_t(ends));
    }
}
void PictureHost::stratified(const jit::ServiceCall& call) {
    if (call.first != placed_) place_samples(call.first);
    answer_stratified(call, places_);
}
void PictureHost::place_samples(int32_t first) {
    placed_ = first;
    for (int lane = 0; lane < jit::kMaxLanes; ++lane) {
        const size_t i = std::min(size_t(first + lane), grid_.count() - 1);
        const raytrace::SampleSeries place =
            grid_.series ? grid_.series[i]
                         : series_of(grid_.hits, grid_.points[i], grid_.frame.seed);
        places_.seed[lane] = raytrace::hash(place.seed, uint32_t(grid_.look->index));
        places_.part[lane] = place.part;
        places_.shared[lane] = place.shared;
    }
}
void PictureHost::samplewish(const jit::ServiceCall& call) {
    if (grid_.answer)
        grid_.answer->tell(call);
    else
        std::fill_n(call.results, 5 * jit::kMaxLanes, 0.0f);
}
void PictureHost::lightsample(const jit::ServiceCall& call) {
    if (grid_.answer) grid_.answer->take(call);
}
void PictureHost::query(const jit::ServiceCall& call) {
    answer_query(scene_, pose_, look_, &grid_, call);
}

void GridHost::print(const jit::ServiceCall& call) {
    services_.prints.add(grid_, call);
}
void GridHost::lights(const jit::ServiceCall& call) {
    StageScope stage(Stage::Lights);
    answer_handle(call, services_.lights.at(grid_, call));
}
void GridHost::samplinglights(const jit::ServiceCall& call) {
    StageScope stage(Stage::Lights);
    answer_handle(call, services_.lights.along(grid_, call));
}
void GridHost::bake3d(const jit::ServiceCall& call) {
    services_.bakes.add(grid_, call);
}

void NotingHost::lights(const jit::ServiceCall& call) {
    grid_.record_sets[1] = {};
    answer_handle(call, 1);
}

void NotingHost::samplinglights(const jit::ServiceCall& call) {
    if (grid_.directions) grid_.directions->note(call);
    lights(call);
}

// As of rays that meet nothing: rsl/model/services.def.
void RelitHost::trace(const jit::ServiceCall& call) {
    std::fill_n(call.results, 3 * jit::kMaxLanes, 0.0f);
    std::fill_n(call.results + 3 * jit::kMaxLanes, jit::kMaxLanes, 1e30f);
}
void RelitHost::transmission(const jit::ServiceCall& call) {
    std::fill_n(call.results, 3 * jit::kMaxLanes, 1.0f);
}
void RelitHost::occlusion(const jit::ServiceCall& call) {
    std::fill_n(call.results, 7 * jit::kMaxLanes, 0.0f);
}
void RelitHost::indirectdiffuse(const jit::ServiceCall& call) {
    std::fill_n(call.results, 7 * jit::kMaxLanes, 0.0f);
}
void RelitHost::gather(const jit::ServiceCall& call) {
    grid_.record_sets[1] = {};
    answer_handle(call, 1);
}
// The set of the points themselves.
void RelitHost::lights(const jit::ServiceCall& call) {
    answer_handle(call, 0);
}
void RelitHost::samplinglights(const jit::ServiceCall& call) {
    gather(call);
}

}  // namespace kinora
