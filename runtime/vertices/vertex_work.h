// runtime/vertices/vertex_work.h: displacement and transformation shaders run on a mesh's vertices.
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
#include "runtime/shading/print.h"
#include "runtime/shading/shader_instance.h"
#include "runtime/vertices/diced_mesh.h"

namespace kinora {

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
        std::array<ShaderInstance*, kStages> looks{};
        std::array<std::span<const VertexAttribute* const>, kStages> varying{};
        const VertexAttribute* st = nullptr;
        PrimitiveGroup* attributes = nullptr;  // takes the shaders' outputs ("vertex:NAME")
    };

    // `mesh` as diced (its positions and normals at rest); the uses' pointers must stay.
    VertexWork(const Mesh& mesh, std::vector<DicedGroup> groups, std::vector<Use> uses);

    // Moves the vertices of a mesh whose present positions (minus `anchor`) and unit normals these
    // are. object_from_mesh takes them, anchor included, to the space of scene node `node`.
    // `mirrored`: what brought them here turned the triangles' winding. The result does not depend
    // on the threads. Allocates nothing after the first time.
    void run(const Scene& scene, uint32_t node, const dmat4& object_from_mesh, dvec3 anchor,
             std::span<vec4> positions, std::span<vec4> normals, bool mirrored = false);

    // Faults and results that were not finite (their vertices stay), once each; forgets them.
    void report(const MeshDefinition& mesh, Diagnostics& diagnostics);

    size_t wedges() const { return wedge_count_; }

    bool each_frame = false;  // the kernels read time, the camera or what is animated

  private:
    struct Group {
        DicedGroup made;
        Use use;
        uint32_t first_wedge = 0;
        Lists corners;  // of each wedge
        size_t first_triangle = 0;
        std::array<std::vector<uint8_t>, kStages> faults;  // one byte a site
        std::array<PrintedLines, kStages> printed;         // in the last frame
    };
    struct Pass;

    void weld_positions(const Mesh& mesh);
    void weld_normals(const Mesh& mesh);
    void run_stage(Pass& pass);
    void run_group(Pass& pass, Group& group);
    void run_wedges(const Pass& pass, Group& group, size_t begin, size_t end,
                    std::span<uint8_t> faults, PrintedLines& prints);
    void find_faces(const Pass& pass);
    vec3 face_sum(std::span<const uint32_t> wedges) const;
    void move_positions(const Pass& pass);
    void turn_normals(const Pass& pass);

    std::vector<Group> groups_;
    size_t wedge_count_ = 0;
    std::vector<uint32_t> group_of_wedge_;
    std::vector<uint32_t> weld_of_position_;  // key of welds_
    Lists welds_;                             // wedges at one position
    std::vector<uint32_t> key_of_normal_;     // key of same_normal_
    Lists same_normal_;                       // wedges that share a position and a normal; none
    std::vector<vec3> moved_, bent_;          // by wedge, in mesh space
    std::vector<vec3> faces_;                 // by triangle: normal times twice the area
    std::vector<vec3> before_;                // by normal that is a key: sum of faces
    std::vector<Arena> arenas_;               // by thread
    std::vector<PrintedLines> prints_;        // by part
    std::vector<uint32_t> not_finite_;        // by part
    uint32_t not_finite_total_ = 0;
};

// Whether a vertex kernel must run at every frame: it reads E, I, du, dv, time, camera space, a
// space that moves against node `node`, or a parameter that is animated.
bool runs_each_frame(const ShaderInstance& look, const Scene& scene, uint32_t node);

// Whether its result differs between nodes: it names a space other than its own.
bool depends_on_node(const ShaderInstance& look);

}  // namespace kinora
