// runtime/programs/play/ui/source_panel.cpp: the file in which a finding stands, at its line.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

constexpr uintmax_t kMostBytes = 64 << 20;  // of a file that is shown
constexpr size_t kMostColumns = 4000;       // of a line

}  // namespace

// The file anew; without one that can be read, what was printed of the finding.
void SourcePanel::read(const SourcePlace& place) {
    file_ = place.file;
    line_ = place.line;
    column_ = place.column;
    text_.clear();
    std::error_code error;
    if (std::filesystem::file_size(place.file, error) <= kMostBytes && !error) {
        std::ifstream in(place.file, std::ios::binary);
        text_.assign(std::istreambuf_iterator<char>(in), {});
    }
    whole_ = !text_.empty();
    if (!whole_) text_ = place.printed;
    starts_.assign(1, 0);
    for (size_t at = text_.find('\n'); at != text_.npos; at = text_.find('\n', at + 1))
        starts_.push_back(at + 1);
    scrolls_ = true;
}

void SourcePanel::row(const Theme& theme, size_t index) const {
    const size_t begin = starts_[index],
                 end = index + 1 < starts_.size() ? starts_[index + 1] - 1 : text_.size();
    const bool here = whole_ && static_cast<int>(index) + 1 == line_;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float high = ImGui::GetTextLineHeightWithSpacing(), cell = ImGui::CalcTextSize("M").x,
                gutter = cell * 7;
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (here) {
        list->AddRectFilled(corner, {corner.x + 1e5f, corner.y + high}, theme.editor.selection);
        const float x = corner.x + gutter + cell * static_cast<float>(std::max(column_, 1) - 1);
        list->AddRectFilled({x, corner.y + high - theme.px(3)},
                            {x + cell, corner.y + high - theme.px(1)}, theme.error);
    }
    if (whole_)
        list->AddText(corner, here ? theme.text : theme.faint,
                      fmt::format("{:>5}", index + 1).c_str());
    const char* text = text_.data() + begin;
    list->AddText({corner.x + gutter, corner.y}, theme.text, text,
                  text + std::min(end - begin, kMostColumns));
    ImGui::Dummy({gutter + cell * static_cast<float>(std::min(end - begin, kMostColumns)),
                  ImGui::GetTextLineHeight()});
}

void SourcePanel::draw(Context& context) {
    const SourcePlace& place = context.state().place;
    const Theme& theme = context.theme;
    if (place.file.empty())
        return empty_note(theme, "A finding of a file that is no shader's text leads here.");
    if (place.file != file_ || place.line != line_ || place.column != column_ ||
        raised_ != context.state().raised.times)
        read(place);
    raised_ = context.state().raised.times;
    ImGui::TextUnformatted(std::filesystem::path(file_).filename().c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%d:%d", line_, column_);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", file_.c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Copy the place"))
        ImGui::SetClipboardText(fmt::format("{}:{}:{}", file_, line_, column_).c_str());
    ImGui::PushFont(theme.fonts.mono);
    ImGui::BeginChild("lines", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
    const float high = ImGui::GetTextLineHeightWithSpacing();
    if (std::exchange(scrolls_, false) && whole_)
        ImGui::SetScrollY(std::max(
            0.0f, high * static_cast<float>(line_ - 1) - ImGui::GetWindowHeight() * 0.4f));
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(starts_.size()), high);
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
            row(theme, static_cast<size_t>(i));
    ImGui::EndChild();
    ImGui::PopFont();
}

}  // namespace kinora::play
