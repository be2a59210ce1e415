// raytrace/accel_state_p.h: what an Accel remembers between updates.
#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "raytrace/accel.h"
#include "raytrace/embree_p.h"
#include "raytrace/kept_trees_p.h"
#include "raytrace/mesh_watch_p.h"
#include "raytrace/placement_p.h"
#include "raytrace/scale_p.h"

namespace kinora::raytrace {

// Rows of one mask and side rule, joined into one mesh of our own buffers.
struct StaticGroup {
    std::vector<vec4> positions;
    std::vector<uint32_t> triangles;
    std::vector<uint32_t> owner;  // row of each triangle
    uint32_t slot = 0;
    EmbreeMesh mesh;
};

// What instanced rows of one Geometry::shape share. A shape that has never deformed has a static
// scene of MEDIUM quality; at its first deformation it gets a dynamic one, to be refitted.
struct InstancedShape {
    uint32_t first_row = 0;
    bool dynamic = false;
    std::shared_ptr<ShapeTree> tree;
};

struct GeometryState {
    Geometry seen;          // as given to the last update
    bool sound = false;     // false: left out, an issue says why
    bool attached = false;  // in the top scene. Instanced: its matrix has an inverse
    uint32_t slot = 0;
    // Deforming
    std::vector<uint32_t> edges;  // shared_edges()
    std::vector<uint32_t> kept;   // without_untraceable(), as Embree has it; the mesh reads it
    EmbreeMesh mesh;
    BuildQuality quality = BuildQuality::Refit;
    double area_at_build = 0;
    int calm_updates = 0;  // LOW rebuilds in a row that would have needed none
    std::span<const uint32_t> triangles() const { return kept.empty() ? seen.triangles : kept; }
    // Instanced
    uint32_t shape = kNone;
    EmbreeInstance instance;
    Placement placement;
};

// A second top scene, built from copies of the moving vertices while the first one serves.
struct BackgroundBuild {
    struct Copy {
        uint32_t row;
        double area;
        std::vector<vec4> positions;
        EmbreeMesh mesh;
    };
    EmbreeScene scene;
    std::vector<Copy> copies;
    bool failed = false;  // memory ended; read once it is done
    std::atomic<bool> done{false};
    std::thread thread;
    ~BackgroundBuild() {
        if (thread.joinable()) thread.join();
    }
};

struct Accel::State {
    AccelPolicy policy;
    double size = 1;  // of the rows as they were first given, about
    float scale = 1;  // of the top scene: Embree's space from accel space
    std::vector<GeometryState> rows;
    std::vector<std::unique_ptr<StaticGroup>> groups;
    std::vector<InstancedShape> shapes;
    HitMap map;
    EmbreeScene top;
    AccelUpdate report;
    std::vector<BoxAreas> partial;  // memory of box_areas
    std::vector<uint8_t> shape_changed;
    std::vector<uint32_t> all_rows;  // 0, 1, 2 ...
    bool any_hidden_backfaces = false;
    float largest_origin = kLargest;  // rays from farther off are filtered, for an instance's sake
    // Last, so that it is joined before what it reads goes.
    std::unique_ptr<BackgroundBuild> background;
};

}  // namespace kinora::raytrace
