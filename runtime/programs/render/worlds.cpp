// runtime/programs/render/worlds.cpp: --frames and frame tokens for files with several pictures.
#include "runtime/programs/render/worlds.h"

#include <algorithm>
#include <cstdio>

#include "raytrace/kept_trees.h"
#include "runtime/base/stats.h"
#include "runtime/kinora/frame_list.h"
#include "runtime/kinora/kept_maps.h"
#include "runtime/kinora/open_scene.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/display_files.h"
#include "runtime/scene/ri/import/film.h"
#include "runtime/scene/ri/import/import.h"
#include "runtime/scene/ri/meshes/merge_meshes.h"

namespace kinora {

namespace {

std::set<std::string> shared_stems(const std::vector<FilePicture>& pictures) {
    std::set<std::string> met, shared;
    for (const FilePicture& picture : pictures) {
        std::set<std::string> own;
        for (const FileDisplay& display : picture.displays) own.insert(display_stem(display));
        for (const std::string& stem : own)
            if (!met.insert(stem).second) shared.insert(stem);
    }
    return shared;
}

// The one that a session shows.
std::vector<int> world_of_session(const RenderOptions& options,
                                  const std::vector<FilePicture>& pictures) {
    const FilmFrames film = film_of(pictures);
    if (film.frames.empty()) return {};
    return {film.frames[film.at(options.session->frame)].world};
}

std::vector<int> wanted_of(const RenderOptions& options, const std::vector<FilePicture>& pictures) {
    const bool all = !options.output.empty() && OutputName(options.output).has_token();
    std::vector<int> worlds;
    for (int w = 0; w < int(pictures.size()); ++w) {
        const bool last = w + 1 == int(pictures.size());
        const int64_t number = pictures[size_t(w)].number;
        if (options.frames ? std::ranges::count(*options.frames, number) > 0 : all || last)
            worlds.push_back(w);
    }
    return worlds;
}

// Whether what is written for these options is what the file itself would look up.
bool writes_what_the_file_says(const RenderOptions& options) {
    return KeptMaps::are_as_the_file_says(options) && !options.session &&
           !options.frame_target.any() && !options.skip_existing;
}

// Pictures that would have one file.
void report_passes(const RenderOptions& options, const ChosenWorlds& worlds,
                   Diagnostics& diagnostics) {
    if (options.output.empty()) return;
    const OutputName name(options.output);
    for (const auto& [number, passes] : worlds.passes)
        if (passes > 1)
            diagnostics.report(Code::FRAME_PASSES, Location{}, number, passes, name.file(number));
}

bool makes_pictures(const RenderOptions& options) {
    return !options.output.empty() || !options.contact_sheet.empty() || options.discard ||
           !options.tradeoff.empty();
}

}  // namespace

std::optional<ChosenWorlds> worlds_to_render(const RenderOptions& options) {
    FilePictures file(options);
    const std::vector<FilePicture> pictures = file.all();
    ChosenWorlds chosen{{}, {}, {}, shared_stems(pictures)};
    chosen.wanted = options.session && !options.frames ? world_of_session(options, pictures)
                                                       : wanted_of(options, pictures);
    for (int w : chosen.wanted) ++chosen.passes[pictures[size_t(w)].number];
    if (makes_pictures(options)) chosen.maps = file.maps_for(chosen.wanted);
    if (!chosen.wanted.empty() || pictures.empty()) return chosen;
    std::fprintf(stderr, "kinora-render: error: '%s' has %zu pictures, none of them of --frames\n",
                 options.scene.c_str(), pictures.size());
    return std::nullopt;
}

bool read_worlds(const RenderOptions& options, const ChosenWorlds& worlds, Diagnostics& found,
                 const std::function<bool(ReadWorld world)>& render) {
    judge_by(options, found);
    report_passes(options, worlds, found);
    const auto trees = std::make_shared<raytrace::KeptTrees>();
    std::vector<int> read = worlds.wanted;
    for (const auto& [index, names] : worlds.maps) read.push_back(index);
    KeptMaps maps;
    KnownHashes hashes;
    int next = 0;
    Stopwatch watch;
    auto take = [&](SceneDescription&& scene) {
        const int index = next++;
        const bool wanted = std::ranges::count(worlds.wanted, index) > 0;
        const auto map = worlds.maps.find(index);
        if (!wanted && map == worlds.maps.end()) return true;
        merge_meshes(scene);
        ReadWorld world{options, std::move(scene),    watch.ms(), found,
                        hashes,  worlds.shared_stems, {}};
        world.options.world = index;
        world.options.trees = trees;
        world.options.frames = {{int64_t(world.scene.file_picture->number)}};
        const bool shared = wanted && writes_what_the_file_says(world.options);
        if (map != worlds.maps.end() && shared)
            world.keep = [&, index,
                          picture = *world.scene.file_picture](const raytrace::Film& film) {
                maps.keep(options.scene, index, picture, map->second.displays, film, found);
            };
        else if (map != worlds.maps.end())
            maps.render(world.options, index, world.scene, map->second.displays, found);
        maps.give(world.scene);
        const bool go_on = !wanted || render(std::move(world));
        for (const auto& [maker, needed] : worlds.maps)
            if (needed.last_user <= index) maps.free(maker);
        watch.restart();
        return go_on && index != worlds.wanted.back();
    };
    return read_rib(options.scene, import_options(options), found, take, {.worlds = read});
}

}  // namespace kinora
