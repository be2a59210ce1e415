// runtime/scene/ri/state/drawing.cpp: primitives into the open world.
#include "runtime/scene/description/findings.h"
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

}  // namespace

bool Interpreter::is_visible() const {
    const int wanted = state_.import.world;
    const Attributes& now = state_.attributes;
    return (wanted < 0 || wanted == worlds_ - 1) && now.in_detail_range && now.visible_to_camera;
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

void Interpreter::primitive(const Call& call) {
    if (!is_visible()) return;
    // Calls of a list that is played again stand where they stood.
    const void* key = replayed_call_ == &call ? &call : nullptr;
    const dmat4 to_camera = state_.to_camera();
    if (key && state_.world->add_again(key, state_.attributes, to_camera)) return;
    const TessellationLimits limits = state_.world->limits();
    std::optional<MeshDefinition> mesh;
    if (is_polygon(call.request)) {
        mesh = polygon_mesh(call, state_.attributes);
    } else if (call.request == Request::SubdivisionMesh) {
        SubdivisionSurface surface = subdivision_surface(call, state_.attributes);
        if (surface.points.empty())
            return report_.add(Code::RI_DATA_MISSING, row(call.request).name, "P");
        if (call.arguments[0].string() != "catmull-clark")
            report_.not_done("SubdivisionMesh", "its scheme is taken for \"catmull-clark\"");
        if (has_creases(call))
            report_.not_done("SubdivisionMesh", "creases, corners and holes are smooth");
        mesh = mesh_of(
            judged(call, subdivide(surface, state_.world->scale(to_camera), limits), limits));
    } else if (auto surface = curved_surface(call, state_.attributes)) {
        mesh = mesh_of(
            judged(call, tessellate(*surface, state_.world->scale(to_camera), limits), limits));
    } else {
        return report_.add(Code::RI_DATA_MISSING, row(call.request).name, "P");
    }
    if (!mesh) return nothing_left(call);
    mesh->where = call.where;
    state_.world->add(std::move(*mesh), state_.attributes, to_camera);
    if (key) state_.world->keep_mesh(key, state_.attributes, to_camera);
}

void Interpreter::geometry(const Call& call) {
    if (!is_visible()) return;
    if (call.arguments[0].string() != "teapot")
        return report_.not_done("Geometry", "only \"teapot\" is known");
    const dmat4 to_camera = state_.to_camera();
    for (const CurvedSurface& patch : teapot(state_.attributes)) {
        const TessellationLimits limits = state_.world->limits();
        Tessellation made = tessellate(patch, state_.world->scale(to_camera), limits);
        if (auto mesh = mesh_of(judged(call, std::move(made), limits))) {
            mesh->where = call.where;
            state_.world->add(std::move(*mesh), state_.attributes, to_camera);
        }
    }
}

void Interpreter::not_drawn(const Call& call) {
    report_.not_done(row(call.request).name, "it is not drawn");
}

}  // namespace kinora::ri
