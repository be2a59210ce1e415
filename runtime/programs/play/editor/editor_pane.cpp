// runtime/programs/play/editor/editor_pane.cpp: keys, mouse and drawing of the editor.
#include "runtime/programs/play/editor/editor_pane.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace kinora::play {

namespace {

constexpr size_t kOffersShown = 9;

bool pressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

std::string utf8(ImWchar character) {
    std::string out;
    const auto c = static_cast<uint32_t>(character);
    if (c < 0x80) {
        out += static_cast<char>(c);
    } else if (c < 0x800) {
        out += static_cast<char>(0xc0 | c >> 6);
        out += static_cast<char>(0x80 | (c & 0x3f));
    } else {
        out += static_cast<char>(0xe0 | c >> 12);
        out += static_cast<char>(0x80 | (c >> 6 & 0x3f));
        out += static_cast<char>(0x80 | (c & 0x3f));
    }
    return out;
}

// Small waves, as editors underline what is wrong.
void draw_wave(ImDrawList* list, ImVec2 from, float width, ImU32 color) {
    constexpr float kStep = 3, kHeight = 2;
    std::vector<ImVec2> points;
    for (float x = 0; x < width + kStep; x += kStep)
        points.push_back({from.x + std::min(x, width), from.y + (points.size() % 2 ? kHeight : 0)});
    list->AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, 1.2f);
}

}  // namespace

ManualLine EditorPane::hint() const {
    const std::string& text = buffer_.text();
    const WordRange word = word_at(text, buffer_.caret());
    ManualLine line = manual_line(std::string_view(text).substr(word.begin, word.end - word.begin));
    // The nearest open parenthesis before the caret with a name in front of it.
    int depth = 0;
    for (size_t at = word.begin; line.form.empty() && at > 0 && text[at] != ';' && text[at] != '}';
         --at) {
        if (text[at - 1] == ')') ++depth;
        if (text[at - 1] != '(' || --depth >= 0) continue;
        const WordRange name = word_at(text, at - 1);
        line = manual_line(std::string_view(text).substr(name.begin, name.end - name.begin));
        depth = 0;
    }
    return line;
}

EditorPane::View EditorPane::view_of(ImVec2 corner, ImVec2 size) const {
    View view;
    const float height = std::round(ImGui::GetFontSize() * 1.28f);
    view.cell = {ImGui::CalcTextSize("M").x, height};
    const auto digits = static_cast<float>(fmt::format("{}", buffer_.line_count()).size());
    view.gutter = view.cell.x * (std::max(digits, 2.0f) + 2.5f);
    view.size = size;
    view.origin = {corner.x + view.gutter - scroll_.x, corner.y + 4 - scroll_.y};
    const auto seen = [&](float y) {
        const float line = std::floor((y + scroll_.y - 4) / height);
        return static_cast<size_t>(
            std::clamp(line, 0.0f, static_cast<float>(buffer_.line_count() - 1)));
    };
    view.first = seen(0);
    view.last = seen(size.y);
    return view;
}

ImVec2 EditorPane::place_of(const View& view, size_t at) const {
    return {view.origin.x + view.cell.x * static_cast<float>(buffer_.column_of(at)),
            view.origin.y + view.cell.y * static_cast<float>(buffer_.line_of(at))};
}

size_t EditorPane::under(const View& view, ImVec2 point) const {
    const float row = std::floor((point.y - view.origin.y) / view.cell.y);
    const float column = std::round((point.x - view.origin.x) / view.cell.x);
    const auto line =
        static_cast<size_t>(std::clamp(row, 0.0f, static_cast<float>(buffer_.line_count() - 1)));
    return buffer_.at_column(line, static_cast<size_t>(std::max(column, 0.0f)));
}

void EditorPane::take_mouse(const View& view, bool hovered) {
    const ImGuiIO& io = ImGui::GetIO();
    if (hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_TextInput);
    if (ImGui::IsMouseClicked(0)) {
        focused_ = hovered;
        if (hovered) {
            dragging_ = true;
            offers_.clear();
            buffer_.set_caret(under(view, io.MousePos), io.KeyShift);
            if (ImGui::IsMouseDoubleClicked(0)) {
                buffer_.select_word(buffer_.caret());
                dragging_ = false;
            }
        }
    }
    if (dragging_ && ImGui::IsMouseDragging(0, 2)) {
        buffer_.set_caret(under(view, io.MousePos), true);
        scroll_to_caret_ = true;
    }
    if (!ImGui::IsMouseDown(0)) dragging_ = false;
}

