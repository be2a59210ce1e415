// runtime/base/math.h: the names of vectors and matrices. Column vectors, GLM's column-major
// storage: m[c][r]; transforms read right to left, world_from_joint * p_joint.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace kinora {

using glm::dmat3;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::mat3;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double radians(double degrees) {
    return degrees * (kPi / 180.0);
}

}  // namespace kinora
