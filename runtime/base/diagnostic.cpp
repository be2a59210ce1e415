// runtime/base/diagnostic.cpp: findings, the texts they point into, and how they print.
#include "runtime/base/diagnostic.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <tuple>

#include "runtime/base/check.h"
#include "runtime/base/display_path.h"

namespace kinora {

const char* severity_name(Severity severity) {
    constexpr const char* kNames[] = {"off", "hint", "info", "warning", "error"};
    return kNames[static_cast<int>(severity)];
}

uint32_t SourceMap::file_offset(uint32_t text_offset) const {
    auto after =
        std::upper_bound(segments.begin(), segments.end(), text_offset,
                         [](uint32_t offset, const Segment& s) { return offset < s.text_offset; });
    if (after == segments.begin()) return text_offset;
    const Segment& s = after[-1];
    return s.file_offset + (text_offset - s.text_offset);
}

Location SourceMap::location(uint32_t text_begin, uint32_t text_end) const {
    // The end maps through the last character, so that a range never swallows what lies between
    // two segments.
    uint32_t begin = file_offset(text_begin);
    uint32_t end = text_end > text_begin ? file_offset(text_end - 1) + 1 : begin;
    return {file, begin, std::max(begin, end)};
}

namespace {

std::vector<uint32_t> find_line_starts(std::string_view text) {
    std::vector<uint32_t> starts = {0};
    const char* begin = text.data();
    const char* end = begin + text.size();
    for (const char* p = begin; p < end;) {
        const char* newline = static_cast<const char*>(std::memchr(p, '\n', size_t(end - p)));
        if (!newline) break;
        p = newline + 1;
        starts.push_back(uint32_t(p - begin));
    }
    return starts;
}

}  // namespace

FileId SourceFiles::add(std::string name, std::string text) {
    auto file = std::make_shared<File>();
    file->name = std::move(name);
    file->text = std::move(text);
    std::lock_guard lock(texts_->mutex);
    texts_->files.push_back(std::move(file));
    return FileId(texts_->files.size() - 1);
}

SourceFiles SourceFiles::fork() const {
    SourceFiles other;
    std::lock_guard lock(texts_->mutex);
    other.texts_->files = texts_->files;
    return other;
}

FileId SourceFiles::count() const {
    std::lock_guard lock(texts_->mutex);
    return FileId(texts_->files.size());
}

SourceFiles::File& SourceFiles::at(FileId file) const {
    std::lock_guard lock(texts_->mutex);
    CHECK_LT(file, texts_->files.size());
    return *texts_->files[file];
}

const std::string& SourceFiles::name(FileId file) const {
    return at(file).name;
}
std::string_view SourceFiles::text(FileId file) const {
    return at(file).text;
}

// Lines are looked for when the first finding of a file is printed: most files have none.
void SourceFiles::File::find_lines() {
    std::call_once(lines_found, [&] { line_starts = find_line_starts(text); });
}

LineColumn SourceFiles::line_column(FileId file, uint32_t offset) const {
    File& f = at(file);
    f.find_lines();
    auto after = std::upper_bound(f.line_starts.begin(), f.line_starts.end(), offset);
    uint32_t start = after[-1];
    return {int(after - f.line_starts.begin()), int(offset - start) + 1};
}

std::string_view SourceFiles::line_text(FileId file, int line) const {
    File& f = at(file);
    f.find_lines();
    const std::vector<uint32_t>& starts = f.kept_starts.empty() ? f.line_starts : f.kept_starts;
    if (line < 1 || size_t(line) > starts.size()) return {};
    uint32_t begin = starts[size_t(line) - 1];
    // Not looked for: thousands of findings may stand in one long line.
    bool last = size_t(line) == starts.size();
    size_t end = last ? f.text.size() : starts[size_t(line)] - 1;
    std::string_view text = std::string_view(f.text).substr(begin, end - begin);
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
}

// Only where that is less than all.
void SourceFiles::File::cut_long_lines() {
    find_lines();
    if (!kept_starts.empty()) return;
    const auto kept_of = [&](size_t line) {
        const size_t end = line + 1 < line_starts.size() ? line_starts[line + 1] - 1 : text.size();
        return std::min<size_t>(end - line_starts[line], kLongestKept);
    };
    size_t room = line_starts.size() - 1;
    for (size_t line = 0; line < line_starts.size(); ++line) room += kept_of(line);
    if (room == text.size()) return;
    std::string kept;
    kept.reserve(room);
    for (size_t line = 0; line < line_starts.size(); ++line) {
        if (line > 0) kept += '\n';
        kept_starts.push_back(uint32_t(kept.size()));
        kept.append(text, line_starts[line], kept_of(line));
    }
    text = std::move(kept);
}

void SourceFiles::cut_long_lines() {
    std::lock_guard lock(texts_->mutex);
    for (const std::shared_ptr<File>& file : texts_->files) file->cut_long_lines();
}

namespace {

// Beyond so many, findings are no help, and their memory would grow past that of the input. Errors
// have some room more, so that none hides behind warnings.
constexpr size_t kMostFindings = 50'000, kMostErrors = 51'000;
constexpr FindingInfo kFindingsCut = finding_row(
    "FINDINGS_CUT", Severity::Warning, "more than {} findings; further ones are left out",
    "A file that is wrong in so many places is wrong throughout, or not what it says it is.", "");

}  // namespace

Severity Diagnostics::severity_of(const FindingInfo& info) const {
    Severity severity = judgement_ == Judgement::Validating ? info.severity : info.rendering;
    if (judgement_ == Judgement::Strict && info.severity == Severity::Error)
        severity = Severity::Error;
    for (const auto& [code, forced] : overrides_)
        if (code == info.code) severity = forced;
    return severity;
}

Finding& Diagnostics::add(const FindingInfo& info, Location where, std::string message) {
    std::lock_guard lock(mutex_);
    Severity severity = severity_of(info);
    if (findings_.size() == kMostFindings)
        findings_.push_back({&kFindingsCut,
                             kFindingsCut.severity,
                             Location{},
                             fmt::format(kFindingsCut.text, kMostFindings),
                             {},
                             {},
                             {}});
    size_t most = severity == Severity::Error ? kMostErrors : kMostFindings;
    if (findings_.size() > most) {
        static thread_local Finding unheard;
        return unheard = {&info, severity, where, {}, {}, {}, {}};
    }
    findings_.push_back(
        {&info, severity, where, display_path(std::move(message)), {}, info.fix, {}});
    return findings_.back();
}

void Diagnostics::set_severity(std::string_view code, Severity severity) {
    std::lock_guard lock(mutex_);
    overrides_.emplace_back(code, severity);
}

void Diagnostics::sort_unique() {
    std::lock_guard lock(mutex_);
    auto location = [](const Finding& f) { return std::tie(f.where.file, f.where.begin); };
    std::stable_sort(findings_.begin(), findings_.end(),
                     [&](const Finding& a, const Finding& b) { return location(a) < location(b); });
    std::vector<Finding> kept;
    std::set<std::pair<std::string_view, std::string>> here;  // of the location of kept.back()
    for (Finding& f : findings_) {
        if (!kept.empty() && location(kept.back()) != location(f)) here.clear();
        if (here.emplace(f.info->code, f.message).second) kept.push_back(std::move(f));
    }
    findings_ = std::move(kept);
}

void Diagnostics::drop_repeats(size_t first) {
    std::lock_guard lock(mutex_);
    for (size_t f = first; f < findings_.size();) {
        const Finding& last = findings_[f];
        auto same = [&](const Finding& other) {
            return other.info == last.info && other.where.file == last.where.file &&
                   other.where.begin == last.where.begin && other.message == last.message;
        };
        auto end = findings_.begin() + ptrdiff_t(f);
        if (last.severity != Severity::Error && std::any_of(findings_.begin(), end, same))
            findings_.erase(findings_.begin() + ptrdiff_t(f));
        else
            ++f;
    }
}

void Diagnostics::lower_errors(size_t first) {
    std::lock_guard lock(mutex_);
    if (judgement_ != Judgement::Rendering) return;
    for (size_t f = first; f < findings_.size(); ++f)
        findings_[f].severity = std::min(findings_[f].severity, Severity::Warning);
}

int Diagnostics::count(Severity severity) const {
    std::lock_guard lock(mutex_);
    return int(std::count_if(findings_.begin(), findings_.end(),
                             [&](const Finding& f) { return f.severity == severity; }));
}

namespace {

constexpr size_t kWidestLine = 200;  // of longer lines (number lists) a part is shown

bool continues_character(char c) {
    return (uint8_t(c) & 0xC0) == 0x80;
}

// Control characters (C0 but tabs, DEL, C1) as \xNN: a file cannot talk to the terminal.
std::string printable(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        uint8_t c = uint8_t(text[i]);
        bool c1 = c == 0xC2 && i + 1 < text.size() && uint8_t(text[i + 1]) < 0xA0;
        if (c1)
            out += fmt::format("\\x{:02x}", uint8_t(text[++i]));
        else if ((c < 0x20 && c != '\t') || c == 0x7F)
            out += fmt::format("\\x{:02x}", c);
        else
            out += char(c);
    }
    return out;
}

std::string location_text(Location where, const SourceFiles& files) {
    if (where.file == kNoFile) return "kinora";
    LineColumn at = files.line_column(where.file, where.begin);
    return fmt::format("{}:{}:{}", printable(display_path(files.name(where.file))), at.line,
                       at.column);
}

// As wide as the text is when printed.
std::string blanks(std::string_view text, char blank) {
    std::string out;
    for (char c : text)
        if (!continues_character(c)) out += c == '\t' && blank == ' ' ? '\t' : blank;
    return out;
}

std::string caret_text(Location where, const SourceFiles& files) {
    if (where.file == kNoFile) return {};
    LineColumn at = files.line_column(where.file, where.begin);
    std::string_view line = files.line_text(where.file, at.line);
    const bool cut = line.size() == SourceFiles::kLongestKept;
    if (cut && size_t(at.column) > line.size() + 1) return {};  // what stood there is gone
    size_t column = std::min(size_t(at.column) - 1, line.size());
    size_t first =
        column > kWidestLine / 2 && line.size() > kWidestLine ? column - kWidestLine / 2 : 0;
    size_t last = std::min(line.size(), first + kWidestLine);
    while (first < column && continues_character(line[first])) ++first;
    while (last > column && last < line.size() && continues_character(line[last])) --last;
    size_t length = where.end > where.begin ? where.end - where.begin : 1;
    size_t end = std::min(column + length, last);
    while (column > first && column < line.size() && continues_character(line[column])) --column;
    while (end < last && continues_character(line[end])) ++end;
    std::string before = printable(line.substr(first, column - first));
    std::string marked = printable(line.substr(column, end - column));
    std::string carets = blanks(marked, '~');
    if (carets.empty()) carets = "~";
    carets[0] = '^';
    return fmt::format("    {}{}{}\n    {}{}\n", before, marked,
                       printable(line.substr(end, last - end)), blanks(before, ' '), carets);
}

}  // namespace

