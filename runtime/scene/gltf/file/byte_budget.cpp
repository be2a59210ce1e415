// runtime/scene/gltf/file/byte_budget.cpp: how much memory a file may take.
#include "runtime/scene/gltf/file/byte_budget.h"

#include <fmt/format.h>

#include "runtime/scene/description/findings.h"

namespace kinora {

bool ByteBudget::charge(size_t bytes, const std::string& pointer) {
    if (bytes <= allowed_ - charged_) {
        charged_ += bytes;
        return true;
    }
    if (!reported_)
        report_.add(Code::GLTF_LIMIT, pointer,
                    fmt::format("the scene's data would take more than {} MB, 20 times the file",
                                allowed_ >> 20));
    reported_ = true;
    return false;
}

}  // namespace kinora
