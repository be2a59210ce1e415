// runtime/kinora/film_reader.h: the pictures of a RIB file as scenes, in any order. What stands
// from one to the next is made once.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/kinora/kept_maps.h"
#include "runtime/kinora/map_worlds.h"
#include "runtime/kinora/open_scene.h"
#include "runtime/scene/ri/import/film.h"

namespace kinora::raytrace {
class KeptTrees;
}
namespace kinora::ri {
class MeshStore;
}

namespace kinora {

// Of a file as it is; another request, or a changed file, takes another reader.
class FilmReader {
  public:
    explicit FilmReader(const SceneRequest& request);

    // None where the file has no pictures or cannot be read.
    const std::shared_ptr<const FilmFrames>& film() const { return film_; }
    // Reads the file up to one of its worlds, with what the request changes of it. Earlier worlds
    // that it looks up are rendered before, where they are not kept. A `stop` that is not 0 ends
    // those. Nothing: findings say why.
    std::optional<ImportedScene> read(int world, Diagnostics& diagnostics,
                                      const std::atomic<int>* stop = nullptr);
    // Of the last world read.
    const SceneRequest& request() const { return request_; }
    int maps_rendered() const { return maps_rendered_; }

  private:
    void find_missing(int world, std::set<int>& missing) const;
    void render_map(int world, SceneDescription&& scene, Diagnostics& diagnostics,
                    const std::atomic<int>* stop);

    SceneRequest request_;
    FilePictures pictures_;
    std::shared_ptr<const FilmFrames> film_;
    MapWorlds map_worlds_;
    KeptMaps maps_;
    std::shared_ptr<ri::MeshStore> meshes_;
    int maps_rendered_ = 0;
};

}  // namespace kinora
