// runtime/base/diagnostic.h: findings about the user's input. A finding is a row of its library's
// findings.def plus values, a location (file and byte range) and, in documents, an id path.
// Reading never gives up at the first one: report and carry on.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace kinora {

enum class Severity : uint8_t { Off, Hint, Info, Warning, Error };
const char* severity_name(Severity severity);  // "warning", ...

// One kind of finding. `text` is a fmt format string for the values given to report().
struct FindingInfo {
    const char* code;         // "ANIM_TARGET_UNRESOLVED": stable, printed in brackets
    Severity rendering;       // where the file is used all the same (Judgement)
    Severity severity;        // where it is validated; Diagnostics may override it per code
    const char* text;         // "channel target '{}' names nothing"
    const char* explanation;  // a paragraph for --explain: why it matters
    const char* fix;          // what to do, printed as a help line; "" if nothing general
};

// A row of a findings.def: one severity, or that of rendering before that of validating.
constexpr FindingInfo finding_row(const char* code, Severity both, const char* text,
                                  const char* explanation, const char* fix) {
    return {code, both, both, text, explanation, fix};
}
constexpr FindingInfo finding_row(const char* code, Severity rendering, Severity validating,
                                  const char* text, const char* explanation, const char* fix) {
    return {code, rendering, validating, text, explanation, fix};
}

// Which severity a finding has. Rendering: a picture is made of what is there, so that what is left
// out or repaired is a Warning, and an Error means that there is no picture. Strict: what is an
// Error in a file that is validated is one here too.
enum class Judgement : uint8_t { Validating, Rendering, Strict };

using FileId = uint32_t;
inline constexpr FileId kNoFile = ~0u;

// A byte range [begin, end) of a registered file; line:column are computed when printed.
struct Location {
    FileId file = kNoFile;
    uint32_t begin = 0;
    uint32_t end = 0;
};

// Maps offsets of a decoded text (an XML text node after entities, CDATA, newline folding) to byte
// offsets of the file it came from. Segments are sorted by text offset; within one, offsets run in
// step. A default-made map is the identity from `file_begin` on.
struct SourceMap {
    struct Segment {
        uint32_t text_offset;
        uint32_t file_offset;
    };
    FileId file = kNoFile;
    std::vector<Segment> segments;

    uint32_t file_offset(uint32_t text_offset) const;
    Location location(uint32_t text_begin, uint32_t text_end) const;
};

struct LineColumn {
    int line = 0;    // from 1
    int column = 0;  // from 1, in bytes
};

// The texts that locations speak of. Thread-safe; ids stay valid for the life of the object and of
// its copies, which share the texts.
class SourceFiles {
  public:
    // One that begins with these texts and ids; what is added to it is not added here.
    SourceFiles fork() const;
    // Keeps a copy of `text`.
    FileId add(std::string name, std::string text);
    FileId count() const;  // ids are 0 .. count() - 1
    const std::string& name(FileId file) const;
    std::string_view text(FileId file) const;
    LineColumn line_column(FileId file, uint32_t offset) const;
    std::string_view line_text(FileId file, int line) const;
    // Frees memory once everything is read: of lines longer than kLongestKept bytes (of numbers, as
    // a rule) their beginnings alone stay. Lines and columns are told as before. Views of texts
    // end.
    void cut_long_lines();
    static constexpr uint32_t kLongestKept = 1024;

  private:
    struct File {
        std::string name;
        std::string text;
        std::once_flag lines_found;
        std::vector<uint32_t> line_starts;
        std::vector<uint32_t> kept_starts;  // in `text`; empty: the same
        void find_lines();
        void cut_long_lines();
    };
    struct Texts {
        std::mutex mutex;
        std::vector<std::shared_ptr<File>> files;
    };
    File& at(FileId file) const;
    std::shared_ptr<Texts> texts_ = std::make_shared<Texts>();
};

// A further location that explains a finding: "in expansion of macro 'X'", "first defined here".
struct Note {
    Location where;
    std::string message;
};

struct Finding {
    const FindingInfo* info;
    Severity severity;
    Location where;
    std::string message;
    std::string id_path;  // "library_effects/effect[@id='Matte']/profile_RSL", or empty
    std::string help;     // info->fix, or a particular suggestion ("did you mean 'diffuse'?")
    std::vector<Note> notes;
};

// Collects findings. Thread-safe. The order of findings is the order of report() calls.
class Diagnostics {
  public:
    SourceFiles files;

    // Adds a finding; `args` fill info.text. Returns it so that a caller can add id_path, help or
    // notes at once (the reference is valid until the next report()).
    template <class... Args>
    Finding& report(const FindingInfo& info, Location where, const Args&... args) {
        return add(info, where, fmt::vformat(info.text, fmt::make_format_args(args...)));
    }
    Finding& add(const FindingInfo& info, Location where, std::string message);

    void set_severity(std::string_view code, Severity severity);
    // Of the findings to come.
    void judge(Judgement judgement) { judgement_ = judgement; }
    const std::vector<Finding>& findings() const { return findings_; }
    int count(Severity severity) const;
    bool has_errors() const { return count(Severity::Error) > 0; }
    void clear() { findings_.clear(); }
    // Orders findings by location (those of one location as reported) and drops all but the
    // first with the same code, location and message.
    void sort_unique();
    // Drops findings from the `first` on that say what an earlier one says (code, location,
    // message); never errors.
    void drop_repeats(size_t first);
    // Findings from the `first` on are of a file that another one names. In Rendering none of them
    // is more than a Warning: the other file is shown without it.
    void lower_errors(size_t first);

  private:
    Severity severity_of(const FindingInfo& info) const;

    mutable std::mutex mutex_;
    std::vector<Finding> findings_;
    std::vector<std::pair<std::string, Severity>> overrides_;
    Judgement judgement_ = Judgement::Validating;
};

// "file:line:col: severity: message [CODE]", then the source line with a caret range, notes and a
// help line; ends with a newline. A finding with no file prints "kinora: severity: message [CODE]".
std::string format_finding(const Finding& finding, const SourceFiles& files);

// The candidate nearest to `word` by edit distance, or "" when none is near (more than a third of
// its letters differ). For "did you mean".
std::string_view nearest_name(std::string_view word,
                              const std::vector<std::string_view>& candidates);

}  // namespace kinora
