// runtime/scene/ri/state/world.h: a world block as a scene description.
//
// The description's world is camera space with z turned round, so that its camera stands at the
// origin and looks along -z; SceneDescription::world_space says where the file's world is.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/ri/calls/call.h"
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

class World {
  public:
    World(const Options& options, const std::string& path, const ImportOptions& import,
          const dmat4& camera_from_world, int number);

    // A primitive, as attributes and transformation are.
    void add(MeshDefinition mesh, const Attributes& attributes, const dmat4& to_camera);
    // Keeps the mesh of the last add() for a call that comes again (`key`), and draws it again.
    // False: there is none, for these attributes, that is as fine as it must be there.
    void keep_mesh(const void* key, const Attributes& attributes, const dmat4& to_camera);
    bool add_again(const void* key, const Attributes& attributes, const dmat4& to_camera);

    PictureScale scale(const dmat4& to_camera) const;
    const Options& options() const { return options_; }

    SceneDescription take(const std::map<std::string, dmat4, std::less<>>& spaces);

  private:
    struct KeptMesh {
        uint32_t mesh;
        dvec3 center;  // of its box, and half the diagonal
        double radius;
        double pixels;  // of a unit, for which it was made
    };
    double pixels_of(const KeptMesh& kept, const dmat4& to_camera) const;
    void use_mesh(uint32_t mesh, const Attributes& attributes, const dmat4& to_camera);
    uint32_t material(const Attributes& attributes, const dmat4& to_camera);
    ShaderUse shader_use(const ShaderBinding& binding, const dmat4* object_to_camera);
    std::vector<ShaderUse> shader_uses(const std::vector<Binding>& bindings,
                                       const dmat4& to_camera);
    ValueSlot values(std::span<const double> numbers);
    uint32_t light(const Light& light);
    uint32_t node(const dmat4& to_camera, std::string id = "");
    std::string space_name(const dmat4& to_camera);
    uint32_t atmosphere(const std::vector<Binding>& bindings);
    std::vector<uint32_t> light_list(const Attributes& attributes);
    void add_camera();
    void settle_lights();

    Options options_;
    dmat4 camera_from_world_;
    WorldCamera camera_;
    SceneDescription out_;
    std::map<std::string, uint32_t> materials_;
    std::map<const LightBinding*, uint32_t> lights_;
    std::map<std::vector<Binding>, uint32_t> atmospheres_;
    std::vector<std::shared_ptr<const void>> held_;  // whose addresses are in keys
    std::map<std::array<double, 16>, uint32_t> nodes_;
    std::map<std::array<double, 16>, std::string> spaces_;
    std::map<std::pair<const void*, std::vector<double>>, KeptMesh> kept_;  // by shape_key()
};

}  // namespace kinora::ri
