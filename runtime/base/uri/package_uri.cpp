// runtime/base/uri/package_uri.cpp: package://NAME/PATH of ROS and model://NAME/PATH of Gazebo.
#include "runtime/base/uri/package_uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "runtime/base/regular_file.h"

namespace kinora {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMostFolders = 4096;  // looked into for packages, of one variable's folders
constexpr uint64_t kMostXml = 1 << 20;

struct Variable {
    const char* name;
    const char* below;  // where in each of its folders the packages stand
};
struct Scheme {
    std::string_view scheme;
    const char* mark;  // the file that makes a folder a package
    bool named;        // the mark's <name> is the package's, not the folder's name
    std::array<Variable, 4> variables;
};
constexpr Scheme kSchemes[] = {
    {"package://",
     "package.xml",
     true,
     {{{"ROS_PACKAGE_PATH", ""}, {"AMENT_PREFIX_PATH", "share"}, {"CMAKE_PREFIX_PATH", "share"}}}},
    {"model://",
     "model.config",
     false,
     {{{"GZ_SIM_RESOURCE_PATH", ""},
       {"IGN_GAZEBO_RESOURCE_PATH", ""},
       {"GAZEBO_MODEL_PATH", ""},
       {"SDF_PATH", ""}}}},
};

const Scheme* scheme_of(std::string_view uri) {
    for (const Scheme& row : kSchemes) {
        bool same = uri.size() >= row.scheme.size() &&
                    std::equal(row.scheme.begin(), row.scheme.end(), uri.begin(),
                               [](char a, char b) { return a == char(std::tolower(uint8_t(b))); });
        if (same) return &row;
    }
    return nullptr;
}

std::vector<fs::path> folders_of(const Variable& variable) {
    std::vector<fs::path> folders;
    const char* value = variable.name ? std::getenv(variable.name) : nullptr;
    std::string_view rest = value ? value : "";
    while (!rest.empty()) {
        std::string_view one = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), one.size() + 1));
        if (!one.empty()) folders.push_back(fs::path(one) / variable.below);
    }
    return folders;
}

// The file `rest` of a package of that name in a folder, of one below it, or of the folder itself.
std::string find_below(const fs::path& folder, const std::string& name, const std::string& rest) {
    auto found = [&](const fs::path& package) {
        std::string path = (package / rest).lexically_normal().string();
        return is_regular_file(path) ? path : std::string();
    };
    if (std::string path = found(folder / name); !path.empty()) return path;
    fs::path whole = (folder / "").parent_path();  // without a '/' at its end
    if (whole.filename() == name)
        if (std::string path = found(whole); !path.empty()) return path;
    std::error_code error;
    fs::directory_iterator at(folder, error), end;
    for (size_t seen = 0; !error && at != end && seen < kMostFolders; at.increment(error), ++seen)
        if (std::string path = found(at->path() / name); !path.empty()) return path;
    return {};
}

// The text of the first <name> of a package.xml.
std::string name_in(const fs::path& mark) {
    std::optional<std::string> xml = read_regular_file(mark.string(), kMostXml);
    size_t begin = xml ? xml->find("<name>") : std::string::npos;
    if (begin == std::string::npos) return {};
    begin = xml->find_first_not_of(" \t\r\n", begin + 6);
    size_t end = std::min(xml->find('<', begin), xml->size());
    std::string name = begin < end ? xml->substr(begin, end - begin) : std::string();
    name.resize(name.find_last_not_of(" \t\r\n") + 1);
    return name;
}

std::string find_around(const Scheme& scheme, const fs::path& folder, const std::string& name,
                        const std::string& rest) {
    auto file = [&](const fs::path& package) {
        std::string path = (package / rest).lexically_normal().string();
        return is_regular_file(path) ? path : std::string();
    };
    std::error_code error;
    fs::path at = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error) return {};
    if (!at.has_filename()) at = at.parent_path();
    for (; at.has_relative_path(); at = at.parent_path()) {
        if (at.filename() == name)
            if (std::string path = file(at); !path.empty()) return path;
        if (!is_regular_file((at / scheme.mark).string())) continue;
        if (scheme.named && name_in(at / scheme.mark) == name) return file(at);
        return file(at.parent_path() / name);
    }
    return {};
}

}  // namespace

bool is_package_uri(std::string_view uri) {
    return scheme_of(uri) != nullptr;
}

std::string path_of_package_uri(std::string_view uri, const std::string& folder) {
    const Scheme* scheme = scheme_of(uri);
    if (!scheme) return {};
    std::string_view whole = uri.substr(scheme->scheme.size());
    size_t slash = std::min(whole.find('/'), whole.size());
    size_t behind = std::min(whole.find_first_not_of('/', slash), whole.size());
    std::string name(whole.substr(0, slash)), rest(whole.substr(behind));
    if (name.empty() || name == "." || name == ".." || rest.empty()) return {};
    for (const Variable& variable : scheme->variables)
        for (const fs::path& place : folders_of(variable))
            if (std::string path = find_below(place, name, rest); !path.empty()) return path;
    return find_around(*scheme, folder, name, rest);
}

}  // namespace kinora
