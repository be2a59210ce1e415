// runtime/picture/shading/rays/map_tables.cpp: the brightness of an environment map, cell by cell.
#include "runtime/picture/shading/rays/map_tables.h"

#include <algorithm>
#include <vector>

#include "runtime/scene/images/map_light.h"
#include "runtime/scene/images/texture_store.h"

namespace kinora {

namespace {

constexpr uint32_t kMostColumns = 2048;
constexpr uint32_t kMostLooks = 4;  // along an edge of a cell

uint32_t width_of(TextureStore& store, int32_t map) {
    const Texture* texture = store.find(map);
    if (!texture) return 4;
    const StoredImage& image = *texture->image;
    if (!image.faces.empty()) return 4 * uint32_t(image.faces[0].levels[0].width);
    return uint32_t(image.pyramid.levels[0].width);
}

float brightness(vec3 light) {
    return std::max(light.x, 0.0f) + std::max(light.y, 0.0f) + std::max(light.z, 0.0f);
}

// The mean of looks at each cell.
std::vector<float> brightness_of_cells(TextureStore& store, int32_t map, const SphereCells& cells,
                                       uint32_t looks) {
    const uint32_t of_cell = looks * looks;
    std::vector<float> bright(cells.count());
    std::vector<vec3> directions(size_t(cells.columns) * of_cell), light(directions.size());
    for (uint32_t row = 0; row < cells.rows; ++row) {
        for (uint32_t i = 0; i < directions.size(); ++i) {
            const vec2 look(float(i % looks), float(i / looks % looks));
            directions[i] =
                cells.at(row * cells.columns + i / of_cell, (look + 0.5f) / float(looks));
        }
        light_of_map(store, map, directions, light.data());
        for (size_t i = 0; i < light.size(); ++i)
            bright[row * cells.columns + i / of_cell] += brightness(light[i]) / float(of_cell);
    }
    return bright;
}

// As fine as the map, so that a sun of one texel is a cell of its own.
EnvironmentTable make_table(TextureStore& store, int32_t map) {
    const uint32_t width = width_of(store, map);
    const uint32_t columns = std::clamp((width + 3) / 4 * 4, 4u, kMostColumns);
    const SphereCells cells{columns, columns / 2};
    const uint32_t looks = std::clamp((width + columns - 1) / columns, 1u, kMostLooks);
    return EnvironmentTable(cells, brightness_of_cells(store, map, cells, looks));
}

}  // namespace

const EnvironmentTable* MapTables::find(int32_t map) {
    std::lock_guard lock(mutex_);
    auto found = tables_.find(map);
    if (found == tables_.end()) found = tables_.emplace(map, make_table(store_, map)).first;
    return found->second.uneven() ? &found->second : nullptr;
}

}  // namespace kinora
