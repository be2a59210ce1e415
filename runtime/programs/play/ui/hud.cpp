// runtime/programs/play/ui/hud.cpp: where the time of the last frames went.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

struct StageRow {
    const char* name;
    double StageTimes::*ms;
};
constexpr StageRow kStages[kHudStages] = {
    {"animate", &StageTimes::animate}, {"skin", &StageTimes::skin},
    {"refit", &StageTimes::refit},     {"trace", &StageTimes::trace},
    {"shade", &StageTimes::shade},     {"present", &StageTimes::present},
};

double total(const StageTimes& times) {
    double sum = 0;
    for (const StageRow& stage : kStages) sum += times.*stage.ms;
    return std::max(sum, times.total);
}

constexpr size_t kFrames = 120;

}  // namespace

void draw_stage_times(Context& context, ImVec2 size) {
    const Theme& theme = context.theme;
    const auto times = context.player.stage_times();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList* list = ImGui::GetWindowDrawList();
    // The scale holds two intervals of the wanted rate; what is longer is cut off at the top.
    const double interval = 1000 / std::max(1.0, context.state().picture.hold_rate),
                 most = 2 * interval;
    const float step = size.x / kFrames, low = corner.y + size.y;
    list->AddRectFilled(corner, {corner.x + size.x, low}, IM_COL32(0, 0, 0, 70), theme.px(3));
    const size_t count = std::min(times.size(), kFrames);
    for (size_t i = 0; i < count; ++i) {
        const StageTimes& frame = times[times.size() - count + i];
        const float x = corner.x + step * static_cast<float>(kFrames - count + i);
        double reached = 0;
        for (size_t s = 0; s < kHudStages; ++s) {
            const double next = reached + frame.*kStages[s].ms;
            const auto y = [&](double ms) {
                return low - size.y * static_cast<float>(std::min(ms, most) / most);
            };
            const ImU32 alpha = frame.cancelled ? 0x50000000u : 0xff000000u;
            if (next > reached)
                list->AddRectFilled({x, y(next)}, {x + std::max(1.0f, step - 0.6f), y(reached)},
                                    (theme.stages[s] & 0xffffff) | alpha);
            reached = next;
        }
    }
    const float line = low - size.y / 2;
    for (float x = corner.x; x < corner.x + size.x; x += theme.px(8))
        list->AddRectFilled({x, line}, {x + theme.px(4), line + 1}, IM_COL32(255, 255, 255, 90));
    const std::string label = fmt::format("{:.0f} ms", interval);
    const ImVec2 extent = ImGui::CalcTextSize(label.c_str()),
                 at{corner.x + theme.px(4), line - extent.y - 1};
    list->AddRectFilled({at.x - theme.px(2), at.y}, {at.x + extent.x + theme.px(2), line - 1},
                        IM_COL32(0, 0, 0, 160), theme.px(2));  // bars lie behind it
    list->AddText(at, IM_COL32(255, 255, 255, 190), label.c_str());
    ImGui::Dummy(size);
}

void draw_times(Context& context) {
    const Theme& theme = context.theme;
    const auto times = context.player.stage_times();
    if (times.empty()) return empty_note(theme, "No frame was rendered so far.");
    const StageTimes& last = times.back();
    const ImVec2 space = ImGui::GetContentRegionAvail();
    const float table = theme.px(300);
    draw_stage_times(context, {std::max(theme.px(100), space.x - table - theme.px(12)),
                               std::max(theme.px(40), space.y)});
    ImGui::SameLine();
    ImGui::BeginGroup();
    if (ImGui::BeginTable("stages", 3, ImGuiTableFlags_SizingFixedFit)) {
        const auto row = [&](ImU32 color, const char* name, double ms, double worst) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float box = theme.px(9), down = (ImGui::GetTextLineHeight() - box) / 2;
            ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + down},
                                                      {at.x + box, at.y + down + box}, color, 2);
            ImGui::Dummy({box + theme.px(3), box});
            ImGui::SameLine();
            ImGui::TextUnformatted(name);
            ImGui::TableNextColumn();
            ImGui::Text("%7.2f ms", ms);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%8.1f worst", worst);
        };
        for (size_t s = 0; s < kHudStages; ++s) {
            double worst = 0;
            for (const StageTimes& frame : times) worst = std::max(worst, frame.*kStages[s].ms);
            row(theme.stages[s], kStages[s].name, last.*kStages[s].ms, worst);
        }
        ImGui::EndTable();
    }
    ImGui::TextDisabled("%.1f ms, %.0f %% of the pixels, %d sample%s", total(last),
                        100 * last.scale * last.scale, last.samples, last.samples == 1 ? "" : "s");
    ImGui::EndGroup();
}

}  // namespace kinora::play
