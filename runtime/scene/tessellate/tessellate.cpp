// runtime/scene/tessellate/tessellate.cpp: the way from a surface to its triangles.
#include "runtime/scene/tessellate/tessellate.h"

#include <utility>

#include "runtime/scene/tessellate/attributes_p.h"
#include "runtime/scene/tessellate/trim_p.h"

namespace kinora {

namespace tessellation {

namespace {

void add_cells(Grid& grid) {
    grid.corners.reserve(6 * grid.samples());
    for (size_t j = 0; j + 1 < grid.v.size(); ++j)
        for (size_t i = 0; i + 1 < grid.u.size(); ++i)
            if (!grid.u[i + 1].first && !grid.v[j + 1].first) add_cell(grid, i, j);
}

// The places that triangles use, each once.
void take_positions(const Grid& grid, Tessellation& result) {
    std::vector<uint32_t> number(grid.samples() + grid.blends.size(), kNone);
    result.group.triangles.reserve(grid.corners.size());
    for (uint32_t corner : grid.corners) {
        const uint32_t at = corner < grid.samples() ? grid.position[corner] : corner;
        if (number[at] == kNone) {
            number[at] = uint32_t(result.positions.size());
            result.positions.push_back(grid.place(corner));
        }
        result.group.triangles.push_back(number[at]);
    }
}

}  // namespace

}  // namespace tessellation

Tessellation tessellate(const CurvedSurface& surface, const PictureScale& scale,
                        const TessellationLimits& limits) {
    using namespace tessellation;
    Tessellation result;
    std::unique_ptr<Sheet> sheet = make_sheet(surface);
    if (!sheet || limits.triangles < 2) return result;
    const PixelMeasure measure(scale, [&] { return largest_extent(*sheet); });
    const Fineness fineness = choose_fineness(*sheet, measure, limits);
    Grid grid = sample_grid(*sheet, fineness);
    if (surface.kind == CurvedKind::Nurbs && !surface.trims.empty())
        add_trimmed_cells(grid, *sheet, surface, limits.triangles);
    else
        add_cells(grid);
    if (grid.corners.empty()) return result;
    fill_normals(grid);
    if (surface.reversed)
        for (size_t k = 0; k < grid.corners.size(); k += 3)
            std::swap(grid.corners[k + 1], grid.corners[k + 2]);
    take_positions(grid, result);
    result.group.attributes = make_attributes(surface, *sheet, grid);
    result.error = fineness.error;
    return result;
}

}  // namespace kinora
