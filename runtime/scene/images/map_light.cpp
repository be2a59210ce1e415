// runtime/scene/images/map_light.cpp: directions to colors of maps, and back.
#include "runtime/scene/images/map_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "jit/ir/kernel_call.h"
#include "rsl/model/renderer_services.h"
#include "runtime/scene/images/latlong/kernels.h"
#include "runtime/scene/images/map_distribution.h"
#include "runtime/scene/images/texture.h"
#include "runtime/scene/images/texture_store.h"

namespace kinora {

void light_of_map(TextureStore& store, int32_t map, std::span<const vec3> directions, vec3* light) {
    alignas(64) float args[13 * jit::kMaxLanes] = {}, results[4 * jit::kMaxLanes];
    for (size_t begin = 0; begin < directions.size(); begin += jit::kMaxLanes) {
        size_t count = std::min(directions.size() - begin, size_t(jit::kMaxLanes));
        for (size_t i = 0; i < count; ++i) {
            args[i] = jit::float_of(map);
            for (int k = 0; k < 3; ++k)
                args[(2 + k) * jit::kMaxLanes + int(i)] = directions[begin + i][k];
        }
        lookup_environment({nullptr, args, results, (1u << count) - 1, 0, jit::kMaxLanes}, store);
        for (size_t i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k) light[begin + i][k] = results[k * jit::kMaxLanes + int(i)];
    }
}

namespace {

// Where one of the four texels about a direction is no number, neither is the light.
vec3 sound(vec3 light) {
    for (int k = 0; k < 3; ++k)
        if (!(std::isfinite(light[k]) && light[k] > 0)) light[k] = 0;
    return light;
}

// ---- how bright a map is ------------------------------------------------------------------------

constexpr uint32_t kMostColumns = 2048, kMostRows = 1024;

// The texels of a map as latitudes and longitudes see them; of a cube about so many.
struct MapTexels {
    explicit MapTexels(const StoredImage& image) {
        const bool cube = !image.faces.empty();
        const TextureLevel& level = (cube ? image.faces[0] : image.pyramid).levels[0];
        columns = uint32_t(cube ? 4 * level.width : level.width);
        rows = uint32_t(cube ? 2 * level.width : level.height);
    }
    uint32_t columns, rows;
};

// From the middle of a texel, or of a part of it, as fine as `grid`; row 0 is the top one.
vec3 middle_of(const MapTexels& grid, uint32_t column, uint32_t row) {
    const double theta = kPi * (row + 0.5) / grid.rows,
                 phi = 2 * kPi * ((column + 0.5) / grid.columns - 0.5);
    return {float(-std::sin(theta) * std::sin(phi)), float(std::cos(theta)),
            float(std::sin(theta) * std::cos(phi))};
}

float sum_of(vec3 light) {
    return light.x / 3 + light.y / 3 + light.z / 3;
}

// As fine as the map, up to a size. Beyond it, a cell holds the mean of its texels.
MapDistribution make_distribution(TextureStore& store, int32_t map, const StoredImage& image) {
    const MapTexels texels(image);
    const uint32_t looks = std::max({(texels.columns + kMostColumns - 1) / kMostColumns,
                                     (texels.rows + kMostRows - 1) / kMostRows, 1u});
    const uint32_t columns = (texels.columns + looks - 1) / looks,
                   rows = (texels.rows + looks - 1) / looks;
    MapTexels fine = texels;
    fine.columns = columns * looks, fine.rows = rows * looks;
    std::vector<float> brightness(size_t(columns) * rows);
    std::vector<vec3> directions(fine.columns), light(fine.columns);
    for (uint32_t y = 0; y < fine.rows; ++y) {
        for (uint32_t x = 0; x < fine.columns; ++x) directions[x] = middle_of(fine, x, y);
        light_of_map(store, map, directions, light.data());
        for (uint32_t x = 0; x < fine.columns; ++x)
            brightness[size_t(y / looks) * columns + x / looks] +=
                sum_of(sound(light[x])) / float(looks * looks);
    }
    return MapDistribution(columns, rows, brightness);
}

}  // namespace

const MapDistribution* distribution_of(TextureStore& store, int32_t map) {
    const Texture* texture = store.find(map);
    if (!texture) return nullptr;
    std::call_once(texture->lights_once, [&] {
        texture->by_light =
            std::make_unique<const MapDistribution>(make_distribution(store, map, *texture->image));
    });
    return texture->by_light.get();
}

// ---- services -----------------------------------------------------------------------------------

namespace {

float argument(const jit::ServiceCall& call, int row, int lane) {
    return call.args[row * jit::kMaxLanes + lane];
}

// Calls f(lanes, distribution) for the lanes that ask, those of one map together.
template <class F>
void for_each_map(const jit::ServiceCall& call, int map_row, TextureStore& store, F&& f) {
    static const MapDistribution white;
    for (uint32_t left = call.mask; left;) {
        const int32_t map = jit::bits_of(argument(call, map_row, std::countr_zero(left)));
        uint32_t same = 0;
        for (int lane = 0; lane < jit::kMaxLanes; ++lane)
            same |= uint32_t(jit::bits_of(argument(call, map_row, lane)) == map) << lane;
        same &= left;
        left &= ~same;
        const MapDistribution* found = distribution_of(store, map);
        f(same, found ? *found : white);
    }
}

}  // namespace

// The light of all lanes at once. Of lanes without a map it is the fill color, white.
void lookup_map_light(const jit::ServiceCall& call, TextureStore& store) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::maplight, name).first;
    };
    constexpr auto looks_at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::environment, name).first;
    };
    constexpr int kLanes = jit::kMaxLanes;
    alignas(64) float args[rsl::argument_count(rsl::Service::environment) * kLanes] = {},
                                                                            light[4 * kLanes] = {};
    std::copy_n(call.args + at("map") * kLanes, kLanes, args + looks_at("map") * kLanes);
    std::copy_n(call.args + at("D") * kLanes, 3 * kLanes, args + looks_at("R") * kLanes);
    int32_t map = 0;
    float fill = 1;
    for (uint32_t left = call.mask; left; left &= left - 1) {
        const int lane = std::countr_zero(left);
        const int32_t own = jit::bits_of(argument(call, at("map"), lane));
        if (left == call.mask || own != map) map = own, fill = store.find(map) ? 0.0f : 1.0f;
        args[looks_at("fill") * kLanes + lane] = fill;
    }
    lookup_environment({nullptr, args, light, call.mask, 0, kLanes}, store);
    for (uint32_t left = call.mask; left; left &= left - 1) {
        const int lane = std::countr_zero(left);
        const vec3 seen = sound({light[lane], light[kLanes + lane], light[2 * kLanes + lane]});
        for (int k = 0; k < 3; ++k) call.results[k * kLanes + lane] = seen[k];
    }
}

void lookup_map_density(const jit::ServiceCall& call, TextureStore& store) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::mapdensity, name).first;
    };
    LatlongPlaces places;
    latlong_kernels().places(call.args + at("D") * jit::kMaxLanes, places);
    for_each_map(call, at("map"), store, [&](uint32_t lanes, const MapDistribution& distribution) {
        distribution.densities(lanes, places, call.results);
    });
}

void lookup_map_direction(const jit::ServiceCall& call, TextureStore& store) {
    constexpr auto at = [](std::string_view name) consteval {
        return rsl::service_argument(rsl::Service::mapdirection, name).first;
    };
    for_each_map(call, at("map"), store, [&](uint32_t lanes, const MapDistribution& distribution) {
        distribution.directions(lanes, call.args + at("x") * jit::kMaxLanes,
                                call.args + at("y") * jit::kMaxLanes, call.results,
                                call.results + 3 * jit::kMaxLanes);
    });
}

}  // namespace kinora
