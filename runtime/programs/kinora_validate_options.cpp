// runtime/programs/kinora_validate_options.cpp: kinora-validate's command line.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <thread>

#include "collada/schema.h"
#include "runtime/programs/exit_codes.h"
#include "runtime/programs/kinora_validate.h"
#include "runtime/programs/validate_report.h"
#include "runtime/programs/validate_rules.h"

namespace kinora {

namespace {

constexpr int kMostThreads = 1024;
constexpr const char* kExitHelp =
    "Exit codes: 0 valid; 1 some file has errors (or what --fail-on names); 2 usage; 3 some file\n"
    "cannot be read; 6 the report cannot be written; 75 out of memory.\n"
    "Groups of codes: XML_ DOC_ SCHEMA_ ID_ SID_ LINK_ FILE_ SRC_ PRIM_ MAT_ TEX_ FX_ SKIN_ "
    "MORPH_\n"
    "ANIM_ CAM_ LIGHT_ RSL_ INFO_ PORT_.";

int parse_threads(const std::string& text) {
    int cores = std::max(1, int(std::thread::hardware_concurrency()));
    if (text == "all") return cores;
    int n = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    if (error != std::errc() || *end != 0 || n == 0)
        throw CLI::ValidationError("-j", "takes a number, -N (all but N) or 'all'");
    return n > 0 ? std::min(n, kMostThreads) : std::max(1, cores + n);
}

std::pair<std::string, std::string> split_pair(const std::string& text, const char* option,
                                               const char* takes) {
    size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw CLI::ValidationError(option, takes);
    return {text.substr(0, equals), text.substr(equals + 1)};
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::toupper(c)); });
    return text;
}

// A code that exists, or why not.
const FindingInfo& known_rule(const std::string& code, const char* option) {
    if (const FindingInfo* row = find_rule(code)) return *row;
    std::vector<std::string_view> codes;
    for (const FindingInfo* row : validate_rules()) codes.push_back(row->code);
    std::string_view near = nearest_name(code, codes);
    throw CLI::ValidationError(
        option, near.empty() ? fmt::format("knows no code '{}'; --list-rules shows them", code)
                             : fmt::format("knows no code '{}'; did you mean {}?", code, near));
}

bool is_prefix_of_some_rule(std::string_view prefix) {
    return std::any_of(
        validate_rules().begin(), validate_rules().end(),
        [&](const FindingInfo* row) { return std::string_view(row->code).starts_with(prefix); });
}

void add_severity(const std::string& text, ValidateSettings& s) {
    auto [code, name] = split_pair(text, "--severity",
                                   "takes CODE=off|hint|info|warning|error, CODE may be PORT_*");
    code = upper(code);
    auto severity = parse_severity(name);
    if (!severity)
        throw CLI::ValidationError("--severity", "knows off, hint, info, warning and error");
    if (!code.ends_with('*')) known_rule(code, "--severity");
    s.severities.emplace_back(code, *severity);
}

void add_budget(const std::string& text, ValidateSettings& s) {
    auto [name, number] = split_pair(text, "--budget", "takes NAME=NUMBER");
    if (!is_budget_name(name)) throw CLI::ValidationError("--budget", "knows " + budget_names());
    double most = 0;
    auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), most);
    if (error != std::errc() || *end != 0 || !std::isfinite(most) || most < 0)
        throw CLI::ValidationError("--budget", fmt::format("'{}' is no number", number));
    s.budgets.emplace_back(name, most);
}

void add_only(const std::string& text, ValidateSettings& s) {
    std::string prefix = upper(text);
    while (prefix.ends_with('*')) prefix.pop_back();
    if (!is_prefix_of_some_rule(prefix))
        throw CLI::ValidationError("--only", fmt::format("no code begins with '{}'", prefix));
    s.only.push_back(prefix);
}

collada::Profile parse_profile(const std::string& name) {
    using collada::Profile;
    constexpr std::pair<std::string_view, Profile> kProfiles[] = {
        {"default", Profile::Default}, {"lenient", Profile::Lenient}, {"strict", Profile::Strict},
        {"1.4.1", Profile::V1_4_1},    {"1.5", Profile::V1_5},        {"1.5.0", Profile::V1_5}};
    for (const auto& [known, profile] : kProfiles)
        if (name == known) return profile;
    throw CLI::ValidationError("--profile", "knows 1.4.1, 1.5, lenient, strict and default");
}

// What the command line says besides the settings.
struct Words {
    std::vector<std::string> severities, only, budgets;
    std::string format = "text", profile = "default", threads = "all", explain, stats, schema;
    std::string fail_on = "error";
    bool list_rules = false;
};

