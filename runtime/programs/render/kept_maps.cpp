// runtime/programs/render/kept_maps.cpp: worlds rendered for their displays, which stay in memory.
#include "runtime/programs/render/kept_maps.h"

#include <stdlib.h>

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

SceneRequest as_the_file_says(const RenderOptions& options) {
    const SceneRequest own;
    SceneRequest request = options;
    request.width = own.width, request.height = own.height, request.scale = own.scale;
    request.camera = own.camera, request.yfov = own.yfov, request.turntable = own.turntable;
    request.look_from = own.look_from, request.look_at = own.look_at;
    request.exposure = own.exposure, request.auto_exposure = own.auto_exposure;
    request.imager = own.imager, request.atmosphere = own.atmosphere;
    request.displays = true;
    return request;
}

}  // namespace

bool KeptMaps::are_as_written(const RenderOptions& options) {
    const SceneRequest own = as_the_file_says(options);
    return options.width == own.width && options.height == own.height &&
           options.scale == own.scale && options.camera == own.camera && options.yfov == own.yfov &&
           options.turntable == own.turntable && !options.look_from && options.look_at.empty() &&
           options.exposure == own.exposure && !options.auto_exposure && options.imager.empty() &&
           options.atmosphere.empty() && !options.session && !options.frame_target.any() &&
           !options.skip_existing;
}

void KeptMaps::render(const RenderOptions& options, SceneDescription world,
                      const SourceFiles& texts, const std::set<std::string>& names,
                      Diagnostics& found) {
    const SceneRequest request = as_the_file_says(options);
    const FilePicture picture = world.file_picture.value();
    OpenScene scene(request, OpenScene::Keep::Nothing);
    give(world);
    SceneError error = scene.take(std::move(world), texts.fork());
    if (error == SceneError::None) error = scene.build();
    raytrace::Film film;
    bool whole = false;
    if (error == SceneError::None) {
        scene.ready_frames();
        scene.settings().integrator.seed = frame_seed(request, picture.number);
        whole = scene.render(scene.scene().options.start_time, film);
    }
    for (const Finding& finding : scene.diagnostics().findings())
        found.add(*finding.info, finding.where, finding.message);
    if (whole) keep(request.scene, picture, names, film, found);
}

void KeptMaps::keep(const std::string& scene, const FilePicture& picture,
                    const std::set<std::string>& names, const raytrace::Film& film,
                    Diagnostics& found) {
    auto is_there = [&](const std::string& output) {
        for (const raytrace::AovPlane& plane : film.aovs)
            if (plane.name.substr(0, plane.name.find('.')) == output) return true;
        return false;
    };
    for (const FileDisplay& display : picture.displays) {
        if (!names.contains(display.name) || !has_outputs(display, is_there)) continue;
        std::string error;
        const auto bytes = bytes_of(display, picture.exposure, film, error);
        const std::string name = kept_picture_name(scene, display.name);
        if (bytes)
            files_[name] = std::make_shared<const MemoryFile>(
                name, std::vector<uint8_t>(bytes->begin(), bytes->end()));
        else
            found.report(Code::RI_NOT_WRITTEN, display.where, display.name, error);
    }
}

void KeptMaps::give(SceneDescription& world) const {
    for (const auto& [name, file] : files_) world.memory_files.push_back(file);
}

}  // namespace kinora
