// runtime/programs/play/editor/text_buffer.cpp: edits, motions and lines.
#include "runtime/programs/play/editor/text_buffer.h"

#include <algorithm>
#include <cctype>

namespace kinora::play {

namespace {

bool continues_character(char c) {
    return (c & 0xc0) == 0x80;
}
bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || (c & 0x80);
}
bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

std::vector<size_t> line_starts(std::string_view text) {
    std::vector<size_t> starts{0};
    for (size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\n') starts.push_back(i + 1);
    return starts;
}

}  // namespace

TextBuffer::TextBuffer(std::string text) {
    reset(std::move(text));
}

std::pair<size_t, size_t> TextBuffer::selection() const {
    return std::minmax(caret_, anchor_);
}

std::string_view TextBuffer::selected() const {
    const auto [begin, end] = selection();
    return std::string_view(text_).substr(begin, end - begin);
}

void TextBuffer::reset(std::string text) {
    text_ = std::move(text);
    lines_ = line_starts(text_);
    caret_ = anchor_ = wanted_column_ = 0;
    done_.clear();
    undone_.clear();
    joinable_ = false;
}

// Only the middle that differs is an edit, so that the caret stays where it was.
void TextBuffer::replace_all(std::string text) {
    size_t same = 0;
    const size_t shorter = std::min(text.size(), text_.size());
    while (same < shorter && text[same] == text_[same]) ++same;
    size_t tail = 0;
    while (tail < shorter - same && text[text.size() - 1 - tail] == text_[text_.size() - 1 - tail])
        ++tail;
    while (same > 0 && same < text_.size() && continues_character(text_[same])) --same;
    while (tail > 0 && continues_character(text_[text_.size() - tail])) --tail;
    const size_t end = text_.size() - tail;
    if (same == end && text.size() == text_.size()) return;
    const size_t caret = caret_;
    const auto inserted = std::string_view(text).substr(same, text.size() - tail - same);
    joinable_ = false;
    change(same, end, inserted);
    joinable_ = false;
    set_caret(caret <= same ? caret : caret >= end ? caret - end + same + inserted.size() : same);
}

size_t TextBuffer::next(size_t at) const {
    if (at < text_.size()) ++at;
    while (at < text_.size() && continues_character(text_[at])) ++at;
    return at;
}

size_t TextBuffer::previous(size_t at) const {
    if (at > 0) --at;
    while (at > 0 && continues_character(text_[at])) --at;
    return at;
}

size_t TextBuffer::word_left(size_t at) const {
    while (at > 0 && !is_word(text_[at - 1])) --at;
    while (at > 0 && is_word(text_[at - 1])) --at;
    return at;
}

size_t TextBuffer::word_right(size_t at) const {
    while (at < text_.size() && !is_word(text_[at])) ++at;
    while (at < text_.size() && is_word(text_[at])) ++at;
    return at;
}

size_t TextBuffer::first_of_line(size_t at) const {
    const size_t begin = line_begin(line_of(at)), end = line_end(line_of(at));
    size_t first = begin;
    while (first < end && is_blank(text_[first])) ++first;
    return first == at ? begin : first;
}

void TextBuffer::set_caret(size_t caret, bool extend) {
    caret = std::min(caret, text_.size());
    while (caret > 0 && caret < text_.size() && continues_character(text_[caret])) --caret;
    caret_ = caret;
    if (!extend) anchor_ = caret;
    wanted_column_ = column_of(caret_);
    joinable_ = false;
}

void TextBuffer::move(Motion motion, bool extend, size_t rows) {
    const auto [begin, end] = selection();
    const size_t line = line_of(caret_);
    switch (motion) {
        case Motion::Left:
            return set_caret(!extend && begin != end ? begin : previous(caret_), extend);
        case Motion::Right:
            return set_caret(!extend && begin != end ? end : next(caret_), extend);
        case Motion::WordLeft:
            return set_caret(word_left(caret_), extend);
        case Motion::WordRight:
            return set_caret(word_right(caret_), extend);
        case Motion::LineStart:
            return set_caret(first_of_line(caret_), extend);
        case Motion::LineEnd:
            return set_caret(line_end(line), extend);
        case Motion::TextStart:
            return set_caret(0, extend);
        case Motion::TextEnd:
            return set_caret(text_.size(), extend);
        case Motion::Up:
        case Motion::Down: {
            const size_t column = wanted_column_;
            if (motion == Motion::Up)
                set_caret(line < rows ? 0 : at_column(line - rows, column), extend);
            else
                set_caret(
                    line + rows >= line_count() ? text_.size() : at_column(line + rows, column),
                    extend);
            wanted_column_ = column;
            return;
        }
    }
}

void TextBuffer::select_word(size_t at) {
    size_t begin = std::min(at, text_.size()), end = begin;
    while (begin > 0 && is_word(text_[begin - 1])) --begin;
    while (end < text_.size() && is_word(text_[end])) ++end;
    if (begin == end) end = next(end);
    set_caret(begin);
    set_caret(end, true);
}

void TextBuffer::select_all() {
    set_caret(0);
    set_caret(text_.size(), true);
}

void TextBuffer::substitute(size_t at, size_t removed, std::string_view inserted) {
    text_.replace(at, removed, inserted);
    lines_ = line_starts(text_);
}

// Characters typed one after another, or erased, are undone together; a new word begins an edit.
bool TextBuffer::continues(const Edit& last, size_t begin, size_t end,
                           std::string_view inserted) const {
    if (!joinable_ || last.inserted.empty() != inserted.empty()) return false;
    if (inserted.empty()) return end == last.at || begin == last.at;
    if (begin != end || begin != last.at + last.inserted.size() || !last.removed.empty())
        return false;
    const bool blank_before = std::isspace(static_cast<unsigned char>(last.inserted.back()));
    return !blank_before || std::isspace(static_cast<unsigned char>(inserted.front()));
}

void TextBuffer::change(size_t begin, size_t end, std::string_view inserted) {
    if (begin == end && inserted.empty()) return;
    std::string removed = text_.substr(begin, end - begin);
    if (!done_.empty() && continues(done_.back(), begin, end, inserted)) {
        Edit& last = done_.back();
        last.removed = end == last.at ? removed + last.removed : last.removed + removed;
        last.at = std::min(last.at, begin);
        last.inserted += inserted;
    } else {
        done_.push_back({begin, std::move(removed), std::string(inserted), caret_, anchor_});
    }
    undone_.clear();
    substitute(begin, end - begin, inserted);
    set_caret(begin + inserted.size());
    joinable_ = true;
}

void TextBuffer::type(std::string_view text) {
    const auto [begin, end] = selection();
    if (text.size() > 4 || begin != end) joinable_ = false;
    change(begin, end, text);
}

void TextBuffer::replace(size_t begin, size_t end, std::string_view text) {
    joinable_ = false;
    change(begin, end, text);
    joinable_ = false;
}

void TextBuffer::erase_back(bool word) {
    const auto [begin, end] = selection();
    if (begin != end) return replace(begin, end, "");
    change(word ? word_left(caret_) : previous(caret_), caret_, "");
}

void TextBuffer::erase_forward(bool word) {
    const auto [begin, end] = selection();
    if (begin != end) return replace(begin, end, "");
    change(caret_, word ? word_right(caret_) : next(caret_), "");
}

void TextBuffer::new_line() {
    const size_t at = selection().first, begin = line_begin(line_of(at));
    size_t first = begin;
    while (first < at && is_blank(text_[first])) ++first;
    std::string inserted = "\n" + text_.substr(begin, first - begin);
    if (at > begin && text_[at - 1] == '{') inserted += std::string(kTab, ' ');
    joinable_ = false;
    change(at, selection().second, inserted);
}

// One step of all lines selected; without a selection a tab is blanks up to the next column.
void TextBuffer::indent(bool back) {
    const auto [begin, end] = selection();
    const size_t first = line_of(begin), last = line_of(end);
    if (!back && first == last) return type(std::string(kTab - column_of(caret_) % kTab, ' '));
    std::string block;
    for (size_t n = first; n <= last; ++n) {
        std::string text(line(n));
        if (back) {
            size_t blanks = 0;
            while (blanks < kTab && blanks < text.size() && text[blanks] == ' ') ++blanks;
            if (!blanks && !text.empty() && text[0] == '\t') blanks = 1;
            text.erase(0, blanks);
        } else if (!text.empty()) {
            text.insert(0, kTab, ' ');
        }
        block += (n == first ? "" : "\n") + text;
    }
    const size_t from = line_begin(first), to = line_end(last);
    if (text_.compare(from, to - from, block) == 0) return;
    replace(from, to, block);
    if (begin != end) {
        set_caret(from);
        set_caret(from + block.size(), true);
    }
}

bool TextBuffer::undo() {
    if (done_.empty()) return false;
    Edit edit = std::move(done_.back());
    done_.pop_back();
    substitute(edit.at, edit.inserted.size(), edit.removed);
    set_caret(edit.anchor);
    set_caret(edit.caret, true);
    undone_.push_back(std::move(edit));
    return true;
}

bool TextBuffer::redo() {
    if (undone_.empty()) return false;
    Edit edit = std::move(undone_.back());
    undone_.pop_back();
    substitute(edit.at, edit.removed.size(), edit.inserted);
    set_caret(edit.at + edit.inserted.size());
    done_.push_back(std::move(edit));
    return true;
}

size_t TextBuffer::line_of(size_t at) const {
    return static_cast<size_t>(std::upper_bound(lines_.begin(), lines_.end(), at) -
                               lines_.begin()) -
           1;
}

size_t TextBuffer::line_end(size_t line) const {
    return line + 1 < lines_.size() ? lines_[line + 1] - 1 : text_.size();
}

std::string_view TextBuffer::line(size_t line) const {
    return std::string_view(text_).substr(line_begin(line), line_end(line) - line_begin(line));
}

size_t TextBuffer::column_of(size_t at) const {
    size_t column = 0;
    for (size_t i = line_begin(line_of(at)); i < at; i = next(i))
        column += text_[i] == '\t' ? kTab - column % kTab : 1;
    return column;
}

size_t TextBuffer::at_column(size_t line, size_t column) const {
    size_t at = line_begin(line), reached = 0;
    while (at < line_end(line)) {
        const size_t width = text_[at] == '\t' ? kTab - reached % kTab : 1;
        if (reached + (width + 1) / 2 > column) break;
        reached += width;
        at = next(at);
    }
    return at;
}

}  // namespace kinora::play
