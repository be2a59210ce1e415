// runtime/build/scene_p.h: the steps of build_scene; for build_scene*.cpp only.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/build/build_scene.h"
#include "runtime/build/defaults.h"
#include "runtime/scene/scene.h"
#include "runtime/shading/shader_instance.h"
#include "runtime/vertices/diced_mesh.h"

namespace kinora {

// A repeated static mesh is instanced when all of it, baked, would be more triangles than this: an
// instance level costs 20-29 % of the trace rate (docs/decisions.md#two-levels-where-they-pay).
inline constexpr size_t kBakedTriangles = 200'000;

class SceneBuilder {
  public:
    SceneBuilder(std::shared_ptr<SceneDescription> description, const SceneOptions& options,
                 Diagnostics& diagnostics, const BuildAgain* again);
    std::unique_ptr<Scene> run();

  private:
    // scene.cpp: nodes, shapes, bounds, the ray tracer's rows
    void find_moving_nodes();
    void unroll(uint32_t definition, uint32_t parent, const dmat4& conversion);
    void evaluate(std::optional<double> time);  // none: the values of the file
    void ask_joints();
    uint32_t nearest_occurrence(uint32_t definition, uint32_t from) const;
    std::span<const MeshUse> meshes_of(const Node& node) const;
    void place_meshes();
    void place_mesh(const MeshUse& use, uint32_t node, size_t uses);
    void add_morph(const MeshUse& use, Shape& shape);
    std::vector<vec3> target_normals(const MeshDefinition& target, const Mesh& base,
                                     const MeshDefinition& base_definition, bool relative);
    void add_skin(const MeshUse& use, uint32_t node, Shape& shape);
    void convert_skin(uint32_t node, Shape& shape);
    skin::SkinMesh skin_mesh_of(const MeshUse& use, size_t vertices,
                                std::span<const uint32_t> normal_positions,
                                const std::vector<Stencil>* stencils, skin::SkinRepairs& repairs);
    Bounds bounds_now() const;
    Bounds played_bounds();
    void deform_now();
    void set_bounds();
    void finish_rows();

    // looks.cpp: cameras, lights, materials
    void place_cameras();
    uint32_t named_node(uint32_t node) const;
    bool choose_camera();
    void place_lights();
    bool needs_no_light() const;
    void extend_values();
    uint32_t add_node(NodeDefinition definition, uint32_t parent);
    void add_light(LightDefinition definition, uint32_t node);
    bool make_looks();
    void set_unit(const LightSource& light, ShaderUse& use);
    uint32_t look_of(Surface& surface, const MeshUse& use);
    bool bind_vertex_inputs(Surface& surface, const MaterialUse* use, ShaderInstance& look,
                            std::vector<const VertexAttribute*>& varying);
    std::unique_ptr<ShaderInstance> begin_look(ShaderInstanceKind kind,
                                               const MaterialDefinition& definition,
                                               std::vector<ShaderUse> layers,
                                               const MaterialUse* use, const Shape& shape,
                                               std::string& key);
    uint32_t vertex_look(ShaderInstanceKind kind, Surface& surface, const MaterialUse* use,
                         const MaterialDefinition& definition, VertexUse& result);
    void bind_displaced(Surface& surface, ShaderInstance& look);
    // Parameters that instance_material binds, put over the material's; `key` tells them apart.
    void apply_binds(const MaterialUse* use, std::vector<ShaderUse>& layers, std::string& key);
    // volumes.cpp
    void add_volumes(Surface& surface, const MaterialDefinition& material, const MaterialUse* use);
    uint32_t volume_look(const std::vector<ShaderUse>& layers, const std::string& name,
                         uint32_t node, const MaterialUse* use, bool exterior);
    void add_atmosphere();
    // area_lights.cpp
    bool add_area_lights();
    const MaterialUse* material_use(size_t surface) const;
    std::vector<ShaderUse> emitter(const MaterialDefinition& material);
    // imager.cpp
    void add_outputs();
    void add_imager();
    void bind_outputs(ShaderInstance& look) const;
    bool compile(ShaderInstance& look, const std::vector<std::string>& messages);
    const MaterialDefinition& default_material();

    // displacement.cpp: meshes diced, vertices moved
    struct Displaced;  // displacement_p.h
    void displace();
    std::vector<Displaced> find_displaced();
    void wear(Displaced& from);
    void make_deforming(Shape& shape, const MeshUse& use, const DicedMesh& diced,
                        WatchedEdges* watched);
    // dicing.cpp: for which views, how finely
    void find_views(std::vector<Displaced>& all);
    bool place_dice_camera();
    void add_view(std::vector<Displaced>& all, double time);
    void add_views(std::vector<Displaced>& all);
    bool refine_views(std::vector<Displaced>& all);
    void back_to_start();
    void dice(std::vector<Displaced>& all);
    void report_dice_limit();
    double coarse_enough(std::vector<Displaced>& all, double pixels);
    bool dice_to(std::vector<Displaced>& all, double pixels, size_t limit);
    void watch_edges(std::vector<Displaced>& all);
    bool stopped() const { return again_ && again_->stop && *again_->stop; }

    SceneDescription& description_;
    Diagnostics& diagnostics_;
    const BuildAgain* again_;
    std::unique_ptr<Scene> scene_;
    std::vector<bool> definition_moves_;
    std::map<uint32_t, uint32_t> first_occurrence_;
    std::vector<dmat4> rest_world_, start_world_;  // of nodes, where there are skins
    std::vector<const MeshUse*> uses_;             // of each surface
    bool vertex_looks_ok_ = true;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> shape_numbers_;
    std::map<std::string, uint32_t> looks_by_key_;
    std::vector<std::string> space_names_;
    std::vector<double> view_times_;         // that meshes are diced for; none where nothing moves
    std::vector<std::string> output_names_;  // parameters behind Scene::outputs
    std::vector<std::string> gathered_;      // outputs that gather statements read of what they hit
    MaterialDefinition default_material_;
};

}  // namespace kinora
