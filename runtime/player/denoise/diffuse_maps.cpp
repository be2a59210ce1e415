// runtime/player/denoise/diffuse_maps.cpp: sixteen pixels of a row at a time.
#include "runtime/player/denoise/diffuse_maps.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "jit/ir/kernel.h"
#include "rsl/model/renderer_services.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/images/texture_sample.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/shapes.h"

namespace kinora {

namespace {

constexpr int kLanes = jit::kMaxLanes;

// Slots of collada_*.sl and gltf_*.sl that hold what a surface is painted with.
constexpr const char* kSlots[] = {"diffuse", "base_color"};

struct DiffuseMap {
    const Texture* texture = nullptr;
    const VertexAttribute* st = nullptr;
    explicit operator bool() const { return texture && texture->image && st && st->stride >= 2; }
};

// The coordinates that the slot reads: its own set where the file names one.
const VertexAttribute* coordinates(const Surface& surface, const ShaderInstance& look,
                                   const std::string& slot) {
    for (size_t k = 0; k < look.varying.size() && k < surface.varying.size(); ++k)
        if (look.varying[k].name == slot + "_s" && surface.varying[k]) return surface.varying[k];
    return surface.st;
}

DiffuseMap find_map(const SceneShaders& shaders, TextureStore* textures, const Surface& surface) {
    const ShaderInstance& look = *shaders.shader_instances[surface.look];
    if (look.layers.empty() || !textures) return {};
    for (const std::string slot : kSlots)
        for (const ParamSource& param : look.layers.back().params)
            if (param.name == slot + "_map" && !param.strings.empty() && !param.strings[0].empty())
                return {textures->find(rsl::intern(param.strings[0])),
                        coordinates(surface, look, slot)};
    return {};
}

// s and t of the lanes' pixels, and from each to the next.
struct Coordinates {
    float s[kLanes] = {}, t[kLanes] = {}, dsdx[kLanes] = {}, dtdx[kLanes] = {};
    uint32_t mask = 0;
};

void find_coordinates(const DiffuseMap& map, const FirstHits& hits, size_t hit, uint32_t mask,
                      Coordinates& to) {
    to.mask = 0;
    for (uint32_t rest = mask; rest; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        const size_t from = hit + size_t(lane), corner = 3 * size_t(hits.primitive[from]);
        if (corner + 3 > map.st->corners.size()) continue;
        const float u = hits.u[from], v = hits.v[from], share[3] = {1 - u - v, u, v};
        to.s[lane] = to.t[lane] = 0;
        for (size_t k = 0; k < 3; ++k) {
            const float* st = &map.st->values[size_t(map.st->corners[corner + k]) * map.st->stride];
            to.s[lane] += share[k] * st[0];
            to.t[lane] += share[k] * st[1];
        }
        to.mask |= 1u << lane;
    }
    for (int lane = 0; lane < kLanes; ++lane) {
        const int next = lane + 1 < kLanes && (to.mask >> (lane + 1) & 1) ? lane + 1
                         : lane > 0 && (to.mask >> (lane - 1) & 1)        ? lane - 1
                                                                          : lane;
        // Across a seam the texture begins anew.
        const float ds = std::abs(to.s[next] - to.s[lane]), dt = std::abs(to.t[next] - to.t[lane]);
        to.dsdx[lane] = ds < 0.5f ? ds : 0.0f;
        to.dtdx[lane] = dt < 0.5f ? dt : 0.0f;
    }
}

void sample(const DiffuseMap& map, const Coordinates& at, float (&texels)[4][kLanes]) {
    static constexpr float kZeros[kLanes] = {};
    const TextureLanes lanes{kZeros, at.s,   at.t,   at.dsdx, at.dtdx, kZeros,
                             kZeros, kZeros, kZeros, kZeros,  kZeros,  texels[0]};
    sample_texture(map.texture->image->pyramid, map.texture->modes, TextureFilter::Trilinear,
                   at.mask, lanes);
}

}  // namespace

void fill_albedo(const SceneShapes& scene, const SceneShaders& shaders, TextureStore* textures,
                 const FirstHits& hits, Planes& planes) {
    std::vector<DiffuseMap> maps;
    for (const Surface& surface : scene.surfaces)
        maps.push_back(find_map(shaders, textures, surface));
    parallel_for(0, size_t(planes.height), 8, [&](size_t begin, size_t end) {
        Coordinates coordinates;
        float texels[4][kLanes];
        for (size_t y = begin; y < end; ++y)
            for (int x = 0; x < planes.width; x += kLanes) {
                const size_t to = planes.at(x, int(y)), hit = y * size_t(planes.width) + size_t(x);
                uint32_t textured = 0;
                for (int k = 0; k < std::min(kLanes, planes.width - x); ++k) {
                    planes.albedo[to + size_t(k)] = 0;
                    const uint32_t row = planes.surface[to + size_t(k)];
                    if (planes.variance[to + size_t(k)] > 0 && maps[row]) textured |= 1u << k;
                }
                while (textured) {
                    const uint32_t row = planes.surface[to + size_t(std::countr_zero(textured))];
                    uint32_t alike = 0;
                    for (uint32_t rest = textured; rest; rest &= rest - 1)
                        if (planes.surface[to + size_t(std::countr_zero(rest))] == row)
                            alike |= rest & -rest;
                    textured &= ~alike;
                    find_coordinates(maps[row], hits, hit, alike, coordinates);
                    sample(maps[row], coordinates, texels);
                    for (uint32_t rest = coordinates.mask; rest; rest &= rest - 1) {
                        const int k = std::countr_zero(rest);
                        planes.albedo[to + size_t(k)] = 0.2126f * texels[0][k] +
                                                        0.7152f * texels[1][k] +
                                                        0.0722f * texels[2][k];
                    }
                }
            }
    });
}

}  // namespace kinora
