// collada/document/uri.cpp: URIs of documents as paths of files.
#include "collada/document/uri.h"

#include <cctype>
#include <filesystem>

#include "collada/text/encoding_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/uri/package_uri.h"

namespace kinora::collada {

bool starts_with_drive(std::string_view path) {
    return path.size() > 2 && std::isalpha(uint8_t(path[0])) && path[1] == ':' && path[2] == '/';
}

// A scheme's letters may be of either case (RFC 3986, 3.1).
bool takes_file_scheme(std::string& path) {
    constexpr std::string_view kScheme = "file:";
    if (path.size() < kScheme.size()) return false;
    for (size_t i = 0; i < kScheme.size(); ++i)
        if (std::tolower(uint8_t(path[i])) != kScheme[i]) return false;
    path.erase(0, kScheme.size());
    return true;
}

namespace {

constexpr std::string_view kLocalHost = "localhost";

// Whether the name of this computer stands before an absolute path.
bool is_local_host(std::string_view path) {
    return path.starts_with(kLocalHost) && path.substr(kLocalHost.size()).starts_with('/');
}

// A URI without its host as a path, '/' between its parts; relative unless it says otherwise.
std::string written_path(std::string_view uri) {
    std::string path = percent_decode(trim(uri));
    for (char& c : path)
        if (c == '\\') c = '/';
    if (takes_file_scheme(path)) {
        // file:///abs and file:/abs are absolute, file://localhost/abs too (RFC 8089, 2);
        // file://NAME is an exporter's relative name.
        bool host = path.starts_with("//");
        if (host) path.erase(0, 2);
        if (host && is_local_host(path)) path.erase(0, kLocalHost.size());
        if (starts_with_drive(std::string_view(path).substr(path.starts_with('/') ? 1 : 0)) &&
            path.starts_with('/'))
            path.erase(0, 1);
    }
    return path;
}

bool is_absolute(std::string_view path) {
    return path.starts_with('/') || starts_with_drive(path);
}

// The folder that relative URIs start from: the document's, or what its xml:base makes of it (RFC
// 3986, 5.1: up to the last '/'). An xml:base of the network is left aside.
std::string base_folder(const Document& document) {
    std::string_view base = trim(document.root().value("xml:base"));
    if (base.empty() || (base.find("://") != base.npos && !base.starts_with("file:")))
        return document.directory();
    std::string path = written_path(base);
    path.resize(path.find_last_of('/') + 1);  // npos + 1 is 0
    return is_absolute(path) ? path : document.directory() + path;
}

}  // namespace

std::string path_of_uri(const Document& document, std::string_view uri) {
    std::string path = written_path(uri);
    if (path.empty()) return {};
    if (std::string found = path_of_package_uri(path, document.directory()); !found.empty())
        return found;
    auto normal = [](const std::string& text) {
        return std::filesystem::path(text).lexically_normal().string();
    };
    if (is_absolute(path)) return normal(path);
    std::string based = normal(base_folder(document) + path);
    std::string beside = normal(document.directory() + path);
    bool moved = based != beside && is_regular_file(based);
    return moved ? based : beside;
}

}  // namespace kinora::collada
