// runtime/scene/gltf/import/cameras.cpp: glTF's cameras.
#include "runtime/scene/gltf/import/cameras.h"

#include <fmt/format.h>

#include "runtime/scene/gltf/import/values.h"

namespace kinora {

void import_cameras(const tinygltf::Model& model, double meter, RslExtras& rsl, UniqueIds& ids,
                    PointerSlots& pointers, const GltfReport& report, SceneDescription& out) {
    for (size_t c = 0; c < model.cameras.size(); ++c) {
        const tinygltf::Camera& from = model.cameras[c];
        CameraDefinition& to = out.cameras.emplace_back();
        to.name = from.name;
        to.id = ids.id(from.name, "camera", c);
        to.where = report.location(fmt::format("/cameras/{}", c));
        to.orthographic = from.type == "orthographic";
        std::string optics = fmt::format("/cameras/{}/{}/", c, from.type);
        auto slot = [&](const char* member, double value, double scale) {
            double number = value * scale;
            if (number == 0) return ValueSlot{};
            ValueSlot made{append_values(out.values, std::span(&number, 1), 1), 1};
            pointers.follow({optics + member, {value}}, {made}, scale);
            return made;
        };
        double metres = 1 / meter;  // lengths are the file's
        if (to.orthographic) {      // xmag and ymag are half the sides here and in COLLADA
            to.x = slot("xmag", from.orthographic.xmag, metres);
            to.y = slot("ymag", from.orthographic.ymag, metres);
            to.znear = slot("znear", from.orthographic.znear, metres);
            to.zfar = slot("zfar", from.orthographic.zfar, metres);
        } else {
            to.y = slot("yfov", from.perspective.yfov, 180.0 / kPi);
            to.aspect = slot("aspectRatio", from.perspective.aspectRatio, 1);
            to.znear = slot("znear", from.perspective.znear, metres);
            to.zfar = slot("zfar", from.perspective.zfar, metres);  // none: beyond everything
        }
        to.picture = rsl.picture_shaders(from.extras, fmt::format("/cameras/{}", c));
    }
}

}  // namespace kinora
