// runtime/scene/shaders/corner.cpp: vertex inputs between the corners of a triangle.
#include "runtime/scene/shaders/corner.h"

#include <algorithm>

#include "runtime/scene/shaders/picture_points.h"

namespace kinora {

void corner_values(const Corner& c, const VaryingParam& param, const VertexAttribute* attribute,
                   uint32_t component, float x[3]) {
    for (int corner = 0; corner < 3; ++corner) {
        x[corner] = 0;
        if (attribute) {
            uint32_t from = std::min(param.component + component, attribute->stride - 1);
            x[corner] = c.attribute(*attribute, corner)[from];
        } else if (param.semantic == "Pref") {
            x[corner] = c.mesh.positions[c.position(corner)][int(component)] +
                        float(c.mesh.anchor[int(component)]);
        }
    }
}

float between(const Corner& c, const VaryingParam& param, const float x[3]) {
    if (!param.text) return x[0] + c.u * (x[1] - x[0]) + c.v * (x[2] - x[0]);
    float w = 1 - c.u - c.v;
    return w >= c.u && w >= c.v ? x[0] : c.u >= c.v ? x[1] : x[2];
}

float varying_at(const SceneShapes& scene, const Pose& pose, const ShaderInstance& look,
                 const raytrace::HitBatch& hits, uint32_t hit, size_t which, uint32_t component) {
    const Surface& surface = scene.surfaces[hits.instance[hit]];
    const Shape& shape = scene.shapes[surface.shape];
    const Mesh& mesh = scene.meshes[shape.mesh];
    Corner c{surface,     pose,       mesh, mesh.groups[surface.group], hits.primitive[hit],
             hits.u[hit], hits.v[hit]};
    const VaryingParam& param = look.varying[which];
    float x[3];
    corner_values(c, param, surface.varying[which], component, x);
    return between(c, param, x);
}

}  // namespace kinora
