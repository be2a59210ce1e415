// runtime/programs/validate/unified_diff.cpp: the longest common subsequence of the lines (libdtl),
// and hunks with three lines around.
#include "runtime/programs/validate/unified_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <dtl/dtl.hpp>
#include <unordered_map>
#include <vector>

namespace kinora {

namespace {

constexpr int kContext = 3;

std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        size_t end = text.find('\n');
        size_t length = end == text.npos ? text.size() : end + 1;
        lines.push_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    return lines;
}

// Which lines of each side the other has not.
struct LineDiff {
    std::vector<bool> removed, added;
};

// One side: its lines as numbers, and which of them the other side has somewhere.
struct Side {
    std::vector<int> lines;
    std::vector<int> shared;        // numbers
    std::vector<size_t> shared_at;  // where they are

    void keep_shared(const Side& other, size_t numbers) {
        std::vector<bool> there(numbers, false);
        for (int line : other.lines) there[size_t(line)] = true;
        for (size_t i = 0; i < lines.size(); ++i) {
            if (!there[size_t(lines[i])]) continue;
            shared.push_back(lines[i]);
            shared_at.push_back(i);
        }
    }
};

// A line that the other side has nowhere is removed or added in any case. Without those the search
// for the longest common subsequence is short where much has changed.
LineDiff compare_lines(const std::vector<std::string_view>& before,
                       const std::vector<std::string_view>& after) {
    std::unordered_map<std::string_view, int> numbers;
    auto numbered = [&](const std::vector<std::string_view>& lines) {
        Side side;
        for (std::string_view line : lines)
            side.lines.push_back(numbers.try_emplace(line, int(numbers.size())).first->second);
        return side;
    };
    Side a = numbered(before), b = numbered(after);
    a.keep_shared(b, numbers.size());
    b.keep_shared(a, numbers.size());
    dtl::Diff<int, std::vector<int>> search(a.shared, b.shared);
    search.compose();
    LineDiff diff{std::vector<bool>(before.size(), true), std::vector<bool>(after.size(), true)};
    size_t x = 0, y = 0;
    for (const auto& [line, edit] : search.getSes().getSequence()) {
        if (edit.type == dtl::SES_COMMON)
            diff.removed[a.shared_at[x]] = diff.added[b.shared_at[y]] = false;
        x += edit.type != dtl::SES_ADD;
        y += edit.type != dtl::SES_DELETE;
    }
    return diff;
}

// One line of a hunk.
struct Line {
    char mark;
    std::string_view text;
};

std::string line_text(const Line& line) {
    std::string text = line.mark + std::string(line.text);
    if (!line.text.ends_with('\n')) text += "\n\\ No newline at end of file\n";
    return text;
}

std::string hunk_text(int a_begin, int a_count, int b_begin, int b_count,
                      const std::vector<Line>& lines) {
    // Of no lines, the number is that of the line before.
    std::string text = fmt::format("@@ -{},{} +{},{} @@\n", a_begin + (a_count ? 1 : 0), a_count,
                                   b_begin + (b_count ? 1 : 0), b_count);
    for (const Line& line : lines) text += line_text(line);
    return text;
}

}  // namespace

std::string unified_diff(std::string_view before, std::string_view after,
                         const std::string& before_name, const std::string& after_name) {
    if (before == after) return {};
    std::vector<std::string_view> a = split_lines(before), b = split_lines(after);
    LineDiff diff = compare_lines(a, b);
    std::string text = fmt::format("--- {}\n+++ {}\n", before_name, after_name);
    size_t x = 0, y = 0, written_x = 0;  // lines of a before written_x stand in some hunk
    while (x < a.size() || y < b.size()) {
        bool differs = (x < a.size() && diff.removed[x]) || (y < b.size() && diff.added[y]);
        if (!differs) {
            ++x, ++y;
            continue;
        }
        size_t lead = std::min<size_t>(kContext, x - written_x);
        size_t a_begin = x - lead, b_begin = y - lead;
        std::vector<Line> lines;
        for (size_t i = a_begin; i < x; ++i) lines.push_back({' ', a[i]});
        size_t same = 0;  // equal lines since the last difference
        while (x < a.size() || y < b.size()) {
            if (x < a.size() && diff.removed[x]) {
                lines.push_back({'-', a[x++]});
                same = 0;
            } else if (y < b.size() && diff.added[y]) {
                lines.push_back({'+', b[y++]});
                same = 0;
            } else if (same == 2 * kContext) {
                break;
            } else {
                lines.push_back({' ', a[x]});
                ++x, ++y, ++same;
            }
        }
        size_t surplus = same > kContext ? same - kContext : 0;
        lines.resize(lines.size() - surplus);
        x -= surplus, y -= surplus;
        written_x = x;
        text += hunk_text(int(a_begin), int(x - a_begin), int(b_begin), int(y - b_begin), lines);
    }
    return text;
}

}  // namespace kinora
