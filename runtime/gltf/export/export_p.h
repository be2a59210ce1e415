// runtime/gltf/export/export_p.h: the parts of the glTF exporter; for export_gltf*.cpp only.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/description/texture_name.h"
#include "runtime/gltf/export/export.h"
#include "runtime/gltf/curves/reduce_keys.h"
#include "runtime/scene/scene.h"

namespace kinora {

using Json = nlohmann::ordered_json;

// M = translation * rotation * diag(scale), rotation as x y z w.
struct Trs {
    dvec3 translation{0.0};
    std::array<double, 4> rotation{0, 0, 0, 1};
    dvec3 scale{1.0};
};
// False where the columns are not orthogonal: `trs` is then the nearest.
bool decompose_trs(const dmat4& m, Trs& trs);
// Any affine matrix as two nodes, outer * inner, exactly.
void split_shear(const dmat4& m, Trs& outer, Trs& inner);

// What a primitive wears.
struct GltfLook {
    const MaterialDefinition& definition;
    const MaterialUse& bound;
    bool is_plain;  // it has no material
    bool is_gltf;   // one of glTF's own, as import_gltf makes them
};

struct GltfAttribute {
    std::string name;  // "TEXCOORD_0", "_HEAT"
    const VertexAttribute* attribute;
    uint32_t width;  // numbers an element
};

class GltfExport {
  public:
    GltfExport(const SceneDescription& description, const GltfExportOptions& options,
               Diagnostics& diagnostics);
    std::string glb();

  private:
    // An occurrence of a node definition in the unrolled tree.
    struct Placed {
        uint32_t definition;
        uint32_t parent;   // kNone: a root
        uint32_t node;     // the glTF node with its whole matrix: what children hang on
        dmat4 world;       // at rest, in the scene's own axes and unit
        dmat4 start;       // likewise, at the first keys
        dmat4 conversion;  // of its use, outside its own stack
    };
    struct Channel {  // one that moves some number of a stack of transforms
        const anim::Sampler* sampler;
        const anim::Channel* channel;
    };
    // What becomes an animation of glTF: the scene's, or a clip's own.
    struct Take {
        std::string name;
        const anim::Animation* animation;
        Json channels = Json::array(), samplers = Json::array();
    };
    // A curve of glTF: what it is at any time, and how near its keys must come.
    struct Path : Curve {
        const char* name;
        std::vector<Channel> channels;
        double tolerance = 1e-4;
        std::vector<double> times;  // keys of the channels, more where they turn far
        uint32_t element_width() const { return name == std::string_view("weights") ? 1 : width; }
    };

    // export.cpp: the file, its buffer, cameras
    template <class T>
    uint32_t accessor(const std::vector<T>& numbers, uint32_t width, int target, bool bounds);
    uint32_t buffer_view(const void* data, size_t size, int target);
    void lost(const std::string& what, const std::string& why, Location where = {});
    void in_extras(const std::string& what, const std::string& why, Location where = {});
    bool is_animated(ValueSlot slot) const;
    std::span<const double> values(ValueSlot slot) const;
    Json camera(const CameraDefinition& definition);
    void use_extension(const char* name);
    std::string finish();

    // export_nodes.cpp
    uint32_t add_node(Json node, uint32_t parent);
    void unroll(uint32_t definition, uint32_t parent, const dmat4& conversion);
    uint32_t stack_nodes(const NodeDefinition& definition, const dmat4& conversion,
                         uint32_t parent);
    uint32_t static_nodes(const dmat4& matrix, uint32_t parent);
    void hang_content(uint32_t placed);
    void give_skins_a_root();
    void set_bounds(const dmat4& axes);
    uint32_t nearest_occurrence(uint32_t definition, uint32_t from) const;
    uint32_t skin(const MeshUse& use, uint32_t placed);
    uint32_t stand_again(uint32_t place, uint32_t above, uint32_t top,
                         std::map<uint32_t, uint32_t>& again);

    // export_animation.cpp: of take_, if not said otherwise
    void find_takes();
    void evaluate(const std::vector<Channel>& channels, double time);
    void to_rest(const std::vector<Channel>& channels);
    std::vector<Channel> channels_of(std::span<const Transform> stack) const;
    bool is_moved(std::span<const Transform> stack);  // by any take
    std::vector<Channel> channels_of(uint32_t first_value, uint32_t count) const;
    const Transform* only_mover(std::span<const Transform> stack, TransformKind kind) const;
    void move_node(uint32_t node, std::span<const Transform> stack, const dmat4& conversion,
                   const std::vector<Channel>& channels);
    void move_weights(uint32_t node, const MorphDefinition& morph);
    std::vector<double> key_times(std::span<const Transform> stack,
                                  const std::vector<Channel>& channels) const;
    void add_path(uint32_t node, Path path);
    bool add_step(uint32_t node, const Path& path);
    bool add_spline(uint32_t node, const Path& path, uint32_t first_value);
    void add_sampled(uint32_t node, const Path& path);
    void add_channel(uint32_t node, const char* path, const std::vector<double>& times,
                     const std::vector<double>& numbers, uint32_t width, const char* interpolation);

