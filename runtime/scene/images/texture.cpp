// runtime/scene/images/texture.cpp: the texture services: names and arguments to the sampler.
#include "runtime/scene/images/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "jit/ir/ir.h"
#include "rsl/model/renderer_services.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/images/latlong/kernels.h"
#include "runtime/scene/images/texture_p.h"

namespace kinora {

namespace {

const float* argument(const jit::ServiceCall& call, int index) {
    return call.args + index * jit::kMaxLanes;
}

// The "filter" parameter; any other name is the default, anisotropic.
struct FilterRow {
    std::string_view name;
    TextureFilter filter;
};
constexpr FilterRow kFilters[] = {
    {"point", TextureFilter::Nearest},       {"nearest", TextureFilter::Nearest},
    {"closest", TextureFilter::Nearest},     {"bilinear", TextureFilter::Bilinear},
    {"trilinear", TextureFilter::Trilinear},
};
TextureFilter filter_of(int32_t name) {
    if (name == 0) return TextureFilter::Anisotropic;
    static const auto ids = [] {
        std::array<int32_t, std::size(kFilters)> interned;
        for (size_t i = 0; i < interned.size(); ++i) interned[i] = rsl::intern(kFilters[i].name);
        return interned;
    }();
    for (size_t i = 0; i < ids.size(); ++i)
        if (ids[i] == name) return kFilters[i].filter;
    return TextureFilter::Anisotropic;
}

// The lanes of `mask` whose int in this row is the first one's.
uint32_t lanes_like_first(const float* row, uint32_t mask) {
    int32_t first = jit::bits_of(row[std::countr_zero(mask)]);
    uint32_t same = 0;
    for (int i = 0; i < jit::kMaxLanes; ++i) same |= uint32_t(jit::bits_of(row[i]) == first) << i;
    return same & mask;
}

void fill_lanes(uint32_t mask, const float* fill, float* results) {
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < jit::kMaxLanes; ++i)
            if (mask >> i & 1) results[k * jit::kMaxLanes + i] = fill[i];
}

// The texture of lanes that share a name; null for none.
const Texture* texture_of(TextureStore& store, const float* names, uint32_t mask) {
    return find_texture(store, jit::bits_of(names[std::countr_zero(mask)]));
}

// Directions as coordinates, footprints as their angles.
LatlongPlaces places_of(const jit::ServiceCall& call) {
    static_assert(kLatlongLanes == jit::kMaxLanes);
    constexpr int kFirst = rsl::service_argument(rsl::Service::environment, "R").first;
    LatlongPlaces places;
    latlong_kernels().footprints(argument(call, kFirst), places);
    return places;
}
uint32_t usable_lanes(const LatlongPlaces& places) {
    uint32_t mask = 0;
    for (int i = 0; i < kLatlongLanes; ++i) mask |= places.usable[i] << i;
    return mask;
}

constexpr auto filled_row(float value) {
    std::array<float, jit::kMaxLanes> row{};
    row.fill(value);
    return row;
}
constexpr auto kZeros = filled_row(0), kOnes = filled_row(1);

}  // namespace

const Texture* find_texture(TextureStore& store, int32_t name) {
    const Texture* texture = store.find(name);
    if (texture && !texture->image->error.empty())
        texture->image->asked.store(true, std::memory_order_relaxed);
    return texture;
}

namespace {

// Rows of t and of its slopes that run downwards.
class TurnedRows {
  public:
    void turn(TextureLanes& lanes) {
        for (int i = 0; i < jit::kMaxLanes; ++i) {
            t_[i] = 1 - lanes.t[i];
            dtdx_[i] = -lanes.dtdx[i];
            dtdy_[i] = -lanes.dtdy[i];
        }
        lanes.t = t_, lanes.dtdx = dtdx_, lanes.dtdy = dtdy_;
    }

  private:
    alignas(64) float t_[jit::kMaxLanes], dtdx_[jit::kMaxLanes], dtdy_[jit::kMaxLanes];
};

}  // namespace

void lookup_texture(const jit::ServiceCall& call, TextureStore& store, TextureFilter best) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::texture, name).first;
    };
    auto row = [&](int index) { return argument(call, index); };
    const float *map = row(at("map")), *filters = row(at("filter")), *fill = row(at("fill"));
    TextureLanes lanes{row(at("channel")),
                       row(at("s")),
                       row(at("t")),
                       row(at("dsdx")),
                       row(at("dtdx")),
                       row(at("dsdy")),
                       row(at("dtdy")),
                       row(at("blur")),
                       row(at("swidth")),
                       row(at("twidth")),
                       fill,
                       call.results};
    TurnedRows turned;
    if (store.from_top()) turned.turn(lanes);
    for (uint32_t left = call.mask; left;) {
        uint32_t same = lanes_like_first(map, left);
        same = lanes_like_first(filters, same);
        left &= ~same;
        int32_t filter = jit::bits_of(filters[std::countr_zero(same)]);
        if (const Texture* texture = texture_of(store, map, same))
            sample_texture(texture->image->pyramid, texture->modes,
                           std::min(filter_of(filter), best), same, lanes);
        else
            fill_lanes(same, fill, call.results);
    }
}

void lookup_environment(const jit::ServiceCall& call, TextureStore& store, TextureFilter best) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::environment, name).first;
    };
    auto row = [&](int index) { return argument(call, index); };
    const float *map = row(at("map")), *fill = row(at("fill"));
    const LatlongPlaces places = places_of(call);
    const uint32_t usable = usable_lanes(places);
    TextureLanes lanes{row(at("channel")), places.s,      places.t,  places.ds,
                       kZeros.data(),      kZeros.data(), places.dt, row(at("blur")),
                       kOnes.data(),       kOnes.data(),  fill,      call.results};
    TextureName modes;
    modes.wrap_t = TextureWrap::Clamp;
    fill_lanes(call.mask & ~usable, fill, call.results);
    for (uint32_t left = call.mask & usable; left;) {
        uint32_t same = lanes_like_first(map, left);
        left &= ~same;
        const Texture* texture = texture_of(store, map, same);
        if (texture && !texture->image->faces.empty()) {
            lookup_cube(*texture->image, call, same);
        } else if (texture) {
            modes.nearest = texture->modes.nearest;
            sample_texture(texture->image->pyramid, modes, best, same, lanes);
        } else {
            fill_lanes(same, fill, call.results);
        }
    }
}

void preload_textures(const SceneDescription& description, TextureStore& store) {
    std::vector<std::string> names;
    auto add_strings = [&](const ShaderUse& use) {
        for (const ParamSource& source : use.params)
            names.insert(names.end(), source.strings.begin(), source.strings.end());
        if (!use.shader) return;
        for (const rsl::ShaderParameter& parameter : use.shader->parameters)
            if (parameter.constant)
                names.insert(names.end(), parameter.constant->strings.begin(),
                             parameter.constant->strings.end());
    };
    for_each_shader_use(description, add_strings);
    store.preload(names);
}

void preload_named_pictures(const SceneDescription& description, TextureStore& store) {
    std::vector<std::string> names;
    for_each_shader_use(description, [&](const ShaderUse& use) {
        if (use.shader && use.shader->ast)
            names.insert(names.end(), use.shader->ast->pictures.begin(),
                         use.shader->ast->pictures.end());
    });
    store.preload(names);
}

}  // namespace kinora
