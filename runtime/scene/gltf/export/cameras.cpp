// runtime/scene/gltf/export/cameras.cpp: cameras.
#include "runtime/scene/gltf/export/cameras.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/scene/gltf/export/params.h"

namespace kinora {

namespace {

double tangent(double degrees) {
    return std::tan(0.5 * radians(degrees));
}

// 0 where there is none.
double number(const std::vector<double>& values, ValueSlot slot) {
    return slot.present() ? values[slot.offset] : 0.0;
}

}  // namespace

uint32_t CameraWriter::write(uint32_t camera) {
    auto [found, is_new] = cameras_.try_emplace(camera, 0);
    if (!is_new) return found->second;
    document_.begin("cameras");
    return found->second = write_new(description_.cameras[camera]);
}

uint32_t CameraWriter::write_new(const CameraDefinition& c) {
    const std::string name = fmt::format("camera '{}'", c.id);
    const ValueSlot slots[] = {c.x, c.y, c.aspect, c.znear, c.zfar};
    ObjectAt optics_of = [&](const std::vector<double>& values) { return optics(c, values); };
    MovingObject moving = motion_.object(slots, optics_of);
    const char* type = c.orthographic ? "orthographic" : "perspective";
    Json result = {{"type", type}, {type, moving.rest()}};
    if (!c.id.empty()) result["name"] = c.id;
    Json shaders = rsl_.picture(c.picture);
    if (!shaders.empty()) {
        result["extras"]["kinora_rsl"] = shaders;
        losses_.in_extras(name, "its RSL shaders", c.where);
    }
    for (const std::string& member : moving.lost())
        losses_.lost(name, fmt::format("how its '{}' comes and goes", member), c.where);
    uint32_t index = document_.add("cameras", std::move(result));
    const std::string pointer = fmt::format("/cameras/{}", index);
    motion_.move_object(fmt::format("{}/{}", pointer, type), slots, optics_of, moving);
    rsl_.move_picture(pointer + "/extras/kinora_rsl", c.picture);
    return index;
}

Json CameraWriter::optics(const CameraDefinition& c, const std::vector<double>& values) {
    double far = number(values, c.zfar) * description_.meter;
    double near = number(values, c.znear) * description_.meter;
    if (!(near > 0)) near = far > 0 ? 1e-4 * far : 1e-3 * bounds_.radius;
    if (!(far > near)) far = 0;
    Json optics = c.orthographic ? orthographic(c, values) : perspective(c, values);
    if (c.orthographic && !(far > 0)) far = near + 1e3 * bounds_.radius;
    optics["znear"] = near;
    if (far > 0) optics["zfar"] = far;
    return optics;
}

Json CameraWriter::orthographic(const CameraDefinition& c,
                                const std::vector<double>& values) const {
    double x = number(values, c.x), y = number(values, c.y), aspect = number(values, c.aspect);
    if (!(aspect > 0)) aspect = 1;
    if (!(x > 0)) x = y > 0 ? y * aspect : 1;
    if (!(y > 0)) y = x / aspect;
    return {{"xmag", x * description_.meter}, {"ymag", y * description_.meter}};
}

// glTF has the vertical field and the aspect: COLLADA's other pairs are turned into that.
Json CameraWriter::perspective(const CameraDefinition& c, const std::vector<double>& values) {
    double x = number(values, c.x), y = number(values, c.y), aspect = number(values, c.aspect);
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
