// runtime/programs/play/ui/timeline.cpp: transport buttons, and a ruler of frames to drag.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

enum class Icon { Home, Back, KeyBack, Play, Pause, KeyNext, Next, End };

void triangle(ImDrawList* list, float x, float y, float r, bool right, ImU32 color) {
    const float s = right ? r : -r;
    list->AddTriangleFilled({x - s * 0.75f, y - r}, {x + s, y}, {x - s * 0.75f, y + r}, color);
}

void bar(ImDrawList* list, float x, float y, float r, float width, ImU32 color) {
    list->AddRectFilled({x - width / 2, y - r}, {x + width / 2, y + r}, color);
}

void diamond(ImDrawList* list, float x, float y, float r, ImU32 color) {
    list->AddQuadFilled({x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}, color);
}

void draw_icon(ImDrawList* list, Icon icon, ImVec2 middle, float r, ImU32 color) {
    const float x = middle.x, y = middle.y, thin = std::max(1.5f, r * 0.35f);
    switch (icon) {
        case Icon::Home:
            bar(list, x - r, y, r, thin, color);
            return triangle(list, x + r * 0.2f, y, r, false, color);
        case Icon::End:
            bar(list, x + r, y, r, thin, color);
            return triangle(list, x - r * 0.2f, y, r, true, color);
        case Icon::Back:
            return triangle(list, x, y, r * 0.8f, false, color);
        case Icon::Next:
            return triangle(list, x, y, r * 0.8f, true, color);
        case Icon::KeyBack:
            diamond(list, x - r * 0.7f, y, r * 0.6f, color);
            return triangle(list, x + r * 0.6f, y, r * 0.7f, false, color);
        case Icon::KeyNext:
            diamond(list, x + r * 0.7f, y, r * 0.6f, color);
            return triangle(list, x - r * 0.6f, y, r * 0.7f, true, color);
        case Icon::Play:
            return triangle(list, x, y, r * 1.25f, true, color);
        case Icon::Pause:
            bar(list, x - r * 0.5f, y, r * 1.1f, r * 0.55f, color);
            return bar(list, x + r * 0.5f, y, r * 1.1f, r * 0.55f, color);
    }
}

bool icon_button(const Theme& theme, const char* id, Icon icon, bool large) {
    const float size = theme.px(large ? 30 : 26);
    const bool pressed = ImGui::InvisibleButton(id, {size, theme.px(28)});
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered())
        list->AddRectFilled(low, high, ImGui::IsItemActive() ? theme.line : theme.raised,
                            theme.px(4));
    draw_icon(list, icon, {std::round((low.x + high.x) / 2), std::round((low.y + high.y) / 2)},
              theme.px(5), icon == Icon::Play || icon == Icon::Pause ? theme.accent : theme.text);
    return pressed;
}

const char* name_of(LoopMode mode) {
    switch (mode) {
        case LoopMode::Loop:
            return "loop";
        case LoopMode::PingPong:
            return "ping-pong";
        case LoopMode::Once:
            return "once";
    }
    return "";
}

struct ButtonRow {
    const char* word;
    Icon icon;
};
constexpr ButtonRow kBefore[] = {
    {"first", Icon::Home}, {"previous_key", Icon::KeyBack}, {"previous", Icon::Back}};
constexpr ButtonRow kAfter[] = {
    {"next", Icon::Next}, {"next_key", Icon::KeyNext}, {"last", Icon::End}};

void buttons(Context& context, std::span<const ButtonRow> rows) {
    for (const ButtonRow& row : rows) {
        if (!Context::has(row.word)) continue;
        if (icon_button(context.theme, row.word, row.icon, false)) context.run(row.word);
        command_tooltip(row.word);
        ImGui::SameLine(0, 0);
    }
}

// 1, 2 or 5 times a power of ten frames, so that labels have room.
double label_step(double frames, float width, float label) {
    const double least = std::max(1.0, frames * static_cast<double>(label / std::max(width, 1.0f)));
    double power = std::pow(10.0, std::floor(std::log10(least)));
    for (double factor : {1.0, 2.0, 5.0, 10.0})
        if (factor * power >= least) return factor * power;
    return 10 * power;
}

void draw_clips(Context& context, const SceneInfo& scene) {
    if (scene.clips.empty() || !Context::has("clip")) return;
    const std::string& clip = context.state().time.clip;
    ImGui::SameLine(0, context.theme.px(14));
    ImGui::SetNextItemWidth(context.theme.px(130));
    if (!ImGui::BeginCombo("##clip", clip.empty() ? "whole range" : clip.c_str())) return;
    for (const ClipInfo& one : scene.clips)
        if (ImGui::Selectable(one.name.c_str(), one.name == clip)) context.run("clip", {one.name});
    ImGui::EndCombo();
}

}  // namespace

