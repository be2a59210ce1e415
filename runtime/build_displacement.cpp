// runtime/build_displacement.cpp: meshes whose shaders move vertices: diced for the closest view of
// the range played, and moved, once or ready to be at each frame.
//
// How fine a mesh is diced depends on the scene, its camera, the range played and the size of the
// picture, not on which frames are rendered: a frame is the same alone and in a sequence.
#include <algorithm>
#include <array>
#include <glm/matrix.hpp>
#include <map>

#include "runtime/base/stats.h"
#include "runtime/build_mesh.h"
#include "runtime/build_scene_p.h"
#include "runtime/deform.h"
#include "runtime/findings.h"
#include "runtime/frame.h"
#include "runtime/vertex_work.h"

namespace kinora {

namespace {

// A camera, and where the base mesh's vertices are for it.
struct DiceView {
    raytrace::Camera camera;
    dmat4 accel_from_pose{1.0};
    std::vector<vec4> pose;  // of deforming meshes; empty: the rest positions

    bool same(const DiceView& o) const {
        return pose.empty() && o.pose.empty() && accel_from_pose == o.accel_from_pose &&
               camera.eye == o.camera.eye && camera.right == o.camera.right &&
               camera.up == o.camera.up && camera.half_width == o.camera.half_width;
    }
};

constexpr int kViewSamples = 8;    // of the range played, and its end
constexpr double kCoarser = 1.25;  // from one try to the next where the limit binds
constexpr double kCoarsest = 1e7;  // pixels: nothing is split any more
// Halving leaves edges between half of the longest and the longest: their mean is to be as asked.
constexpr double kLongest = 1.41421356;

dvec3 point(std::span<const vec4> pose, const uint32_t corners[3], DicePoint at) {
    dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k) sum += double(at.weight(k)) / kDiceOne * dvec3(pose[corners[k]]);
    return sum;
}

const VertexAttribute* find_own(const PrimitiveGroup& group, std::string_view semantic) {
    for (const VertexAttribute& a : group.attributes)
        if (a.semantic == semantic) return &a;
    return nullptr;
}

}  // namespace

// Shapes that share one displaced mesh: several only where it is displaced once and alike.
struct SceneBuilder::Displaced {
    std::vector<uint32_t> shapes;
    std::vector<std::vector<uint32_t>> surfaces;  // by shape, by group
    std::vector<uint8_t> diced;                   // by group
    bool deforms = false;                         // a skin or morph
    bool each_frame = false;
    std::vector<DiceView> views;
    Mesh base;
    std::optional<DicedMesh> made;

    bool any_diced() const { return std::find(diced.begin(), diced.end(), 1) != diced.end(); }
};

void SceneBuilder::displace() {
    std::vector<Displaced> all = find_displaced();
    if (all.empty()) return;
    Stopwatch watch;
    Scene& scene = *scene_;
    bool any = std::any_of(all.begin(), all.end(), [](const auto& d) { return d.any_diced(); });
    if (any) find_views(all);
    dice(all);
    for (Displaced& displaced : all) wear(displaced);
    bake_static(scene);
    deform_now();
    scene.dice.ms = watch.ms();
}

std::vector<SceneBuilder::Displaced> SceneBuilder::find_displaced() {
    Scene& scene = *scene_;
    std::vector<std::vector<uint32_t>> surfaces(scene.shapes.size());
    for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
        surfaces[scene.surfaces[s].shape].push_back(s);
    std::vector<Displaced> result;
    std::map<std::vector<uintptr_t>, size_t> known;  // all that makes results differ
    for (uint32_t h = 0; h < scene.shapes.size(); ++h) {
        const Shape& shape = scene.shapes[h];
        Displaced found;
        bool any = false, by_node = false;
        std::vector<uintptr_t> key = {shape.mesh};
        for (uint32_t s : surfaces[h]) {
            const Surface& surface = scene.surfaces[s];
            found.diced.push_back(surface.displacement.look != kNone);
            key.push_back(uintptr_t(surface.st));
            for (const VertexUse* use : {&surface.transformation, &surface.displacement}) {
                key.push_back(use->look);
                for (const VertexAttribute* a : use->varying) key.push_back(uintptr_t(a));
                if (use->look == kNone) continue;
                const Look& look = *scene.vertex_looks[use->look];
                any = true;
                found.each_frame |= runs_each_frame(look, scene, shape.node);
                by_node |= depends_on_node(look);
            }
        }
        if (!any) continue;
        found.deforms = shape.kind == raytrace::GeometryKind::Deforming;
        bool own = found.deforms || found.each_frame || by_node;
        if (!own) {
            auto [place, is_new] = known.try_emplace(key, result.size());
            if (!is_new) {
                Displaced& first = result[place->second];
                if (scene.shapes[first.shapes[0]].conversion == shape.conversion) {
                    first.shapes.push_back(h);
                    first.surfaces.push_back(surfaces[h]);
                    continue;
                }
            }
        }
        found.shapes = {h};
        found.surfaces = {surfaces[h]};
        found.base = build_mesh(description_.meshes[scene.meshes[shape.mesh].definition], true);
        found.base.definition = scene.meshes[shape.mesh].definition;
        result.push_back(std::move(found));
    }
    return result;
}

