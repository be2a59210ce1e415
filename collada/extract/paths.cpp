// collada/extract/paths.cpp: which files a document may name, and what is wrong with their names.
#include "collada/document/uri.h"
#include "collada/extract/extract_p.h"

namespace kinora::collada {

namespace {

// "C:/", also behind "../../": how exporters made absolute paths relative.
bool names_drive(std::string_view path) {
    while (path.starts_with("../")) path.remove_prefix(3);
    return starts_with_drive(path);
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

bool inside_tree(Extraction& x, const std::string& path) {
    if (!x.trees) {
        const std::string& own = x.options.folder;
        std::vector<std::string> folders{own.empty() ? x.document(0).directory() : own};
        folders.insert(folders.end(), x.options.allow_external.begin(),
                       x.options.allow_external.end());
        x.trees = AllowedPaths(folders);
    }
    return x.trees->contains(path);
}

}  // namespace kinora::collada