void EditorPane::take_wheel(const View& view) {
    const ImGuiIO& io = ImGui::GetIO();
    (io.KeyShift ? scroll_.x : scroll_.y) -= 3 * view.cell.y * io.MouseWheel;
    scroll_.x -= 3 * view.cell.x * io.MouseWheelH;
    const float lines = static_cast<float>(buffer_.line_count()) * view.cell.y;
    scroll_.y = std::clamp(scroll_.y, 0.0f, std::max(0.0f, lines + 8 - view.size.y / 2));
    scroll_.x = std::max(0.0f, scroll_.x);
}

bool EditorPane::take_completion_keys() {
    if (offers_.empty()) return false;
    if (pressed(ImGuiKey_Escape)) {
        offers_.clear();
        return true;
    }
    if (pressed(ImGuiKey_DownArrow))
        chosen_ = (chosen_ + 1) % offers_.size();
    else if (pressed(ImGuiKey_UpArrow))
        chosen_ = (chosen_ + offers_.size() - 1) % offers_.size();
    else if (pressed(ImGuiKey_Tab) || pressed(ImGuiKey_Enter))
        accept_completion();
    else
        return false;
    return true;
}

void EditorPane::accept_completion() {
    const WordRange word = word_at(buffer_.text(), buffer_.caret());
    buffer_.replace(word.begin, buffer_.caret(), offers_[chosen_].name);
    offers_.clear();
}

bool EditorPane::take_clipboard_keys() {
    const auto copy = [&] {
        if (!buffer_.selected().empty())
            ImGui::SetClipboardText(std::string(buffer_.selected()).c_str());
    };
    if (pressed(ImGuiKey_C)) {
        copy();
    } else if (pressed(ImGuiKey_X)) {
        copy();
        if (!buffer_.selected().empty()) buffer_.erase_back();
    } else if (pressed(ImGuiKey_V)) {
        const char* text = ImGui::GetClipboardText();
        if (text) buffer_.type(text);
    } else {
        return false;
    }
    return true;
}

void EditorPane::take_keys(const View& view) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool word = io.KeyCtrl, extend = io.KeyShift;
    const auto page = static_cast<size_t>(std::max(1.0f, view.size.y / view.cell.y - 2));
    const size_t caret = buffer_.caret();
    const uint64_t length = buffer_.text().size();
    if (pressed(ImGuiKey_LeftArrow)) buffer_.move(word ? Motion::WordLeft : Motion::Left, extend);
    if (pressed(ImGuiKey_RightArrow))
        buffer_.move(word ? Motion::WordRight : Motion::Right, extend);
    if (pressed(ImGuiKey_UpArrow)) buffer_.move(Motion::Up, extend);
    if (pressed(ImGuiKey_DownArrow)) buffer_.move(Motion::Down, extend);
    if (pressed(ImGuiKey_PageUp)) buffer_.move(Motion::Up, extend, page);
    if (pressed(ImGuiKey_PageDown)) buffer_.move(Motion::Down, extend, page);
    if (pressed(ImGuiKey_Home)) buffer_.move(word ? Motion::TextStart : Motion::LineStart, extend);
    if (pressed(ImGuiKey_End)) buffer_.move(word ? Motion::TextEnd : Motion::LineEnd, extend);
    if (pressed(ImGuiKey_Backspace)) buffer_.erase_back(word);
    if (pressed(ImGuiKey_Delete)) buffer_.erase_forward(word);
    if (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter)) buffer_.new_line();
    if (pressed(ImGuiKey_Tab) && !word) buffer_.indent(extend);
    if (pressed(ImGuiKey_Escape)) focused_ = false;
    if (word && !io.KeyAlt) {
        if (pressed(ImGuiKey_A)) buffer_.select_all();
        if (pressed(ImGuiKey_Z)) extend ? buffer_.redo() : buffer_.undo();
        if (pressed(ImGuiKey_Y)) buffer_.redo();
        if (pressed(ImGuiKey_Space)) {
            offers_ = completions(buffer_.text(), buffer_.caret(), 0);
            chosen_ = 0;
        }
        take_clipboard_keys();
    }
    if (caret != buffer_.caret() || length != buffer_.text().size()) {
        offers_.clear();
        scroll_to_caret_ = true;
    }
}