void SceneBuilder::find_views(std::vector<Displaced>& all) {
    Scene& scene = *scene_;
    const SceneOptions& options = scene.options;
    bool moves = !description_.animation.channels.empty() && options.end_time > options.start_time;
    double aspect = camera_aspect(scene).value_or(16.0 / 9.0);
    int width = std::max(options.width, 1);
    int height = options.height > 0 ? options.height : std::max(1, int(width / aspect + 0.5));
    for (int s = 0; s <= (moves ? kViewSamples : 0); ++s) {
        if (moves) {
            double along = double(s) / kViewSamples;
            evaluate(options.start_time + (options.end_time - options.start_time) * along);
            deform_now();
        }
        if (raytrace::is_error(place_camera(scene, width, height))) continue;
        for (Displaced& displaced : all)
            for (uint32_t h : displaced.shapes) {
                const Shape& shape = scene.shapes[h];
                DiceView view;
                view.camera = scene.view;
                if (displaced.deforms) {
                    view.pose = shape.positions;
                } else {
                    view.accel_from_pose = scene.nodes[shape.node].world * shape.conversion;
                    dmat4 from_anchor(1.0), to_accel(1.0);
                    from_anchor[3] = dvec4(displaced.base.anchor, 1.0);
                    to_accel[3] = dvec4(-scene.origin, 1.0);
                    view.accel_from_pose = to_accel * view.accel_from_pose * from_anchor;
                }
                bool seen = std::any_of(displaced.views.begin(), displaced.views.end(),
                                        [&](const DiceView& v) { return v.same(view); });
                if (!seen) displaced.views.push_back(std::move(view));
            }
    }
    if (!moves) return;
    evaluate(options.start_time);
    deform_now();
    place_camera(scene, width, height);
}

// `pixels`, or more where a coarse try tells that it would take more than twice the limit: fine
// tries that fail cost much more.
double SceneBuilder::coarse_enough(std::vector<Displaced>& all, double pixels) {
    constexpr double kProbe = 8;
    double limit = double(scene_->options.dice_limit), base = 0, probed = 0;
    while (pixels < kCoarsest && !dice_to(all, kProbe * pixels, scene_->options.dice_limit))
        pixels *= kProbe;
    for (const Displaced& displaced : all) {
        if (!displaced.any_diced() || !displaced.made) continue;
        for (const MeshGroup& group : displaced.base.groups)
            base += double(group.triangles.size() / 3);
        probed += double(displaced.made->triangles());
    }
    double added = (probed - base) * kProbe * kProbe;
    for (; base + added > 2 * limit && pixels < kCoarsest; pixels *= kCoarser)
        added /= kCoarser * kCoarser;
    return pixels;
}

void SceneBuilder::dice(std::vector<Displaced>& all) {
    Scene& scene = *scene_;
    const SceneOptions& options = scene.options;
    double pixels = coarse_enough(all, std::max(options.dice, 1e-3));
    while (pixels < kCoarsest && !dice_to(all, pixels, options.dice_limit)) pixels *= kCoarser;
    if (pixels >= kCoarsest) dice_to(all, pixels, ~size_t(0) / 2);
    if (pixels > std::max(options.dice, 1e-3))
        diagnostics_.report(Code::DICE_LIMIT, Location{}, pixels, options.dice, options.dice_limit);
    scene.dice.pixels = pixels;
    for (const Displaced& displaced : all) {
        if (!displaced.any_diced()) continue;
        scene.dice.triangles += displaced.made->triangles();
        scene.dice.vertices += displaced.made->mesh.positions.size();
    }
}

