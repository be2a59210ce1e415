// runtime/programs/render/kept_maps.h: pictures of a RIB file that its later worlds look up.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "raytrace/film.h"
#include "runtime/programs/render/options.h"
#include "runtime/scene/description/memory_file.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

class KeptMaps {
  public:
    // Whether what is written for these options is what the file itself would look up.
    static bool are_as_written(const RenderOptions& options);

    // Renders a world as its file says, whatever the options say of the view, and keeps displays of
    // these names. Findings of it go to `found`.
    void render(const RenderOptions& options, SceneDescription world, const SourceFiles& texts,
                const std::set<std::string>& names, Diagnostics& found);
    // Keeps displays of a picture that was rendered. `scene`: the path of its file.
    void keep(const std::string& scene, const FilePicture& picture,
              const std::set<std::string>& names, const raytrace::Film& film, Diagnostics& found);
    // Gives a world those that were kept, as long as it lives.
    void give(SceneDescription& world) const;

  private:
    std::map<std::string, std::shared_ptr<const MemoryFile>> files_;
};

}  // namespace kinora
