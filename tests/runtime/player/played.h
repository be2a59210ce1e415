// tests/runtime/player/played.h: a player without a clock, small and quick.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <mutex>
#include <string>
#include <utility>

#include "runtime/base/parallel.h"
#include "runtime/kinora/open_scene.h"
#include "runtime/player/player.h"
#include "runtime/player/script.h"
#include "runtime/scene/quality/quality.h"
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

// What other threads announce: PlayerSetup::wake, or SceneMaker's `done`.
class News {
  public:
    std::function<void()> bell() {
        return [this] {
            {
                const std::lock_guard lock(mutex_);
                rung_ = true;
            }
            woken_.notify_all();
        };
    }

    // Until it is so, looked at whenever the bell rings. False after so many seconds.
    bool await(const std::function<bool()>& reached, double seconds = kLong) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (!reached()) {
            if (std::chrono::steady_clock::now() >= end) return false;
            std::unique_lock lock(mutex_);
            woken_.wait_for(lock, kLook, [&] { return rung_; });
            rung_ = false;
        }
        return true;
    }

  private:
    // A frame that begins rings no bell.
    static constexpr std::chrono::milliseconds kLook{5};
    std::mutex mutex_;
    std::condition_variable woken_;
    bool rung_ = false;
};

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
        : player(with_bell(std::move(setup))) {
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

    // Until it is so: looked at whenever the player has something new. Each look takes it up, and
    // time goes on by so many seconds.
    bool until(const std::function<bool()>& reached, double seconds_a_look = 0) {
        return news_.await([&] {
            player.advance(seconds_a_look);
            return reached();
        });
    }
    // Until its threads are deep in a frame, by the CPU time that they take.
    bool until_busy() {
        const clock_t before = clock();
        return until([&] { return clock() - before > CLOCKS_PER_SEC / 20; });
    }

  private:
    PlayerSetup with_bell(PlayerSetup setup) {
        setup.wake = news_.bell();
        return setup;
    }
    News news_;  // before the player, which rings it

  public:
    Player player;
};

}  // namespace kinora