// False when all together come to more than `limit` triangles.
bool SceneBuilder::dice_to(std::vector<Displaced>& all, double pixels, size_t limit) {
    size_t used = 0;
    for (Displaced& displaced : all) {
        const Mesh& base = displaced.base;
        auto too_long = [&](const uint32_t corners[3], DicePoint a, DicePoint b) {
            if (pixels >= kCoarsest) return false;
            return std::any_of(
                displaced.views.begin(), displaced.views.end(), [&](const DiceView& view) {
                    std::span<const vec4> pose = view.pose.empty() ? base.positions : view.pose;
                    dvec3 from(view.accel_from_pose * dvec4(point(pose, corners, a), 1.0));
                    dvec3 to(view.accel_from_pose * dvec4(point(pose, corners, b), 1.0));
                    return edge_pixels(view.camera, from, to) > kLongest * pixels;
                });
        };
        bool counts = displaced.any_diced();
        displaced.made.reset();
        displaced.made =
            dice_mesh(base, displaced.diced, too_long, counts ? limit - used : ~size_t(0) / 2);
        if (!displaced.made) return false;
        if (counts) used += displaced.made->triangles();
    }
    return true;
}

namespace {

// Where an attribute of the mesh as read is in its diced group. What was null is what dicing made:
// texture coordinates, the rest position or an output of the displacement.
const VertexAttribute* diced_attribute(const VertexAttribute* from, std::string_view semantic,
                                       const PrimitiveGroup& old, const PrimitiveGroup& made) {
    if (!from) return find_own(made, semantic);
    size_t index = 0;
    for (const VertexAttribute& a : old.attributes) {
        if (&a == from) return &made.attributes[index];
        index += a.semantic != "NORMAL";
    }
    return find_own(made, semantic);
}

// Attributes that the looks want beyond those of the file.
void add_attributes(std::span<const VaryingParam> varying, const Mesh& mesh,
                    const DicedGroup& group, PrimitiveGroup& made) {
    for (const VaryingParam& param : varying) {
        bool wanted = param.semantic == "Pref" || param.semantic.starts_with("vertex:");
        if (!wanted || find_own(made, param.semantic)) continue;
        VertexAttribute a;
        a.semantic = param.semantic;
        a.stride = param.components;
        a.corners = group.corners;
        a.values.resize(group.position.size() * a.stride);
        if (param.semantic == "Pref")
            for (size_t w = 0; w < group.position.size(); ++w)
                for (int k = 0; k < 3; ++k)
                    a.values[3 * w + size_t(k)] =
                        mesh.positions[group.position[w]][k] + float(mesh.anchor[k]);
        made.attributes.push_back(std::move(a));
    }
}

void find_attributes(std::span<const VaryingParam> params, const PrimitiveGroup& old,
                     const PrimitiveGroup& made, std::vector<const VertexAttribute*>& varying) {
    for (size_t k = 0; k < varying.size(); ++k)
        varying[k] = diced_attribute(varying[k], params[k].semantic, old, made);
}

// Vertex looks of the surface, transformation first.
std::array<const VertexUse*, VertexWork::kStages> vertex_stages(const Surface& surface) {
    return {&surface.transformation, &surface.displacement};
}

using SurfaceLists = std::span<const std::vector<uint32_t>>;  // by shape, by group

void add_wanted_attributes(const Scene& scene, SurfaceLists surfaces_of_shapes, DicedMesh& made) {
    for (const auto& surfaces : surfaces_of_shapes)
        for (size_t g = 0; g < surfaces.size(); ++g) {
            const Surface& surface = scene.surfaces[surfaces[g]];
            PrimitiveGroup& group = *made.mesh.own_groups[g];
            add_attributes(scene.looks[surface.look]->varying, made.mesh, made.groups[g], group);
            for (const VertexUse* use : vertex_stages(surface))
                if (use->look != kNone)
                    add_attributes(scene.vertex_looks[use->look]->varying, made.mesh,
                                   made.groups[g], group);
        }
}

// Vertex inputs of the surfaces are those of the diced mesh from now on.
void take_diced_attributes(Scene& scene, SurfaceLists surfaces_of_shapes, const Mesh& base,
                           const Mesh& mesh) {
    for (const auto& surfaces : surfaces_of_shapes)
        for (size_t g = 0; g < surfaces.size(); ++g) {
            Surface& surface = scene.surfaces[surfaces[g]];
            const PrimitiveGroup &old = *base.groups[g].definition, &group = *mesh.own_groups[g];
            surface.st = diced_attribute(surface.st, "TEXCOORD", old, group);
            find_attributes(scene.looks[surface.look]->varying, old, group, surface.varying);
            for (VertexUse* use : {&surface.transformation, &surface.displacement})
                if (use->look != kNone)
                    find_attributes(scene.vertex_looks[use->look]->varying, old, group,
                                    use->varying);
        }
}

// What moves the vertices of each group.
std::vector<VertexWork::Use> vertex_uses(const Scene& scene, std::span<const uint32_t> surfaces,
                                         const Mesh& mesh) {
    std::vector<VertexWork::Use> uses;
    for (size_t g = 0; g < surfaces.size(); ++g) {
        const Surface& surface = scene.surfaces[surfaces[g]];
        VertexWork::Use& use = uses.emplace_back();
        use.st = surface.st;
        use.attributes = mesh.own_groups[g].get();
        auto stages = vertex_stages(surface);
        for (size_t s = 0; s < stages.size(); ++s) {
            if (stages[s]->look == kNone) continue;
            use.looks[s] = scene.vertex_looks[stages[s]->look].get();
            use.varying[s] = stages[s]->varying;
        }
    }
    return uses;
}

void include_moved(Mesh& mesh) {
    for (const vec4& p : mesh.positions) {
        mesh.low = glm::min(mesh.low, dvec3(p) + mesh.anchor);
        mesh.high = glm::max(mesh.high, dvec3(p) + mesh.anchor);
    }
}

}  // namespace

