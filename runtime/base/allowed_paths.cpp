// runtime/base/allowed_paths.cpp: paths against folders, by what they really are.
#include "runtime/base/allowed_paths.h"

#include <filesystem>

namespace kinora {

namespace {

namespace fs = std::filesystem;

// Both absolute and without links.
bool below(const std::string& path, const std::string& folder) {
    if (folder == "/" || path == folder) return true;
    return path.starts_with(folder) && path[folder.size()] == '/';
}

bool is_file(const std::string& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

// What cannot be a path for the system: it would end at the 0.
bool is_path(std::string_view name) {
    return !name.empty() && name.find('\0') == name.npos;
}

}  // namespace

std::string real_path(const std::string& path) {
    std::error_code error;
    // Absolute first: a relative path of nothing that exists would stay relative.
    fs::path absolute = fs::absolute(path.empty() ? "." : path, error);
    if (error) return path;
    fs::path real = fs::weakly_canonical(absolute, error);
    if (error) return path;
    std::string text = real.string();
    while (text.size() > 1 && text.ends_with('/')) text.pop_back();
    if (text.size() > 2 && text.ends_with("/.")) text.resize(text.size() - 2);
    return text;
}

AllowedPaths::AllowedPaths(const std::vector<std::string>& folders) : limited_(true) {
    for (const std::string& folder : folders) add(folder);
}

void AllowedPaths::add(const std::string& folder) {
    if (!limited_) return;
    folders_.push_back(folder.empty() || folder.ends_with('/') ? folder : folder + "/");
    real_.push_back(real_path(folder));
}

bool AllowedPaths::contains(const std::string& path) const {
    if (!limited_) return true;
    if (!is_path(path)) return false;
    std::string real = real_path(path);
    if (!real.starts_with('/')) return false;  // it could not be found out
    for (const std::string& folder : real_)
        if (below(real, folder)) return true;
    return false;
}

AllowedPaths::Found AllowedPaths::find(std::string_view text) const {
    std::string name(text);
    if (!limited_ || name.empty()) return {name};
    if (!is_path(text)) return {name, true};
    bool inside = contains(name);
    if (name.starts_with('/') || (inside && is_file(name))) return {name, !inside};
    bool outside = folders_.empty();
    for (const std::string& folder : folders_) {
        std::string path = folder + name;
        bool there = contains(path);
        if (there && is_file(path)) return {path};
        outside = outside || !there;
    }
    if (outside || inside) return {name, outside && !inside};
    return {folders_.front() + name};
}

}  // namespace kinora
