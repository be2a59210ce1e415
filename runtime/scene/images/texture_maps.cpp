// runtime/scene/images/texture_maps.cpp: what is known of an image, depth maps, and maps of six
// faces.
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

#include "jit/ir/ir.h"
#include "rsl/model/renderer_services.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/images/texture_p.h"

namespace kinora {

namespace {

float argument(const jit::ServiceCall& call, int index, int lane) {
    return call.args[index * jit::kMaxLanes + lane];
}
vec3 triple(const jit::ServiceCall& call, int first, int lane) {
    return {argument(call, first, lane), argument(call, first + 1, lane),
            argument(call, first + 2, lane)};
}

// ---- textureinfo --------------------------------------------------------------------------------

constexpr int kIsString = -1;

// Numbers of a fact, or kIsString; 0 if it is not known.
int find_fact(const TextureFacts& facts, std::string_view name, float* values) {
    auto copy = [&](const std::array<float, 16>& matrix) {
        std::copy(matrix.begin(), matrix.end(), values);
        return facts.has_matrices ? 16 : 0;
    };
    if (name == "resolution")
        return values[0] = float(facts.width), values[1] = float(facts.height), 2;
    if (name == "channels") return values[0] = float(facts.channels), 1;
    if (name == "type") return values[0] = jit::float_of(rsl::intern(facts.type)), kIsString;
    if (name == "exists") return values[0] = 1, 1;
    if (name == "viewingmatrix") return copy(facts.world_to_camera);
    if (name == "projectionmatrix") return copy(facts.world_to_screen);
    return 0;
}

// ---- shadow -------------------------------------------------------------------------------------

// RenderMan's matrices are for row vectors.
vec4 row_times(vec3 p, const std::array<float, 16>& m) {
    vec4 r;
    for (int k = 0; k < 4; ++k)
        r[k] = p.x * m[size_t(k)] + p.y * m[size_t(4 + k)] + p.z * m[size_t(8 + k)] +
               m[size_t(12 + k)];
    return r;
}

// A point as the map sees it: s, t in 0..1 from the lower left, and its depth.
struct Seen {
    vec2 position{0, 0};
    float depth = 0;
    bool inside = false;
};
Seen seen_from(const TextureFacts& facts, vec3 world) {
    vec4 screen = row_times(world, facts.world_to_screen);
    float depth = row_times(world, facts.world_to_camera).z;
    if (!(screen.w > 0) || !(depth > 0)) return {};
    vec2 position = (vec2(screen) / screen.w + 1.0f) * 0.5f;
    bool inside = position.x >= 0 && position.x <= 1 && position.y >= 0 && position.y <= 1;
    return {position, depth, inside};
}

constexpr float kSlope = 0.002f;  // bias as a share of the depth, where none is given
constexpr int kMostSide = 32;     // samples along one side

// The share of the footprint, widened by blur (a share of the map), that lies behind what the map
// saw. Beyond the map's edges there is light.
float share_behind(const StoredImage& image, const Seen& at, vec2 extent, float bias, int side) {
    const TexturePyramid& pyramid = image.pyramid;
    const TextureLevel& level = pyramid.levels[0];
    float limit = at.depth - (bias >= 0 ? bias : kSlope * at.depth);
    int behind = 0;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            vec2 offset = (vec2(float(i), float(j)) + 0.5f) / float(side) - 0.5f;
            vec2 p = at.position + offset * extent;
            if (!(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1)) continue;
            float z =
                pyramid.texel(0, int(p.x * float(level.width)), int(p.y * float(level.height)))[0];
            behind += z < limit;
        }
    return float(behind) / float(side * side);
}

// ---- six faces ----------------------------------------------------------------------------------

// Face of a direction and the position on it, from -1 to 1, s to the right and t upwards.
//
// As OpenEXR lays out its cubes (ImfEnvmap.h): faces +x
// -x +y -y +z -z from the top, the outermost texels' centres on the cube's edges.
struct OnFace {
    int face;
    float s, t;
};
OnFace face_of(vec3 d) {
    vec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) {
        float y = d.y / a.x, z = d.z / a.x;
        return d.x > 0 ? OnFace{0, z, y} : OnFace{1, -z, y};
    }
    if (a.y >= a.z) {
        float x = d.x / a.y, z = d.z / a.y;
        return d.y > 0 ? OnFace{2, x, z} : OnFace{3, x, -z};
    }
    float x = d.x / a.z, y = d.y / a.z;
    return d.z > 0 ? OnFace{4, -x, y} : OnFace{5, x, y};
}

// What a left-handed camera with y up sees: x to the right of z, -z to the right of x. Looking
// along y its up is -z, along -y it is z (RI 3.2, section 7.1).
OnFace camera_face_of(vec3 d) {
    vec3 a = glm::abs(d);
    if (a.x >= a.y && a.x >= a.z) {
        float y = d.y / a.x, z = d.z / a.x;
        return d.x > 0 ? OnFace{0, -z, y} : OnFace{1, z, y};
    }
    if (a.y >= a.z) {
        float x = d.x / a.y, z = d.z / a.y;
        return d.y > 0 ? OnFace{2, x, -z} : OnFace{3, x, z};
    }
    float x = d.x / a.z, y = d.y / a.z;
    return d.z > 0 ? OnFace{4, x, y} : OnFace{5, -x, y};
}

