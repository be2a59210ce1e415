// runtime/programs/play/ui/lights_panel.cpp: the lights, to be seen one by one, and the quality.
#include <fmt/format.h>
#include <imgui.h>

#include "runtime/programs/play/ui/panels.h"
#include "runtime/scene/quality/quality.h"

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

// From the picture that holds the rate to the reference.
void draw_quality(Context& context) {
    const PictureState& picture = context.state().picture;
    const std::string quick = fmt::format("{:.0f} fps", picture.hold_rate);
    constexpr int kStops = int(kPresets) + 1;
    int at = 0;
    if (picture.refine)
        while (at < kStops && (at == 0 || picture.quality != kPresetNames[at - 1])) ++at;
    const bool own = at == kStops;  // single options were given
    const std::string name = own ? "own options" : at == 0 ? quick : kPresetNames[at - 1];
    ImGui::SetNextItemWidth(-1);
    if (own) at = kStops - 1;
    if (ImGui::SliderInt("##quality", &at, 0, kStops - 1, name.c_str()))
        context.run("quality", {at == 0 ? "quick" : kPresetNames[at - 1]});
    command_tooltip("quality");
    if (picture.stops.empty() || !ImGui::BeginTable("stops", 4, ImGuiTableFlags_SizingFixedFit))
        return;
    for (const char* title : {"", "ms", "RMSE", "FLIP"}) ImGui::TableSetupColumn(title);
    ImGui::TableHeadersRow();
    for (const TradeStop& stop : picture.stops) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(stop.name == "quick" ? quick.c_str() : stop.name.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%.0f", stop.ms);
        ImGui::TableNextColumn();
        const bool best = &stop == &picture.stops.back();
        if (stop.against.empty()) {
            ImGui::TextDisabled("%s", best ? "best" : "...");
            if (best && ImGui::IsItemHovered())
                ImGui::SetTooltip("the others are compared with it");
            ImGui::TableNextColumn();
            continue;
        }
        ImGui::Text("%.4f", stop.rmse);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("against the refined picture of %s", stop.against.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%.4f", stop.flip);
    }
    ImGui::EndTable();
    if (picture.stops.size() > 1) return;
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.dim);
    ImGui::TextWrapped("Choose another quality to see what it takes and misses.");
    ImGui::PopStyleColor();
}

}  // namespace kinora::play