void Timeline::transport(Context& context) {
    const Theme& theme = context.theme;
    const TimeState& time = context.state().time;
    buttons(context, kBefore);
    if (Context::has("play")) {
        if (icon_button(theme, "play", time.playing ? Icon::Pause : Icon::Play, true))
            context.run("play");
        command_tooltip("play");
        ImGui::SameLine(0, 0);
    }
    buttons(context, kAfter);
    ImGui::SameLine(0, theme.px(14));
    ImGui::SetNextItemWidth(theme.px(86));
    auto frame = static_cast<float>(time.frame);
    if (ImGui::DragFloat("##frame", &frame, 0.25f, static_cast<float>(time.first),
                         static_cast<float>(time.last), time.playing ? "%.1f" : "%.6g") &&
        Context::has("seek"))
        context.run("seek", {fmt::format("{}", std::round(frame))});
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("frame: drag, or double-click to type");
    const auto scene = context.player.scene();
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const double rate = scene ? scene->frame_rate : 24;
    ImGui::TextDisabled("%s s   %s fps", short_number(time.frame / rate).c_str(),
                        short_number(rate).c_str());
    if (scene) draw_clips(context, *scene);
    if (time.speed != 1) {
        ImGui::SameLine(0, theme.px(14));
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(theme.accent), "%sx",
                           short_number(time.speed).c_str());
    }
    if (Context::has("loop")) {
        ImGui::SameLine(0, theme.px(14));
        if (ImGui::Button(name_of(time.loop))) context.run("loop");
        command_tooltip("loop");
    }
    if (Context::has("every_frame")) {
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        if (toggle_button(theme, "every frame", time.every_frame, nullptr))
            context.run("every_frame");
        command_tooltip("every_frame");
    }
}

void Timeline::ruler(Context& context) {
    const Theme& theme = context.theme;
    const TimeState& time = context.state().time;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, theme.px(32)};
    if (size.x < theme.px(60)) return;
    ImGui::InvisibleButton("ruler", size);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float margin = theme.px(12), low = corner.y + size.y, wide = size.x - 2 * margin;
    const double first = time.first, frames = std::max(1.0, time.last - time.first);
    const auto x_of = [&](double frame) {
        return corner.x + margin + wide * static_cast<float>((frame - first) / frames);
    };
    list->AddRectFilled(corner, {corner.x + size.x, low}, IM_COL32(0x17, 0x18, 0x1b, 255),
                        theme.px(4));
    const double in = time.in.value_or(time.first), out = time.out.value_or(time.last);
    list->AddRectFilled({x_of(in), corner.y}, {x_of(out), low}, IM_COL32(255, 255, 255, 9));
    if (time.in || time.out)
        for (double frame : {in, out})
            list->AddRectFilled({x_of(frame) - 1, corner.y}, {x_of(frame) + 1, low}, theme.good);

    const double step = label_step(frames, wide, theme.px(64));
    for (double frame = std::ceil(first / step) * step; frame <= time.last + 1e-9; frame += step) {
        const float x = std::round(x_of(frame));
        list->AddRectFilled({x, corner.y}, {x + 1, corner.y + theme.px(6)}, theme.faint);
        const std::string label = fmt::format("{:.0f}", frame);
        const float width = ImGui::CalcTextSize(label.c_str()).x, gap = theme.px(4);
        const bool fits = x + gap + width <= corner.x + size.x;
        list->AddText({fits ? x + gap : x - gap - width, corner.y}, theme.dim, label.c_str());
    }
    if (wide / static_cast<float>(frames) > theme.px(4))
        for (double frame = std::ceil(first); frame <= time.last + 1e-9; frame += 1)
            list->AddRectFilled({std::round(x_of(frame)), corner.y},
                                {std::round(x_of(frame)) + 1, corner.y + theme.px(3)}, theme.line);
    if (const auto scene = context.player.scene()) {
        float last = -1e9f;
        for (double key : scene->keys) {
            const float x = x_of(key);
            if (key < first || key > time.last || x - last < theme.px(2)) continue;
            last = x;
            diamond(list, x, low - theme.px(9), theme.px(3.5f), IM_COL32(0xf0, 0xa9, 0x4b, 150));
        }
    }
    const float head = x_of(std::clamp(time.frame, first, time.last));
    list->AddRectFilled({head - 1, corner.y}, {head + 1, low}, theme.accent);
    list->AddTriangleFilled({head - theme.px(5), corner.y}, {head + theme.px(5), corner.y},
                            {head, corner.y + theme.px(7)}, theme.accent);

    if (ImGui::IsItemActive() && Context::has("seek")) {
        const float share =
            std::clamp((ImGui::GetIO().MousePos.x - corner.x - margin) / wide, 0.0f, 1.0f);
        const double frame = std::round(first + frames * static_cast<double>(share));
        if (frame != time.frame || time.playing) context.run("seek", {fmt::format("{}", frame)});
    }
}

void Timeline::draw(Context& context) {
    transport(context);
    ruler(context);
}

}  // namespace kinora::play