std::string format_finding(const Finding& finding, const SourceFiles& files) {
    std::string text = fmt::format("{}: {}: {} [{}]\n", location_text(finding.where, files),
                                   severity_name(finding.severity), printable(finding.message),
                                   finding.info->code);
    if (!finding.id_path.empty()) text += fmt::format("    in {}\n", printable(finding.id_path));
    text += caret_text(finding.where, files);
    for (const Note& note : finding.notes) {
        text += fmt::format("{}: note: {}\n", location_text(note.where, files),
                            printable(note.message));
        text += caret_text(note.where, files);
    }
    if (!finding.help.empty()) text += fmt::format("    help: {}\n", printable(finding.help));
    return text;
}

namespace {

// Letters inserted, left out, changed, or swapped with their neighbour; `most` or more where there
// are that many.
size_t edit_distance(std::string_view a, std::string_view b, size_t most) {
    size_t apart = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
    if (apart >= most) return most;
    std::vector<size_t> last(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    size_t least_before = 0;
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t least = *std::min_element(row.begin(), row.end());
        if (std::min(least, least_before) >= most) return most;  // it never falls again
        least_before = least;
        next[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] != b[j - 1])});
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) next[j] = std::min(next[j], last[j - 2] + 1);
        }
        last.swap(row);
        row.swap(next);
    }
    return row[b.size()];
}

}  // namespace

std::string_view nearest_name(std::string_view word,
                              const std::vector<std::string_view>& candidates) {
    std::string_view best;
    size_t best_distance = std::max<size_t>(1, word.size() / 3) + 1;
    constexpr size_t kMostCandidates = 1000, kLongestWord = 100;
    if (word.size() > kLongestWord) return {};
    size_t tried = 0;
    for (std::string_view candidate : candidates) {
        if (++tried > kMostCandidates) break;
        size_t distance = edit_distance(word, candidate, best_distance);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace kinora
