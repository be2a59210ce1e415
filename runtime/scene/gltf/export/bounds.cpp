// runtime/scene/gltf/export/bounds.cpp: the scene's axes and size in glTF's space.
#include "runtime/scene/gltf/export/bounds.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

// COLLADA 1.4.1, chapter 5, up_axis: x is right for y and z up, -y for x up.
dmat4 y_up_from(UpAxis up) {
    dmat4 m(1.0);
    if (up == UpAxis::X) {
        m[0] = dvec4(0, 1, 0, 0);
        m[1] = dvec4(-1, 0, 0, 0);
    } else if (up == UpAxis::Z) {
        m[1] = dvec4(0, 0, -1, 0);
        m[2] = dvec4(0, 1, 0, 0);
    }
    return m;
}

}  // namespace

dmat4 gltf_axes(const SceneDescription& description) {
    dmat4 axes = y_up_from(description.up_axis);
    for (int c = 0; c < 3; ++c) axes[c] = axes[c] * description.meter;
    return axes;
}

SceneBounds bounds_of(const SceneDescription& description, const Occurrences& occurrences,
                      const dmat4& axes) {
    dvec3 low(1e300), high(-1e300);
    for (const Occurrence& o : occurrences)
        for (const MeshUse& use : description.nodes[o.definition].meshes)
            for (const dvec3& x : description.meshes[use.mesh].positions) {
                dvec3 y(axes * o.world * use.conversion * dvec4(x, 1.0));
                low = glm::min(low, y), high = glm::max(high, y);
            }
    if (!(low.x <= high.x)) return {};
    return {std::max(0.5 * glm::length(high - low), 1e-12), 0.5 * (low + high)};
}

}  // namespace kinora
