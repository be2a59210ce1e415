// runtime/scene/tessellate/grid_p.h: a surface's samples and the triangles between them.
#pragma once

#include <vector>

#include "runtime/scene/tessellate/fineness_p.h"

namespace kinora::tessellation {

// A point inside a cell, as a mean of samples.
struct SampleBlend {
    uint32_t sample[3];
    double weight[3];
};

// Samples are where lines meet, u fastest; blends are numbered on behind them.
struct Grid {
    std::vector<Line> u, v;
    std::vector<dvec3> places;
    std::vector<dvec3> normals;      // unit, along dP/du x dP/dv; zero where none is known
    std::vector<uint32_t> position;  // of samples that are at one place the first one
    std::vector<SampleBlend> blends;
    std::vector<uint32_t> corners;  // samples, 3 a triangle

    size_t samples() const { return u.size() * v.size(); }
    size_t sample_of(uint32_t corner) const {
        return corner < samples() ? corner : blends[corner - samples()].sample[0];
    }
    const Line& line_u(uint32_t corner) const { return u[sample_of(corner) % u.size()]; }
    const Line& line_v(uint32_t corner) const { return v[sample_of(corner) / u.size()]; }
    dvec3 place(uint32_t corner) const;
};

Grid sample_grid(const Sheet& sheet, const Fineness& fineness);
// Both of a cell's triangles, counter-clockwise as seen from the tip of dP/du x dP/dv.
void add_cell(Grid& grid, size_t i, size_t j);
// Leaves out triangles without area.
void add_triangle(Grid& grid, uint32_t a, uint32_t b, uint32_t c);
// Normals of samples that have none, from the triangles around them.
void fill_normals(Grid& grid);

}  // namespace kinora::tessellation
