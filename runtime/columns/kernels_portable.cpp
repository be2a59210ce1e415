// runtime/columns/kernels_portable.cpp: the kernels for any CPU.
#include "runtime/columns/kernels_p.h"

namespace kinora {

extern const ColumnKernels kPortableColumns;
const ColumnKernels kPortableColumns = {"portable",      turn, turn_from, turn_between, mix_normals,
                                        find_parameters, mix,  tangents,  extents,      random};

}  // namespace kinora
