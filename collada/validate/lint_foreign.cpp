// collada/validate/lint_foreign.cpp: elements of other makers against the schema that the document
// names for them. The program that validates brings the checker of schemas along.
#include <map>

#include "collada/document/uri.h"
#include "collada/schema/namespaces_p.h"
#include "collada/validate/lint_p.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

namespace {

// "http://..." and the like: a scheme that is not file's.
bool is_remote(std::string_view uri) {
    size_t colon = uri.find("://");
    if (colon == uri.npos) return false;
    std::string scheme(uri.substr(0, colon));
    for (char& c : scheme) c = char(std::tolower(uint8_t(c)));
    return scheme != "file";
}

class ForeignWalk {
  public:
    ForeignWalk(Lint& lint, uint32_t doc)
        : lint_(lint), document_(lint.x.document(doc)), namespaces_(document_.root()) {}

    void run() {
        collect(document_.root());
        for (const auto& [key, elements] : by_schema_) {
            const auto& [name_space, file] = key;
            std::string why = check(name_space, file, elements);
            if (!why.empty())
                lint_.diag.report(Code::SCHEMA_FOREIGN, document_.location(*elements.front()),
                                  name_space, ": " + why);
        }
    }

  private:
    using Elements = std::vector<const Element*>;

    // The outermost ones; what is inside belongs to them.
    void collect(const Element& element) {
        if (!namespaces_.foreign(element)) {
            for (const Element& child : element.children()) collect(child);
            return;
        }
        std::string_view name_space = namespaces_.of(element);
        std::string_view file = namespaces_.schema(element, name_space);
        if (!file.empty()) by_schema_[{name_space, file}].push_back(&element);
    }

    // "" or why nothing was checked.
    std::string check(std::string_view name_space, std::string_view file,
                      const Elements& elements) {
        std::string path = path_of_uri(document_, file);
        if (is_remote(file))
            return fmt::format("their schema '{}' is no local file, and no network is used", file);
        if (!lint_.x.documents.allowed_paths().contains(path))
            return fmt::format(
                "their schema '{}' lies outside the scene's folder (--allow-external DIR)", file);
        if (!is_regular_file(path)) return fmt::format("there is no file '{}', their schema", file);
        if (!lint_.options.check_foreign) return fmt::format("their schema '{}' is not read", file);
        return lint_.options.check_foreign(
            {document_, name_space, path, elements, lint_.x.documents.allowed_paths(), lint_.diag});
    }

    Lint& lint_;
    const Document& document_;
    Namespaces namespaces_;
    std::map<std::pair<std::string_view, std::string_view>, Elements> by_schema_;
};

}  // namespace

void lint_foreign(Lint& lint) {
    for (uint32_t doc = 0; doc < lint.x.documents.size(); ++doc) ForeignWalk(lint, doc).run();
}

}  // namespace kinora::collada
