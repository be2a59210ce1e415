// runtime/picture/explain/explain_lights.cpp: which lights reach which materials, and why others do
// not: by the tests that the shading of a grid makes
// (runtime/picture/shading/lighting/light_records.cpp).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "runtime/picture/explain/explain_p.h"
#include "runtime/picture/lights/light_bindings.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

std::string light_name(const Scene& scene, const LightSource& source) {
    const LightDefinition& light = scene.description->lights[source.definition];
    return fmt::format("{} on {}", light.id.empty() ? light.name : light.id,
                       shown_node(scene, source.node));
}

// About what stands still or moves as a whole, in current space; nothing where vertices move.
bool find_sphere(const Scene& scene, const Pose& pose, uint32_t index, Sphere& sphere) {
    const Shape& shape = scene.shapes[index];
    const ShapePose& stands = pose.shapes[index];
    if (shape.kind == raytrace::GeometryKind::Deforming || stands.shown_positions.empty())
        return false;
    const bool instanced = shape.kind == raytrace::GeometryKind::Instanced;
    const dvec3 anchor = scene.meshes[shape.mesh].anchor;
    const dmat4 world = pose.nodes[shape.node].world * shape.conversion;
    dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const vec4& p : stands.shown_positions) {
        const dvec3 at = instanced ? dvec3(world * dvec4(dvec3(vec3(p)) + anchor, 1))
                                   : dvec3(vec3(p)) + scene.origin;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    sphere.center = dvec3(pose.view.camera_from_world * dvec4((low + high) * 0.5, 1));
    sphere.radius = 0.5 * glm::length(high - low);
    return std::isfinite(sphere.radius);
}

LightReach reach_of(const Scene& scene, const Pose& pose, const LightSource& source) {
    return LightBindings::reach(scene, pose, *scene.shader_instances[source.look]);
}

// Why no surface in the look is lit by the light; "" where one may be.
std::string why_unlit(const Scene& scene, const Pose& pose, const LightBindings& bindings,
                      uint32_t look, size_t light) {
    const rsl::LoweredShader& lowered = scene.shader_instances[look]->lowered;
    const bool asks = lowered.lit_by_all || lowered.lit_by_ambient || !lowered.categories.empty();
    if (!asks) return "its shader asks for no light";
    if (!bindings.binding(look, light).seen)
        return bindings.directed(light) ? "its shader asks for other categories"
                                        : "its shader does not ask for ambient light";
    const LightReach reach = reach_of(scene, pose, scene.lights[light]);
    if (reach.black) return "it is black";
    if (!reach.bounded()) return "";
    for (const Surface& surface : scene.surfaces) {
        Sphere sphere;
        if (surface.look != look) continue;
        if (!find_sphere(scene, pose, surface.shape, sphere) || reaches(reach, sphere)) return "";
    }
    return "it lies outside the light's cone or range";
}

void explain_look(const Scene& scene, const Pose& pose, const LightBindings& bindings,
                  uint32_t look, ExplainedRows& rows) {
    const std::string subject = "material " + scene.shader_instances[look]->name;
    std::vector<std::string> lit;
    for (size_t l = 0; l < scene.lights.size(); ++l) {
        const std::string why = why_unlit(scene, pose, bindings, look, l);
        if (why.empty())
            lit.push_back(light_name(scene, scene.lights[l]));
        else
            rows.leave_out(subject, "not lit by " + light_name(scene, scene.lights[l]), why);
    }
    if (!lit.empty())
        rows.add(subject, fmt::format("lit by {}", fmt::join(lit, ", ")),
                 fmt::format("{} of {} lights", lit.size(), scene.lights.size()));
}

}  // namespace

void explain_lights(const Scene& scene, const Pose& pose, ExplainedRows& rows) {
    const LightBindings bindings(scene, scene, scene);
    for (size_t l = 0; l < scene.lights.size(); ++l) {
        const LightSource& source = scene.lights[l];
        const std::string subject = light_name(scene, source);
        const auto statements = bindings.statements(l);
        const LightReach reach = reach_of(scene, pose, source);
        if (reach.black) {
            rows.leave_out(subject, "not run", "it is black at this time");
            continue;
        }
        if (!bindings.directed(l)) {
            rows.add(subject, "ambient: added at each point", "");
            rows.leave_out(subject, "no shadow rays", "ambient light has no direction");
            continue;
        }
        const bool wide =
            std::ranges::any_of(statements, [](const auto& s) { return s.spread >= 0; });
        rows.add(subject,
                 source.surface != kNone ? "an area light, by samples"
                 : wide                  ? "a cone of the sky, by samples"
                                         : "one direction a point",
                 reach.bounded() ? "within its cone or range" : "everywhere");
        if (std::ranges::any_of(statements, [](const auto& s) { return s.casts_shadow; })) continue;
        const LightDefinition& light = scene.description->lights[source.definition];
        rows.leave_out(subject, "no automatic shadow rays",
                       scene.options.quality.shadows != ShadowMode::Auto ? "--shadows"
                       : light.shadows                                   ? "the light says so"
                                       : "its shader asks for them itself");
    }
    std::set<uint32_t> looks, placed;
    for (const Surface& surface : scene.surfaces) looks.insert(surface.look);
    for (uint32_t look : looks) explain_look(scene, pose, bindings, look, rows);
    for (const LightSource& source : scene.lights) {
        placed.insert(source.definition);
        if (source.listed != kNone) placed.insert(source.listed);
    }
    if (const size_t unplaced = scene.description->lights.size() - placed.size())
        rows.leave_out(fmt::format("{} lights", unplaced), "never run",
                       "no node that is shown has them, or --lights left them out");
}

}  // namespace kinora
