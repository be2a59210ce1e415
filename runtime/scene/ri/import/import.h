// runtime/scene/ri/import/import.h: RIB files as scenes.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_source.h"
#include "runtime/scene/ri/state/world_choice.h"

namespace kinora {

// Whether a file is RIB, zipped or not: by its first bytes, or a name that ends in .rib or .rib.gz.
bool is_rib(const SceneSource& source);

// Reads the file, and gives each world block to `take`, in order. False from it ends the reading.
// False: the file cannot be read. Archives and shaders are looked for in the file's folder and
// along its search paths.
bool read_rib(const SceneSource& source, const ImportOptions& options, Diagnostics& diagnostics,
              const std::function<bool(SceneDescription&& world)>& take,
              ri::WorldChoice drawn = {});

// The picture of each world block, in order. Nothing is drawn, and nothing is found.
std::vector<FilePicture> pictures_of(const SceneSource& source);
// Their frame numbers.
std::vector<int> worlds_of(const SceneSource& source);

// Worlds that are drawn before the one that is wanted, and who gets them.
struct EarlierWorlds {
    std::vector<int> worlds;
    std::function<void(int world, SceneDescription&& scene)> take;
    std::shared_ptr<ri::MeshStore> meshes = {};  // WorldChoice::meshes
};
// The world block ImportOptions::world. Nothing: there is none, or the file
// cannot be read; findings say why.
std::optional<SceneDescription> import_rib(const SceneSource& source, const ImportOptions& options,
                                           Diagnostics& diagnostics,
                                           const EarlierWorlds& earlier = {});

}  // namespace kinora
