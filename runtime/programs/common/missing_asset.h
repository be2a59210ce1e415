// runtime/programs/common/missing_asset.h: findings that say that something the scene names is not
// there or may not be read.
#pragma once

#include <algorithm>
#include <iterator>
#include <string_view>

#include "runtime/base/diagnostic.h"

namespace kinora {

inline bool is_missing_asset(std::string_view code) {
    constexpr std::string_view kCodes[] = {"FILE_MISSING",
                                           "FILE_EMPTY_URI",
                                           "IMAGE_EMBEDDED",
                                           "IMAGE_UNREADABLE",
                                           "POINT_FILE_UNREADABLE",
                                           "LINK_EXTERNAL_MISSING",
                                           "LINK_EXTERNAL_UNREADABLE",
                                           "LINK_OUTSIDE",
                                           "RSL_FILE_OUTSIDE",
                                           "GLTF_FILE"};
    return std::find(std::begin(kCodes), std::end(kCodes), code) != std::end(kCodes);
}

inline bool is_missing_asset(const FindingInfo& info) {
    return is_missing_asset(std::string_view(info.code));
}

}  // namespace kinora
