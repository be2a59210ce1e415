// runtime/scene/ri/import/import.cpp: a file's worlds as scenes.
#include "runtime/scene/ri/import/import.h"

#include <algorithm>
#include <cstdio>

#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/bytestream/read_stream.h"
#include "runtime/scene/ri/import/interpretation.h"
#include "runtime/scene/ri/meshes/merge_meshes.h"

namespace kinora {
namespace {

// The first bytes.
std::optional<std::string> content_of(const std::string& path, size_t most) {
    OpenFile file = open_regular_file(path);
    if (!file) return std::nullopt;
    std::string content;
    char block[65536];
    while (content.size() < most)
        if (size_t got =
                std::fread(block, 1, std::min(sizeof block, most - content.size()), file.get()))
            content.append(block, got);
        else
            break;
    return content;
}

}  // namespace

bool is_rib(const SceneSource& source) {
    if (has_extension(source.path, {".rib"}) || source.path.ends_with(".rib.gz")) return true;
    constexpr size_t kLooked = 4096;
    if (source.bytes) return ri::looks_like_rib(source.bytes->substr(0, kLooked));
    std::optional<std::string> start = content_of(source.path, kLooked);
    return start && ri::looks_like_rib(*start);
}

bool read_rib(const SceneSource& source, const ImportOptions& options, Diagnostics& diagnostics,
              const std::function<bool(SceneDescription&& world)>& take, ri::WorldChoice drawn) {
    std::optional<std::string> content =
        source.bytes ? std::string(*source.bytes) : read_regular_file(source.path);
    if (!content) {
        diagnostics.report(Code::RIB_UNREADABLE, Location{}, source.path);
        return false;
    }
    ri::Interpretation reading(source.path, options, std::move(drawn), diagnostics, take);
    bool sound = reading.read(source.path, std::move(*content));
    reading.finish();
    return sound;
}

std::vector<FilePicture> pictures_of(const SceneSource& source) {
    std::vector<FilePicture> pictures;
    Diagnostics unheard;  // they come when the world itself is read
    auto count = [&](SceneDescription&& world) {
        pictures.push_back(std::move(*world.file_picture));
        return true;
    };
    read_rib(source, {}, unheard, count, {.counts_alone = true, .worlds = {}});
    return pictures;
}

std::vector<int> worlds_of(const SceneSource& source) {
    std::vector<int> numbers;
    for (const FilePicture& picture : pictures_of(source)) numbers.push_back(picture.number);
    return numbers;
}

std::optional<SceneDescription> import_rib(const SceneSource& source, const ImportOptions& options,
                                           Diagnostics& diagnostics, const EarlierWorlds& earlier) {
    const int wanted =
        options.world < 0 ? std::max(int(worlds_of(source).size()) - 1, 0) : options.world;
    std::optional<SceneDescription> found;
    int seen = 0;
    ri::WorldChoice drawn{.worlds = earlier.worlds, .meshes = earlier.meshes};
    drawn.worlds.push_back(wanted);
    auto take = [&](SceneDescription&& world) {
        if (seen == wanted)
            found = std::move(world);
        else if (drawn.draws(seen))
            earlier.take(seen, std::move(world));
        return ++seen <= wanted;
    };
    const bool sound = read_rib(source, options, diagnostics, take, drawn);
    if (sound && seen <= wanted) {
        if (seen)
            diagnostics.report(Code::RIB_WORLD_UNKNOWN, Location{}, wanted + 1, seen);
        else
            diagnostics.report(Code::RIB_NO_WORLD, Location{}, source.path);
    }
    if (found) merge_meshes(*found);
    return found;
}

}  // namespace kinora
