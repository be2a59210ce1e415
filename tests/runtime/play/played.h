// tests/runtime/play/played.h: a player without a clock, small and quick.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>

#include "runtime/base/parallel.h"
#include "runtime/play/player.h"
#include "runtime/play/script.h"
#include "runtime/programs/open/open_scene.h"
#include "runtime/trade/quality.h"
#include "tests/folders.h"

namespace kinora {

inline std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

constexpr double kLong = 300;  // seconds: more is a hang

inline std::string scene_path(const std::string& name) {
    return project_folder() + "/assets/" + name;
}

inline SceneRequest small_request(const std::string& scene, int samples = 1) {
    SceneRequest request;
    request.scene = scene;
    request.width = 64;
    request.height = 36;
    request.threads = 2;
    request.quality = *find_quality(kDefaultQuality);
    request.quality.samples_per_pixel = samples;
    return request;
}

// A scene as kinora-render would make frames of it.
struct OpenedScene {
    explicit OpenedScene(const SceneRequest& request) {
        set_thread_count(request.threads);
        diagnostics.judge(Judgement::Rendering);
        auto imported = import_requested(request, diagnostics);
        if (!imported) return;
        rate = imported->rate;
        BuiltScene built = build_imported(std::move(*imported), diagnostics);
        scene = std::move(built.scene);
        pose = std::move(built.pose);
        if (scene) settings = frame_settings(request, *scene, *pose, diagnostics);
    }
    Diagnostics diagnostics;
    FrameRate rate;
    std::unique_ptr<Scene> scene;  // null: it is none
    std::unique_ptr<Pose> pose;
    FrameSettings settings;
};

struct Played {
    explicit Played(const SceneRequest& request, PlayerSetup setup = {false, false, nullptr})
        : player(setup) {
        player.open(request);
        EXPECT_TRUE(player.wait_loaded(kLong));
    }
    explicit Played(const std::string& name) : Played(small_request(scene_path(name))) {}

    // Lines parted by ';'. What was reported, "" where all was done.
    std::string script(std::string lines) {
        std::string said;
        for (char& c : lines)
            if (c == ';') c = '\n';
        Script run(player, "test", [&](const std::string& line) { said += line; });
        run.run(lines);
        return said;
    }

    Player player;
};

}  // namespace kinora