// Where it lies in the picture of its face, from 0 to 1.
OnFace in_picture(const StoredImage& image, vec3 d) {
    if (image.face_extent > 0) {
        OnFace on = camera_face_of(d);
        return {on.face, on.s / image.face_extent * 0.5f + 0.5f,
                on.t / image.face_extent * 0.5f + 0.5f};
    }
    const float size = float(image.faces[0].levels[0].width);
    auto on_texels = [&](float x) { return ((x + 1) * 0.5f * (size - 1) + 0.5f) / size; };
    OnFace on = face_of(d);
    return {on.face, on_texels(on.s), on_texels(on.t)};
}

}  // namespace

void lookup_texture_info(const jit::ServiceCall& call, TextureStore& store) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::textureinfo, name).first;
    };
    for (int i = 0; i < jit::kMaxLanes; ++i) {
        if (!(call.mask >> i & 1)) continue;
        float values[16] = {};
        int32_t name = jit::bits_of(argument(call, at("map"), i));
        const std::string& field = rsl::interned(jit::bits_of(argument(call, at("field"), i)));
        int count = 0;
        // To ask whether a file is there is no use of it.
        const Texture* texture = store.find(name);
        if (texture && texture->image->error.empty())
            count = find_fact(texture->image->facts, field, values);
        else if (texture && field == "exists")
            count = 1;
        call.results[i] = jit::float_of(count);
        for (int k = 0; k < 16; ++k) call.results[(1 + k) * jit::kMaxLanes + i] = values[k];
    }
}

void lookup_shadow(const jit::ServiceCall& call, const dmat4& world_from_current,
                   TextureStore& store) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::shadow, name).first;
    };
    mat4 to_world(world_from_current);
    for (int i = 0; i < jit::kMaxLanes; ++i) {
        if (!(call.mask >> i & 1)) continue;
        for (int k = 0; k < 3; ++k) call.results[k * jit::kMaxLanes + i] = 0;
        const Texture* texture = find_texture(store, jit::bits_of(argument(call, at("map"), i)));
        if (!texture || !texture->image->error.empty() || !texture->image->facts.has_matrices)
            continue;
        const TextureFacts& facts = texture->image->facts;
        auto seen = [&](vec3 current) {
            return seen_from(facts, vec3(to_world * vec4(current, 1)));
        };
        vec3 p = triple(call, at("P"), i);
        Seen point = seen(p);
        if (!point.inside) continue;
        vec2 extent(1.0f / float(facts.width), 1.0f / float(facts.height));
        for (int from : {at("dPdx"), at("dPdy")}) {
            Seen beside = seen(p + triple(call, from, i));
            if (beside.depth > 0)
                extent = glm::max(extent, glm::abs(beside.position - point.position));
        }
        float blur = argument(call, at("blur"), i), samples = argument(call, at("samples"), i);
        extent = glm::min(extent, vec2(0.1f)) + std::clamp(blur, 0.0f, 1.0f);
        int side =
            int(std::ceil(std::sqrt(std::clamp(samples, 1.0f, float(kMostSide * kMostSide)))));
        float hidden =
            share_behind(*texture->image, point, extent, argument(call, at("bias"), i), side);
        for (int k = 0; k < 3; ++k) call.results[k * jit::kMaxLanes + i] = hidden;
    }
}

void lookup_cube(const StoredImage& image, const jit::ServiceCall& call, uint32_t mask) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::environment, name).first;
    };
    alignas(64) float s[jit::kMaxLanes] = {}, t[jit::kMaxLanes] = {}, ds[jit::kMaxLanes] = {},
                      zero[jit::kMaxLanes] = {}, one[jit::kMaxLanes];
    int face[jit::kMaxLanes] = {};
    std::fill_n(one, jit::kMaxLanes, 1.0f);
    const float extent = image.face_extent > 0 ? image.face_extent : 1;
    for (int i = 0; i < jit::kMaxLanes; ++i) {
        if (!(mask >> i & 1)) continue;
        vec3 d = triple(call, at("R"), i), dx = triple(call, at("dRdx"), i),
             dy = triple(call, at("dRdy"), i);
        OnFace on = in_picture(image, d);
        float large = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        face[i] = on.face;
        s[i] = on.s, t[i] = on.t;
        float width =
            std::sqrt(std::max(glm::dot(dx, dx), glm::dot(dy, dy))) / (2 * large * extent);
        ds[i] = width >= 0 ? std::min(width, 1.0f) : 0;
    }
    auto row = [&](int index) { return call.args + index * jit::kMaxLanes; };
    TextureLanes lanes{
        row(at("channel")), s,           t, ds, zero, zero, ds, row(at("blur")), one, one,
        row(at("fill")),    call.results};
    TextureName modes;
    modes.wrap_s = modes.wrap_t = TextureWrap::Clamp;
    for (int f = 0; f < 6; ++f) {
        uint32_t here = 0;
        for (int i = 0; i < jit::kMaxLanes; ++i) here |= uint32_t(face[i] == f) << i;
        here &= mask;
        if (here)
            sample_texture(image.faces[size_t(f)], modes, TextureFilter::Anisotropic, here, lanes);
    }
}

}  // namespace kinora
