// runtime/scene/build/coverage.cpp: how much of a picture a scene takes: triangles marked on a grid
// of rays, which needs no acceleration structure.
#include "runtime/scene/build/coverage.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace kinora {

namespace {

constexpr int kGrid = 64;
constexpr size_t kLookEvery = 3 * 1024;  // corners

// A vertex before the camera. (x, y, w) is homogeneous: the picture is -1..1 in x / w and y / w.
struct Seen {
    dvec3 xyw;
    double depth;
};

class CoverageGrid {
  public:
    explicit CoverageGrid(const raytrace::Camera& camera) : camera_(camera) {
        nearest_ = camera.clip ? camera.znear : 0;
        farthest_ = camera.clip ? camera.zfar : std::numeric_limits<double>::infinity();
    }

    Seen seen(dvec3 p) const {
        dvec3 to = p - camera_.eye;
        double depth = glm::dot(to, camera_.forward);
        const double w = camera_.orthographic ? 1.0 : depth;
        return {{(glm::dot(to, camera_.right) - camera_.middle.x * w) / camera_.half_width,
                 (glm::dot(to, camera_.up) - camera_.middle.y * w) / camera_.half_height, w},
                depth};
    }

    // `front`: 1 or -1, the side that is seen; 0: both.
    void mark(const Seen& a, const Seen& b, const Seen& c, double front) {
        if (!std::isfinite(a.depth + b.depth + c.depth)) return;
        if (std::max({a.depth, b.depth, c.depth}) <= nearest_ || beside(a, b, c)) return;
        // Olano, Greer: Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997: right for
        // triangles that reach behind the eye.
        dvec3 edges[3] = {glm::cross(b.xyw, c.xyw), glm::cross(c.xyw, a.xyw),
                          glm::cross(a.xyw, b.xyw)};
        Range xs = range(a, b, c, 0), ys = range(a, b, c, 1);
        for (int y = ys.first; y <= ys.last; ++y)
            for (int x = xs.first; x <= xs.last; ++x) {
                size_t ray = size_t(y * kGrid + x);
                if (met_[ray]) continue;
                dvec3 at(grid_coordinate(x), grid_coordinate(y), 1.0);
                double e[3] = {glm::dot(edges[0], at), glm::dot(edges[1], at),
                               glm::dot(edges[2], at)};
                double sum = e[0] + e[1] + e[2];
                bool in = (e[0] >= 0 && e[1] >= 0 && e[2] >= 0 && front >= 0) ||
                          (e[0] <= 0 && e[1] <= 0 && e[2] <= 0 && front <= 0);
                double depth = (e[0] * a.depth + e[1] * b.depth + e[2] * c.depth) / sum;
                met_[ray] = in && depth > nearest_ && depth < farthest_;  // not where sum is 0
            }
    }

    double share() const { return double(met_.count()) / (kGrid * kGrid); }

  private:
    struct Range {
        int first, last;
    };
    static double grid_coordinate(int i) { return (2 * i + 1) / double(kGrid) - 1; }

    // Wholly outside one side of the picture.
    static bool beside(const Seen& a, const Seen& b, const Seen& c) {
        for (int k = 0; k < 2; ++k)
            for (double side : {-1.0, 1.0}) {
                auto outside = [&](const Seen& v) { return side * v.xyw[k] > v.xyw.z; };
                if (outside(a) && outside(b) && outside(c)) return true;
            }
        return false;
    }

    // Of the rays that it may meet.
    static Range range(const Seen& a, const Seen& b, const Seen& c, int k) {
        if (!(std::min({a.xyw.z, b.xyw.z, c.xyw.z}) > 0)) return {0, kGrid - 1};
        auto [low, high] =
            std::minmax({a.xyw[k] / a.xyw.z, b.xyw[k] / b.xyw.z, c.xyw[k] / c.xyw.z});
        auto ray = [](double at) { return 0.5 * (std::clamp(at, -1.0, 1.0) + 1) * kGrid - 0.5; };
        return {int(std::ceil(ray(low) - 1e-6)),
                std::min(int(std::floor(ray(high) + 1e-6)), kGrid - 1)};
    }

    const raytrace::Camera& camera_;
    double nearest_, farthest_;
    std::bitset<kGrid * kGrid> met_;
};

// All positions of a shape, in accel space.
void place_vertices(const SceneShapes& scene, const Pose& pose, uint32_t index,
                    const CoverageGrid& grid, std::vector<Seen>& vertices) {
    const Shape& shape = scene.shapes[index];
    const Mesh& mesh = scene.meshes[shape.mesh];
    vertices.clear();
    if (shape.kind != raytrace::GeometryKind::Instanced) {
        for (const vec4& p : pose.shapes[index].shown_positions)
            vertices.push_back(grid.seen(dvec3(p)));
        return;
    }
    dmat4 world = pose.nodes[shape.node].world * shape.conversion;
    for (const vec4& p : mesh.positions)
        vertices.push_back(
            grid.seen(dvec3(world * dvec4(dvec3(p) + mesh.anchor, 1.0)) - scene.origin));
}

}  // namespace

double covered_share(const SceneShapes& scene, const Pose& pose, const raytrace::Camera& camera,
                     double enough) {
    CoverageGrid grid(camera);
    std::vector<Seen> vertices;
    uint32_t placed = kNone;
    for (const Surface& surface : scene.surfaces) {
        const Shape& shape = scene.shapes[surface.shape];
        const Mesh& mesh = scene.meshes[shape.mesh];
        if (placed != surface.shape) place_vertices(scene, pose, surface.shape, grid, vertices);
        placed = surface.shape;
        double front = mesh.double_sided ? 0 : pose.shapes[surface.shape].mirrored ? -1 : 1;
        const std::vector<uint32_t>& t = mesh.groups[surface.group].triangles;
        for (size_t c = 0; c + 2 < t.size(); c += 3) {
            if (c % kLookEvery == 0 && grid.share() >= enough) return grid.share();
            grid.mark(vertices[t[c]], vertices[t[c + 1]], vertices[t[c + 2]], front);
        }
    }
    return grid.share();
}

}  // namespace kinora
