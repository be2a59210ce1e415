// runtime/scene/shaders/corner.h: a point on a triangle of a scene, and what vertex inputs are
// there.
#pragma once

#include "runtime/scene/pose.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// A hit's triangle with everything interpolation needs.
struct Corner {
    const Surface& surface;
    const Pose& pose;
    const Mesh& mesh;
    const MeshGroup& group;
    uint32_t primitive;
    float u, v;  // barycentrics of corners 1 and 2

    uint32_t position(int k) const { return group.triangles[3 * primitive + uint32_t(k)]; }
    vec3 normal(int k) const {
        return vec3(pose.shapes[surface.shape]
                        .shown_normals[group.normal_corners[3 * primitive + uint32_t(k)]]);
    }
    const float* attribute(const VertexAttribute& a, int k) const {
        return &values_of(a, pose)[size_t(a.corners[3 * primitive + uint32_t(k)]) * a.stride];
    }
};

// A number of a varying parameter at the three corners.
void corner_values(const Corner& c, const VaryingParam& param, const VertexAttribute* attribute,
                   uint32_t component, float x[3]);

// Between the corners; a text is the nearest corner's, bit for bit.
float between(const Corner& c, const VaryingParam& param, const float x[3]);

}  // namespace kinora
