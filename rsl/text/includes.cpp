// rsl/text/includes.cpp: the search for an included file.
#include "rsl/text/includes.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "rsl/text/did_you_mean.h"
#include "rsl/text/standard_headers.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"

namespace kinora::rsl {

namespace {

// The file of that name in whatever letter case, as systems find it whose names have none.
std::filesystem::path in_any_case(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::exists(path, error)) return path;
    std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::filesystem::path best;
    std::filesystem::directory_iterator at(folder, error), end;
    for (; !error && at != end; at.increment(error)) {
        bool same = same_letters(at->path().filename().string(), path.filename().string());
        if (same && (best.empty() || at->path() < best)) best = at->path();
    }
    return best.empty() ? path : best;
}

}  // namespace

void Includes::read_once(const std::string& path) {
    once_.push_back(std::filesystem::path(path).lexically_normal().string());
}

std::optional<SourceText> Includes::find(std::string file, bool quoted, const std::string& from,
                                         const Token& at) {
    std::replace(file.begin(), file.end(), '\\', '/');  // as written on Windows
    std::vector<std::filesystem::path> folders;
    if (quoted) folders.push_back(std::filesystem::path(from).parent_path());
    for (const std::string& directory : options_.include_directories) folders.push_back(directory);
    if (!quoted) folders.push_back(std::filesystem::path(from).parent_path());
    bool outside = false;
    for (const std::filesystem::path& folder : folders) {
        std::filesystem::path path = in_any_case(folder / file);
        if (!options_.files.contains(path.string())) {
            outside = true;
            continue;
        }
        std::optional<std::string> bytes = read_regular_file(path.string(), kMostIncludeBytes);
        if (!bytes) continue;
        std::string text = utf8_text(std::move(*bytes));
        std::string key = path.lexically_normal().string();
        if (std::find(once_.begin(), once_.end(), key) != once_.end()) return std::nullopt;
        SourceMap map;
        map.file = files_.add(path.string(), text);
        return SourceText{texts_.keep(std::move(text)), &texts_.keep(std::move(map)), key};
    }
    if (std::string_view text = standard_header(file); !text.empty()) {
        SourceMap map;
        map.file = files_.add("include/" + file, std::string(text));
        return SourceText{text, &texts_.keep(std::move(map)), file, true};
    }
    reporter_.report(outside ? Code::RSL_INCLUDE_OUTSIDE : Code::RSL_INCLUDE_NOT_FOUND, at, file);
    return std::nullopt;
}

}  // namespace kinora::rsl
