// collada/extract/linked_documents.cpp: documents that links name are found, read once and
// numbered.
#include "collada/extract/linked_documents_p.h"

#include "collada/document/findings.h"
#include "collada/document/uri.h"
#include "collada/extract/extract_p.h"
#include "collada/schema/schema.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

const AllowedPaths& LinkedDocuments::allowed_paths() {
    if (!allowed_) {
        const std::string& own = options_.folder;
        std::vector<std::string> folders{own.empty() ? documents_[0]->directory() : own};
        folders.insert(folders.end(), options_.allow_external.begin(),
                       options_.allow_external.end());
        allowed_ = AllowedPaths(folders);
    }
    return *allowed_;
}

const AllowedPaths& LinkedDocuments::allowed_pictures() {
    bool confined = options_.confine || !options_.folder.empty();
    if (!pictures_) pictures_ = confined ? allowed_paths() : allowed_paths().anywhere();
    return *pictures_;
}

// Each link into a document that cannot be had says so.
void LinkedDocuments::report_unread(const std::string& path, std::string_view file,
                                    Location where) {
    diag_.report(
        is_regular_file(path) ? Code::LINK_EXTERNAL_UNREADABLE : Code::LINK_EXTERNAL_MISSING, where,
        file);
}

// The file that a link means: where its URI says, else one of that name beside the document.
std::string LinkedDocuments::path_of_link(uint32_t from, std::string_view file, Location where) {
    const Document& document = *documents_[from];
    std::string path = path_of_uri(document, file);
    bool found = allowed_paths().contains(path) && is_regular_file(path);
    std::string beside = document.directory() + path.substr(path.find_last_of('/') + 1);
    if (found || beside == path || !allowed_paths().contains(beside) || !is_regular_file(beside))
        return path;
    diag_.report(Code::FILE_FALLBACK, where, file, beside);
    return beside;
}

uint32_t LinkedDocuments::linked(uint32_t from, std::string_view file, Location where) {
    // The system is asked once a path: thousands of links may name one document.
    std::string written = path_of_uri(*documents_[from], file);
    auto linked = by_link_.find(written);
    if (linked != by_link_.end()) return linked->second;
    uint32_t doc = at_path(path_of_link(from, file, where), file, where);
    if (doc != kNone) by_link_.emplace(written, doc);
    return doc;
}

uint32_t LinkedDocuments::at_path(const std::string& path, std::string_view file, Location where) {
    if (!allowed_paths().contains(path)) {
        diag_.report(Code::LINK_OUTSIDE, where, file);
        return kNone;
    }
    std::string real = real_path(path);
    auto known = by_path_.find(real);
    if (known != by_path_.end()) {
        if (known->second == kNone) report_unread(path, file, where);
        return known->second;
    }
    if (documents_.size() >= options_.max_documents) {
        diag_.report(Code::LINK_TOO_MANY, where,
                     fmt::format("more than {} linked documents", options_.max_documents));
        return kNone;
    }
    std::optional<Document> document;
    size_t before = diag_.findings().size();
    if (is_regular_file(path)) document = read_document(path, diag_);
    diag_.lower_errors(before);
    if (!document) {
        report_unread(path, file, where);
        by_path_[real] = kNone;
        return kNone;
    }
    owned_.push_back(std::make_unique<Document>(std::move(*document)));
    return add(*owned_.back(), real);
}

uint32_t LinkedDocuments::find(uint32_t from, std::string_view file) {
    std::string path = path_of_uri(*documents_[from], file);
    auto known = by_link_.find(path);
    if (known != by_link_.end()) return known->second;
    auto read = by_path_.find(real_path(path));
    if (read == by_path_.end() || read->second == kNone) return kNone;
    by_link_.emplace(path, read->second);
    return read->second;
}

uint32_t LinkedDocuments::add(const Document& document, const std::string& real_path) {
    uint32_t index = size();
    documents_.push_back(&document);
    budget_.add_text(diag_.files.text(document.file()).size());
    by_path_[real_path] = index;
    check_elements(document, diag_, schema_.value_or(document.version()));
    scene_.documents.push_back({document.path(), read_asset(document, diag_), document.file()});
    return index;
}

}  // namespace kinora::collada
