// collada/extract/images.cpp: the file an <image> means, wherever exporters said it was, and what
// is wrong with its name.
#include <algorithm>
#include <filesystem>

#include "collada/document/uri.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtensions[] = {"png",  "jpg", "jpeg", "tga", "dds", "tif",
                                            "tiff", "bmp", "exr",  "hdr", "gif", "psd"};

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = char(std::tolower(uint8_t(c)));
    return out;
}

std::string_view file_name(std::string_view path) {
    return path.substr(path.find_last_of('/') + 1);
}

std::string_view stem(std::string_view name) {
    size_t dot = name.find_last_of('.');
    return dot == name.npos || dot == 0 ? name : name.substr(0, dot);
}

bool is_file(const std::string& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

constexpr size_t kMostFiles = 10'000, kMostListed = 100'000;  // of a folder, of all folders

}  // namespace

void ImageFolders::list(const std::string& folder, Images& images) {
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

std::string ImageFolders::find(const std::string& folder, std::string_view wanted) {
    auto at = folders_.find(folder);
    if (at == folders_.end()) {
        if (listed_ > kMostListed || folders_.size() > kMostFiles) return {};
        at = folders_.try_emplace(folder).first;
        list(folder, at->second);
    }
    std::string name = lower(wanted);
    auto same = at->second.by_name.find(name);
    if (same != at->second.by_name.end()) return folder + same->second;
    auto like = at->second.by_stem.find(std::string(stem(name)));
    return like == at->second.by_stem.end() ? "" : folder + like->second.name;
}

namespace {

std::string find_image(Extraction& x, uint32_t doc, const std::string& path, std::string_view uri,
                       Location where) {
    bool inside = x.documents.allowed_paths().contains(path);
    if (inside && is_file(path)) return path;
    const std::string& beside = x.document(doc).directory();
    std::string_view name = file_name(path);
    std::string found;
    if (inside) found = x.image_folders.find(path.substr(0, path.size() - name.size()), name);
    if (found.empty()) found = x.image_folders.find(beside, name);
    if (!found.empty() &&
        x.documents.allowed_paths().contains(found)) {  // it may be a link that leads out
        bool case_only = lower(found) == lower(path);
        x.diag.report(case_only ? Code::FILE_CASE : Code::FILE_FALLBACK, where, uri, found);
        return found;
    }
    if (!inside && is_file(path))
        x.diag.report(Code::LINK_OUTSIDE, where, uri);
    else
        x.diag.report(Code::FILE_MISSING, where, uri);
    return {};
}

// "C:/", also behind "../../": how exporters made absolute paths relative.
bool names_drive(std::string_view path) {
    while (path.starts_with("../")) path.remove_prefix(3);
    return starts_with_drive(path);
}

// 1.5 may make an image instead of loading it.
bool is_created(const Element& image) {
    for (const Element& child : image.children())
        if (child.name.starts_with("create_")) return true;
    return false;
}

}  // namespace

void check_file_uri(Extraction& x, std::string_view uri, Location where) {
    if (uri.find('\\') != uri.npos) x.diag.report(Code::FILE_BACKSLASH, where, uri);
    if (uri.find(' ') != uri.npos) x.diag.report(Code::FILE_SPACE, where, uri);
    std::string path(uri);
    for (char& c : path)
        if (c == '\\') c = '/';
    bool scheme = takes_file_scheme(path);
    bool host = path.starts_with("//") && !path.starts_with("///") &&
                !starts_with_drive(std::string_view(path).substr(2));
    if (host && scheme)
        x.diag.report(Code::FILE_HOST, where, uri);
    else if (path.starts_with('/') || names_drive(path))
        x.diag.report(Code::FILE_ABSOLUTE, where, uri);
}

uint32_t image_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    const Element& e = *link.element;
    if (!x.budget.reserve(sizeof(Image), x.where(link))) return kNone;
    Image image;
    image.id = e.value("id");
    image.name = e.value("name");
    image.where = x.where(link);
    const Element* from = e.child("init_from");
    for (std::string_view create : {"create_2d", "create_3d", "create_cube"})  // 1.5
        if (const Element* made = e.child(create); made && !from) from = made->child("init_from");
    const Element* embedded = e.child("data") ? e.child("data")
                              : from          ? from->child("hex")
                                              : nullptr;
    if (from && from->child("ref")) from = from->child("ref");
    if (from && !trim(from->text).empty()) {
        image.uri = trim(from->text);
        Location where = x.text_where({link.doc, from});
        check_file_uri(x, image.uri, where);
        std::string path = path_of_uri(x.document(link.doc), image.uri);
        image.path = find_image(x, link.doc, path, image.uri, where);
    } else if (embedded) {
        std::string_view format = embedded->name == "hex" ? embedded->value("format") : "";
        image.path = unpack_image(x, {link.doc, embedded},
                                  format.empty() ? e.value("format") : format, image.id);
    } else if (from) {
        x.diag.report(Code::FILE_EMPTY_URI, x.where({link.doc, from}), from->name);
    } else if (!is_created(e)) {
        x.diag.report(Code::SCHEMA_MISSING_ELEMENT, image.where, "image", "init_from");
    }
    return at->second = append(x.scene.images, std::move(image));
}

}  // namespace kinora::collada
