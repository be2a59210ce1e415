// runtime/shading/services.cpp: the table of functions that generated code calls.
#include "runtime/shading/services.h"

#include <algorithm>
#include <cstdio>
#include <glm/matrix.hpp>

#include "rsl/model/renderer_services.h"
#include "rsl/model/service_table.h"
#include "runtime/images/texture.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/spaces.h"
#include "runtime/shading/bake.h"
#include "runtime/shading/light_records.h"
#include "runtime/shading/print.h"
#include "runtime/shading/queries.h"
#include "runtime/shading/ray_services.h"

namespace kinora {

namespace {

constexpr int kLanes = jit::kMaxLanes;

const float* argument(const jit::ServiceCall& call, int index) {
    return call.args + index * kLanes;
}
float* result(const jit::ServiceCall& call, int index) {
    return call.results + index * kLanes;
}
const KernelHost& host_of(const jit::ServiceCall& call) {
    return *static_cast<const KernelHost*>(call.grid);
}
Grid& grid_of(const jit::ServiceCall& call) {
    return *host_of(call).grid;
}

// Kernels that move vertices see no lights and no other surfaces.
template <rsl::Service service>
bool zeros_without_grid(const jit::ServiceCall& call) {
    if (host_of(call).grid) return false;
    rsl::answer_zeros<service>(call);
    return true;
}

void lights(const jit::ServiceCall& call) {
    if (zeros_without_grid<rsl::Service::lights>(call)) return;
    Grid& grid = grid_of(call);
    int32_t handle = grid.services->lights.at(grid, call);
    for (int i = 0; i < kLanes; ++i) result(call, 0)[i] = jit::float_of(handle);
}

void texture(const jit::ServiceCall& call) {
    lookup_texture(call, *host_of(call).scene->textures);
}
void environment(const jit::ServiceCall& call) {
    lookup_environment(call, *host_of(call).scene->textures);
}

void texture_info(const jit::ServiceCall& call) {
    lookup_texture_info(call, *host_of(call).scene->textures);
}

void shadow(const jit::ServiceCall& call) {
    const KernelHost& host = host_of(call);
    lookup_shadow(call, glm::inverse(current_from_space(*host.scene, "world", host.look->node)),
                  *host.scene->textures);
}

void trace(const jit::ServiceCall& call) {
    if (zeros_without_grid<rsl::Service::trace>(call)) return;
    Grid& grid = grid_of(call);
    grid.services->rays.trace(grid, call);
}
void transmission(const jit::ServiceCall& call) {
    if (zeros_without_grid<rsl::Service::transmission>(call)) return;
    Grid& grid = grid_of(call);
    grid.services->rays.transmission(grid, call);
}
void occlusion(const jit::ServiceCall& call) {
    if (zeros_without_grid<rsl::Service::occlusion>(call)) return;
    Grid& grid = grid_of(call);
    grid.services->rays.occlusion(grid, call);
}
void indirectdiffuse(const jit::ServiceCall& call) {
    if (zeros_without_grid<rsl::Service::indirectdiffuse>(call)) return;
    Grid& grid = grid_of(call);
    grid.services->rays.indirect_diffuse(grid, call);
}
void gather_service(const jit::ServiceCall& call) {
    Grid& grid = grid_of(call);
    int32_t handle = grid.services->gathers.gather(grid, call);
    for (int i = 0; i < kLanes; ++i) result(call, 0)[i] = jit::float_of(handle);
}
void query(const jit::ServiceCall& call) {
    answer_query(host_of(call), call);
}
void bake3d(const jit::ServiceCall& call) {
    if (zeros_without_grid<rsl::Service::bake3d>(call)) return;
    Grid& grid = grid_of(call);
    grid.services->bakes.add(grid, call);
}
void texture3d(const jit::ServiceCall& call) {
    look_up_points(host_of(call), call);
}
void photons(const jit::ServiceCall& call) {
    look_up_photons(host_of(call), call);
}

void transform(const jit::ServiceCall& call) {
    const KernelHost& host = host_of(call);
    for (int i = 0; i < kLanes; ++i) {
        if (!(call.mask >> i & 1)) continue;
        int32_t space = jit::bits_of(argument(call, 0)[i]);
        uint32_t node = host.look->node;
        if (host.grid && host.look->kind == ShaderInstanceKind::Surface) {
            const Grid& grid = *host.grid;
            size_t point = std::min(size_t(call.first + i), grid.count() - 1);
            const Surface& surface = grid.scene.surfaces[grid.hits.instance[grid.points[point]]];
            node = grid.scene.shapes[surface.shape].node;
        }
        const std::string& name = rsl::interned(space);
        dmat4 to = host.vertices ? object_from_space(*host.scene, name, host.vertices->node)
                                 : current_from_space(*host.scene, name, node);
        dmat4 from = glm::inverse(to);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column) {
                result(call, row * 4 + column)[i] = float(to[column][row]);
                result(call, 12 + row * 4 + column)[i] = float(from[column][row]);
            }
    }
}

// At frame rate it prints at once: once per instance and frame.
void print(const jit::ServiceCall& call) {
    const KernelHost& host = host_of(call);
    if (host.grid) {
        host.grid->services->prints.add(*host.grid, call);
    } else if (host.vertices) {
        for (int lane = 0; lane < call.lanes; ++lane)
            if (call.mask >> lane & 1) *host.vertices->prints += print_text(call, lane);
    } else
        std::fputs(print_text(call, 0).c_str(), stdout);
}

constexpr rsl::ServiceTable kServices = {
    .lights = lights,
    .texture = texture,
    .environment = environment,
    .shadow = shadow,
    .textureinfo = texture_info,
    .trace = trace,
    .transmission = transmission,
    .occlusion = occlusion,
    .indirectdiffuse = indirectdiffuse,
    .gather = gather_service,
    .query = query,
    .bake3d = bake3d,
    .texture3d = texture3d,
    .photons = photons,
    .transform = transform,
    .print = print,
};

}  // namespace

jit::ServiceFn find_service(std::string_view name) {
    return rsl::find_service(kServices, name);
}

}  // namespace kinora
