// runtime/programs/play/window/window.cpp: events in, commands out, pictures shown. The loop sleeps
// until there is an event, a picture or a time to advance to.
#include "runtime/programs/play/window/window.h"

#include <SDL.h>
#include <imgui.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iterator>
#include <optional>

#include "runtime/player/scene_maker.h"
#include "runtime/player/script.h"
#include "runtime/programs/play/ui/ui.h"
#include "runtime/programs/play/window/batch.h"
#include "runtime/programs/play/window/input.h"
#include "runtime/programs/play/window/keys.h"
#include "runtime/programs/play/window/libsdl_p.h"
#include "runtime/programs/play/window/script_lines.h"
#include "runtime/programs/play/window/surface.h"

namespace kinora::play {

namespace {

std::atomic<uint32_t> g_wake_event{0};  // 0: there is no window
std::atomic<bool> g_woken{false};       // an event is on its way: one is enough

constexpr double kPlayTurn = 1.0 / 60;  // seconds between turns while time goes on
constexpr double kOpeningTurn = 0.1;    // while another scene is read: its seconds are counted
constexpr double kFirstWait = 0.05;     // for a scene, whose picture is made while panels are drawn
constexpr double kUnhurried = 0.05;     // between turns while that picture is made
constexpr int kTurnsAfterEvent = 3;     // ImGui settles sizes in the frames after a change

using Clock = std::chrono::steady_clock;

struct ImGuiScope {
    ImGuiScope() { ImGui::CreateContext(); }
    ~ImGuiScope() {
        free_pointers();
        ImGui::DestroyContext();
    }
};

class WindowLoop {
  public:
    WindowLoop(Player& player, const WindowOptions& options)
        : player_(player),
          options_(options),
          layout_(read_layout(options.layout)),
          surface_("Kinora", {layout_.width, layout_.height, layout_.maximized}) {
        scale_ = layout_.scale > 0 ? layout_.scale : surface_.display_scale();
        surface_.set_full_screen(options.full_screen);
        player.advance(0);  // a scene that is there by now is rendered while fonts are loaded
        ui_.emplace(player, layout_, scale_ * surface_.pixels_per_unit(), !options.fixed_size);
        connect_input();
        begin_script();
        player.wait_loaded(kFirstWait);
    }

    bool script_failed() const { return script_failed_; }

    void run() {
        last_ = Clock::now();
        while (!player_.state().quit && !closed_) {
            wait();
            turn();
        }
        Layout layout = ui_->layout();
        if (!surface_.full_screen()) {
            const WindowBounds bounds = surface_.bounds();
            layout.maximized = bounds.maximized;
            if (!bounds.maximized) layout.width = bounds.width, layout.height = bounds.height;
        }
        write_layout(options_.layout, layout);
    }

  private:
    // Seconds that may pass without an event; < 0: any time.
    double patience() const {
        if (turns_ > 0) return makes_first_picture() ? kUnhurried : 0;
        if (line_) return kPlayTurn;
        if (player_.opening().step != Opening::Step::None) return kOpeningTurn;
        if (player_.state().time.playing || player_.state().camera.turntable)
            return surface_.hidden() ? 0.1 : kPlayTurn;
        return ui_->next_turn();
    }

    // Nothing on the screen is worth its time then.
    bool makes_first_picture() const {
        return player_.load_state() == LoadState::Ready && !player_.picture();
    }

    void wait() {
        SDL_Event event;
        const double seconds = patience();
        int some = 0;
        if (held_)
            some = 0;
        else if (seconds < 0)
            some = sdl().SDL_WaitEvent(&event);
        else
            some = sdl().SDL_WaitEventTimeout(
                &event, std::max(1, static_cast<int>(std::ceil(seconds * 1000))));
        const ImGuiIO& io = ImGui::GetIO();
        Batch batch(std::find(std::begin(io.MouseDown), std::end(io.MouseDown), true) !=
                    std::end(io.MouseDown));
        if (held_) {
            event = *std::exchange(held_, std::nullopt);
            some = 1;
        }
        while (some) {
            if (!batch.takes(event)) {
                held_ = event;
                break;
            }
            take(event);
            some = sdl().SDL_PollEvent(&event);
        }
    }

