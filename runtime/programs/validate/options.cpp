// runtime/programs/validate/options.cpp: kinora-validate's command line.
#include <cmath>
#include <filesystem>
#include <set>

#include "collada/schema/schema.h"
#include "runtime/programs/common/command_line.h"
#include "runtime/programs/validate/kinora_validate.h"
#include "runtime/programs/validate/report.h"
#include "runtime/programs/validate/rules.h"

namespace kinora {

namespace {

const std::vector<std::string_view> kSeverities = {"off", "hint", "info", "warning", "error"};
constexpr const char* kExitHelp =
    "Exit codes: 0 valid; 1 some file has errors (or what --fail-on names); 2 usage; 3 some file\n"
    "cannot be read; 5 files that a scene names are missing, under --strict; 6 the report cannot "
    "be\n"
    "written; 75 out of memory.\n"
    "Groups of codes: XML_ DOC_ SCHEMA_ ID_ SID_ LINK_ FILE_ SRC_ PRIM_ MAT_ TEX_ FX_ SKIN_ "
    "MORPH_\n"
    "ANIM_ CAM_ LIGHT_ RSL_ INFO_ PORT_.";

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

// A prefix that some code has, or which groups there are.
void known_prefix(const std::string& prefix, const char* option) {
    std::set<std::string_view> groups;
    for (const FindingInfo* row : validate_rules()) {
        std::string_view code = row->code;
        if (code.starts_with(prefix)) return;
        groups.insert(code.substr(0, code.find('_') + 1));
    }
    throw CLI::ValidationError(option, fmt::format("no code begins with '{}'; there are {}", prefix,
                                                   fmt::join(groups, " ")));
}

void add_severity(const std::string& text, ValidateSettings& s) {
    auto [code, name] =
        split_pair(text, "--severity", "CODE=off|hint|info|warning|error (CODE may be PORT_*)");
    code = upper(code);
    auto severity = parse_severity(name);
    if (!severity) throw CLI::ValidationError("--severity", none_of(name, kSeverities));
    if (code.ends_with('*'))
        known_prefix(code.substr(0, code.size() - 1), "--severity");
    else
        known_rule(code, "--severity");
    s.severities.emplace_back(code, *severity);
}

void add_budget(const std::string& text, ValidateSettings& s) {
    auto [name, number] = split_pair(text, "--budget", "NAME=NUMBER");
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
    known_prefix(prefix, "--only");
    s.only.push_back(prefix);
}

// What the command line says besides the settings.
struct Words {
    std::vector<std::string> severities, only, budgets;
    std::string format = "text", threads = "all", explain, stats, schema;
    std::string fail_on = "error";
    bool list_rules = false;
};

void add_options(CLI::App& app, ValidateSettings& s, Words& w) {
    using collada::Profile;
    app.add_option("files", s.inputs, "files (.dae .zae .kmz), - for stdin, directories with -r");
    app.add_flag("-r,--recursive", s.recurse, "all .dae, .zae and .kmz files below directories");
    app.add_option("-j,--threads,--jobs", w.threads, "N, -N (all but N) or all (all)");
    app.add_option("--format", w.format, "text, json, sarif, junit or html (text)")
        ->check(one_of({"text", "json", "sarif", "junit", "html"}));
    app.add_option("-o,--output", s.output, "the report's file instead of stdout");
    add_choice<Profile>(app, "--profile", s.validate.profile,
                        {{"1.4.1", Profile::V1_4_1},
                         {"1.5", Profile::V1_5},
                         {"1.5.0", Profile::V1_5},
                         {"lenient", Profile::Lenient},
                         {"strict", Profile::Strict},
                         {"default", Profile::Default}},
                        "1.4.1, 1.5, lenient, default (by the file's version) or strict");
    add_list(app, "--severity", w.severities, "CODE=off|hint|info|warning|error; CODE or PORT_*",
             ',');
    add_list(app, "--only", w.only, "codes that begin so: XML_,SCHEMA_,ID_", ',');
    app.add_flag("--strict", s.strict,
                 "as --profile strict; exit 5 where all that is wrong is a missing file");
    app.add_option("--fail-on", w.fail_on, "least severity that makes exit 1 (error)")
        ->check(one_of({"hint", "info", "warning", "error"}));
    app.add_option("--max-issues", s.max_issues, "shown per file (all)")
        ->check(CLI::Range(int64_t(0), int64_t(1) << 40).description("NUMBER"));
    app.add_flag("--info", s.info, "also what the scene holds: triangles, joints, clips, bounds");
    add_list(app, "--budget", w.budgets, "NAME=NUMBER,...: " + budget_names(), ',');
    auto* fix = app.add_flag("--fix", s.fix, "repair: the text to -o or stdout");
    auto* diff = app.add_flag("--diff", s.diff, "show the repairs as a unified diff")->needs(fix);
    app.add_flag("--in-place", s.in_place, "write them into the files")->needs(fix)->excludes(diff);
    app.add_flag("--list-rules", w.list_rules, "every code, its severity and text");
    app.add_option("--explain", w.explain, "what a code means and what to do; all for all");
    app.add_option("--print-schema", w.schema, "an XSD with profile_RSL: 1.4.1 or 1.5")
        ->check(one_of({"1.4", "1.4.0", "1.4.1", "1.5", "1.5.0"}));
    add_list(app, "--allow-external", s.validate.extract.allow_external,
             "DIR: read files there too, outside the scene's folder");
    app.add_flag("--confine", s.validate.extract.confine,
                 "read pictures too only there; else they may lie anywhere");
    add_list(app, "-I", s.include_directories, "DIR: where shaders find #include files");
    app.add_option("--stats", w.stats, "[=json]: what the run took, on stderr")
        ->check(one_of({"text", "json"}));
    app.add_flag("-v,--verbose", s.verbose, "say more: why, and a line for each file");
    app.add_flag("-q,--quiet", s.quiet, "say only errors");
}

void take_words(const Words& w, ValidateSettings& s) {
    s.format = find_report_format(w.format);
    s.threads = parse_threads(w.threads, "-j");
    s.fail_on = *parse_severity(w.fail_on);
    // Files below a directory may name all that is below it.
    std::error_code error;
    for (const std::string& input : s.inputs)
        if (s.recurse && std::filesystem::is_directory(input, error))
            s.validate.extract.allow_external.push_back(input);
    if (s.strict) s.validate.profile = collada::Profile::Strict;
    for (const std::string& text : w.severities) add_severity(text, s);
    for (const std::string& text : w.only) add_only(text, s);
    for (const std::string& text : w.budgets) add_budget(text, s);
    s.stats = !w.stats.empty();
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
        auto version = is_15 ? collada::Version::V1_5_0 : collada::Version::V1_4_1;
        std::fputs(collada::print_schema(version).c_str(), stdout);
        return kExitOk;
    }
    if (s.inputs.empty())
        throw CLI::RequiredError("a file (or --list-rules, --explain, --print-schema)");
    return std::nullopt;
}

}  // namespace

std::optional<int> parse_validate_options(int argc, char** argv, ValidateSettings& s) {
    CLI::App app("kinora-validate: checks COLLADA files, shaders included", "kinora-validate");
    app.footer(kExitHelp);
    app.set_version_flag("--version", "kinora-validate " KINORA_VERSION);
    Words w;
    add_options(app, s, w);
    std::optional<int> answered;
    std::optional<int> code =
        parse_command_line(app, words_of(argc, argv), {{"--stats", "text"}}, [&] {
            take_words(w, s);
            answered = answer(w, s);
        });
    return code ? code : answered;
}

}  // namespace kinora
