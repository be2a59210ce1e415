// runtime/scene/build/instances/output_planes.h: the planes that surfaces' outputs fill.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/build/instances/light_groups.h"
#include "runtime/scene/description/file_picture.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

// Writes Scene::outputs.
class OutputPlanes {
  public:
    // Planes that are wanted and of `groups`, then those of displays and those that the imagers
    // have parameters of. The scene has the instances of its surfaces.
    OutputPlanes(SceneShaders& scene, std::span<const std::string> wanted,
                 std::span<const LightGroup> lights, std::span<const LightGroup> groups,
                 std::span<const FileDisplay> displays, std::span<const ShaderUse> imagers,
                 Diagnostics& diagnostics);

    // The outputs of kernels behind the planes: parameters, globals, or z.
    const std::vector<std::string>& outputs() const { return outputs_; }

  private:
    enum class Reader : uint8_t { File, Display, Imager };

    void add_wanted(const std::string& text, Diagnostics& diagnostics);
    void add_all(const WantedAov& wanted, Diagnostics& diagnostics);
    void add_display(const FileDisplay& display, Diagnostics& diagnostics);
    bool add_built_in(const WantedAov& wanted, Diagnostics& diagnostics);
    bool add_lights(const WantedAov& wanted);
    void add_group(const LightGroup& group, const WantedAov& wanted);
    bool add_output(const WantedAov& wanted, Reader reader);
    bool is_there(const std::string& layer) const;
    void want_output(const std::string& output);

    SceneShaders& scene_;
    std::span<const LightGroup> lights_, groups_;
    std::vector<std::string> outputs_;
};

// Where a compiled instance of a surface has the planes among its outputs.
void bind_planes(std::span<const OutputPlane> planes, ShaderInstance& instance);

}  // namespace kinora
