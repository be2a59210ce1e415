// runtime/picture/explain/explain_passes.cpp: what a frame does between its times and its file.
#include <algorithm>

#include "runtime/picture/explain/explain_p.h"
#include "runtime/picture/shading/shading.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

struct PassRow {
    const char* name;
    bool (*runs)(const Scene&);
    const char* what;
    const char* because;  // it runs
    const char* because_not;
};

bool any_shape(const Scene& scene, bool (*is)(const Shape&)) {
    return std::ranges::any_of(scene.shapes, is);
}
bool any_calls(const Scene& scene, std::initializer_list<const char*> services) {
    return std::ranges::any_of(scene.shader_instances, [&](const auto& look) {
        if (look->full.empty()) return false;
        return std::ranges::any_of(look->full.kernel().services, [&](const auto& service) {
            return std::ranges::count(services, service.name) > 0;
        });
    });
}

constexpr PassRow kPasses[] = {
    {"skins",
     [](const Scene& s) {
         return any_shape(s, [](const Shape& shape) { return shape.skin != kNone; });
     },
     "joints move vertices", "a mesh has a skin", "no mesh has a skin"},
    {"morphs",
     [](const Scene& s) {
         return any_shape(s, [](const Shape& shape) { return shape.morph != kNone; });
     },
     "targets are mixed", "a mesh has morph targets", "no mesh has morph targets"},
    {"displacement each frame",
     [](const Scene& s) {
         return any_shape(s, [](const Shape& shape) {
             return shape.vertex_work && shape.kind == raytrace::GeometryKind::Deforming;
         });
     },
     "shaders move vertices", "a displacement or transformation is worn by what deforms",
     "no shader moves vertices, or once for all frames"},
    {"nested rays",
     [](const Scene& s) {
         return any_calls(s, {"trace", "gather", "occlusion", "indirectdiffuse"});
     },
     "shaders send rays", "trace, gather, occlusion or indirectdiffuse is called",
     "no shader calls them"},
    {"footprints", [](const Scene& s) { return reads_footprints(s); }, "rays carry differentials",
     "a shader filters, reads du or dv, or bakes", "no shader reads du or dv"},
    {"opacity",
     [](const Scene& s) {
         return std::ranges::any_of(s.shader_instances,
                                    [](const auto& l) { return l->opacity.has_value(); });
     },
     "rays go on behind surfaces", "an Oi is not 1", "every Oi is 1"},
    {"volumes",
     [](const Scene& s) {
         return !s.volumes.empty() || s.atmosphere != kNone || s.own_atmospheres;
     },
     "segments of rays are shaded", "an object or the scene has a volume shader",
     "no volume shader"},
    {"imager", [](const Scene& s) { return s.imager != kNone; },
     "it runs over the finished picture", "the scene has one", "the scene has none"},
};

}  // namespace

void explain_passes(const Scene& scene, const Pose&, ExplainedRows& rows) {
    for (const PassRow& pass : kPasses)
        if (pass.runs(scene))
            rows.add(pass.name, pass.what, pass.because);
        else
            rows.leave_out(pass.name, "not run", pass.because_not);
}

}  // namespace kinora
