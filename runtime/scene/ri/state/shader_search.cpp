// runtime/scene/ri/state/shader_search.cpp: from a name along folders to a compiled shader.
#include "runtime/scene/ri/state/shader_search.h"

#include <algorithm>
#include <filesystem>

#include "runtime/scene/description/shader_library.h"

namespace kinora::ri {
namespace {

namespace fs = std::filesystem;

std::string_view without_suffix(std::string_view name) {
    for (std::string_view suffix : {".sl", ".slo", ".slx", ".sdl", ".slp", ".so"})
        if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
    return name;
}

std::string_view base_name(std::string_view path) {
    size_t slash = path.find_last_of("/\\");
    return slash == path.npos ? path : path.substr(slash + 1);
}

bool same_letters(std::string_view a, std::string_view b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

// The file of that name in a folder, whatever the case of its letters.
std::string file_in(const fs::path& folder, const std::string& name) {
    if (is_file(folder / name)) return (folder / name).string();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
        if (same_letters(entry.path().filename().string(), name) && is_file(entry.path()))
            return entry.path().string();
    return "";
}

// What scenes mean by a name that one of ours, with other parameters, has too.
struct OtherName {
    std::string_view name, ours;
};
constexpr OtherName kOtherNames[] = {
    {"default", "defaultsurface"},
    {"shadowspot", "ri_shadowspot"},
};
std::string_view library_name(std::string_view name) {
    for (const OtherName& other : kOtherNames)
        if (other.name == name) return other.ours;
    return name;
}

}  // namespace

std::string ShaderSearch::file_of(std::string_view name,
                                  const std::vector<std::string>& folders) const {
    std::string plain(without_suffix(name)), last(base_name(plain));
    for (const std::string& wanted : {plain, last}) {
        fs::path file(wanted + ".sl");
        if (file.is_absolute() && is_file(file)) return file.string();
        for (const std::string& folder : folders) {
            fs::path in = fs::path(folder) / file.parent_path();
            if (std::string found = file_in(in, file.filename().string()); !found.empty())
                return found;
        }
        fs::path in = fs::path(folder_) / file.parent_path();
        if (std::string found = file_in(in, file.filename().string()); !found.empty()) return found;
    }
    return "";
}

ShaderSearch::Made ShaderSearch::compiled(const std::string& path, std::string_view name) {
    auto [entry, is_new] = by_path_.try_emplace(path);
    File& file = entry->second;
    if (is_new) {
        file.id = diagnostics_.files.count();  // the next that is added
        for (auto& shader : rsl::compile_file(path, options_, diagnostics_))
            file.shaders.push_back(std::move(shader));
    }
    for (const Made& shader : file.shaders)
        if (shader->name == name) return shader;
    return file.shaders.empty() ? nullptr : file.shaders.front();
}

rsl::ShaderSource ShaderSearch::source_of(const rsl::Shader& shader) const {
    auto is_it = [&](const Made& made) { return made.get() == &shader; };
    for (const auto& [path, file] : by_path_)
        if (std::ranges::any_of(file.shaders, is_it))
            return {diagnostics_.files.text(file.id), {file.id, {}}};
    return {library_shader_text(shader.name), {}};
}

ShaderSearch::Made ShaderSearch::find(std::string_view name,
                                      const std::vector<std::string>& folders) {
    std::string key(name);
    for (const std::string& folder : folders) key += '\n' + folder;
    auto known = by_name_.find(key);
    if (known != by_name_.end()) return known->second;
    std::string_view plain = base_name(without_suffix(name));
    std::string path = file_of(name, folders);
    Made made = path.empty() ? nullptr : compiled(path, plain);
    if (path.empty()) made = library_shader(library_name(plain));
    by_name_.emplace(std::move(key), made);
    return made;
}

}  // namespace kinora::ri
