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

std::string base_name(std::string_view path) {
    size_t slash = path.find_last_of("/\\");
    return std::string(slash == path.npos ? path : path.substr(slash + 1));
}

// <init_from>file</init_from>, in 1.5 <init_from><ref>file</ref></init_from>.
std::string_view file_of(const Element& image) {
    const Element* from = image.child("init_from");
    if (from && from->child("ref")) from = from->child("ref");
    return from ? trim(from->text) : std::string_view{};
}

}  // namespace

const Element* ImageNames::find(uint32_t doc, const std::string& name) {
    auto [at, fresh] = of_.try_emplace(doc);
    Table& table = at->second;
    for (const Element* library = fresh ? documents_[doc].root().first_child : nullptr; library;
         library = library->next) {
        if (library->name != "library_images") continue;
        for (const Element& image : library->children()) {
            if (image.name != "image") continue;
            for (const char* attribute : {"name", "sid"})
                if (image.attribute(attribute))
                    table.try_emplace(std::string(image.value(attribute)), &image);
            if (std::string file = base_name(file_of(image)); !file.empty())
                table.try_emplace(std::move(file), &image);
        }
    }
    auto found = table.find(name);
    return found == table.end() ? nullptr : found->second;
}

uint32_t image_called(Extraction& x, uint32_t doc, std::string_view name) {
    std::string_view id = name.starts_with('#') ? name.substr(1) : name;
    const Element* image = find_kind(x.document(doc), id, {"image"});
    if (!image) image = x.image_names.find(doc, base_name(id));
    return image ? image_index(x, {doc, image}) : kNone;
}

uint32_t file_image(Extraction& x, Link user, std::string_view uri) {
    const Document& document = x.document(user.doc);
    if (uri.find('.') == uri.npos) return kNone;  // no name of a file
    FoundPicture found = x.pictures.find(path_of_uri(document, uri), document.directory(),
                                         x.documents.allowed_pictures());
    if (found.match == PictureMatch::Missing || found.match == PictureMatch::Outside) return kNone;
    auto [at, fresh] = x.file_images.emplace(found.path, kNone);
    if (!fresh || !x.budget.reserve(sizeof(Image) + kBookBytes, x.where(user))) return at->second;
    Image image;
    image.name = image.uri = uri;
    image.path = found.path;
    image.where = x.where(user);
    return at->second = append(x.scene.images, std::move(image));
}

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
