// runtime/scene/scene_options.cpp: the settings as the libraries below take them.
#include "runtime/scene/scene_options.h"

namespace kinora {

raytrace::AccelPolicy accel_policy(const SceneOptions& options) {
    return {.robust = options.quality.robust,
            .always_rebuild = options.quality.always_rebuild,
            .background = options.background_rebuilds,
            .refit_limit = float(options.quality.refit_limit),
            .low_limit = float(options.low_limit),
            .kept = options.trees};
}

anim::KeyOptions key_options(const Quality& quality) {
    return {.rate = quality.key_rate, .rotation = quality.rotation};
}

}  // namespace kinora
