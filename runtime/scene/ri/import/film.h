// runtime/scene/ri/import/film.h: the pictures of a RIB file as the frames of a film.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "runtime/scene/description/file_picture.h"
#include "runtime/scene/description/scene_source.h"

namespace kinora {

struct FilmFrame {
    int number = 0;       // of FrameBegin, or counted
    int world = 0;        // the world block that is its picture, from 0
    bool colors = false;  // some display of it shows colors
};

struct FilmFrames {
    std::vector<FilmFrame> frames;  // by number, each number once

    // The frame that is seen at a time in frames: the last that has begun by then, else the first.
    size_t at(double time) const;
    // The first that shows colors; else the last.
    size_t beginning() const;
};

// Worlds of one number are passes of a frame: its picture is the last that shows colors, else the
// last. No frames: the file has no pictures or cannot be read.
FilmFrames film_of(std::span<const FilePicture> pictures);
FilmFrames film_of(const SceneSource& source);

}  // namespace kinora
