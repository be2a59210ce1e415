// runtime/programs/validate/inputs.cpp: files and directories to a list of files.
#include <algorithm>
#include <filesystem>

#include "runtime/base/file_extension.h"
#include "runtime/programs/validate/kinora_validate.h"

namespace kinora {

namespace {

namespace fs = std::filesystem;

// Links to directories are not followed: they may lead back. What cannot be opened is passed over.
void add_directory(const std::string& directory, std::vector<std::string>& files) {
    std::error_code error;
    std::vector<std::string> found;
    fs::recursive_directory_iterator at(directory, fs::directory_options::skip_permission_denied,
                                        error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
        std::error_code ignored;
        // Pipes and devices may never end; a link that leads nowhere is reported.
        fs::file_type type = at->status(ignored).type();
        bool file = type == fs::file_type::regular || type == fs::file_type::not_found;
        if (file && has_extension(at->path().string(), {".dae", ".zae", ".kmz"}))
            found.push_back(at->path().string());
    }
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
    if (found.empty()) files.push_back(directory);  // reported as what it is
}

}  // namespace

std::vector<std::string> expand_inputs(const ValidateSettings& settings) {
    std::vector<std::string> files;
    for (const std::string& input : settings.inputs) {
        std::error_code error;
        if (settings.recurse && input != "-" && fs::is_directory(input, error))
            add_directory(input, files);
        else
            files.push_back(input);
    }
    return files;
}

}  // namespace kinora
