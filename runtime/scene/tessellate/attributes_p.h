// runtime/scene/tessellate/attributes_p.h: what a surface's triangles carry.
#pragma once

#include "runtime/scene/tessellate/grid_p.h"
#include "runtime/scene/tessellate/tessellate.h"

namespace kinora::tessellation {

// All attributes, for the corners of the grid, in their order.
std::vector<VertexAttribute> make_attributes(const CurvedSurface& surface, const Sheet& sheet,
                                             const Grid& grid);

}  // namespace kinora::tessellation