void add_options(CLI::App& app, ValidateSettings& s, Words& w) {
    app.add_option("files", s.inputs, "files (.dae .zae .kmz), - for stdin, directories with -r");
    app.add_flag("-r,--recursive", s.recurse, "all .dae, .zae and .kmz files below directories");
    app.add_option("-j,--threads,--jobs", w.threads, "N, -N (all but N) or all");
    app.add_option("--format", w.format, "text, json, sarif, junit or html");
    app.add_option("-o,--output", s.output, "the report's file instead of stdout");
    app.add_option("--profile", w.profile, "1.4.1, 1.5, lenient or strict (by the file's version)");
    app.add_option("--severity", w.severities, "CODE=off|hint|info|warning|error; CODE or PORT_*")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--only", w.only, "codes that begin so: XML_,SCHEMA_,ID_")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--fail-on", w.fail_on, "least severity that makes exit 1 (error)");
    app.add_option("--max-issues", s.max_issues, "shown per file (all)");
    app.add_flag("--info", s.info, "also what the scene holds: triangles, joints, clips, bounds");
    app.add_option("--budget", w.budgets, "NAME=NUMBER,...: " + budget_names())
        ->delimiter(',')
        ->allow_extra_args(false);
    auto* fix = app.add_flag("--fix", s.fix, "repair: the text to -o or stdout");
    auto* diff = app.add_flag("--diff", s.diff, "show the repairs as a unified diff")->needs(fix);
    app.add_flag("--in-place", s.in_place, "write them into the files")->needs(fix)->excludes(diff);
    app.add_flag("--list-rules", w.list_rules, "every code, its severity and text");
    app.add_option("--explain", w.explain, "what a code means and what to do; all for all");
    app.add_option("--print-schema", w.schema, "an XSD with profile_RSL: 1.4.1 or 1.5");
    app.add_option("--allow-external", s.validate.extract.allow_external,
                   "DIR: read files there too, outside the scene's folder")
        ->allow_extra_args(false);
    app.add_option("-I", s.include_directories, "where shaders find #include files")
        ->allow_extra_args(false);
    app.add_option("--stats", w.stats, "what the run took, on stderr: text or json")
        ->expected(0, 1)
        ->default_str("text")
        ->check(CLI::IsMember({"text", "json"}));
    app.add_flag("-v,--verbose", s.verbose, "say more: why, and a line for each file");
    app.add_flag("-q,--quiet", s.quiet, "say only errors");
}

void take_words(const CLI::App& app, const Words& w, ValidateSettings& s) {
    s.format = find_report_format(w.format);
    if (!s.format)
        throw CLI::ValidationError("--format", "knows text, json, sarif, junit and html");
    s.threads = parse_threads(w.threads);
    s.validate.profile = parse_profile(w.profile);
    auto fail_on = parse_severity(w.fail_on);
    if (!fail_on || *fail_on == Severity::Off)
        throw CLI::ValidationError("--fail-on", "knows hint, info, warning and error");
    s.fail_on = *fail_on;
    for (const std::string& text : w.severities) add_severity(text, s);
    for (const std::string& text : w.only) add_only(text, s);
    for (const std::string& text : w.budgets) add_budget(text, s);
    s.stats = app.count("--stats") > 0;
    s.stats_json = w.stats == "json";
}

// Prints what needs no file; nothing if there is none such.
std::optional<int> answer(const Words& w, const ValidateSettings& s) {
    if (w.list_rules) {
        std::fputs((w.format == "json" ? rules_json() : rules_text()).c_str(), stdout);
        return kExitOk;
    }
    if (w.explain == "all") {
        for (const FindingInfo* row : validate_rules())
            std::printf("%s\n", explain_text(*row).c_str());
        return kExitOk;
    }
    if (!w.explain.empty()) {
        std::fputs(explain_text(known_rule(upper(w.explain), "--explain")).c_str(), stdout);
        return kExitOk;
    }
    if (!w.schema.empty()) {
        bool is_15 = w.schema.starts_with("1.5");
        if (!is_15 && !w.schema.starts_with("1.4"))
            throw CLI::ValidationError("--print-schema", "knows 1.4.1 and 1.5");
        auto version = is_15 ? collada::Version::V1_5_0 : collada::Version::V1_4_1;
        std::fputs(collada::print_schema(version).c_str(), stdout);
        return kExitOk;
    }
    if (s.inputs.empty()) throw CLI::RequiredError("files");
    return std::nullopt;
}

}  // namespace

std::optional<int> parse_validate_options(int argc, char** argv, ValidateSettings& s) {
    CLI::App app("kinora-validate: checks COLLADA files, shaders included", "kinora-validate");
    app.footer(kExitHelp);
    app.set_version_flag("--version", "kinora-validate " KINORA_VERSION);
    Words w;
    add_options(app, s, w);
    try {
        app.parse(argc, argv);
        take_words(app, w, s);
        return answer(w, s);
    } catch (const CLI::ParseError& error) {
        int code = app.exit(error);
        return code == 0 ? kExitOk : kExitUsage;
    }
}

}  // namespace kinora