    void take(const SDL_Event& event) {
        turns_ = std::max(turns_, 1);
        if (event.type == g_wake_event) {
            g_woken = false;
            return;
        }
        turns_ = kTurnsAfterEvent;
        take_event(event, surface_.pixels_per_unit());
        switch (event.type) {
            case SDL_QUIT:
                closed_ = true;
                break;
            case SDL_DROPFILE:
                ui_->context().run("open", {event.drop.file});
                sdl().SDL_free(event.drop.file);
                break;
            case SDL_KEYDOWN:
                press(event.key);
                break;
            case SDL_TEXTINPUT:
                ui_->typed(event.text.text);
                break;
            default:
                break;
        }
    }

    void press(const SDL_KeyboardEvent& event) {
        const std::string name = key_name(event.keysym.sym, event.keysym.mod);
        if (name.empty()) return;
        const bool took = ui_->press(name);
        // Letters of a key that was a command are no text: of the palette that it opened, say.
        swallow_text_ = took;
    }

    void turn() {
        const auto now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        player_.advance(seconds);
        follow_script();
        if (turns_ > 0) --turns_;
        follow_title();
        follow_full_screen();
        if (surface_.hidden()) return;
        const Target target = surface_.frame();
        if (!target.pixels) return;
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {static_cast<float>(target.width), static_cast<float>(target.height)};
        if (std::exchange(swallow_text_, false)) io.ClearInputCharacters();
        ui_->steer(steering());
        ui_->render(target, static_cast<float>(seconds));
        show_pointer();
        surface_.present();
    }

    void begin_script() {
        if (options_.script.empty()) return;
        lines_.emplace(options_.script, wake_window);
        const auto say = [this](const std::string& text) {
            std::fprintf(stderr, "%s\n", text.c_str());
            ui_->context().say(text, true);
        };
        script_.emplace(player_, options_.script, say);
        if (lines_->error().empty()) return;
        say("kinora-play: error: the script '" + options_.script +
            "' cannot be read: " + lines_->error());
        end_script();
    }

    void end_script() {
        script_.reset();
        line_.reset();
        script_failed_ = true;
    }

    // Its lines, up to one that has to wait.
    void follow_script() {
        while (script_ && !player_.state().quit) {
            if (!line_) line_ = lines_->next();
            if (!line_) return;
            const Script::Progress progress = script_->step(*line_);
            if (progress == Script::Progress::Waits) return;
            line_.reset();
            if (progress == Script::Progress::Failed) return end_script();
            turns_ = kTurnsAfterEvent;
        }
    }

    void follow_title() {
        const auto scene = player_.scene();
        if (!scene || scene->serial == titled_) return;
        titled_ = scene->serial;
        surface_.set_title(scene->path.substr(scene->path.rfind('/') + 1) + " - Kinora");
    }

    void follow_full_screen() {
        const auto& panels = player_.state().panels;
        const bool wanted = options_.full_screen != (std::find(panels.begin(), panels.end(),
                                                               "full_screen") != panels.end());
        if (wanted != full_screen_) surface_.set_full_screen(full_screen_ = wanted);
    }

    Player& player_;
    const WindowOptions& options_;
    Layout layout_;
    Surface surface_;
    ImGuiScope imgui_;
    std::optional<Ui> ui_;
    std::optional<ScriptLines> lines_;
    std::optional<Script> script_;
    std::optional<std::string> line_;  // the script's, which is not done yet
    std::optional<SDL_Event> held_;
    Clock::time_point last_;
    float scale_ = 1;
    int turns_ = kTurnsAfterEvent;
    bool closed_ = false, swallow_text_ = false, full_screen_ = false, script_failed_ = false;
    uint64_t titled_ = 0;
};

}  // namespace

void wake_window() {
    const uint32_t type = g_wake_event;
    if (!type || g_woken.exchange(true)) return;
    SDL_Event event{};
    event.type = type;
    sdl().SDL_PushEvent(&event);
}

WindowEnd run_window(Player& player, const WindowOptions& options, std::string& error) {
    std::optional<WindowLoop> loop;
    try {
        loop.emplace(player, options);
    } catch (const std::exception& reason) {
        error = reason.what();
        return WindowEnd::NoWindow;
    }
    static const uint32_t type = sdl().SDL_RegisterEvents(1);
    g_wake_event = type;
    loop->run();
    g_wake_event = 0;
    return loop->script_failed() ? WindowEnd::ScriptFailed : WindowEnd::Closed;
}

}  // namespace kinora::play
