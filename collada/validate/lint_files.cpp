// collada/validate/lint_files.cpp: files that <include> names; of images the reader speaks, of RSL
// sources the reader of profile_RSL.
#include "collada/document/uri.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

namespace {

bool in_profile_rsl(const Element& element) {
    for (const Element* e = element.parent; e; e = e->parent)
        if (e->name == "profile_RSL") return true;
    return false;
}

}  // namespace

void lint_files(Lint& lint) {
    for (const Element* include : lint.named("include")) {
        std::string_view url = trim(include->value("url"));
        Location where = lint.where(*include, "url");
        if (url.empty()) {
            if (include->attribute("url"))
                lint.diag.report(Code::FILE_EMPTY_URI, where, include->name);
            continue;
        }
        check_file_uri(lint.x, url, where);
        if (in_profile_rsl(*include)) continue;
        std::string path = path_of_uri(lint.document, url);
        if (!lint.x.documents.allowed_paths().contains(path))
            lint.diag.report(Code::LINK_OUTSIDE, where, url);
        else if (!is_regular_file(path))
            lint.diag.report(Code::FILE_MISSING, where, url);
    }
}

}  // namespace kinora::collada
