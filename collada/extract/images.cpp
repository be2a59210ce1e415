// collada/extract/images.cpp: the file an <image> means, wherever exporters said it was, and what
// is wrong with its name.
#include "collada/document/uri.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

std::string find_image(Extraction& x, uint32_t doc, std::string_view uri, Location where) {
    std::string path = path_of_uri(x.document(doc), uri);
    FoundPicture found =
        x.pictures.find(path, x.document(doc).directory(), x.documents.allowed_pictures());
    switch (found.match) {
        case PictureMatch::Exact:
            break;
        case PictureMatch::Case:
            x.diag.report(Code::FILE_CASE, where, uri, found.path);
            break;
        case PictureMatch::Elsewhere:
            x.diag.report(Code::FILE_FALLBACK, where, uri, found.path);
            break;
        case PictureMatch::Outside:
            x.diag.report(Code::LINK_OUTSIDE, where, uri);
            break;
        case PictureMatch::Missing:
            x.diag.report(Code::FILE_MISSING, where, uri);
            break;
    }
    return found.path;
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
        image.path = find_image(x, link.doc, image.uri, where);
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
