// runtime/gltf/export/cameras.cpp: cameras.
#include "runtime/gltf/export/cameras.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/gltf/export/params.h"

namespace kinora {

namespace {

double tangent(double degrees) {
    return std::tan(0.5 * radians(degrees));
}

}  // namespace

uint32_t CameraWriter::write(uint32_t camera) {
    auto [found, is_new] = cameras_.try_emplace(camera, 0);
    if (!is_new) return found->second;
    document_.begin("cameras");
    return found->second = document_.add("cameras", new_camera(description_.cameras[camera]));
}

double CameraWriter::number(ValueSlot slot) const {
    return slot.present() ? description_.values[slot.offset] : 0.0;
}

Json CameraWriter::new_camera(const CameraDefinition& c) {
    for (ValueSlot slot : {c.x, c.y, c.aspect, c.znear, c.zfar})
        if (is_animated(description_, slot)) {
            losses_.lost(fmt::format("camera '{}'", c.id), "its animated optics", c.where);
            break;
        }
    double far = number(c.zfar) * description_.meter, near = number(c.znear) * description_.meter;
    if (!(near > 0)) near = far > 0 ? 1e-4 * far : 1e-3 * bounds_.radius;
    if (!(far > near)) far = 0;
    Json optics = c.orthographic ? orthographic(c) : perspective(c);
    if (c.orthographic && !(far > 0)) far = near + 1e3 * bounds_.radius;
    optics["znear"] = near;
    if (far > 0) optics["zfar"] = far;
    const char* type = c.orthographic ? "orthographic" : "perspective";
    Json result = {{"type", type}, {type, optics}};
    if (!c.id.empty()) result["name"] = c.id;
    Json shaders = rsl_.picture(c.picture);
    if (!shaders.empty()) {
        result["extras"]["kinora_rsl"] = shaders;
        losses_.in_extras(fmt::format("camera '{}'", c.id), "its RSL shaders", c.where);
    }
    return result;
}

Json CameraWriter::orthographic(const CameraDefinition& c) const {
    double x = number(c.x), y = number(c.y), aspect = number(c.aspect);
    if (!(aspect > 0)) aspect = 1;
    if (!(x > 0)) x = y > 0 ? y * aspect : 1;
    if (!(y > 0)) y = x / aspect;
    return {{"xmag", x * description_.meter}, {"ymag", y * description_.meter}};
}

// glTF has the vertical field and the aspect: COLLADA's other pairs are turned into that.
Json CameraWriter::perspective(const CameraDefinition& c) {
    double x = number(c.x), y = number(c.y), aspect = number(c.aspect);
    if (x > 0 && y > 0) aspect = tangent(x) / tangent(y);
    if (x > 0 && !(y > 0)) {
        if (!(aspect > 0)) {
            losses_.lost(fmt::format("camera '{}'", c.id),
                         "a horizontal field of view without an aspect ratio (1 is taken)",
                         c.where);
            aspect = 1;
        }
        y = 2 * std::atan(tangent(x) / aspect) * 180 / kPi;
    }
    if (!(y > 0 && y < 180)) y = 37;
    Json optics = {{"yfov", radians(y)}};
    if (aspect > 0) optics["aspectRatio"] = aspect;
    return optics;
}

}  // namespace kinora
