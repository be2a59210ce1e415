// runtime/kinora/film_reader.cpp: worlds, and before them the maps that they look up.
#include "runtime/kinora/film_reader.h"

#include <utility>

#include "raytrace/kept_trees.h"
#include "runtime/scene/ri/import/import.h"
#include "runtime/scene/ri/meshes/merge_meshes.h"
#include "runtime/scene/ri/meshes/mesh_store.h"

namespace kinora {
namespace {

constexpr size_t kMostMapBytes = size_t(512) << 20;

MapWorlds maps_of_frames(const FilmFrames& film, FilePictures& pictures) {
    std::vector<int> worlds;
    for (const FilmFrame& frame : film.frames) worlds.push_back(frame.world);
    return pictures.maps_for(worlds);
}

}  // namespace

FilmReader::FilmReader(const SceneRequest& request)
    : request_(request),
      pictures_(request),
      film_(std::make_shared<const FilmFrames>(film_of(pictures_.all()))),
      map_worlds_(maps_of_frames(*film_, pictures_)),
      meshes_(std::make_shared<ri::MeshStore>()) {
    request_.trees = std::make_shared<raytrace::KeptTrees>();
}

// Those that a world looks up and that are not kept, and what they look up in turn.
void FilmReader::find_missing(int world, std::set<int>& missing) const {
    for (const MapPicture& picture : pictures_.all()[size_t(world)].map_pictures)
        if (map_worlds_.contains(picture.world) && !maps_.has(picture.world) &&
            missing.insert(picture.world).second)
            find_missing(picture.world, missing);
}

void FilmReader::render_map(int world, SceneDescription&& scene, Diagnostics& diagnostics,
                            const std::atomic<int>* stop) {
    if (stop && *stop != 0) return;
    merge_meshes(scene);
    maps_.render(request_, world, std::move(scene), map_worlds_.at(world).displays, diagnostics,
                 stop);
    ++maps_rendered_;
}

std::optional<ImportedScene> FilmReader::read(int world, Diagnostics& diagnostics,
                                              const std::atomic<int>* stop) {
    request_.world = world;
    std::set<int> missing;
    find_missing(world, missing);
    EarlierWorlds earlier;
    earlier.worlds.assign(missing.begin(), missing.end());
    earlier.take = [&](int index, SceneDescription&& scene) {
        render_map(index, std::move(scene), diagnostics, stop);
    };
    earlier.meshes = meshes_;
    auto scene = import_rib(request_.scene, import_options(request_), diagnostics, earlier);
    if (!scene) return std::nullopt;
    maps_.give(*scene);
    maps_.free_beyond(kMostMapBytes);
    return import_made(request_, std::move(*scene), diagnostics);
}

}  // namespace kinora
