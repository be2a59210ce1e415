// runtime/scene/kernels/point_source.cpp: columns from any source of points.
#include "runtime/scene/kernels/point_source.h"

#include <algorithm>

#include "jit/ir/kernel_call.h"
#include "runtime/scene/kernels/columns.h"

namespace kinora {

void fill_constants(const PointColumns& columns) {
    for (auto [which, value] : kConstantColumns)
        if (float* row = columns.rows[which]) std::fill_n(row, columns.count, value);
}

void fill_columns(PointSource& source, const PointColumns& columns) {
    source.fill(columns);
    if (!source.fills_constants()) fill_constants(columns);
    for (float* row : columns.rows)
        if (row && columns.count > 0)
            std::fill(row + columns.count, row + jit::padded(columns.count),
                      row[columns.count - 1]);
}

}  // namespace kinora
