// runtime/base/allowed_paths.cpp: paths against folders, by what they really are.
#include "runtime/base/allowed_paths.h"

#include <filesystem>

#include "runtime/base/regular_file.h"

namespace kinora {

namespace {

namespace fs = std::filesystem;

// Both absolute and without links.
bool below(const std::string& path, const std::string& folder) {
    if (folder == "/" || path == folder) return true;
    return path.starts_with(folder) && path[folder.size()] == '/';
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

void AllowedPaths::add_file(const std::string& path) {
    if (limited_ && is_path(path)) real_.push_back(real_path(path));
}

AllowedPaths AllowedPaths::anywhere() const {
    AllowedPaths same = *this;
    same.anywhere_ = true;
    return same;
}

bool AllowedPaths::in_a_tree(const std::string& path) const {
    std::string real = real_path(path);
    if (!real.starts_with('/')) return false;  // it could not be found out
    for (const std::string& tree : real_)
        if (below(real, tree)) return true;
    return false;
}

std::string AllowedPaths::name_of(const std::string& path) const {
    if (!limited_ || in_a_tree(path)) return path;
    std::error_code error;
    fs::path absolute = fs::absolute(path, error);
    return error ? path : absolute.lexically_normal().string();
}

bool AllowedPaths::contains(const std::string& path) const {
    return !limited_ || (is_path(path) && (anywhere_ || in_a_tree(path)));
}

AllowedPaths::Found AllowedPaths::find(std::string_view text) const {
    std::string name(text);
    if (!limited_ || name.empty()) return {name};
    if (!is_path(text)) return {name, true};
    if (name.starts_with('/')) return {name, !contains(name)};
    bool inside = in_a_tree(name);
    if (inside && is_regular_file(name)) return {name};
    bool outside = folders_.empty();
    for (const std::string& folder : folders_) {
        std::string path = folder + name;
        bool there = contains(path);
        if (there && is_regular_file(path)) return {path};
        outside = outside || !there;
    }
    if (outside || inside || folders_.empty()) return {name, outside && !inside && !anywhere_};
    return {folders_.front() + name};
}

}  // namespace kinora
