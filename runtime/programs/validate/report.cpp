// runtime/programs/validate/report.cpp: what the formats share.
#include "runtime/programs/validate/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace kinora {

namespace {

constexpr const ReportFormat* kFormats[] = {&kTextReport, &kJsonReport, &kSarifReport,
                                            &kJunitReport, &kHtmlReport};

// Characters of UTF-8 text: bytes that do not continue another one.
int count_characters(std::string_view text) {
    return int(std::count_if(text.begin(), text.end(),
                             [](char c) { return (uint8_t(c) & 0xC0) != 0x80; }));
}

int character_column(FileId file, LineColumn at, const SourceFiles& files) {
    return count_characters(files.line_text(file, at.line)
                                .substr(0, std::min(size_t(at.column) - 1,
                                                    files.line_text(file, at.line).size()))) +
           1;
}

}  // namespace

const ReportFormat* find_report_format(std::string_view name) {
    for (const ReportFormat* format : kFormats)
        if (name == format->name) return format;
    return nullptr;
}

TextRegion text_region(Location where, const SourceFiles& files) {
    if (where.file == kNoFile) return {};
    LineColumn begin = files.line_column(where.file, where.begin);
    LineColumn end = files.line_column(where.file, std::max(where.begin, where.end));
    return {begin.line, character_column(where.file, begin, files), end.line,
            character_column(where.file, end, files)};
}

std::string counted(size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string counts_text(const std::array<size_t, 5>& counts) {
    constexpr std::string_view kNouns[] = {"", "hint", "remark", "warning", "error"};
    std::string text;
    for (size_t s = counts.size() - 1; s > 0; --s)
        if (counts[s]) text += (text.empty() ? "" : ", ") + counted(counts[s], kNouns[s]);
    return text.empty() ? "no findings" : text;
}

}  // namespace kinora
