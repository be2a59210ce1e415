// runtime/scene/vertices/vertex_work.h: displacement and transformation shaders run on a mesh's
// vertices.
//
// A kernel runs once for each wedge (a vertex as one group's corners see it), in "current" = the
// space of the shape's node. Wedges at one position move by the mean of their displacements, so
// that nothing cracks where texture coordinates, normals or materials change. N is the shader's
// where it gives one (the mean over wedges that shared a normal). Else a displacement's normals are
// those of the displaced triangles, smooth where the file's were; a transformation's are the
// file's, turned as the triangles around them turn. Either leaves them alone where nothing moves.
// Where the file has none, N is the triangle's; what displacement makes of a flat face is smooth
// within it, and has a crease where faces of different directions meet.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/arena.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/shaders/printed_lines.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/vertices/diced_mesh.h"

namespace kinora {

struct SceneNodes;
struct VertexState;

// Lists of numbers by key, joined: those of k are items[first[k]] to items[first[k + 1]].
struct Lists {
    std::vector<uint32_t> first, items;
    std::span<const uint32_t> of(size_t k) const {
        return {items.data() + first[k], first[k + 1] - first[k]};
    }
};

class VertexWork {
  public:
    static constexpr size_t kStages = 2;  // transformation, then displacement

    // One group of the mesh: null where it has no such shader.
    struct Use {
        std::array<const ShaderInstance*, kStages> looks{};
        std::array<std::span<const VertexAttribute* const>, kStages> varying{};
        const VertexAttribute* st = nullptr;
        PrimitiveGroup* attributes = nullptr;  // has those of the shaders' outputs ("vertex:NAME")
    };

    // `mesh` as diced (its positions and normals at rest); the uses' pointers must stay.
    VertexWork(const Mesh& mesh, std::vector<DicedGroup> groups, std::vector<Use> uses);

    // The vertices to be moved: their present positions (minus `anchor`) and unit normals.
    struct Vertices {
        uint32_t node = kNone;        // a scene node, in whose space they are moved
        dmat4 object_from_mesh{1.0};  // takes them, anchor included, to that space
        dvec3 anchor{0.0};
        std::span<vec4> positions, normals;
        bool mirrored = false;  // what brought them here turned the triangles' winding
    };
    // Moves them. Outputs of the shaders go to the pose where they are of each frame, else into the
    // attributes. The result does not depend on the threads. Allocates nothing after the first
    // time.
    void run(const Scene& scene, Pose& pose, VertexState& state, const Vertices& vertices) const;

    // Faults and results that were not finite (their vertices stay), once each; the state forgets
    // them.
    void report(const MeshDefinition& mesh, VertexState& state, Diagnostics& diagnostics) const;

    size_t wedges() const { return wedge_count_; }

    bool each_frame = false;  // the kernels read time, the camera or what is animated

  private:
    friend struct VertexState;
    struct Group {
        DicedGroup made;
        Use use;
        uint32_t first_wedge = 0;
        Lists corners;  // of each wedge
        size_t first_triangle = 0;
    };
    struct Pass;

    void weld_positions(const Mesh& mesh);
    void weld_normals(const Mesh& mesh);
    void run_stage(Pass& pass) const;
    void run_group(Pass& pass, size_t group) const;
    void run_wedges(const Pass& pass, size_t group, size_t begin, size_t end,
                    std::span<uint8_t> faults, PrintedLines& prints) const;
    void store_outputs(const Pass& pass, const Group& group, std::span<float* const> out,
                       size_t first, size_t count) const;
    void find_faces(const Pass& pass) const;
    vec3 face_sum(std::span<const vec3> faces, std::span<const uint32_t> wedges) const;
    void move_positions(const Pass& pass) const;
    void turn_normals(const Pass& pass) const;

    std::vector<Group> groups_;
    size_t wedge_count_ = 0, triangle_count_ = 0;
    std::vector<uint32_t> group_of_wedge_;
    std::vector<uint32_t> weld_of_position_;  // key of welds_
    Lists welds_;                             // wedges at one position
    std::vector<uint32_t> key_of_normal_;     // key of same_normal_
    Lists same_normal_;                       // wedges that share a position and a normal; none
};

// Memory of one shape's VertexWork in one pose, and what it has to report.
struct VertexState {
    explicit VertexState(const VertexWork& work);

    struct Stage {
        InstanceFrame frame;
        std::vector<uint8_t> faults;  // one byte a site
        PrintedLines printed;         // in the last frame
    };
    std::vector<std::array<Stage, VertexWork::kStages>> groups;
    std::vector<vec3> moved, bent;     // by wedge, in mesh space
    std::vector<vec3> faces;           // by triangle: normal times twice the area
    std::vector<vec3> before;          // by normal that is a key: sum of faces
    std::vector<Arena> arenas;         // by thread
    std::vector<PrintedLines> prints;  // by part
    std::vector<uint32_t> not_finite;  // by part
    uint32_t not_finite_total = 0;
};

// Whether a vertex kernel must run at every frame: it reads E, I, du, dv, time, camera space, a
// space that moves against node `node`, or a parameter that is animated.
bool runs_each_frame(const ShaderInstance& look, const SceneNodes& scene, uint32_t node);

// Whether its result differs between nodes: it names a space other than its own.
bool depends_on_node(const ShaderInstance& look);

}  // namespace kinora
