// runtime/scene/dae/export_p.h: the parts of the COLLADA exporter; for export_collada*.cpp only.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/scene/dae/export.h"
#include "runtime/scene/dae/export_animation_p.h"
#include "runtime/scene/description/texture_name.h"

namespace kinora {

// glTF has a vertex for each combination of attributes; COLLADA an index for each. Vertices that
// are at one place in every pose are one. Empty: all stay.
struct MergedVertices {
    std::vector<uint32_t> vertex;  // of each position
    std::vector<uint32_t> first;   // of each vertex, its first position

    uint32_t of(uint32_t position) const { return vertex.empty() ? position : vertex[position]; }
    // Of `count` positions those that stay.
    std::vector<uint32_t> kept(size_t count) const;
};

// What COLLADA's model shows of a surface by the values of a time.
struct SeenSurface {
    ShaderUse use;             // of collada_*.sl, or of what has no model of COLLADA's
    std::vector<double> more;  // numbers behind the description's values
    std::span<const double> numbers(ValueSlot slot, std::span<const double> values) const;
};

class ColladaExporter {
  public:
    ColladaExporter(const SceneDescription& description, const std::string& path,
                    Diagnostics& diagnostics)
        : description_(description),
          path_(path),
          diagnostics_(diagnostics),
          animation_(description, names_) {}
    ColladaExport run();

  private:
    // export.cpp: the document, nodes
    std::string id(const std::string& wanted, const char* kind);
    void lost(const std::string& what, const std::string& why, Location where = {});
    const std::string& told(const std::string& text, const std::string& what);
    std::span<const double> values(ValueSlot slot) const;
    void name_all();
    std::string asset() const;
    std::string transform(const Transform& t, const std::string& node, size_t number);
    std::string node(uint32_t index);
    std::string child(const ChildUse& use);
    std::string mesh_instance(const MeshUse& use);
    std::string light_list(const std::vector<uint32_t>& lights) const;
    std::string vertex_inputs(const MaterialUse& use, const PrimitiveGroup& group) const;
    bool is_below_hidden(uint32_t node) const;  // or is hidden itself
    std::string library(const char* name, const std::string& content) const;

    // export_mesh.cpp: geometries and controllers
    const MeshDefinition& with_triangles(uint32_t mesh) const;
    void merge_vertices();
    std::string geometry(uint32_t index);
    std::vector<float> numbers_of(const VertexAttribute& values, bool by_rsl) const;
    std::string skin(const MeshUse& use, const std::string& controller);
    std::string morph(uint32_t index, uint32_t mesh);
    std::string controller(const MeshUse& use);

    // export_material.cpp: images, effects, lights, cameras
    std::string image(const std::string& texture_name);
    ValueSlot written(ValueSlot color) const;
    std::string texture(const ParamSource& map, const std::string& sid, const std::string& extra,
                        std::string& params);
    std::string bump(const SeenSurface& seen, const std::string& effect, std::string& params);
    void in_modes_of_1_4(SeenSurface& seen, std::span<const double> values,
                         const std::string& effect);
    SeenSurface seen_surface(const MaterialDefinition& material, std::span<const double> values,
                             const std::string& effect);
    std::string inner_file(const std::string& name) const;
    std::string effect(uint32_t material);
    bool is_rsl(const MaterialDefinition& definition) const;
    std::string common(const MaterialDefinition& definition, const SeenSurface* seen,
                       const std::string& effect);
    // export_rsl.cpp
    struct RslProfile {
        struct Param {
            std::string type, value;
            uint32_t offset;
        };
        std::map<std::string, Param> params;  // by sid
        std::set<std::string> written;        // codes: import_gltf reads each stage's by itself
        std::string newparams, codes, passes;
        std::string shaders;                         // of the last pass
        std::map<std::string, std::string> handles;  // its co-shaders, as they are written
    };
    std::string rsl(const std::vector<const ShaderUse*>& uses, const std::string& effect);
    void rsl_shader(const ShaderUse& use, const std::string& effect, RslProfile& profile);
    void rsl_code(const rsl::Shader& shader, size_t part, const std::string& effect,
                  RslProfile& profile);
    std::string rsl_binds(const ShaderUse& use, const std::string& handle,
                          const std::string& effect, RslProfile& profile);
    std::string rsl_value(const ParamSource& source, const std::string& effect);
    std::string rsl_extra(const std::vector<ShaderUse>& uses, const std::string& owner);
    std::string light(uint32_t index);
    std::string camera(uint32_t index);

    const SceneDescription& description_;
    std::string path_;
    Diagnostics& diagnostics_;
    ColladaExport result_;
    UniqueNames names_;
    AnimationWriter animation_;
    std::vector<std::string> node_ids_, mesh_ids_, material_ids_, light_ids_, camera_ids_;
    std::vector<uint32_t> uses_, parents_;  // of node definitions
    std::vector<MergedVertices> merged_;    // of meshes
    std::vector<bool> joint_;
    std::set<std::pair<uint32_t, std::string>> rsl_groups_;  // mesh and symbol: RSL is worn there
    std::string images_, effects_, materials_, controllers_;
    std::map<std::string, std::string> image_ids_, controller_ids_;
    std::map<uint32_t, std::string> morph_ids_;
    std::string skinned_;  // nodes of skinned meshes, at the top
};

// "<name a="b">text</name>" with `attributes` as they stand (" a=\"b\"").
std::string xml(const std::string& name, const std::string& attributes, const std::string& content);
std::string attribute(const std::string& name, const std::string& value);
std::string xml_name(const std::string& wanted);  // xs:NCName: other characters become '_'
std::string input(const char* semantic, const std::string& source, int offset = -1,
                  uint32_t set = kNone);
// Doubles that are no floats have 15 digits: the last bits of what was computed say nothing.
std::string number_text(std::span<const double> numbers);
std::string number_text(std::span<const float> numbers);
// The display colour with the fewest digits that is read as this colour, but for a relative error.
dvec3 short_display_color(const dvec3& linear, double error);
// A <source> of floats with an accessor of these params ("XYZ", or "" for one without names).
std::string float_source(const std::string& id, const std::string& numbers, size_t count,
                         const std::vector<std::string>& params, const char* type = "float");

}  // namespace kinora
