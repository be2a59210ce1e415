// runtime/programs/play/editor/text_buffer.h: a text that is being edited: caret, selection, undo.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinora::play {

enum class Motion : uint8_t {
    Left,
    Right,
    WordLeft,
    WordRight,
    Up,
    Down,
    LineStart,  // the first character that is no blank, then column 0
    LineEnd,
    TextStart,
    TextEnd,
};

// Offsets are bytes of UTF-8 and never fall within a character.
class TextBuffer {
  public:
    explicit TextBuffer(std::string text = {});

    const std::string& text() const { return text_; }
    size_t caret() const { return caret_; }
    size_t anchor() const { return anchor_; }  // the other end of the selection
    std::pair<size_t, size_t> selection() const;
    std::string_view selected() const;

    void reset(std::string text);        // another text: nothing to undo
    void replace_all(std::string text);  // the same text, changed elsewhere: can be undone

    void set_caret(size_t caret, bool extend = false);
    void move(Motion motion, bool extend = false, size_t rows = 1);
    void select_word(size_t at);
    void select_all();

    void type(std::string_view text);  // in place of the selection
    void replace(size_t begin, size_t end, std::string_view text);
    void erase_back(bool word = false);
    void erase_forward(bool word = false);
    void new_line();  // indented as this line is, and one step more behind a brace
    void indent(bool back);

    bool undo();
    bool redo();

    size_t line_count() const { return lines_.size(); }
    size_t line_of(size_t at) const;
    size_t line_begin(size_t line) const { return lines_[line]; }
    size_t line_end(size_t line) const;  // without its newline
    std::string_view line(size_t line) const;
    size_t column_of(size_t at) const;  // characters, a tab up to the next multiple of kTab
    size_t at_column(size_t line, size_t column) const;

    static constexpr size_t kTab = 4;

  private:
    struct Edit {
        size_t at;
        std::string removed, inserted;
        size_t caret, anchor;  // before it
    };
    void change(size_t begin, size_t end, std::string_view inserted);
    void substitute(size_t at, size_t removed, std::string_view inserted);
    bool continues(const Edit& last, size_t begin, size_t end, std::string_view inserted) const;
    size_t next(size_t at) const;
    size_t previous(size_t at) const;
    size_t word_left(size_t at) const;
    size_t word_right(size_t at) const;
    size_t first_of_line(size_t at) const;

    std::string text_;
    std::vector<size_t> lines_;
    size_t caret_ = 0, anchor_ = 0, wanted_column_ = 0;
    std::vector<Edit> done_, undone_;
    bool joinable_ = false;  // the next typed character belongs to the last edit
};

}  // namespace kinora::play
