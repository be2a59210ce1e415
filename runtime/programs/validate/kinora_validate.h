// runtime/programs/validate/kinora_validate.h: what kinora-validate was asked for, and what it
// finds in a file.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "collada/validate/validate.h"
#include "runtime/base/diagnostic.h"
#include "runtime/programs/validate/scene_info.h"

namespace kinora {

struct ReportFormat;

struct ValidateSettings {
    std::vector<std::string> inputs;  // files, directories, - for stdin
    const ReportFormat* format = nullptr;
    std::string output;    // -o; "": stdout
    bool recurse = false;  // -r
    int threads = 1;
    collada::ValidateOptions validate;
    std::vector<std::string> include_directories;
    std::vector<std::pair<std::string, Severity>> severities;  // code or PREFIX*; the last counts
    std::vector<std::string> only;                             // prefixes of codes; none: all
    std::vector<std::pair<std::string, double>> budgets;
    Severity fail_on = Severity::Error;
    bool strict = false;    // missing files have an exit code of their own
    size_t max_issues = 0;  // shown per file; 0: all
    bool info = false;
    bool fix = false, diff = false, in_place = false;
    bool quiet = false, verbose = false;
    bool stats = false, stats_json = false;
};

// One file's findings, those of --only and above Off, by location, with id paths.
struct FileResult {
    std::string name;  // as the user or the directory gave it; "<stdin>"
    bool unreadable = false;
    std::unique_ptr<Diagnostics> diagnostics;  // the texts that the findings speak of
    std::shared_ptr<const void> keep;          // an unpacked archive, while it is spoken of
    std::vector<Finding> findings;             // to be shown
    std::array<size_t, 5> counts{};            // by severity, of all, shown or not
    std::array<size_t, 5> missing{};           // of these, files that are not there
    size_t hidden = 0;                         // beyond --max-issues
    size_t bytes = 0;
    std::optional<DocumentInfo> info;

    size_t count(Severity severity) const { return counts[size_t(severity)]; }
    size_t at_least(Severity severity) const;
    // Nothing else is wrong than that files are missing.
    bool only_misses(Severity severity) const;
    const SourceFiles& files() const { return diagnostics->files; }
};

// What all files together amount to.
struct ValidateTotals {
    size_t files = 0, failed = 0, unreadable = 0, bytes = 0;
    size_t incomplete = 0;  // of the failed: only for files that are missing
    std::array<size_t, 5> counts{};
    void add(const FileResult& result, const ValidateSettings& settings);
    // 0 valid, 1 findings that fail, 3 some file unreadable, 5 files missing under --strict.
    int exit_code() const;
};

// Reads the command line. Returns an exit code when there is nothing to validate (help, --explain,
// a usage error, which is printed), nothing otherwise.
std::optional<int> parse_validate_options(int argc, char** argv, ValidateSettings& settings);

// inputs.cpp: the files that the inputs mean, in their order; those of a directory
// (with -r) by name.
std::vector<std::string> expand_inputs(const ValidateSettings& settings);

// file.cpp: all checks of one file. `stdin_bytes` is what "-" holds.
FileResult validate_file(const std::string& input, const ValidateSettings& settings,
                         const std::string& stdin_bytes);
// The same of a text under that name.
FileResult validate_text(const std::string& name, std::string bytes,
                         const ValidateSettings& settings);

// batch.cpp: all files; prints the report. Returns an exit code.
int validate_batch(const ValidateSettings& settings, const std::vector<std::string>& files);

// fix.cpp: repairs files as --fix asks; what is left goes to stderr. Returns an
// exit code.
int fix_batch(const ValidateSettings& settings, const std::vector<std::string>& files);

// budget.cpp: findings where `info` passes a budget.
void check_budgets(const DocumentInfo& info, const ValidateSettings& settings, Location where,
                   Diagnostics& diagnostics);
bool is_budget_name(std::string_view name);
std::string budget_names();  // "triangles, joints, ..."

}  // namespace kinora
