// runtime/kinora/map_worlds.cpp: displays and the maps that are made of them.
#include "runtime/kinora/map_worlds.h"

#include <algorithm>
#include <utility>

#include "runtime/base/diagnostic.h"
#include "runtime/kinora/open_scene.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {
namespace {

// From the last world to the first, so that maps of maps are there, too.
MapWorlds maps_of(const std::vector<FilePicture>& pictures, std::span<const int> wanted) {
    MapWorlds maps;
    for (int w = int(pictures.size()) - 1; w >= 0; --w) {
        if (!std::ranges::count(wanted, w) && !maps.contains(w)) continue;
        for (const MapPicture& picture : pictures[size_t(w)].map_pictures)
            maps.try_emplace(picture.world, MapWorld{{}, w})
                .first->second.displays.insert(picture.display);
    }
    return maps;
}

// With shaders, which say what maps they look up, and without anything else.
std::vector<FilePicture> pictures_with_shaders(const SceneRequest& request) {
    std::vector<FilePicture> pictures;
    Diagnostics unheard;  // they come when the worlds themselves are read
    auto take = [&](SceneDescription&& world) {
        pictures.push_back(std::move(*world.file_picture));
        return true;
    };
    read_rib(request.scene, import_options(request), unheard, take, {.worlds = {-1}});
    return pictures;
}

}  // namespace

FilePictures::FilePictures(const SceneRequest& request)
    : request_(request), pictures_(pictures_of(request.scene)) {}

MapWorlds FilePictures::maps_for(std::span<const int> wanted) {
    MapWorlds maps = maps_of(pictures_, wanted);
    if (maps.empty() || has_shaders_) return maps;
    pictures_ = pictures_with_shaders(request_);
    has_shaders_ = true;
    return maps_of(pictures_, wanted);
}

}  // namespace kinora
