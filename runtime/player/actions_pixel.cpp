// runtime/player/actions_pixel.cpp: what is known of the clicked pixel and of the scene, to files.
#include <fmt/format.h>

#include <fstream>

#include "runtime/picture/explain/explain.h"
#include "runtime/player/core_p.h"
#include "runtime/player/pixel/pixel_story.h"

namespace kinora {

std::shared_ptr<const PixelStory> story_of(const Inspected& inspected, int x, int y) {
    const ViewOrder& order = inspected.order;
    const double time = time_of(inspected.shown, order);
    auto story = std::make_shared<PixelStory>(pixel_story(
        inspected.scene, inspected.pose, time, inspected.settings, inspected.shown.texts, x, y, 0));
    story->frame = order.frame;
    return story;
}

namespace {

constexpr double kExplainSeconds = 60;

CommandResult write_text(PlayerCore& core, const std::string& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    out << text;
    if (!out.flush()) return refused(fmt::format("'{}' cannot be written", file), 1);
    ++core.state.files_written;
    return {};
}

}  // namespace

CommandResult action_explain(PlayerCore& core, const Arguments& a) {
    if (!core.info) return refused("there is no scene yet");
    core.explain_scene();
    core.wait_for([&] { return core.inspector.has_answered(); }, kExplainSeconds);
    const auto& rows = core.state.explained;
    if (!rows) return refused("the scene is not there yet");
    return write_text(core, a.text(0), explained_json(*rows));
}

CommandResult action_variables(PlayerCore& core, const Arguments& a) {
    const PixelStory* story = core.state.selection.story.get();
    if (!story) return refused("no surface was clicked");
    return write_text(core, a.text(0), to_json(*story));
}

}  // namespace kinora
