// runtime/columns/kernels_avx2.cpp: the kernels for AVX2.
#include "runtime/columns/kernels_p.h"

namespace kinora {

extern const ColumnKernels kAvx2Columns;
const ColumnKernels kAvx2Columns = {"avx2",          turn, turn_from, turn_between, mix_normals,
                                    find_parameters, mix,  tangents,  extents,      random};

}  // namespace kinora
