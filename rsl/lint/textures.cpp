// rsl/lint/textures.cpp: pictures that the source names and that are not there.
#include <algorithm>
#include <filesystem>

#include "rsl/lint/lint_p.h"
#include "rsl/text/findings.h"

namespace kinora::rsl {

namespace {

constexpr std::string_view kReaders[] = {"texture", "environment", "shadow", "bump"};
constexpr std::string_view kNoFiles[] = {"", "raytrace", "reflection"};

template <class List>
bool contains(const List& list, std::string_view name) {
    return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

bool is_there(const std::string& name, const std::vector<std::string>& folders) {
    std::error_code error;
    return std::any_of(folders.begin(), folders.end(), [&](const std::string& folder) {
        return std::filesystem::is_regular_file(std::filesystem::path(folder) / name, error);
    });
}

}  // namespace

void lint_textures(LintSource& source) {
    for_each_node(
        source,
        [&](const Expr& expr) {
            auto* call = as_if<CallExpr>(&expr);
            if (!call || !call->builtin || !contains(kReaders, call->name)) return;
            auto* name = call->args.empty() ? nullptr : as_if<StringExpr>(call->args[0]);
            if (!name || contains(kNoFiles, name->value) || !source.is_own(name->span)) return;
            std::string file(name->value);
            if (!is_there(file, source.options.folders))
                source.reporter.report(Code::RSL_TEXTURE_MISSING, name->span, file);
        },
        [](const Stmt&) {});
}

}  // namespace kinora::rsl
