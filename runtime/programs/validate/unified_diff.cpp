// runtime/programs/validate/unified_diff.cpp: Myers' algorithm (An O(ND) difference algorithm,
// 1986) in its linear-space form, and hunks with three lines around.
#include "runtime/programs/validate/unified_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

namespace kinora {

namespace {

constexpr int kContext = 3;
constexpr int kMostDifferences = 4000;  // in one search; beyond, the range is replaced as a whole

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

struct Range {
    int begin, end;
    int size() const { return end - begin; }
};
struct Point {
    int x, y;
};

// Marks the lines of each side that the other has not.
class LineDiff {
  public:
    LineDiff(const std::vector<std::string_view>& a, const std::vector<std::string_view>& b)
        : removed(a.size()), added(b.size()) {
        std::unordered_map<std::string_view, int> numbers;
        for (auto line : a)
            a_.push_back(numbers.try_emplace(line, int(numbers.size())).first->second);
        for (auto line : b)
            b_.push_back(numbers.try_emplace(line, int(numbers.size())).first->second);
        compare({0, int(a.size())}, {0, int(b.size())});
    }
    std::vector<bool> removed, added;

  private:
    void compare(Range a, Range b) {
        while (a.size() && b.size() && a_[size_t(a.begin)] == b_[size_t(b.begin)])
            ++a.begin, ++b.begin;
        while (a.size() && b.size() && a_[size_t(a.end) - 1] == b_[size_t(b.end) - 1])
            --a.end, --b.end;
        std::optional<Point> middle;
        if (a.size() && b.size()) middle = split(a, b);
        if (!middle) {
            std::fill(removed.begin() + a.begin, removed.begin() + a.end, true);
            std::fill(added.begin() + b.begin, added.begin() + b.end, true);
            return;
        }
        compare({a.begin, middle->x}, {b.begin, middle->y});
        compare({middle->x, a.end}, {middle->y, b.end});
    }

    // Where the paths from both ends meet; nothing when it is too far, or would not split.
    std::optional<Point> split(Range a, Range b) {
        int n = a.size(), m = b.size(), most = std::min((n + m + 1) / 2, kMostDifferences);
        std::vector<int> forward(2 * size_t(most) + 3, 0), backward(2 * size_t(most) + 3, 0);
        auto at = [&](std::vector<int>& v, int k) -> int& { return v[size_t(k + most + 1)]; };
        int delta = n - m;
        for (int d = 0; d <= most; ++d) {
            for (int k = -d; k <= d; k += 2) {
                int x = d == 0 ? 0
                        : k == -d || (k != d && at(forward, k - 1) < at(forward, k + 1))
                            ? at(forward, k + 1)
                            : at(forward, k - 1) + 1;
                int y = x - k;
                while (x < n && y < m && y >= 0 &&
                       a_[size_t(a.begin + x)] == b_[size_t(b.begin + y)])
                    ++x, ++y;
                at(forward, k) = x;
                int back = delta - k;
                if (delta % 2 && std::abs(back) < d && x + at(backward, back) >= n)
                    return inner({a.begin + x, b.begin + y}, a, b);
            }
            for (int k = -d; k <= d; k += 2) {
                int x = d == 0 ? 0
                        : k == -d || (k != d && at(backward, k - 1) < at(backward, k + 1))
                            ? at(backward, k + 1)
                            : at(backward, k - 1) + 1;
                int y = x - k;
                while (x < n && y < m && y >= 0 &&
                       a_[size_t(a.end - 1 - x)] == b_[size_t(b.end - 1 - y)])
                    ++x, ++y;
                at(backward, k) = x;
                int front = delta - k;
                if (delta % 2 == 0 && std::abs(front) <= d && x + at(forward, front) >= n)
                    return inner({a.end - x, b.end - y}, a, b);
            }
        }
        return std::nullopt;
    }

    static std::optional<Point> inner(Point p, Range a, Range b) {
        bool inside = p.x >= a.begin && p.x <= a.end && p.y >= b.begin && p.y <= b.end;
        bool splits = (p.x != a.begin || p.y != b.begin) && (p.x != a.end || p.y != b.end);
        return inside && splits ? std::optional(p) : std::nullopt;
    }

    std::vector<int> a_, b_;
};

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
    LineDiff diff(a, b);
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
