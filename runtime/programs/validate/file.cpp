// runtime/programs/validate/file.cpp: one file through reading, rules, shaders and budgets.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "collada/document/findings.h"
#include "collada/document/id_path.h"
#include "collada/document/open_scene.h"
#include "collada/validate/profile.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/missing_asset.h"
#include "runtime/programs/validate/foreign_schema.h"
#include "runtime/programs/validate/kinora_validate.h"
#include "runtime/programs/validate/rules.h"
#include "runtime/scene/profile_rsl/check.h"

namespace kinora {

namespace {

// The last --severity that names the code, or what the profile makes of it.
Severity weigh(const Finding& finding, const ValidateSettings& settings) {
    std::string_view code = finding.info->code;
    for (auto row = settings.severities.rbegin(); row != settings.severities.rend(); ++row) {
        std::string_view name = row->first;
        bool prefix = name.ends_with('*');
        if (prefix ? code.starts_with(name.substr(0, name.size() - 1)) : code == name)
            return row->second;
    }
    return collada::profile_severity(*finding.info, finding.severity, settings.validate.profile);
}

bool wanted(const Finding& finding, const ValidateSettings& settings) {
    std::string_view code = finding.info->code;
    return settings.only.empty() ||
           std::any_of(settings.only.begin(), settings.only.end(),
                       [&](const std::string& prefix) { return code.starts_with(prefix); });
}

void take_findings(FileResult& result, const ValidateSettings& settings) {
    for (const Finding& finding : result.diagnostics->findings()) {
        Severity severity = weigh(finding, settings);
        if (severity == Severity::Off || !wanted(finding, settings)) continue;
        ++result.counts[size_t(severity)];
        result.missing[size_t(severity)] += is_missing_asset(*finding.info);
        if (settings.max_issues && result.findings.size() >= settings.max_issues) {
            ++result.hidden;
            continue;
        }
        result.findings.push_back(finding);
        result.findings.back().severity = severity;
    }
}

void finish(FileResult& result, const collada::Document* document,
            const ValidateSettings& settings) {
    take_findings(result, settings);
    if (document) collada::add_id_paths(*document, result.files(), result.findings);
    for (const Finding& finding : result.diagnostics->findings())
        if (finding.info == &collada::Code::XML_OPEN && finding.where.file == kNoFile)
            result.unreadable = true;
    for (FileId file = 0; file < result.files().count(); ++file)
        result.bytes += result.files().text(file).size();
}

// What the scene's shaders may read.
rsl::CompileOptions shader_options(const collada::Document& document,
                                   const collada::SceneFile& file,
                                   const ValidateSettings& settings) {
    std::vector<std::string> folders{file.folder.empty() ? document.directory() : file.folder};
    for (const auto* more :
         {&settings.validate.extract.allow_external, &settings.include_directories})
        folders.insert(folders.end(), more->begin(), more->end());
    rsl::CompileOptions options;
    options.include_directories = settings.include_directories;
    options.files = AllowedPaths(folders);
    bool confined = settings.validate.extract.confine || !file.folder.empty();
    options.pictures = confined ? options.files : options.files.anywhere();
    return options;
}

void check(FileResult& result, std::optional<collada::Document> document,
           const collada::SceneFile& file, const ValidateSettings& settings) {
    Diagnostics& diagnostics = *result.diagnostics;
    if (document) {
        collada::judge_by_profile(*document, settings.validate.profile, diagnostics);
        collada::ValidateOptions options = settings.validate;
        options.extract.folder = file.folder;
        options.check_foreign = check_foreign;
        options.extract.scene_id = file.scene_id;
        options.extract.models = file.models;
        auto scene = collada::validate(*document, diagnostics, options);
        if (scene) {
            check_profile_rsl(*scene, shader_options(*document, file, settings), diagnostics);
            if (settings.info || !settings.budgets.empty()) {
                result.info = scene_info(*document, *scene);
                check_budgets(*result.info, settings, document->location(document->root()),
                              diagnostics);
            }
        }
        diagnostics.sort_unique();
    }
    finish(result, document ? &*document : nullptr, settings);
}

void check_scene_file(FileResult& result, const std::optional<collada::SceneFile>& file,
                      const ValidateSettings& settings) {
    if (!file) return finish(result, nullptr, settings);
    result.keep = file->keep;
    auto document = collada::read_document(file->document, *result.diagnostics);
    check(result, std::move(document), *file, settings);
}

FileResult new_result(const std::string& name) {
    FileResult result;
    result.name = name;
    result.diagnostics = std::make_unique<Diagnostics>();
    return result;
}

FileResult refused(const std::string& input, const char* why, const ValidateSettings& settings) {
    FileResult result = new_result(input);
    result.diagnostics->report(collada::Code::XML_OPEN, Location{}, input, why);
    finish(result, nullptr, settings);
    return result;
}

}  // namespace

namespace {

size_t sum_from(const std::array<size_t, 5>& counts, Severity severity) {
    return std::accumulate(counts.begin() + ptrdiff_t(severity), counts.end(), size_t(0));
}

}  // namespace

size_t FileResult::at_least(Severity severity) const {
    return sum_from(counts, severity);
}

bool FileResult::only_misses(Severity severity) const {
    return at_least(severity) == sum_from(missing, severity);
}

void ValidateTotals::add(const FileResult& result, const ValidateSettings& settings) {
    ++files;
    bytes += result.bytes;
    unreadable += result.unreadable;
    bool fails = !result.unreadable && result.at_least(settings.fail_on) > 0;
    failed += fails;
    incomplete += fails && settings.strict && result.only_misses(settings.fail_on);
    for (size_t s = 0; s < counts.size(); ++s) counts[s] += result.counts[s];
}

int ValidateTotals::exit_code() const {
    if (unreadable) return kExitUnreadable;
    if (failed > incomplete) return kExitSomeFailed;
    return incomplete ? kExitMissingAsset : kExitOk;
}

FileResult validate_text(const std::string& name, std::string bytes,
                         const ValidateSettings& settings) {
    FileResult result = new_result(name);
    if (collada::is_archive_bytes(bytes)) {
        check_scene_file(result, collada::open_scene_bytes(name, bytes, *result.diagnostics),
                         settings);
        return result;
    }
    auto document = collada::read_document_text(name, std::move(bytes), *result.diagnostics);
    check(result, std::move(document), {}, settings);
    return result;
}

FileResult validate_file(const std::string& input, const ValidateSettings& settings,
                         const std::string& stdin_bytes) {
    if (input == "-") return validate_text("<stdin>", stdin_bytes, settings);
    std::error_code error;
    auto type = std::filesystem::status(input, error).type();
    using std::filesystem::file_type;
    if (type == file_type::directory)
        return refused(input,
                       settings.recurse ? "no .dae, .zae or .kmz file in it"
                                        : "it is a directory; -r reads the files in it",
                       settings);
    if (type == file_type::character || type == file_type::block || type == file_type::socket)
        return refused(input, "it is a device, not a file", settings);
    FileResult result = new_result(input);
    check_scene_file(result, collada::open_scene(input, *result.diagnostics), settings);
    return result;
}

}  // namespace kinora
