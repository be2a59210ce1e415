// runtime/gltf/import/import_p.h: the parts of the glTF importer; for import_gltf*.cpp only.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/gltf/import/import.h"
#include "runtime/gltf/file/file.h"

namespace kinora {

class GltfImport {
  public:
    GltfImport(GltfFile& file, const ImportOptions& options, Diagnostics& diagnostics,
               SceneDescription& out)
        : file_(file),
          model_(file.model),
          options_(options),
          diagnostics_(diagnostics),
          out_(out),
          allowed_bytes_((size_t(64) << 20) + 20 * file.bytes) {}

    bool run();

  private:
    // Numbers of an accessor, `width` an element.
    struct Numbers {
        uint32_t width = 0;
        std::vector<float> values;
        size_t count() const { return width ? values.size() / width : 0; }
    };
    // Where a node's translation, rotation and scale lie in values; kNone: there is none.
    struct NodeSlots {
        uint32_t translation = kNone, rotation = kNone, scale = kNone;
    };
    // Where the vertices of a primitive begin among its mesh's positions.
    struct PlacedPrimitive {
        bool usable = false;
        uint32_t first = 0, count = 0;
        uint32_t group = kNone;
    };
    struct MeshPlan {
        std::vector<PlacedPrimitive> primitives;
        uint32_t targets = 0;
    };

    // import.cpp: nodes, cameras, findings
    template <class... Args>
    void report(const FindingInfo& info, const std::string& pointer, const Args&... args) {
        if (++findings_ > kMaxGltfFindings) return;
        diagnostics_.report(info, gltf_location(file_, pointer), args...).id_path = pointer;
    }
    bool charge(size_t bytes, const std::string& pointer);
    bool exists(int index, size_t count, const char* what, const std::string& pointer);
    uint32_t append(std::span<const double> numbers, size_t room);
    std::vector<int> root_nodes();
    void claim_nodes(const std::vector<int>& roots);
    void import_nodes();
    void import_transforms(uint32_t node);
    void import_cameras();
    std::string unique_id(const std::string& name, const char* kind, size_t index);

    // import_accessor.cpp
    struct View {
        const uint8_t* data = nullptr;
        size_t size = 0, stride = 0;
    };
    View view_bytes(int view, const std::string& pointer, int accessor);
    bool read_accessor(int accessor, const std::string& pointer, Numbers& out);
    bool read_sparse(int accessor, const std::string& pointer, Numbers& out);
    bool read_indices(int accessor, const std::string& pointer, std::vector<uint32_t>& out);
    bool read_vertices(int accessor, std::span<const uint32_t> widths, size_t count,
                       const std::string& pointer, Numbers& out);

    // import_mesh.cpp
    struct Numbered {
        std::string name;
        uint32_t set = kNone;
    };
    // "TEXCOORD_2" as name and set; nothing for other names.
    static Numbered numbered(const std::string& semantic);
    // The application's own, "_HEAT": colours and coordinates that glTF's own would give a meaning
    // have sets, "_COLOR_0"; all else is a name.
    static Numbered own_attribute(const std::string& name);
    void import_meshes();
    void import_primitive(uint32_t mesh, uint32_t primitive);
    bool place_vertices(uint32_t mesh, uint32_t primitive, const std::string& pointer);
    std::vector<uint32_t> triangles_of(const tinygltf::Primitive& primitive, uint32_t vertices,
                                       const std::string& pointer);
    std::vector<float> add_attributes(const tinygltf::Primitive& primitive,
                                      const PlacedPrimitive& placed, const std::string& pointer,
                                      PrimitiveGroup& group);
    // import_tangent.cpp
    void add_tangents(const std::vector<dvec3>& positions, uint32_t first_vertex,
                      std::span<const float> tangents, PrimitiveGroup& group);
    MeshUse mesh_use(uint32_t node);

