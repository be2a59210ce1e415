// runtime/programs/play/ui/story_view.cpp: a pixel's shaders, statement by statement.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "runtime/player/pixel/pixel_story.h"
#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

constexpr size_t kMostNumbers = 16;  // of one variable in a row

std::string value_text(const StoryVariable& v) {
    if (v.text) return fmt::format("\"{}\"", fmt::join(v.texts, "\" \""));
    std::string text;
    for (size_t k = 0; k < std::min(v.values.size(), kMostNumbers); ++k)
        text += fmt::format("{:.6g}  ", v.values[k]);
    return v.values.size() > kMostNumbers ? text + "..." : text;
}

// "12  Ci = Os * color(1);", with what it stands in where that is not plain.
void title(const Theme& theme, const StoryStep& step) {
    std::string place;
    if (step.inside.starts_with("function")) place = step.inside;
    if (!step.light.empty()) place += (place.empty() ? "light " : ", light ") + step.light;
    if (!step.turns.empty())
        place += fmt::format("{}turn {}", place.empty() ? "" : ", ", fmt::join(step.turns, "."));
    ImGui::PushFont(theme.fonts.mono);
    ImGui::TextDisabled("%d", step.line);
    ImGui::SameLine(theme.px(44));
    ImGui::TextUnformatted(step.source.c_str());
    ImGui::PopFont();
    if (place.empty()) return;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", place.c_str());
}

void changes(const Theme& theme, const StoryStep& step) {
    for (const StoryVariable& v : step.changes) {
        ImGui::Dummy({theme.px(44), 0});
        ImGui::SameLine(theme.px(52));
        ImGui::PushFont(theme.fonts.mono);
        const std::string text = fmt::format("{} = {}", v.name, value_text(v));
        if (v.nan)
            ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(theme.error), "%s", text.c_str());
        else
            ImGui::TextUnformatted(text.c_str());
        ImGui::PopFont();
        ImGui::SameLine();
        ImGui::TextDisabled("%s %s", v.varying ? "varying" : "uniform", v.type.c_str());
    }
}

// What the compiler made of a line, where it made anything in the kernel of points: lines whose
// values are the same for all are computed once a frame.
void machine_code(const Theme& theme, const PointStory& point, const StoryStep& step) {
    ImGui::PushFont(theme.fonts.mono);
    for (const MachineRun& run : point.code) {
        if (run.line != step.line || run.file != step.file) continue;
        for (const std::string& instruction : run.instructions) {
            ImGui::Dummy({theme.px(44), 0});
            ImGui::SameLine(theme.px(52));
            ImGui::PushStyleColor(ImGuiCol_Text, theme.dim);
            ImGui::TextUnformatted(instruction.c_str());
            ImGui::PopStyleColor();
        }
    }
    ImGui::PopFont();
}

void ray_counts(const Theme& theme, const PixelStory& story) {
    size_t eye = 0, traced = 0, shadow = 0, blocked = 0;
    for (const StoryRay& ray : story.rays) {
        eye += ray.kind == StoryRay::Kind::Eye;
        traced += ray.kind == StoryRay::Kind::Traced;
        shadow += ray.kind == StoryRay::Kind::Shadow;
        blocked += ray.kind == StoryRay::Kind::Shadow && ray.hit;
    }
    ImGui::Dummy({0, theme.px(4)});
    ImGui::TextDisabled("Rays: %zu of the eye, %zu traced, %zu to lights (%zu blocked)%s", eye,
                        traced, shadow, blocked, story.rays_cut ? "; and more" : "");
}

void verdict(const Theme& theme, const PointStory& point) {
    const bool good = point.agreement == Agreement::Agrees;
    const std::string text =
        good ? "The reference comes to the same color."
             : fmt::format("The reference {}: {}.", agreement_text(point.agreement), point.why);
    const ImU32 color = good                                    ? theme.dim
                        : point.agreement == Agreement::Differs ? theme.error
                                                                : theme.warning;
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(color), "%s", text.c_str());
    if (point.nan_line)
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(theme.error),
                           "Not a number from line %d, column %d on.", point.nan_line,
                           point.nan_column);
}

}  // namespace

void draw_story(Context& context, const PixelStory& story) {
    const Theme& theme = context.theme;
    ray_counts(theme, story);
    if (toggle_button(theme, "Rays", context.state().picture.rays, nullptr)) context.run("rays");
    command_tooltip("rays");
    ImGui::SameLine();
    const bool with_code = context.open("code");
    if (toggle_button(theme, "Machine code", with_code, nullptr)) context.run("show_code");
    command_tooltip("show_code");
    int id = 0;
    for (const PointStory& point : story.points) {
        ImGui::PushID(id++);
        ImGui::Dummy({0, theme.px(6)});
        ImGui::Separator();
        ImGui::Text("%s on %s", point.shader.c_str(), point.material.c_str());
        verdict(theme, point);
        if (with_code && !point.no_code.empty()) ImGui::TextDisabled("%s", point.no_code.c_str());
        std::set<std::pair<std::string, int>> listed;  // a loop's lines come again
        for (const StoryStep& step : point.steps) {
            title(theme, step);
            if (with_code && listed.insert({step.file, step.line}).second)
                machine_code(theme, point, step);
            changes(theme, step);
        }
        if (point.cut) ImGui::TextDisabled("More statements ran than are kept.");
        ImGui::PopID();
    }
}

}  // namespace kinora::play
