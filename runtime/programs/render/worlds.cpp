// runtime/programs/render/worlds.cpp: --frames and frame tokens for files with several pictures.
#include "runtime/programs/render/worlds.h"

#include <algorithm>
#include <cstdio>

#include "raytrace/kept_trees.h"
#include "runtime/base/stats.h"
#include "runtime/kinora/frame_list.h"
#include "runtime/kinora/open_scene.h"
#include "runtime/scene/ri/import/film.h"
#include "runtime/scene/ri/import/import.h"
#include "runtime/scene/ri/meshes/merge_meshes.h"

namespace kinora {

std::optional<std::vector<int>> worlds_to_render(const RenderOptions& options) {
    if (options.session && !options.frames) {
        const FilmFrames film = film_of(options.scene);
        if (film.frames.empty()) return std::vector<int>{};
        return std::vector<int>{film.frames[film.at(options.session->frame)].world};
    }
    const std::vector<int> numbers = worlds_of(options.scene);
    const bool all = !options.output.empty() && OutputName(options.output).has_token();
    std::vector<int> worlds;
    for (int w = 0; w < int(numbers.size()); ++w) {
        const bool last = w + 1 == int(numbers.size());
        const int64_t number = numbers[size_t(w)];
        if (options.frames ? std::ranges::count(*options.frames, number) > 0 : all || last)
            worlds.push_back(w);
    }
    if (!worlds.empty() || numbers.empty()) return worlds;
    std::fprintf(stderr, "kinora-render: error: '%s' has %zu pictures, none of them of --frames\n",
                 options.scene.c_str(), numbers.size());
    return std::nullopt;
}

bool read_worlds(const RenderOptions& options, const std::vector<int>& worlds, Diagnostics& found,
                 const std::function<bool(ReadWorld world)>& render) {
    judge_by(options, found);
    const auto trees = std::make_shared<raytrace::KeptTrees>();
    int next = 0;
    Stopwatch watch;
    auto take = [&](SceneDescription&& scene) {
        const int index = next++;
        if (std::ranges::count(worlds, index) == 0) return true;
        merge_meshes(scene);
        ReadWorld world{options, std::move(scene), watch.ms(), found};
        world.options.world = index;
        world.options.trees = trees;
        world.options.frames = {{int64_t(world.scene.file_picture->number)}};
        const bool go_on = render(std::move(world));
        watch.restart();
        return go_on && index != worlds.back();
    };
    return read_rib(options.scene, import_options(options), found, take, {.worlds = worlds});
}

}  // namespace kinora