    // import_skin.cpp, import_morph.cpp
    uint32_t skin_of(uint32_t mesh, uint32_t skin);
    void add_influences(uint32_t mesh, const std::string& pointer, SkinDefinition& skin);
    uint32_t morph_of(uint32_t mesh, uint32_t node);
    void import_targets(uint32_t mesh);

    // import_material.cpp, import_texture.cpp, import_rsl.cpp, import_light.cpp
    struct Map {  // any of tinygltf's texture infos
        int index, set;
        const tinygltf::ExtensionMap& extensions;
    };
    void import_materials();
    void import_material(uint32_t index);
    void set_number(ShaderUse& use, const char* name, std::span<const double> numbers);
    void set_string(ShaderUse& use, const std::string& name, std::string text);
    void set_map(ShaderUse& use, const std::string& name, const Map& map, bool data,
                 const std::string& pointer);
    std::string texture_string(int texture, bool data, const std::string& pointer);
    std::string image_path(int image, const std::string& pointer);
    void import_rsl(uint32_t index);
    std::vector<std::shared_ptr<const rsl::Shader>> rsl_shaders(const tinygltf::Value& stage,
                                                                const std::string& pointer);
    ShaderUse rsl_use(const tinygltf::Value& stage, const tinygltf::Value* params,
                      rsl::ShaderKind kind, const std::string& pointer);
    std::vector<ShaderUse> rsl_stage(const tinygltf::Value& object, const char* stage,
                                     rsl::ShaderKind kind, const std::string& pointer);
    void unknown_param(const rsl::Shader& shader, const std::string& name,
                       const std::string& pointer);
    void set_rsl_param(ShaderUse& use, const std::string& name, const tinygltf::Value& value,
                       const std::string& pointer);
    void import_lights();
    double nits_of_one();
    // import_extras.cpp: what kinora-convert writes that glTF cannot say
    PictureShaders picture_shaders(const tinygltf::Value& extras, const std::string& pointer);
    bool import_rsl_light(const tinygltf::Light& light, const std::string& pointer,
                          LightDefinition& to);
    void import_scene_extras();
    void find_axes(const std::vector<int>& roots);
    void import_attributes(const tinygltf::Value& extras, NodeDefinition& to);

    // import_animation.cpp
    struct Target {  // what a channel writes
        uint32_t slot = kNone, count = 0, owner = 0;
    };
    void find_animated();
    Target target_of(const tinygltf::AnimationChannel& channel) const;
    std::optional<anim::Sampler> sampler_of(uint32_t animation, uint32_t channel, uint32_t stride);
    anim::Animation animation_of(uint32_t index);
    void import_animations();

    GltfFile& file_;
    tinygltf::Model& model_;
    const ImportOptions& options_;
    Diagnostics& diagnostics_;
    SceneDescription& out_;
    size_t allowed_bytes_, charged_bytes_ = 0;
    bool limit_told_ = false;
    size_t findings_ = 0;

    std::map<std::string, uint32_t> ids_;
    int axes_node_ = -1;                           // stands for the axes and the unit of the world
    double axes_meter_ = 1;                        // its metres per unit
    std::vector<bool> shown_;                      // per node: the scene reaches it
    std::vector<std::vector<uint32_t>> children_;  // per node, each with one parent
    std::vector<NodeSlots> slots_;
    enum : uint8_t {
        kMovesTranslation = 1,
        kMovesRotation = 2,
        kMovesScale = 4,
        kMovesWeights = 8
    };
    std::vector<uint8_t> moves_;  // per node: what channels write
    std::vector<MeshPlan> plans_;
    std::vector<std::vector<uint32_t>> target_meshes_;  // per mesh: definitions of its targets
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> skins_;   // mesh, skin
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> morphs_;  // mesh, node or kNone
    std::vector<uint32_t> node_morphs_;                         // per node
    std::map<int, std::string> images_;
    std::map<uint32_t, std::vector<VertexBinding>> inputs_;  // of materials with kinora_rsl
};

}  // namespace kinora
