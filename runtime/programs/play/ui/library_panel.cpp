// runtime/programs/play/ui/library_panel.cpp: our shaders as pictures of the selected object.
#include <imgui.h>

#include "runtime/player/thumbnails.h"
#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

void LibraryPanel::draw(Context& context) {
    if (!context.player.scene()) return empty_note(context.theme, "No scene is open.");
    if (context.state().selection.material.empty())
        return empty_note(context.theme, "Click a thing in the picture, or choose a material.");
    shown_ = context.player.thumbnails();
    textures_.resize(shown_.size());
    ImGui::BeginChild("library");
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x,
                gap = ImGui::GetStyle().ItemSpacing.x;
    for (size_t k = 0; k < shown_.size(); ++k) {
        const Thumbnail& made = *shown_[k];
        textures_[k] = {made.rgba.data(), made.width, made.height, TexelFormat::Rgba8};
        const ImVec2 size{context.theme.px(static_cast<float>(made.width)),
                          context.theme.px(static_cast<float>(made.height))};
        ImGui::PushID(static_cast<int>(k));
        ImGui::BeginGroup();
        if (ImGui::ImageButton(texture_id(&textures_[k]), size, {0, 0}, {1, 1}, 1))
            context.run("bind", {made.shader});
        ImGui::TextUnformatted(made.shader.c_str());
        ImGui::EndGroup();
        ImGui::PopID();
        if (ImGui::GetItemRectMax().x + gap + size.x < right) ImGui::SameLine();
    }
    if (shown_.empty()) empty_note(context.theme, "The pictures are being made.");
    ImGui::EndChild();
}

}  // namespace kinora::play
