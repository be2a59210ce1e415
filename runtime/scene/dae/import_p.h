// runtime/scene/dae/import_p.h: the parts of the COLLADA importer; for import_collada*.cpp only.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "collada/scene/scene.h"
#include "runtime/scene/dae/import.h"
#include "runtime/scene/profile_rsl/effect_linker.h"

namespace kinora {

class ColladaImport {
  public:
    // What is large in `data` is moved out of it: meshes and skins.
    ColladaImport(collada::SceneData& data, const ImportOptions& options, Diagnostics& diagnostics,
                  SceneDescription& out)
        : data_(data), options_(options), diagnostics_(diagnostics), out_(out) {}

    void run();

  private:
    // import.cpp: every animatable number gets an offset in values.
    void allocate_values();
    uint32_t append(const double* numbers, size_t count);
    uint32_t append(const collada::ParamValue& value);
    ValueSlot linear(ValueSlot display);
    void settle_colors();
    ValueSlot slot(const collada::TargetRef& ref) const;
    uint32_t owner_bit(const collada::TargetRef& ref) const;
    void import_nodes();
    void import_cameras();
    void import_clips();
    NodeDefinition& add_reference(size_t n, uint32_t conversion_index);
    MeshUse mesh_use(const collada::MeshInstance& instance);
    dmat4 conversion(uint32_t index) const;

    // import_mesh.cpp
    void import_meshes();
    void add_linear_vertex_colors();
    void import_skins();
    void import_morphs();

    // import_material.cpp
    void import_materials();
    void import_lights();
    PictureShaders picture_shaders(const std::vector<uint32_t>& materials);
    MaterialDefinition material(uint32_t index);
    void rsl_material(uint32_t index, const collada::Effect& effect, MaterialDefinition& result);
    void common_material(uint32_t index, const collada::Effect& effect, MaterialDefinition& result);
    std::string image_path(const collada::Image& image);
    std::string image_name(const collada::Image& image, std::string_view text, Location where);
    std::optional<ShaderUse> shader_use(uint32_t material, const collada::Effect& effect,
                                        const collada::RslShader& shader);
    EffectLinker& linker();
    void add_binds(const BoundShader& shader, const std::string& prefix, ShaderUse& use);
    ValueSlot bound_slot(uint32_t material, const collada::ParamBinding& param);
    ValueSlot param_slot(uint32_t material, uint32_t effect, uint32_t param) const;
    void set_texture(uint32_t material, const collada::CommonValue& value, const char* name,
                     bool data, ShaderUse& use);
    // Sampler `number` of its effect, or the one its <setparam>s replaced it with.
    const collada::TextureSampler& sampler_of(uint32_t material, uint32_t number) const;

    // import_animation.cpp
    void import_animation();
    // Of those channels; SceneDescription::animated is told where they write.
    anim::Animation animation_of(const std::vector<bool>& channels);
    bool is_matrix_param(const collada::TargetRef& ref) const;

    collada::SceneData& data_;
    const ImportOptions& options_;
    Diagnostics& diagnostics_;
    SceneDescription& out_;

    std::vector<std::unordered_map<uint32_t, uint32_t>> setparam_of_;  // by material: by param
    // Offsets into values: [definition][slot].
    std::vector<std::vector<uint32_t>> transform_values_, light_values_, camera_values_,
        param_values_, common_values_, setparam_values_;
    std::vector<uint32_t> morph_values_;
    std::unordered_map<uint32_t, uint32_t> linear_colors_;  // by the display colour's offset
    std::vector<bool> sampler_told_;                        // what was repaired in it
    std::optional<EffectLinker> linker_;
    std::set<const collada::RslBind*> told_;  // what was reported of a co-shader
};

}  // namespace kinora