void EditorPane::take_characters() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl && !io.KeyAlt) return;
    for (ImWchar c : io.InputQueueCharacters) {
        if (c < 32 || c == 127) continue;
        buffer_.type(utf8(c));
        offers_ = completions(buffer_.text(), buffer_.caret(), 2);
        chosen_ = 0;
        scroll_to_caret_ = true;
    }
}

void EditorPane::keep_caret_in_view(const View& view) {
    scroll_to_caret_ = false;
    const float x = view.cell.x * static_cast<float>(buffer_.column_of(buffer_.caret()));
    const float y = view.cell.y * static_cast<float>(buffer_.line_of(buffer_.caret()));
    const float wide = view.size.x - view.gutter - 2 * view.cell.x,
                high = view.size.y - 2 * view.cell.y;
    scroll_.x =
        std::clamp(scroll_.x, std::max(0.0f, x - wide), std::max(0.0f, x - 2 * view.cell.x));
    scroll_.y = std::clamp(scroll_.y, std::max(0.0f, y - high), y);
}

void EditorPane::draw_selection(const View& view) const {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const auto [begin, end] = buffer_.selection();
    if (begin == end) return;
    for (size_t n = std::max(view.first, buffer_.line_of(begin));
         n <= std::min(view.last, buffer_.line_of(end)); ++n) {
        const ImVec2 from = place_of(view, std::max(begin, buffer_.line_begin(n)));
        ImVec2 to = place_of(view, std::min(end, buffer_.line_end(n)));
        if (buffer_.line_end(n) < end) to.x += view.cell.x / 2;
        list->AddRectFilled(from, {to.x, to.y + view.cell.y}, colors_.selection);
    }
}

void EditorPane::draw_text(const View& view) const {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float down = std::floor((view.cell.y - ImGui::GetFontSize()) / 2);
    const std::string& text = buffer_.text();
    const size_t begin = buffer_.line_begin(view.first), end = buffer_.line_end(view.last);
    auto run = std::partition_point(runs_.begin(), runs_.end(),
                                    [&](const InkRun& r) { return r.end <= begin; });
    for (; run != runs_.end() && run->begin < end; ++run) {
        const ImU32 color = colors_.ink[static_cast<size_t>(run->ink)];
        // a comment may have several lines, and tabs
        size_t at = std::max(run->begin, begin);
        while (at < std::min(run->end, end)) {
            const size_t stop = std::min({run->end, text.find_first_of("\n\t", at), end});
            ImVec2 corner = place_of(view, at);
            corner.y += down;
            if (stop > at) list->AddText(corner, color, text.data() + at, text.data() + stop);
            at = stop + 1;
        }
    }
}

void EditorPane::draw_marks(const View& view, const std::vector<EditorMark>& marks) const {
    ImDrawList* list = ImGui::GetWindowDrawList();
    size_t told = SIZE_MAX;  // the line that has a message already
    for (const EditorMark& mark : marks) {
        const size_t begin = std::min(mark.begin, buffer_.text().size());
        const size_t n = buffer_.line_of(begin);
        if (n < view.first || n > view.last) continue;
        const size_t end = std::clamp(mark.end, begin, buffer_.line_end(n));
        const ImU32 color = mark.error ? colors_.error : colors_.warning;
        const ImVec2 from = place_of(view, begin);
        const float width = std::max(place_of(view, end).x - from.x, view.cell.x);
        draw_wave(list, {from.x, from.y + view.cell.y - 3}, width, color);
        if (n == told) continue;
        told = n;
        const float down = std::floor((view.cell.y - ImGui::GetFontSize()) / 2);
        const float right = place_of(view, buffer_.line_end(n)).x + 3 * view.cell.x;
        list->AddText({right, from.y + down}, (color & 0xffffff) | 0xb0000000,
                      mark.message.c_str());
        list->AddCircleFilled({view.origin.x + scroll_.x - view.gutter + view.cell.x * 0.8f,
                               from.y + view.cell.y / 2},
                              3, color);
    }
}

