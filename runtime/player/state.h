// runtime/player/state.h: what the player is asked to show. A copy of it is all that a panel reads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/player/board/trade_board.h"
#include "runtime/player/session/free_camera.h"
#include "runtime/scene/ri/import/film.h"

namespace kinora {

struct PixelStory;  // runtime/player/pixel/pixel_story.h

enum class LoopMode : uint8_t { Loop, PingPong, Once };
enum class ToneCurve : uint8_t { Plain, Filmic };  // Plain: what kinora-render writes

struct CameraState {
    bool free = false;  // moved by hand; else the scene's camera `index`
    uint32_t index = 0;
    bool locked = false;  // moves do not leave the scene's camera
    FreeCamera own;
    bool turntable = false;
    std::string follow;  // the node it moves with; "" none
};

struct TimeState {
    double frame = 0;  // whole unless it plays
    double first = 0, last = 0;
    std::shared_ptr<const FilmFrames> film;  // whose frames alone there are; null: all numbers are
    std::optional<double> in, out;           // of what plays, frames
    bool playing = false;
    double speed = 1;  // J K L: -4 .. 4 times, 1 forwards
    LoopMode loop = LoopMode::Loop;
    bool every_frame = false;  // none is dropped, it plays slower instead
    std::string clip;
};

struct PictureState {
    int width = 640, height = 360;  // of the refined picture
    double exposure = 0;            // stops
    ToneCurve tone = ToneCurve::Plain;
    std::string aov;               // "" the picture itself
    bool false_color = false;      // of the luminance or the AOV
    double hold_rate = 30;         // pictures a second while something moves
    bool adapt = true;             // fewer pixels where that rate is not reached
    bool filter = true;            // the noise of pictures that are not refined
    bool refine = true;            // to the quality of kinora-render when nothing moves
    std::string quality;           // the preset; "" single options were put over one
    uint32_t bounces = 0;          // of indirect light that every scene has
    std::vector<TradeStop> stops;  // while the panel `quality` is open: of this view
    std::string light;             // the one that shines alone, as the scene lists it; "" all
    std::string wipe;              // the picture kept by `keep`, left of `wipe_at`; "" none
    double wipe_at = 0.5;          // share of the width
    bool rays = false;             // those of the clicked pixel are drawn
};

// What lies under a pixel.
struct PickedPixel {
    int x = 0, y = 0;
    bool hit = false;
    std::string node, mesh, material, shader;
    dvec3 P{0.0}, N{0.0};  // world
    double u = 0, v = 0, distance = 0;
    vec4 color{0.0f};  // of the picture shown: linear, associated
};

struct Selection {
    std::string node, material;
    std::optional<PickedPixel> pixel;
    std::shared_ptr<const PixelStory> story;  // of that pixel
};

struct Explained;  // runtime/picture/explain/explain.h

// Where a finding leads that stands in no text of a shader.
struct SourcePlace {
    std::string file;
    int line = 0, column = 0;  // from 1
    std::string printed;       // the finding as programs print it
};

// The panel that comes to the front of its area whenever `times` grows.
struct RaisedPanel {
    std::string name;
    int times = 0;
};

struct PlayerState {
    CameraState camera;
    TimeState time;
    PictureState picture;
    Selection selection;
    std::vector<std::string> panels;  // open ones, by name
    RaisedPanel raised;
    size_t finding = 0;  // the one that `finding` led to last, from 1
    SourcePlace place;   // what the panel `source` shows
    // What the scene models and leaves out, of when it was asked for last; null: never.
    std::shared_ptr<const std::vector<Explained>> explained;
    int files_written = 0;
    bool quit = false;
};

}  // namespace kinora
