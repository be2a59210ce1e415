// skin/reference.cpp: skinning and morphing by their formulas, scalar and in double.
#include "skin/reference.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace kinora::skin::reference {
namespace {

// The weighted sum of a vertex's matrices.
dmat4 blended(const InfluenceSource& source, std::span<const dmat4> joint_matrices,
              const dmat4& bind, size_t vertex) {
    dmat4 sum(0.0);
    double total = 0;
    for (size_t i = source.first[vertex]; i < source.first[vertex + 1]; ++i) {
        int joint = source.joints[i];
        sum += source.weights[i] * (joint < 0 ? bind : joint_matrices[joint]);
        total += source.weights[i];
    }
    return source.normalise ? sum / total : sum;
}

}  // namespace

std::vector<dvec3> skin_positions(const InfluenceSource& source,
                                  std::span<const dmat4> joint_matrices, const dmat4& bind,
                                  std::span<const dvec3> rest) {
    std::vector<dvec3> out;
    for (size_t v = 0; v < rest.size(); ++v)
        out.push_back(dvec3(blended(source, joint_matrices, bind, v) * dvec4(rest[v], 1.0)));
    return out;
}

std::vector<dvec3> skin_normals(const InfluenceSource& source,
                                std::span<const dmat4> joint_matrices, const dmat4& bind,
                                std::span<const uint32_t> normal_positions,
                                std::span<const dvec3> rest) {
    std::vector<dvec3> out;
    for (size_t i = 0; i < rest.size(); ++i) {
        dmat3 linear(blended(source, joint_matrices, bind, normal_positions[i]));
        dvec3 n = glm::transpose(glm::inverse(linear)) * rest[i];
        double length = glm::length(n);
        out.push_back(std::isfinite(length) && length > 0 ? n / length : dvec3(0.0));
    }
    return out;
}

std::vector<dvec3> morph(MorphMethod method, std::span<const dvec3> base,
                         std::span<const std::vector<dvec3>> targets,
                         std::span<const double> weights) {
    double base_weight = 1;
    if (method == MorphMethod::Normalized)
        for (double w : weights) base_weight -= w;
    std::vector<dvec3> out;
    for (size_t i = 0; i < base.size(); ++i) {
        dvec3 sum = base_weight * base[i];
        for (size_t t = 0; t < targets.size(); ++t) sum += weights[t] * targets[t][i];
        out.push_back(sum);
    }
    return out;
}

}  // namespace kinora::skin::reference
