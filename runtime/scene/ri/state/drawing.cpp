// runtime/scene/ri/state/drawing.cpp: primitives into the open world.
#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/state/call_content.h"
#include "runtime/scene/ri/state/interpreter.h"
#include "runtime/scene/ri/state/primitives.h"
#include "runtime/scene/tessellate/subdivide.h"
#include "runtime/scene/tessellate/tessellate.h"

namespace kinora::ri {
namespace {

bool is_polygon(Request request) {
    return request == Request::Polygon || request == Request::GeneralPolygon ||
           request == Request::PointsPolygons || request == Request::PointsGeneralPolygons;
}

std::optional<MeshDefinition> mesh_of(Tessellation made) {
    if (made.group.triangles.empty()) return std::nullopt;
    MeshDefinition mesh;
    mesh.positions = std::move(made.positions);
    mesh.groups.push_back(std::move(made.group));
    return mesh;
}

bool is_other_scheme(std::string_view scheme) {
    return scheme == "loop" || scheme == "bilinear";
}

constexpr uint32_t kFewCorners = 256;

}  // namespace

bool Interpreter::is_visible() const {
    const Attributes& now = state_.attributes;
    return drawn_.draws(worlds_ - 1) && now.in_detail_range && now.visibility.any();
}

// Says once that limits have made a surface coarse.
Tessellation Interpreter::judged(const Call& call, Tessellation made,
                                 const TessellationLimits& limits) {
    constexpr double kCoarse = 8;  // times the error that is wanted
    constexpr const char* kWhy =
        "surfaces that are very much larger than the picture are coarser than it needs";
    const bool limited = made.group.triangles.size() / 3 > limits.triangles / 4;
    if (limited && made.error > kCoarse * limits.error && report_.is_new(kWhy))
        report_.add(Code::RI_RANGE, row(call.request).name, kWhy);
    return made;
}

// Once for each kind of curved surface: exporters write caps without a radius by the hundreds.
void Interpreter::nothing_left(const Call& call) {
    if (is_polygon(call.request)) return;
    const std::string_view name = row(call.request).name;
    const std::string_view why =
        call.request == Request::SubdivisionMesh
            ? "no face is left; those at the boundary need the tag \"interpolateboundary\""
            : "its numbers leave no area: a size of 0, knots that fall, or what is not finite";
    if (report_.is_new(fmt::format("{} {}", name, why))) report_.add(Code::RI_RANGE, name, why);
}

// Of a primitive that may come again. Where it has a steady size in the picture, `scale` becomes
// that. Nothing: it is made as it comes.
std::optional<MeshKey> Interpreter::key_of(const Call& call, PictureScale& scale) const {
    const Attributes& now = state_.attributes;
    if (is_polygon(call.request)) {
        if (call.counts.face_varying < kFewCorners) return std::nullopt;
        return MeshKey{content_of(call, now), 0};
    }
    const std::optional<Ball> ball = ball_of(call, now);
    if (!ball) return std::nullopt;
    const auto steady = steady_scale(scale, ball->center, ball->radius);
    if (!steady) return std::nullopt;
    scale = *steady;
    return MeshKey{content_of(call, now), scale.pixels};
}

std::optional<MeshDefinition> Interpreter::mesh_of_call(const Call& call, const PictureScale& scale,
                                                        const TessellationLimits& limits) {
    std::optional<MeshDefinition> mesh;
    if (is_polygon(call.request)) {
        mesh = polygon_mesh(call, state_.attributes);
    } else if (call.request == Request::SubdivisionMesh) {
        const SubdivisionSurface surface = subdivision_of(call);
        if (surface.points.empty()) return std::nullopt;
        mesh = mesh_of(judged(call, subdivide(surface, scale, limits), limits));
    } else if (auto surface = curved_surface(call, state_.attributes)) {
        mesh = mesh_of(judged(call, tessellate(*surface, scale, limits), limits));
    } else {
        report_.add(Code::RI_DATA_MISSING, row(call.request).name, "P");
        return std::nullopt;
    }
    if (mesh)
        mesh->where = call.where;
    else
        nothing_left(call);
    return mesh;
}

SubdivisionSurface Interpreter::subdivision_of(const Call& call) {
    SubdivisionSurface surface = subdivision_surface(call, state_.attributes);
    if (surface.points.empty())
        report_.add(Code::RI_DATA_MISSING, row(call.request).name, "P");
    else if (is_other_scheme(call.arguments[0].string()))
        report_.not_done("SubdivisionMesh", "its scheme is taken for \"catmull-clark\"");
    if (has_creases(call))
        report_.not_done("SubdivisionMesh", "creases, corners and holes are smooth");
    return surface;
}

// One of a film's last picture, or a new one.
std::optional<MeshDefinition> Interpreter::kept_mesh(const MeshKey& key, const Call& call,
                                                     const PictureScale& scale) {
    constexpr size_t kMostTriangles = 500'000;  // whatever else is there
    const bool costly = state_.frame && !is_polygon(call.request);
    if (costly)
        if (auto kept = meshes_->find(key)) return *kept;
    std::optional<MeshDefinition> mesh =
        mesh_of_call(call, scale, {state_.world->limits().error, kMostTriangles});
    if (costly && mesh) meshes_->keep(key, *mesh);
    return mesh;
}

void Interpreter::primitive(const Call& call) {
    if (!is_visible()) return;
    const Placement placement{state_.transform, state_.to_camera()};
    PictureScale scale = state_.world->scale(placement.to_camera);
    if (const std::optional<MeshKey> key = key_of(call, scale))
        state_.world->add(*key, state_.attributes, placement,
                          [&] { return kept_mesh(*key, call, scale); });
    else if (auto mesh = mesh_of_call(call, scale, state_.world->limits()))
        state_.world->add(std::move(*mesh), state_.attributes, placement);
}

void Interpreter::geometry(const Call& call) {
    if (!is_visible()) return;
    if (call.arguments[0].string() != "teapot")
        return report_.not_done("Geometry", "only \"teapot\" is known");
    const Placement placement{state_.transform, state_.to_camera()};
    const PictureScale scale = state_.world->scale(placement.to_camera);
    for (const CurvedSurface& patch : teapot(state_.attributes)) {
        const TessellationLimits limits = state_.world->limits();
        if (auto mesh = mesh_of(judged(call, tessellate(patch, scale, limits), limits))) {
            mesh->where = call.where;
            state_.world->add(std::move(*mesh), state_.attributes, placement);
        }
    }
}

void Interpreter::not_drawn(const Call& call) {
    report_.not_done(row(call.request).name, "it is not drawn");
}

}  // namespace kinora::ri
