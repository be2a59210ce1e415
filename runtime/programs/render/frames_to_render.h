// runtime/programs/render/frames_to_render.h: the frames that a command line asks for, and their
// times.
#pragma once

#include <optional>

#include "runtime/programs/render/options.h"
#include "runtime/programs/render/run_report.h"

namespace kinora {

struct SceneResources;
struct SceneShaders;

// Frames and their times, seconds: --time, --frames, a turn of the turntable, or all that the scene
// plays; where nothing of it moves and -o names one file, the first. Nothing, with a message on
// stderr, where they are too many or -o has one name for several.
std::optional<FrameTimes> frames_to_render(const RenderOptions& options, FrameRate rate,
                                           const SceneResources& scene,
                                           const SceneShaders& shaders);

// The middle frame of all that the scene plays, behind the one before it, whatever part of them is
// rendered. Nothing where they are too many to say.
FrameTimes middle_of_shot(const RenderOptions& options, FrameRate rate, double start, double end);

// One finding where --frames or --time name frames past the range that the scene plays.
void report_past(const RenderOptions& options, FrameRate rate, const SceneResources& scene,
                 const FrameTimes& frames, Diagnostics& diagnostics);

}  // namespace kinora
