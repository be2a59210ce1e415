// runtime/scene/ri/state/world.h: a world block as a scene description.
//
// The description's world is camera space with z turned round, so that its camera stands at the
// origin and looks along -z; SceneDescription::world_space says where the file's world is.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/meshes/merged_meshes.h"
#include "runtime/scene/ri/meshes/mesh_store.h"
#include "runtime/scene/ri/state/graphics_state.h"
#include "runtime/scene/tessellate/tessellate.h"

namespace kinora::ri {

// What the camera of some options sees, and how large.
struct WorldCamera {
    FilePicture picture;
    double window[4];  // left right bottom top of those pixels, at z = 1 where it is in perspective
    double pixels;     // a unit at z = 1, or of the window; of the larger of both directions
};
WorldCamera camera_of(const Options& options);

// Where a primitive stands.
struct Placement {
    dmat4 to_world, to_camera;
};

class World {
  public:
    World(const Options& options, const std::string& path, const ImportOptions& import,
          const dmat4& camera_from_world, int number, bool in_film);

    // A primitive, as attributes and transformation are.
    void add(MeshDefinition mesh, const Attributes& attributes, const Placement& placement);
    // One whose mesh `make` makes, if it has any, where no primitive of this key came before.
    using MakeMesh = FunctionRef<std::optional<MeshDefinition>()>;
    void add(const MeshKey& key, const Attributes& attributes, const Placement& placement,
             MakeMesh make);

    PictureScale scale(const dmat4& to_camera) const;
    // Of the next surface: a part of what is left for all, so that any number of huge ones fits in
    // memory.
    TessellationLimits limits() const;
    const Options& options() const { return options_; }

    SceneDescription take(const std::map<std::string, dmat4, std::less<>>& spaces);

  private:
    struct KnownMesh {
        std::optional<MeshDefinition> small;  // not among the meshes, since those merge it
        uint32_t mesh = kNone;                // kNone: not yet among them
    };
    void draw(KnownMesh& known, const Attributes& attributes, const Placement& placement);
    bool merges(const MeshDefinition& mesh, const Attributes& attributes,
                const Placement& placement);
    bool names_object_space(const Binding& binding);
    void merge(const MeshDefinition& mesh, const Attributes& attributes,
               const Placement& placement);
    uint32_t push_mesh(MeshDefinition mesh, const Attributes& attributes);
    void use_mesh(uint32_t mesh, uint32_t material, const Attributes& attributes,
                  const dmat4& to_camera);
    uint32_t material(const Attributes& attributes, const dmat4& to_camera, bool any_color);
    ShaderUse shader_use(const ShaderBinding& binding, const dmat4* object_to_camera);
    std::vector<ShaderUse> shader_uses(const std::vector<Binding>& bindings,
                                       const dmat4& to_camera);
    ValueSlot values(std::span<const double> numbers);
    uint32_t light(const Light& light);
    uint32_t node(const dmat4& to_camera, std::string id = "");
    std::string numbered(const ShaderUse& use);
    std::string space_name(const dmat4& to_camera);
    uint32_t atmosphere(const std::vector<Binding>& bindings);
    std::vector<uint32_t> light_list(const Attributes& attributes);
    void add_camera();
    void settle_lights();

    Options options_;
    dmat4 camera_from_world_;
    WorldCamera camera_;
    double enlarged_;  // the picture that is made, from the file's own
    double curve_error_;
    SceneDescription out_;
    size_t triangles_ = 0;  // of all meshes
    std::map<std::vector<uint64_t>, uint32_t> materials_;
    std::map<const LightBinding*, uint32_t> lights_;
    std::map<std::vector<Binding>, uint32_t> atmospheres_;
    std::map<std::string, int, std::less<>> worn_;   // shaders, how often so far
    std::vector<std::shared_ptr<const void>> held_;  // whose addresses are in keys
    std::map<std::array<double, 16>, uint32_t> nodes_;
    std::map<std::array<double, 16>, std::string> spaces_;
    std::map<MeshKey, KnownMesh> known_;
    MergedMeshes merged_;
    std::map<const ShaderBinding*, bool> in_object_space_;  // answers of names_object_space()
    bool in_film_;                                          // pictures like this one follow
};

}  // namespace kinora::ri