    // export_attributes.cpp
    GltfLook look_of(const MeshUse& use, const PrimitiveGroup& group);
    std::vector<GltfAttribute> attributes_of(const GltfLook& look, const PrimitiveGroup& group);

    // export_mesh.cpp
    uint32_t mesh(const MeshUse& use);
    Json primitive(const MeshUse& use, const PrimitiveGroup& group, const Mesh& built,
                   uint32_t group_index);
    void add_influences(const MeshUse& use, const std::vector<uint32_t>& positions,
                        Json& attributes);
    void add_targets(const MeshUse& use, const Mesh& built, uint32_t group_index,
                     const std::vector<uint32_t>& corners, Json& primitive);

    // export_material.cpp, export_rsl.cpp
    uint32_t material(const MeshUse& use, const PrimitiveGroup& group);
    Json common_material(const MaterialDefinition& definition, const ShaderUse& shader,
                         const MaterialUse& use, const PrimitiveGroup& group);
    Json pbr_material(const ShaderUse& shader, const MaterialUse& use, const PrimitiveGroup& group,
                      bool& is_all);
    Json texture_info(const std::string& name, const ParamSource& source, const MaterialUse& use,
                      const PrimitiveGroup& group);
    uint32_t texcoord_index(const std::string& name, const MaterialUse& use,
                            const PrimitiveGroup& group) const;
    void tell_losses(const MaterialDefinition& definition, const char* extras);
    Location material_place(const ShaderUse& use) const;
    uint32_t texture(const std::string& name);
    uint32_t image(const std::string& path);
    Json rsl(const std::vector<ShaderUse>& uses);
    Json rsl(const ShaderUse& use);
    Json rsl_of(const GltfLook& look, const PrimitiveGroup& group);

    // export_rsl.cpp: lights
    uint32_t light(const LightDefinition& definition, const dmat4& world);

    const SceneDescription& description_;
    const GltfExportOptions& options_;
    Diagnostics& diagnostics_;
    Json json_;
    std::vector<Take> takes_;
    Take* take_ = nullptr;
    MaterialDefinition plain_;  // what has no material
    MaterialUse unbound_;
    std::string buffer_;
    std::vector<Placed> placed_;
    std::vector<double> start_values_;  // at the first keys
    uint32_t root_ = kNone;             // the node of axes and unit
    std::vector<double> at_time_;       // values while a path is evaluated
    std::map<std::string, uint32_t> meshes_, materials_, textures_, images_;
    std::set<const MaterialDefinition*> told_materials_;
    std::set<std::string> told_;  // what is lost, each once
    std::map<uint32_t, Mesh> built_;
    std::map<uint32_t, uint32_t> cameras_, lights_;
    std::map<std::vector<double>, uint32_t> key_accessors_;
    std::vector<std::string> extensions_;
    dmat4 axes_{1.0};  // from the scene's axes and unit to glTF's
    double bounds_radius_ = 1;
    dvec3 bounds_centre_{0.0};
    double worst_error_ = 0;
    uint32_t sampled_paths_ = 0;
};

// A parameter's source, or null; whether the use is that library shader.
const ParamSource* find_source(const ShaderUse& use, std::string_view name);

// The parameters that a use of a shader gives, at rest.
struct UsedParams {
    const ShaderUse& use;
    const std::vector<double>& values;

    // One value is grey.
    dvec3 color(std::string_view name, double otherwise) const {
        const ParamSource* p = find_source(use, name);
        if (!p || !p->value.present() || p->value.count < 1) return dvec3(otherwise);
        const double* v = &values[p->value.offset];
        return p->value.count < 3 ? dvec3(v[0]) : dvec3(v[0], v[1], v[2]);
    }
    double number(std::string_view name, double otherwise) const {
        return color(name, otherwise).x;
    }
    std::string text(std::string_view name) const {
        const ParamSource* p = find_source(use, name);
        return p && !p->strings.empty() ? p->strings[0] : "";
    }
};
bool is_library_shader(const ShaderUse& use, std::string_view name);
// Whether a glTF sampler, "data" and "uv" say all of it.
bool fits_gltf_sampler(const TextureName& look);
// Json's text, whatever bytes its strings hold.
std::string text_of(const Json& json);

}  // namespace kinora
