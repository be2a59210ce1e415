// runtime/programs/play/ui/lights_panel.cpp: the lights, to be seen one by one, and the quality.
#include <fmt/format.h>
#include <imgui.h>

#include "runtime/programs/play/ui/panels.h"
#include "runtime/trade/quality.h"

namespace kinora::play {

namespace {

void choice(Context& context, const char* label, const std::string& light, bool chosen) {
    ImGui::PushID(light.c_str());
    if (ImGui::RadioButton(label, chosen) && !chosen) context.run("light", {light});
    ImGui::PopID();
}

}  // namespace

void draw_lights(Context& context) {
    const auto scene = context.player.scene();
    if (!scene) return empty_note(context.theme, "No scene is open.");
    if (scene->lights.empty()) return empty_note(context.theme, "The scene has no lights.");
    const std::string& alone = context.state().picture.light;
    choice(context, "all lights", "all", alone.empty());
    for (const std::string& light : scene->lights)
        choice(context, light.c_str(), light, alone == light);
}

void draw_quality(Context& context) {
    const std::string& now = context.state().picture.quality;
    int at = 0;
    while (at < int(kPresets) && now != kPresetNames[at]) ++at;
    const bool own = at == int(kPresets);  // single options were given
    ImGui::SetNextItemWidth(context.theme.px(180));
    if (own) at = 0;
    if (ImGui::SliderInt("##quality", &at, 0, int(kPresets) - 1, own ? "own" : now.c_str()))
        context.run("quality", {kPresetNames[at]});
    command_tooltip("quality");
    for (const auto& [name, price] : context.state().picture.prices)
        ImGui::TextDisabled("%s  %s", name.c_str(),
                            fmt::format("{:.0f} ms a refined picture", price).c_str());
}

}  // namespace kinora::play
