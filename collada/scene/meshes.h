// collada/scene/meshes.h: geometries, and the controllers that deform them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collada/scene/values.h"

namespace kinora::collada {

// --- geometries ----------------------------------------------------------------------------------

// Values of a <source>, without the unnamed params of its accessor. No NaN or infinity.
struct FloatSource {
    std::string id;
    uint32_t stride = 0;        // floats per entry: 2 or 3 for TEXCOORD, 3 or 4 for COLOR, ...
    std::vector<float> values;  // stride * entries
};

struct VertexInput {
    std::string semantic;  // NORMAL TEXCOORD COLOR TANGENT TEXTANGENT TEXBINORMAL UV or a user's
    uint32_t set = 0;      // 0 when not written
    uint32_t source = 0;   // index into Geometry::sources
    uint32_t list = 0;     // index into PrimitiveGroup::indices
};

// The triangles of one <triangles>, <polylist>, ... element: corner 3t+k is corner k of triangle t.
struct PrimitiveGroup {
    std::string material;                        // symbol, "" if none
    std::vector<VertexInput> inputs;             // all but POSITION
    std::vector<std::vector<uint32_t>> indices;  // [0]: positions; one list per distinct offset
    uint32_t triangle_count() const { return uint32_t(indices[0].size() / 3); }
    Location where;
};

// A mesh, triangulated. Position i is the one that skins and morph targets speak of.
struct Geometry {
    std::string id, name;
    std::vector<dvec3> positions;
    std::vector<FloatSource> sources;
    std::vector<PrimitiveGroup> groups;  // every one has indices[0] and at least one triangle
    bool double_sided = true;            // from <extra>; false hides back faces from camera rays
    uint32_t line_count = 0;             // <lines>/<linestrips> segments read and not shaded
    Location where;
};

// --- controllers ---------------------------------------------------------------------------------

enum class JointNames : uint8_t { Name, Idref, Sidref };

// Vertex i has influences [offsets[i], offsets[i+1]). Weights are as written (sums are not
// normalised; NaN became 0). joint -1 is the bind shape itself.
struct Skin {
    std::string id;
    uint32_t geometry = kNone;
    uint32_t morph = kNone;  // the skin's source is this morph (over `geometry`)
    bool has_bind_shape_matrix = false;
    dmat4 bind_shape_matrix{1.0};
    JointNames joint_kind = JointNames::Name;
    std::vector<std::string> joints;
    std::vector<dmat4> inverse_bind;  // one per joint
    std::vector<uint32_t> offsets;    // geometry positions + 1
    std::vector<int32_t> influence_joints;
    std::vector<float> influence_weights;
    Location where;
};

enum class MorphMethod : uint8_t { Normalized, Relative };

// Targets have as many positions as the base. Normals of a target are in its own sources/groups.
struct Morph {
    std::string id;
    uint32_t geometry = kNone;  // the base mesh
    uint32_t base = kNone;      // the morph whose result it changes: index into morphs, smaller
    uint32_t skin = kNone;      // it is written on this skin: the skin moves its result
    MorphMethod method = MorphMethod::Normalized;
    std::vector<uint32_t> targets;  // geometries
    std::vector<double> weights;    // one per target: base values that channels write
    Location where;
    Location weights_where;
};

}  // namespace kinora::collada
