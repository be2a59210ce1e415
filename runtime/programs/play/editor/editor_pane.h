// runtime/programs/play/editor/editor_pane.h: a text editor with colours, as a Dear ImGui widget.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/programs/play/editor/language.h"
#include "runtime/programs/play/editor/text_buffer.h"

namespace kinora::play {

// A part of the text that a finding speaks of.
struct EditorMark {
    size_t begin = 0, end = 0;
    bool error = true;  // else a warning
    std::string message;
};

struct EditorColors {
    ImU32 ink[static_cast<size_t>(Ink::Count)];
    ImU32 background, gutter, line_number, current_line, selection, caret;
    ImU32 error, warning, popup, popup_selected;
};

class EditorPane {
  public:
    explicit EditorPane(const EditorColors& colors) : colors_(colors) {}

    // Draws in the rest of the window, in the current font (of fixed width). True: the text
    // changed.
    bool draw(const char* id, const std::vector<EditorMark>& marks);

    TextBuffer& buffer() { return buffer_; }
    bool focused() const { return focused_; }
    void focus(bool on) { focused_ = on; }
    void show_caret() { scroll_to_caret_ = true; }
    // Of the word under the caret, or of the call around it.
    ManualLine hint() const;

  private:
    struct View {
        ImVec2 origin, size, cell;  // of the text's first character; of the pane; of a character
        float gutter;
        size_t first, last;  // lines seen
    };
    View view_of(ImVec2 corner, ImVec2 size) const;
    ImVec2 place_of(const View& view, size_t at) const;
    size_t under(const View& view, ImVec2 point) const;
    void take_mouse(const View& view, bool hovered);
    void take_wheel(const View& view);
    void take_keys(const View& view);
    bool take_clipboard_keys();
    void take_characters();
    bool take_completion_keys();
    void keep_caret_in_view(const View& view);
    void draw_selection(const View& view) const;
    void draw_text(const View& view) const;
    void draw_marks(const View& view, const std::vector<EditorMark>& marks) const;
    void draw_popup(const View& view);
    void accept_completion();
    void refresh();

    EditorColors colors_;
    TextBuffer buffer_;
    std::string colored_;  // the text that runs_ belongs to
    std::vector<InkRun> runs_;
    std::vector<Completion> offers_;
    size_t chosen_ = 0;
    ImVec2 scroll_{0, 0};
    bool focused_ = false, dragging_ = false, scroll_to_caret_ = false;
};

}  // namespace kinora::play
