// runtime/programs/common/finding_lines.h: which lines of many findings are printed.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora {

// What a program prints of the findings of one run: kMostLines lines, the most serious findings
// first. Of each code the first finding has its first line before any has all of its lines, and
// before a second one is shown. The first error of a code is shown even where no line is left.
class FindingLines {
  public:
    static constexpr size_t kMostLines = 20;

    // `all`: every finding with all its lines, in their order.
    explicit FindingLines(bool all) : all_(all) {}

    // `text` is a finding as format_finding writes it.
    void add(Severity severity, std::string_view code, std::string text);
    // The lines of what was added since the last call.
    std::string take();
    // One line that counts what has not been shown since it last did; "" for nothing.
    std::string take_rest();

  private:
    struct Entry {
        Severity severity;
        std::string code, text;
        size_t lines = 0;  // of its text
        size_t shown = 0;  // of these
    };

    void grant(Entry& entry, size_t lines);

    bool all_;
    size_t left_ = kMostLines - 2;  // two lines are for what take_rest and the programs add
    std::vector<Entry> entries_;
    std::map<std::string, size_t> shown_of_, hidden_of_;  // findings by code
};

}  // namespace kinora