// Puts the diced mesh on its shapes and moves its vertices, or readies them to be moved.
void SceneBuilder::wear(Displaced& from) {
    Scene& scene = *scene_;
    DicedMesh& made = *from.made;
    Mesh& mesh = made.mesh;
    uint32_t index = uint32_t(scene.meshes.size());
    add_wanted_attributes(scene, from.surfaces, made);
    take_diced_attributes(scene, from.surfaces, from.base, mesh);
    std::vector<VertexWork::Use> uses = vertex_uses(scene, from.surfaces[0], mesh);
    bool instanced = from.shapes.size() > 1 && made.triangles() > kBakedTriangles;
    bool once = !from.deforms && !from.each_frame;
    Shape& first = scene.shapes[from.shapes[0]];
    auto work = std::make_unique<VertexWork>(mesh, std::move(made.groups), std::move(uses));
    if (once) {
        work->run(scene, first.node, first.conversion, mesh.anchor, mesh.positions, mesh.normals);
        work->report(description_.meshes[mesh.definition].id, diagnostics_);
        include_moved(mesh);
    }
    scene.meshes.push_back(std::move(mesh));
    for (uint32_t h : from.shapes) {
        Shape& shape = scene.shapes[h];
        shape.mesh = index;
        if (!once)
            make_deforming(shape, *uses_[from.surfaces[0][0]], made);
        else if (instanced)
            shape.kind = raytrace::GeometryKind::Instanced;
        bool own = shape.kind != raytrace::GeometryKind::Instanced;
        shape.positions.assign(own ? scene.meshes[index].positions.size() : 0, vec4(0.0f));
        shape.normals.assign(own ? scene.meshes[index].normals.size() : 0, vec4(0.0f));
    }
    if (once) return;
    work->each_frame = from.each_frame;
    first.vertex_work = std::move(work);
}

void SceneBuilder::make_deforming(Shape& shape, const MeshUse& use, const DicedMesh& diced) {
    Scene& scene = *scene_;
    shape.kind = raytrace::GeometryKind::Deforming;
    const Mesh& mesh = scene.meshes[shape.mesh];
    if (shape.morph != kNone) {
        scene.morphs.push_back(dice_morph(scene.morphs[shape.morph_data], diced.position_stencils,
                                          diced.normal_stencils));
        shape.morph_data = uint32_t(scene.morphs.size() - 1);
        shape.morphed_positions.resize(mesh.positions.size());
        shape.morphed_normals.resize(mesh.normals.size());
    }
    skin::SkinRepairs told;  // by the mesh as read
    build_skin_mesh(use, shape, &diced.position_stencils, told);
    if (shape.skin == kNone) {
        shape.palette.resize(2);  // joint -1, and the node's matrix
        shape.displaced_positions.resize(mesh.positions.size());
        shape.displaced_normals.resize(mesh.normals.size());
    }
}

}  // namespace kinora
