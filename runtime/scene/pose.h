// runtime/scene/pose.h: a scene at one moment: all that a time decides. It depends on the time
// alone, never on the time before.
//
// A scene may have any number of poses, and each is rendered on its own.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "raytrace/accel.h"
#include "raytrace/camera.h"
#include "raytrace/tiles/integrator.h"
#include "runtime/scene/description/scene_description.h"
#include "skin/dual_quaternion.h"
#include "skin/skin.h"

namespace kinora {

struct Mesh;
struct Scene;
struct SceneResources;
struct SceneShapes;
struct Shape;
struct NeighbourPoses;
class Shading;       // runtime/picture/shading/shading.h
struct VertexState;  // runtime/scene/vertices/vertex_work.h

// Where one of Scene::nodes stands.
struct NodePose {
    dmat4 world{1.0};    // world_from_node
    bool moved = true;   // by the last update_transforms
    bool finite = true;  // else `world` is all zero
};

// Where one of Scene::shapes stands.
struct ShapePose {
    dmat4 world{1.0};  // world_from_mesh: the node's matrix and the conversion (not the anchor)
    bool mirrored = false;
    uint32_t positions_version = 0;
    // What the ray tracer and shading read: a deforming shape's own (accel space), a static one's
    // (accel space) or the mesh's, of instanced shapes.
    std::span<const vec4> shown_positions, shown_normals;

    // Of deforming shapes.
    std::vector<vec4> positions, normals;  // accel space
    std::vector<dmat4> joint_world;        // world_from_joint, in joint order
    std::vector<skin::JointMatrix> palette;
    std::vector<skin::DualJoint> dual_palette;  // of SkinMethod::Dual, else empty
    std::vector<double> morph_weights;          // of the targets of Shape::morph_data
    std::vector<vec4> morphed_positions, morphed_normals;
    std::shared_ptr<VertexState> vertex_state;                 // of Shape::vertex_work
    std::vector<vec4> displaced_positions, displaced_normals;  // without a skin
};

// The vertices of watched edges (Scene::watched) where they deform.
struct WatchedPose {
    std::vector<vec4> morphed, posed;  // `posed`: accel space
};

// What the frames of a pose have reported: each thing once.
struct Reported {
    std::vector<bool> nodes;                                        // that are not finite
    std::set<std::pair<uint32_t, raytrace::GeometryIssue>> issues;  // of rows
    bool fewer_samples = false;
};

struct Pose {
    Pose() = default;
    // Of a scene that is built; stands nowhere before the first pose_frame. The scene stays.
    explicit Pose(const Scene& scene);
    Pose(const Pose&) = delete;  // its parts point at each other

    uint32_t camera = 0;            // into Scene::cameras: what it is seen by
    double time = 0, shutter = 0;   // seconds
    std::vector<double> values;     // of Scene::description, at the time
    std::vector<uint64_t> changed;  // owner bits of the last evaluate
    bool first_frame = true;        // nothing stands yet
    bool all_finite = true;         // the nodes' matrices
    bool rest_finite = true;        // those of nodes that nothing moves

    std::vector<NodePose> nodes;    // of Scene::nodes
    std::vector<ShapePose> shapes;  // of Scene::shapes
    std::vector<WatchedPose> watched;
    std::vector<std::vector<float>> vertex_outputs;  // VertexAttribute::output

    std::vector<raytrace::Geometry> rows;  // one a surface
    raytrace::Accel accel;
    raytrace::Camera view;

    // Memory of frames, kept from one to the next.
    raytrace::IntegratorScratch scratch;
    std::shared_ptr<Shading> shading;
    Reported reported;
    uint32_t watch_dark = 0;                     // frames left of Scene::watch_dark
    std::shared_ptr<NeighbourPoses> neighbours;  // of a picture with an AOV of motion
};

// The scene a frame before a pose and a frame after it. They have no trees.
struct NeighbourPoses {
    explicit NeighbourPoses(const Scene& scene) : before(scene), after(scene) {}
    Pose before, after;
    bool before_seen = false, after_seen = false;  // their cameras make pictures
};

// Gives what a shape of that mesh stands in its room; what stood there goes.
void size_shape(const SceneResources& scene, const Mesh& mesh, const Shape& shape,
                ShapePose& stands);
// The same for what shaders give vertices in each frame.
void size_outputs(const SceneShapes& scene, Pose& pose);

// The numbers of an attribute, whether the file or a shader gives them.
std::span<const float> values_of(const VertexAttribute& attribute, const Pose& pose);

}  // namespace kinora
