// runtime/programs/common/finding_lines.cpp: lines are dealt out in rounds.
#include "runtime/programs/common/finding_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace kinora {

namespace {

constexpr size_t kMostCodesNamed = 6;

// The text's first `count` lines.
std::string_view first_lines(std::string_view text, size_t count) {
    size_t end = 0;
    for (; count > 0 && end < text.size(); --count) end = text.find('\n', end) + 1;
    return text.substr(0, end);
}

}  // namespace

void FindingLines::add(Severity severity, std::string_view code, std::string text) {
    if (!text.ends_with('\n')) text += '\n';
    size_t lines = size_t(std::count(text.begin(), text.end(), '\n'));
    entries_.push_back({severity, std::string(code), std::move(text), lines});
}

// All or nothing.
void FindingLines::grant(Entry& entry, size_t lines) {
    size_t more = lines - entry.shown;
    if (more > left_) return;
    if (entry.shown == 0 && lines > 0) ++shown_of_[entry.code];
    left_ -= more;
    entry.shown = lines;
}

std::string FindingLines::take() {
    auto more_serious = [](const Entry& a, const Entry& b) { return a.severity > b.severity; };
    if (!all_) std::stable_sort(entries_.begin(), entries_.end(), more_serious);
    if (all_)
        for (Entry& entry : entries_) entry.shown = entry.lines;
    std::vector<Entry*> first;  // of the codes that were not shown before
    std::set<std::string_view> codes;
    for (Entry& entry : entries_)
        if (!all_ && shown_of_.count(entry.code) == 0 && codes.insert(entry.code).second)
            first.push_back(&entry);
    for (Entry* entry : first) {
        if (entry->severity == Severity::Error && left_ == 0) left_ = 1;
        grant(*entry, 1);
    }
    for (Entry* entry : first)
        if (entry->shown > 0) grant(*entry, entry->lines);
    for (Entry& entry : entries_)
        if (!all_ && entry.shown == 0) grant(entry, entry.lines);
    std::string text;
    for (const Entry& entry : entries_) {
        text += first_lines(entry.text, entry.shown);
        if (entry.shown == 0) ++hidden_of_[entry.code];
    }
    entries_.clear();
    return text;
}

std::string FindingLines::take_rest() {
    std::vector<std::pair<std::string, size_t>> rest(hidden_of_.begin(), hidden_of_.end());
    hidden_of_.clear();
    if (rest.empty()) return "";
    auto more = [](const auto& a, const auto& b) { return a.second > b.second; };
    std::stable_sort(rest.begin(), rest.end(), more);
    std::string text;
    size_t unnamed = 0;
    for (size_t k = 0; k < rest.size(); ++k)
        if (k < kMostCodesNamed)
            text += fmt::format("{}{} more of {}", k ? ", " : "", rest[k].second, rest[k].first);
        else
            unnamed += rest[k].second;
    if (unnamed > 0) text += fmt::format(", {} others", unnamed);
    return fmt::format("kinora: {}; -v shows all\n", text);
}

}  // namespace kinora
