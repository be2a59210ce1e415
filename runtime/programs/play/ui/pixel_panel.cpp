// runtime/programs/play/ui/pixel_panel.cpp: what lies under the pixel that was clicked.
#include <fmt/format.h>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

void row(const Theme& theme, const char* name, const std::string& value) {
    if (value.empty()) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    ImGui::PushFont(theme.fonts.mono);
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopFont();
}

std::string triple(dvec3 v) {
    return fmt::format("{:9.4f} {:9.4f} {:9.4f}", v.x, v.y, v.z);
}

}  // namespace

void draw_pixel(Context& context) {
    const auto& pixel = context.state().selection.pixel;
    if (!pixel)
        return empty_note(context.theme, "Click a pixel of the picture to see what lies there.");
    const Theme& theme = context.theme;
    const vec4& c = pixel->color;
    const auto display = [](float v) {
        return std::clamp(std::pow(std::max(v, 0.0f), 1 / 2.2f), 0.0f, 1.0f);
    };
    ImGui::ColorButton("color", {display(c.x), display(c.y), display(c.z), 1},
                       ImGuiColorEditFlags_NoTooltip, {theme.px(40), theme.px(40)});
    ImGui::SameLine();
    ImGui::BeginGroup();
    ImGui::Text("pixel %d, %d", pixel->x, pixel->y);
    ImGui::TextDisabled("%s", pixel->hit ? pixel->node.c_str() : "nothing is there");
    ImGui::EndGroup();
    ImGui::Dummy({0, theme.px(4)});
    if (!ImGui::BeginTable("pixel", 2, ImGuiTableFlags_SizingFixedFit)) return;
    row(theme, "color", fmt::format("{:9.4f} {:9.4f} {:9.4f}", c.x, c.y, c.z));
    row(theme, "alpha", fmt::format("{:9.4f}", c.w));
    if (pixel->hit) {
        row(theme, "P", triple(pixel->P));
        row(theme, "N", triple(pixel->N));
        row(theme, "u, v", fmt::format("{:9.4f} {:9.4f}", pixel->u, pixel->v));
        row(theme, "distance", fmt::format("{:9.4f}", pixel->distance));
        row(theme, "mesh", pixel->mesh);
        row(theme, "material", pixel->material);
        row(theme, "shader", pixel->shader);
    }
    ImGui::EndTable();
    if (!pixel->hit || !Context::has("select_material")) return;
    ImGui::Dummy({0, theme.px(4)});
    if (ImGui::Button("Edit this shader")) {
        context.run("select_material", {pixel->material});
        if (Context::has("edit")) context.run("edit");
        context.show("editor");
    }
    if (const PixelStory* story = context.state().selection.story.get())
        draw_story(context, *story);
}

}  // namespace kinora::play
