// runtime/player/bytes/byte_kernels.cpp: chooses the kernels.
#include "runtime/player/bytes/byte_kernels.h"

#include "runtime/base/choose_kernels.h"

namespace kinora {

const UsableKernels<ByteKernels>& usable_byte_kernels() {
    static const auto usable = choose_kernels(KINORA_ALL_TABLES(Byte));
    return usable;
}

const ByteKernels& byte_kernels() {
    static const ByteKernels& widest = *usable_byte_kernels().kernels[0];
    return widest;
}

}  // namespace kinora
