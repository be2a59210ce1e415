// runtime/kinora/kept_maps.h: pictures of a RIB file that its later worlds look up, in memory.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "raytrace/film.h"
#include "runtime/base/diagnostic.h"
#include "runtime/kinora/scene_request.h"
#include "runtime/scene/description/memory_file.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Worlds are counted from 0.
class KeptMaps {
  public:
    // Whether pictures of these options are what the file itself would look up.
    static bool are_as_the_file_says(const SceneRequest& request);

    // Whether displays of a world were kept. None of them may be there: what it did not have is not
    // to be looked for again.
    bool has(int world) const { return worlds_.contains(world); }
    // Renders a world as its file says, whatever the request says of the view, and keeps displays
    // of these names. Findings of it go to `found`. A `stop` that is not 0 ends it, and nothing is
    // kept then.
    void render(const SceneRequest& request, int world, SceneDescription scene,
                const std::set<std::string>& names, Diagnostics& found,
                const std::atomic<int>* stop = nullptr);
    // Keeps displays of a picture that was rendered. `scene`: the path of its file.
    void keep(const std::string& scene, int world, const FilePicture& picture,
              const std::set<std::string>& names, const raytrace::Film& film, Diagnostics& found);
    // Gives a world, as long as it lives, those that its shaders look up.
    void give(SceneDescription& scene);

    void free(int world) { worlds_.erase(world); }
    // Frees those that were given longest ago, until so many bytes are left. What was given last
    // stays.
    void free_beyond(size_t bytes);

  private:
    struct World {
        std::map<std::string, std::shared_ptr<const MemoryFile>> files;  // by their displays' names
        uint64_t given = 0;  // when it was last, by a count
    };
    std::map<int, World> worlds_;
    uint64_t gifts_ = 0;
};

}  // namespace kinora
