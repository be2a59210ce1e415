// runtime/scene/transforms.h: values to node matrices, in double.
#pragma once

#include <span>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct Pose;
struct SceneNodes;
struct SceneShapes;

// The matrix of one operation; `v` starts at its values. Angles in degrees. COLLADA 1.4.1 chapter
// 5: rotate about an axis (zero axis: identity), lookat (eye, interest, up), skew (angle, rotated
// axis, translated axis: runtime/base/transform_matrix.h); quaternion (glTF 2.0, 3.5.3).
dmat4 transform_matrix(TransformKind kind, const double* v);

// The product of a node's operations in order.
dmat4 node_matrix(const NodeDefinition& node, std::span<const double> values);

// Cofactor of the linear part: takes normals along (docs/numerics.md#geometry), the mirror's sign
// taken out; its largest entry 1, since squares of lengths are floats.
mat3 normal_matrix(const dmat4& m, bool mirrored);

// Brings Pose::nodes up to date: those whose definition's bit is set, and what hangs below them.
// A matrix that is not finite becomes all zero.
void update_transforms(const SceneNodes& scene, Pose& pose);

// Lets all nodes rest; at the end of a pose's first frame.
void rest_nodes(Pose& pose);

// Fills SceneNodes::moving; when its nodes, shapes and surfaces are known.
void find_moving_parts(SceneNodes& scene, const SceneShapes& placed);

// The product of the conversions on the way to the node: from the document it is written in into
// the scene's units and axes.
dmat4 path_conversion(const SceneNodes& scene, uint32_t node);
// Units behind such a matrix in one unit before it.
double unit_of(const dmat4& conversion);

// Whether every entry is finite.
bool is_finite(const dmat4& m);

}  // namespace kinora
