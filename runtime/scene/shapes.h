// runtime/scene/shapes.h: what stands in a scene: meshes, the shapes that place and deform them,
// and the surfaces that shaders cover.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/geometry.h"
#include "runtime/base/math.h"
#include "runtime/base/memory/shared_vector.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/extent.h"
#include "skin/morph.h"
#include "skin/skeleton.h"
#include "skin/skin.h"

namespace kinora {

struct WatchedEdges;  // runtime/scene/vertices/dice_error.h
class VertexWork;     // runtime/scene/vertices/vertex_work.h

// Rest data of a mesh, shared by all its shapes. Positions are minus `anchor`.
struct MeshGroup {
    std::string symbol;
    std::vector<uint32_t> triangles;
    std::vector<uint32_t> normal_corners;  // entry of Mesh::normals for each corner; empty: flat
    const PrimitiveGroup* definition = nullptr;  // texture coordinates, colours
    // The file gives no normals: N is Ng at each hit.
    bool flat() const { return normal_corners.empty(); }
};
struct Mesh {
    dvec3 anchor{0.0};
    std::vector<vec4> positions;
    std::vector<vec4> normals;
    std::vector<uint32_t> normal_positions;  // position of each normal
    std::vector<MeshGroup> groups;
    bool double_sided = true;
    // Bounds of the triangles as in the document; low > high: there are none.
    dvec3 low{0.0}, high{0.0};
    uint32_t definition = kNone;  // index into SceneDescription::meshes
    // Groups of a diced mesh, which no document holds.
    std::vector<std::unique_ptr<PrimitiveGroup>> own_groups;
};

// A mesh on a node, with what deforms it.
struct Shape {
    Shape();
    ~Shape();
    Shape(Shape&&) noexcept;
    Shape& operator=(Shape&&) noexcept;

    raytrace::GeometryKind kind = raytrace::GeometryKind::Static;
    uint32_t mesh = kNone;
    uint32_t node = kNone;
    uint32_t skin = kNone;        // index into SceneDescription::skins
    uint32_t morph = kNone;       // index into SceneDescription::morphs
    uint32_t morph_data = kNone;  // index into Scene::morphs: of it and those it changes
    dmat4 conversion{1.0};
    bool in_world = false;  // a skin's result is in world space; its node's matrix does not apply
    uint32_t applies_below = kNone;     // if it does: below this node, which moves the joints, too
    std::vector<uint32_t> joint_nodes;  // scene nodes

    // Of a static shape: where its triangles stand, accel space.
    std::vector<vec4> positions, normals;

    skin::Skeleton skeleton;
    skin::SkinMesh skin_mesh;

    // Displacement and transformation that run at frames; null where none does. Without a skin they
    // move the (morphed) mesh and the node's matrix comes after; with one they move what it gives.
    std::unique_ptr<VertexWork> vertex_work;
};

// A shader that moves a surface's vertices.
struct VertexUse {
    uint32_t instance = kNone;  // into Scene::vertex_instances
    std::vector<const VertexAttribute*> varying;
};

// Triangles of one shape that share a shader instance: a row of the ray tracer.
struct Surface {
    uint32_t shape = kNone;
    uint32_t group = kNone;
    uint32_t look = kNone;      // into Scene::shader_instances
    uint32_t material = kNone;  // index into description.materials, kNone: the default
    uint32_t interior =
        kNone;  // volumes inside and around, into Scene::shader_instances; kNone: none
    uint32_t exterior = kNone;
    uint32_t atmosphere = kNone;  // of camera rays to it alone, likewise
    uint32_t seen_by = raytrace::kSeenByAll;
    bool matte = false;
    const VertexAttribute* st = nullptr;  // the bound or lowest TEXCOORD set; null if none
    const VertexAttribute* uv = nullptr;  // u and v, where they are not s and t
    // Vertex inputs of the instance's varying parameters, in the order of ShaderInstance::varying.
    std::vector<const VertexAttribute*> varying;
    VertexUse transformation, displacement;
};

// What dicing made at load.
struct DiceStats {
    double ms = 0;
    size_t triangles = 0, vertices = 0;
    double pixels = 0;  // edge length used; more than asked for where the limit bound
};

// Accel space is that of the extent.
struct SceneShapes : SceneExtent {
    SharedVector<Mesh> meshes;
    SharedVector<skin::Morph> morphs;
    SharedVector<Shape> shapes;
    SharedVector<Surface> surfaces;
    SharedVector<raytrace::Geometry> rows;  // one a surface; a pose has those of its own vertices

    DiceStats dice;
    std::vector<std::shared_ptr<WatchedEdges>> watched;  // by displaced mesh that was diced
    std::vector<size_t> vertex_outputs;  // floats of each attribute with VertexAttribute::output
};

}  // namespace kinora
