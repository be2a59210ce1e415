// runtime/kinora/kept_maps.cpp: worlds rendered for their displays, which stay in memory.
#include "runtime/kinora/kept_maps.h"

#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/base/regular_file.h"
#include "runtime/kinora/kinora.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/kept_picture.h"
#include "runtime/scene/images/display_files.h"

namespace kinora {

namespace {

namespace fs = std::filesystem;

// A folder of this process alone, for as long as a picture takes to be written and read.
class BriefFolder {
  public:
    BriefFolder() : path_((fs::temp_directory_path() / "kinora-map-XXXXXX").string()) {
        if (!::mkdtemp(path_.data())) path_.clear();
    }
    ~BriefFolder() {
        std::error_code error;
        if (!path_.empty()) fs::remove_all(path_, error);
    }
    BriefFolder(const BriefFolder&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

// The bytes of a display's file; nothing, with the reason in `error`.
std::optional<std::string> bytes_of(const FileDisplay& display, const Exposure& exposed,
                                    const raytrace::Film& film, std::string& error) {
    const BriefFolder folder;
    if (folder.path().empty()) error = std::strerror(errno);
    if (!error.empty()) return std::nullopt;
    FileDisplay here = display;
    here.name = folder.path() + "/map";
    const std::string path = file_of(here);
    error = write_display({display, path}, exposed, film, ColorEncoding::Linear, {});
    return error.empty() ? read_regular_file(path) : std::nullopt;
}

SceneRequest as_the_file_says(SceneRequest request) {
    const SceneRequest own;
    request.width = own.width, request.height = own.height, request.scale = own.scale;
    request.camera = own.camera, request.yfov = own.yfov, request.turntable = own.turntable;
    request.look_from = own.look_from, request.look_at = own.look_at;
    request.exposure = own.exposure, request.auto_exposure = own.auto_exposure;
    request.imager = own.imager, request.atmosphere = own.atmosphere;
    request.displays = true;
    return request;
}

}  // namespace

bool KeptMaps::are_as_the_file_says(const SceneRequest& request) {
    const SceneRequest own = as_the_file_says(request);
    return request.width == own.width && request.height == own.height &&
           request.scale == own.scale && request.camera == own.camera && request.yfov == own.yfov &&
           request.turntable == own.turntable && !request.look_from && request.look_at.empty() &&
           request.exposure == own.exposure && !request.auto_exposure && request.imager.empty() &&
           request.atmosphere.empty();
}

void KeptMaps::render(const SceneRequest& request, int world, SceneDescription scene,
                      const std::set<std::string>& names, Diagnostics& found,
                      const std::atomic<int>* stop) {
    const SceneRequest own = as_the_file_says(request);
    const FilePicture picture = scene.file_picture.value();
    OpenScene open(own, OpenScene::Keep::Nothing);
    give(scene);
    SceneError error = open.take(std::move(scene), found.files.fork());
    if (error == SceneError::None) error = open.build();
    raytrace::Film film;
    bool whole = false;
    if (error == SceneError::None) {
        open.ready_frames(stop);
        open.settings().integrator.seed = frame_seed(own, picture.number);
        whole = open.render(open.scene().options.start_time, film);
    }
    for (const Finding& finding : open.diagnostics().findings())
        found.add(*finding.info, finding.where, finding.message);
    if (whole) keep(own.scene, world, picture, names, film, found);
}

void KeptMaps::keep(const std::string& scene, int world, const FilePicture& picture,
                    const std::set<std::string>& names, const raytrace::Film& film,
                    Diagnostics& found) {
    World& kept = worlds_[world];
    auto is_there = [&](const std::string& output) {
        for (const raytrace::AovPlane& plane : film.aovs)
            if (plane.name.substr(0, plane.name.find('.')) == output) return true;
        return false;
    };
    for (const FileDisplay& display : picture.displays) {
        if (!names.contains(display.name) || !has_outputs(display, is_there)) continue;
        std::string error;
        const auto bytes = bytes_of(display, picture.exposure, film, error);
        const std::string name = kept_picture_name(scene, {world, display.name});
        if (bytes)
            kept.files[display.name] = std::make_shared<const MemoryFile>(
                name, std::vector<uint8_t>(bytes->begin(), bytes->end()));
        else
            found.report(Code::RI_NOT_WRITTEN, display.where, display.name, error);
    }
}

void KeptMaps::give(SceneDescription& scene) {
    ++gifts_;
    for (const MapPicture& picture : scene.file_picture->map_pictures) {
        const auto maker = worlds_.find(picture.world);
        if (maker == worlds_.end()) continue;
        maker->second.given = gifts_;
        const auto file = maker->second.files.find(picture.display);
        if (file != maker->second.files.end()) scene.memory_files.push_back(file->second);
    }
}

void KeptMaps::free_beyond(size_t bytes) {
    std::vector<std::pair<uint64_t, int>> oldest;
    size_t all = 0;
    auto size_of = [](const World& world) {
        size_t size = 0;
        for (const auto& [name, file] : world.files) size += file->bytes().size();
        return size;
    };
    for (const auto& [world, kept] : worlds_) {
        all += size_of(kept);
        if (kept.given < gifts_) oldest.push_back({kept.given, world});
    }
    std::ranges::sort(oldest);
    for (const auto& [given, world] : oldest) {
        if (all <= bytes) return;
        all -= size_of(worlds_.at(world));
        worlds_.erase(world);
    }
}

}  // namespace kinora
