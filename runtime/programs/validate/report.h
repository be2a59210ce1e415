// runtime/programs/validate/report.h: the shapes a report can have. A report is a head, one piece a
// file in their order, a separator between pieces, and a tail; pieces are made on any thread.
#pragma once

#include <string>
#include <string_view>

#include "runtime/programs/validate/kinora_validate.h"

namespace kinora {

struct ReportFormat {
    const char* name;
    std::string (*head)(const ValidateSettings&);
    std::string (*file)(const FileResult&, const ValidateSettings&);
    const char* separator;  // between pieces that are not empty
    std::string (*tail)(const ValidateTotals&, const ValidateSettings&);
};

const ReportFormat* find_report_format(std::string_view name);  // null: none of that name

// Lines and columns from 1; a column counts characters, the end lies behind the last one.
struct TextRegion {
    int line = 1, column = 1, end_line = 1, end_column = 1;
};
TextRegion text_region(Location where, const SourceFiles& files);

// "3 errors, 1 warning", of the severities that occur; "no findings" for none.
std::string counts_text(const std::array<size_t, 5>& counts);
std::string counted(size_t count, std::string_view noun);

// The parts of the formats; one file each: validate_report_NAME.cpp.
extern const ReportFormat kTextReport, kJsonReport, kSarifReport, kJunitReport, kHtmlReport;

}  // namespace kinora