void EditorPane::draw_popup(const View& view) {
    if (offers_.empty() || !focused_) return;
    const size_t first = chosen_ < kOffersShown ? 0 : chosen_ - kOffersShown + 1;
    const size_t count = std::min(kOffersShown, offers_.size() - first);
    float names = 0;
    for (size_t i = first; i < first + count; ++i)
        names = std::max(names, ImGui::CalcTextSize(offers_[i].name.c_str()).x);
    const ManualLine manual = manual_line(offers_[chosen_].name);
    const float forms = std::min(view.size.x * 0.6f, 46 * view.cell.x),
                width = names + forms + 5 * view.cell.x;
    const float rows = static_cast<float>(count) + (manual.text.empty() ? 0.0f : 1.2f);
    const WordRange word = word_at(buffer_.text(), buffer_.caret());
    ImVec2 corner = place_of(view, word.begin);
    corner.y += view.cell.y + 2;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    corner.x = std::max(0.0f, std::min(corner.x - view.cell.x, display.x - width - 8));
    if (corner.y + rows * view.cell.y + 8 > display.y) corner.y -= (rows + 1) * view.cell.y + 12;
    ImDrawList* list = ImGui::GetForegroundDrawList();
    const ImVec2 low{corner.x + width, corner.y + rows * view.cell.y + 8};
    list->AddRectFilled({corner.x + 2, corner.y + 3}, {low.x + 3, low.y + 4}, 0x60000000, 5);
    list->AddRectFilled(corner, low, colors_.popup, 5);
    list->AddRect(corner, low, colors_.popup_selected, 5);
    list->PushClipRect(corner, {low.x - view.cell.x, low.y}, true);
    for (size_t i = 0; i < count; ++i) {
        const Completion& offer = offers_[first + i];
        const float y = corner.y + 4 + static_cast<float>(i) * view.cell.y;
        if (first + i == chosen_)
            list->AddRectFilled({corner.x + 3, y}, {low.x - 3, y + view.cell.y},
                                colors_.popup_selected, 3);
        list->AddText({corner.x + view.cell.x, y + 2}, colors_.ink[static_cast<size_t>(offer.ink)],
                      offer.name.c_str());
        list->AddText({corner.x + names + 3 * view.cell.x, y + 2}, colors_.line_number,
                      offer.form.c_str());
    }
    if (!manual.text.empty())
        list->AddText({corner.x + view.cell.x, low.y - view.cell.y - 2}, colors_.ink[0],
                      manual.text.c_str());
    list->PopClipRect();
}

void EditorPane::refresh() {
    if (colored_ == buffer_.text() && !runs_.empty()) return;
    colored_ = buffer_.text();
    runs_ = color_runs(colored_);
}

bool EditorPane::draw(const char* id, const std::vector<EditorMark>& marks) {
    const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
    if (size.x < 16 || size.y < 16) return false;
    ImGui::InvisibleButton(id, size);
    const bool hovered = ImGui::IsItemHovered();
    const std::string before = buffer_.text();
    View view = view_of(corner, size);
    take_mouse(view, hovered);
    if (hovered) take_wheel(view);
    if (focused_) {
        if (!take_completion_keys()) take_keys(view);
        take_characters();
    }
    if (scroll_to_caret_) keep_caret_in_view(view);
    refresh();
    view = view_of(corner, size);

    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 low{corner.x + size.x, corner.y + size.y};
    list->PushClipRect(corner, low, true);
    list->AddRectFilled(corner, low, colors_.background);
    const float caret_y = place_of(view, buffer_.caret()).y;
    list->AddRectFilled({corner.x, caret_y}, {low.x, caret_y + view.cell.y}, colors_.current_line);
    list->PushClipRect({corner.x + view.gutter - 4, corner.y}, low, true);
    draw_selection(view);
    draw_text(view);
    list->PopClipRect();
    list->AddRectFilled(corner, {corner.x + view.gutter - 6, low.y}, colors_.gutter);
    const size_t current = buffer_.line_of(buffer_.caret());
    for (size_t n = view.first; n <= view.last; ++n) {
        const std::string number = fmt::format("{}", n + 1);
        const float right =
            corner.x + view.gutter - 6 - view.cell.x * (static_cast<float>(number.size()) + 0.7f);
        list->AddText({right, view.origin.y + view.cell.y * static_cast<float>(n) + 2},
                      n == current ? colors_.ink[0] : colors_.line_number, number.c_str());
    }
    draw_marks(view, marks);
    if (focused_) {
        const ImVec2 caret = place_of(view, buffer_.caret());
        list->AddRectFilled({caret.x - 1, caret.y + 1}, {caret.x + 1, caret.y + view.cell.y - 1},
                            colors_.caret);
    }
    list->PopClipRect();
    draw_popup(view);
    return before != buffer_.text();
}

}  // namespace kinora::play
