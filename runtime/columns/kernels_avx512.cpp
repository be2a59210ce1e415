// runtime/columns/kernels_avx512.cpp: the kernels for AVX-512.
#include "runtime/columns/kernels_p.h"

namespace kinora {

extern const ColumnKernels kAvx512Columns;
const ColumnKernels kAvx512Columns = {"avx512",        turn, turn_from, turn_between, mix_normals,
                                      find_parameters, mix,  tangents,  extents,      random};

}  // namespace kinora
