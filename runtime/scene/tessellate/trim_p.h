// runtime/scene/tessellate/trim_p.h: cells of a grid cut along loops in the surface's parameters.
#pragma once

#include "runtime/scene/tessellate/grid_p.h"

namespace kinora::tessellation {

// The triangles of what the loops leave, at most so many. Cut cells stay in their two triangles'
// planes, so that new points open no cracks.
void add_trimmed_cells(Grid& grid, const Sheet& sheet, const CurvedSurface& surface, size_t most);

}  // namespace kinora::tessellation
