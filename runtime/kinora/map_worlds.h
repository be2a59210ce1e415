// runtime/kinora/map_worlds.h: which pictures of a RIB file are maps of which later ones.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/kinora/scene_request.h"
#include "runtime/scene/description/file_picture.h"

namespace kinora {

// Displays of a world that later ones look up.
struct MapWorld {
    std::set<std::string> displays;  // their names
    int last_user = 0;
};
using MapWorlds = std::map<int, MapWorld>;  // by the worlds' order in the file, from 0

// The pictures of a file, and what they are made of.
class FilePictures {
  public:
    // Reads the file for its numbers alone.
    explicit FilePictures(const SceneRequest& request);

    const std::vector<FilePicture>& all() const { return pictures_; }
    // What the worlds `wanted` look up, and what those look up in turn. Reads the file's shaders
    // where one of them may: they say which maps they were given.
    MapWorlds maps_for(std::span<const int> wanted);

  private:
    SceneRequest request_;
    std::vector<FilePicture> pictures_;
    bool has_shaders_ = false;  // they were read
};

}  // namespace kinora
