// runtime/programs/convert/folder_files.cpp: the scene files of a folder and where each goes.
#include <algorithm>
#include <filesystem>
#include <map>

#include "runtime/base/file_extension.h"
#include "runtime/programs/convert/folder_p.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

int64_t nanoseconds(fs::file_time_type time) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace

std::vector<FolderFile> folder_files(const ConvertOptions& options) {
    std::error_code code;
    fs::path root = options.input, output = fs::weakly_canonical(options.output, code);
    std::vector<FolderFile> files;
    fs::recursive_directory_iterator at(root, fs::directory_options::skip_permission_denied, code);
    for (; !code && at != fs::recursive_directory_iterator(); at.increment(code)) {
        std::error_code ignored;
        if (at->is_directory(ignored)) {
            // The output may lie inside of the input.
            if (fs::weakly_canonical(at->path(), ignored) == output) at.disable_recursion_pending();
            continue;
        }
        std::string name = at->path().lexically_relative(root).generic_string();
        bool is_scene = has_extension(name, {".dae", ".zae", ".kmz", ".gltf", ".glb"});
        if (!is_scene || !at->is_regular_file(ignored)) continue;
        FolderFile& file = files.emplace_back();
        file.input = name;
        file.size = at->file_size(ignored);
        file.changed = nanoseconds(at->last_write_time(ignored));
    }
    std::ranges::sort(files, {}, &FolderFile::input);
    std::map<std::string, int> wanted;
    auto named = [&](const FolderFile& file) {
        return fs::path(file.input).replace_extension("." + options.to).generic_string();
    };
    for (const FolderFile& file : files) ++wanted[named(file)];
    for (FolderFile& file : files)
        file.output = wanted[named(file)] > 1 ? file.input + "." + options.to : named(file);
    return files;
}

}  // namespace kinora
