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

bool Interpreter::in_detail() const {
    return is_drawn() && attributes_.in_detail_range && attributes_.visible_to_camera;
}

void Interpreter::primitive(const Call& call) {
    if (!in_detail()) return;
    // Calls of a list that is played again stand where they stood.
    const void* key = replayed_call_ == &call ? &call : nullptr;
    if (key && world_->add_again(key, attributes_, to_camera())) return;
    std::optional<MeshDefinition> mesh;
    if (is_polygon(call.request)) {
        mesh = polygon_mesh(call, attributes_);
    } else if (call.request == Request::SubdivisionMesh) {
        SubdivisionSurface surface = subdivision_surface(call, attributes_);
        if (surface.points.empty())
            return report(Code::RI_DATA_MISSING, row(call.request).name, "P");
        if (call.arguments[0].string() != "catmull-clark")
            not_done("SubdivisionMesh", "its scheme is taken for \"catmull-clark\"");
        if (has_creases(call)) not_done("SubdivisionMesh", "creases, corners and holes are smooth");
        mesh = mesh_of(subdivide(surface, world_->scale(to_camera())));
    } else if (auto surface = curved_surface(call, attributes_)) {
        mesh = mesh_of(tessellate(*surface, world_->scale(to_camera())));
    } else {
        return report(Code::RI_DATA_MISSING, row(call.request).name, "P");
    }
    if (!mesh) return;
    mesh->where = call.where;
    world_->add(std::move(*mesh), attributes_, to_camera());
    if (key) world_->keep_mesh(key, attributes_);
}

void Interpreter::geometry(const Call& call) {
    if (!in_detail()) return;
    if (call.arguments[0].string() != "teapot")
        return not_done("Geometry", "only \"teapot\" is known");
    for (const CurvedSurface& patch : teapot(attributes_))
        if (auto mesh = mesh_of(tessellate(patch, world_->scale(to_camera())))) {
            mesh->where = call.where;
            world_->add(std::move(*mesh), attributes_, to_camera());
        }
}

void Interpreter::not_drawn(const Call& call) {
    std::string name(row(call.request).name);
    not_done(name.c_str(), "it is not drawn");
}

}  // namespace kinora::ri
