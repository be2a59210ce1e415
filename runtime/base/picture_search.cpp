// runtime/base/picture_search.cpp: the places where exporters leave pictures.
#include "runtime/base/picture_search.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"

namespace kinora {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtensions[] = {"png",  "jpg", "jpeg", "tga", "dds", "tif",
                                            "tiff", "bmp", "exr",  "hdr", "gif", "psd"};

// Beside the document; the last two are the layout of Gazebo's and ROS's packages.
constexpr std::string_view kFolders[] = {"", "textures/", "images/", "../textures/",
                                         "../materials/textures/"};

constexpr size_t kMostEnds = 4;  // folders of a path that are looked for elsewhere
constexpr size_t kMostFiles = 10'000, kMostListed = 100'000;  // of a folder, of all folders

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = char(std::tolower(uint8_t(c)));
    return out;
}

std::string_view stem(std::string_view name) {
    size_t dot = name.find_last_of('.');
    return dot == name.npos || dot == 0 ? name : name.substr(0, dot);
}

// The folder's only entry of that name but for its case; "" if there is none or more than one.
std::string entry_of(const fs::path& folder, const std::string& name) {
    std::error_code error;
    std::string match;
    fs::directory_iterator at(folder.empty() ? "." : folder, error), end;
    for (size_t seen = 0; !error && at != end && seen < kMostFiles; at.increment(error), ++seen) {
        std::string found = at->path().filename().string();
        if (lower(found) != lower(name)) continue;
        if (!match.empty()) return {};
        match = found;
    }
    return match;
}

// The path of a folder as it is written on disk, where only the case of its names differs.
std::string written_folder(const std::string& folder) {
    std::error_code error;
    if (folder.empty() || fs::is_directory(folder, error)) return folder;
    fs::path written;
    for (const fs::path& name : fs::path(folder)) {
        if (name.empty() || fs::exists(written / name, error)) {
            written /= name;
            continue;
        }
        std::string entry = entry_of(written, name.string());
        if (entry.empty()) return folder;
        written /= entry;
    }
    return written.string();
}

// "Macintosh HD:Textures:skin.png": how an old Mac wrote paths.
std::string with_slashes(std::string path) {
    size_t name = path.find_last_of('/') + 1;
    if (std::count(path.begin() + ptrdiff_t(name), path.end(), ':') > 1)
        std::replace(path.begin() + ptrdiff_t(name), path.end(), ':', '/');
    return path;
}

// What the ends of a path's folder name, the longest first: art/tex/ and tex/ of
// "C:/art/tex/a.png".
std::vector<std::string> ends_of_folder(const std::string& path) {
    std::vector<std::string> ends;
    for (const fs::path& name : fs::path(path).parent_path()) {
        std::string entry = name.string();
        if (entry == "." || entry == ".." || entry == "/" || entry.ends_with(':')) {
            ends.clear();
            continue;
        }
        for (std::string& end : ends) end += entry + "/";
        ends.push_back(entry + "/");
        if (ends.size() > kMostEnds) ends.erase(ends.begin());
    }
    return ends;
}

}  // namespace

void PictureSearch::list(const std::string& folder, Images& images) {
    std::error_code error;
    fs::directory_iterator at(folder.empty() ? "." : folder, error), end;
    for (size_t seen = 0; !error && at != end && seen < kMostFiles; at.increment(error), ++seen) {
        if (++listed_ > kMostListed) break;
        std::error_code no_file;
        if (!at->is_regular_file(no_file)) continue;
        std::string found = at->path().filename().string();
        std::string low = lower(found);
        images.by_name.try_emplace(low, found);
        std::string name_stem(stem(low));
        if (low.size() <= name_stem.size()) continue;
        std::string_view extension = std::string_view(low).substr(name_stem.size() + 1);
        auto known = std::find(std::begin(kExtensions), std::end(kExtensions), extension);
        if (known == std::end(kExtensions)) continue;
        size_t rank = size_t(known - std::begin(kExtensions));
        auto [best, fresh] = images.by_stem.try_emplace(name_stem, Best{rank, found});
        if (!fresh && rank < best->second.rank) best->second = {rank, found};
    }
}

const PictureSearch::Images* PictureSearch::images_of(const std::string& folder) {
    auto at = folders_.find(folder);
    if (at == folders_.end()) {
        if (listed_ > kMostListed || folders_.size() > kMostFiles) return nullptr;
        at = folders_.try_emplace(folder).first;
        list(folder, at->second);
    }
    return &at->second;
}

std::string PictureSearch::find_in(const std::string& folder, const std::string& name,
                                   bool by_stem) {
    const Images* images = images_of(folder);
    if (!images) return {};
    if (!by_stem) {
        auto same = images->by_name.find(name);
        return same == images->by_name.end() ? "" : folder + same->second;
    }
    auto like = images->by_stem.find(std::string(stem(name)));
    return like == images->by_stem.end() ? "" : folder + like->second.name;
}

const std::string& PictureSearch::written(const std::string& folder) {
    auto [at, fresh] = written_.try_emplace(folder);
    if (fresh) at->second = written_folder(folder);
    return at->second;
}

std::vector<std::string> PictureSearch::places(const std::string& own, const std::string& folder,
                                               const std::string& path,
                                               const AllowedPaths& allowed) {
    std::vector<std::string> list{own};
    auto add = [&](const std::string& candidate) {
        if (std::find(list.begin(), list.end(), candidate) == list.end()) list.push_back(candidate);
    };
    auto normal = [](const std::string& below) {
        return fs::path(below).lexically_normal().string();
    };
    for (std::string_view below : kFolders) add(normal(folder + std::string(below)));
    for (const char* above : {"", "../", "../../"})
        for (const std::string& end : ends_of_folder(path))
            if (std::string below = normal(folder + above + end); allowed.contains(below))
                add(written(below));
    return list;
}

FoundPicture PictureSearch::find(const std::string& path, const std::string& folder,
                                 const AllowedPaths& allowed) {
    bool inside = allowed.contains(path), there = is_regular_file(path);
    if (inside && there) return {PictureMatch::Exact, allowed.name_of(path)};
    std::string slashed = with_slashes(path);
    std::string_view base = std::string_view(slashed).substr(slashed.find_last_of('/') + 1);
    std::string name = lower(utf8_or_latin1(base));
    // A folder that may not be read is not listed either.
    std::string own = inside ? written(slashed.substr(0, slashed.size() - base.size())) : folder;
    for (bool by_stem : {false, true})
        for (const std::string& candidate : places(own, folder, slashed, allowed)) {
            if (name.empty() || !allowed.contains(candidate)) continue;
            std::string found = find_in(candidate, name, by_stem);
            if (found.empty() || !allowed.contains(found)) continue;  // a link may lead out
            bool case_only = lower(found) == lower(path);
            return {case_only ? PictureMatch::Case : PictureMatch::Elsewhere,
                    allowed.name_of(found)};
        }
    return {there && !inside ? PictureMatch::Outside : PictureMatch::Missing, ""};
}

}  // namespace kinora
