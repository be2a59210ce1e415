// runtime/scene/ri/import/film.cpp: world blocks to frames.
#include "runtime/scene/ri/import/film.h"

#include <algorithm>
#include <map>

#include "runtime/scene/ri/import/import.h"

namespace kinora {
namespace {

// Modes are "rgb", "rgba", "rgbaz", the name of a variable, "z" and so on. Without a display there
// is the framebuffer.
bool shows_colors(const std::vector<FileDisplay>& displays) {
    return displays.empty() || std::ranges::any_of(displays, [](const FileDisplay& display) {
               return display.mode.starts_with("rgb") || display.mode == "Ci";
           });
}

}  // namespace

size_t FilmFrames::at(double time) const {
    const auto begins_later = [](double at, const FilmFrame& frame) { return at < frame.number; };
    const auto later = std::upper_bound(frames.begin(), frames.end(), time, begins_later);
    return later == frames.begin() ? 0 : size_t(later - frames.begin()) - 1;
}

size_t FilmFrames::beginning() const {
    const auto first = std::ranges::find(frames, true, &FilmFrame::colors);
    return first == frames.end() ? std::max<size_t>(frames.size(), 1) - 1
                                 : size_t(first - frames.begin());
}

FilmFrames film_of(std::span<const FilePicture> pictures) {
    std::map<int, FilmFrame> by_number;
    int world = 0;
    for (const FilePicture& picture : pictures) {
        const FilmFrame frame{picture.number, world++, shows_colors(picture.displays)};
        const auto [known, is_new] = by_number.try_emplace(frame.number, frame);
        if (!is_new && (frame.colors || !known->second.colors)) known->second = frame;
    }
    FilmFrames film;
    for (const auto& [number, frame] : by_number) film.frames.push_back(frame);
    return film;
}

FilmFrames film_of(const SceneSource& source) {
    return film_of(pictures_of(source));
}

}  // namespace kinora
