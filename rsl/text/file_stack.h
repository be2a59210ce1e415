// rsl/text/file_stack.h: the texts being read: the source, and the files that include one another.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rsl/text/condition.h"
#include "rsl/text/lexer.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// A text to read. The views live as long as the reading.
struct SourceText {
    std::string_view text;
    const SourceMap* map = nullptr;
    std::string path;
    bool standard = false;  // a customary header of ours
};

// Raw tokens come from the innermost file until it is left. What is wrong with a token is reported,
// except in a group of an #if that does not count.
class FileStack {
  public:
    explicit FileStack(Reporter& reporter) : reporter_(reporter) {}

    // Only while no group is being skipped: an #if of a file then never depends on its includer's.
    void enter(SourceText source);
    // Ends the innermost file: its open #if are errors.
    void leave();
    size_t depth() const { return files_.size(); }

    Token next();
    Token peek() const { return ahead().next(); }
    Lexer ahead() const { return files_.back().lexer; }  // a copy, to look ahead
    std::string_view rest_of_line() { return files_.back().lexer.rest_of_line(); }

    const std::string& path() const { return files_.back().path; }
    bool in_standard_header() const { return files_.back().standard; }
    ConditionStack& conditions() { return files_.back().conditions; }
    bool skipping() const { return files_.back().conditions.skipping(); }

  private:
    struct File {
        Lexer lexer;
        std::string path;
        bool standard;
        ConditionStack conditions;
    };
    void report_trouble();

    Reporter& reporter_;
    std::vector<File> files_;
};

}  // namespace kinora::rsl
