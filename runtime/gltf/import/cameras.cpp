// runtime/gltf/import/cameras.cpp: glTF's cameras.
#include "runtime/gltf/import/cameras.h"

#include <fmt/format.h>

#include "runtime/gltf/import/values.h"

namespace kinora {

void import_cameras(const tinygltf::Model& model, double meter, RslExtras& rsl, UniqueIds& ids,
                    const GltfReport& report, SceneDescription& out) {
    for (size_t c = 0; c < model.cameras.size(); ++c) {
        const tinygltf::Camera& from = model.cameras[c];
        CameraDefinition& to = out.cameras.emplace_back();
        to.name = from.name;
        to.id = ids.id(from.name, "camera", c);
        to.where = report.location(fmt::format("/cameras/{}", c));
        to.orthographic = from.type == "orthographic";
        auto slot = [&](double value) {
            return value != 0 ? ValueSlot{append_values(out.values, std::span(&value, 1), 1), 1}
                              : ValueSlot{};
        };
        double metres = 1 / meter;  // lengths are the file's
        if (to.orthographic) {      // xmag and ymag are half the sides here and in COLLADA
            to.x = slot(from.orthographic.xmag * metres);
            to.y = slot(from.orthographic.ymag * metres);
            to.znear = slot(from.orthographic.znear * metres);
            to.zfar = slot(from.orthographic.zfar * metres);
        } else {
            to.y = slot(from.perspective.yfov * 180.0 / kPi);
            to.aspect = slot(from.perspective.aspectRatio);
            to.znear = slot(from.perspective.znear * metres);
            to.zfar = slot(from.perspective.zfar * metres);  // none: beyond everything
        }
        to.picture = rsl.picture_shaders(from.extras, fmt::format("/cameras/{}", c));
    }
}

}  // namespace kinora
