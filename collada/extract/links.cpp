// collada/extract/links.cpp: url, source and target attributes lead to elements.
#include <filesystem>

#include "collada/document/uri.h"
#include "collada/extract/extract_p.h"
#include "collada/schema/schema.h"
#include "collada/text/encoding_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

bool is_kind(std::string_view name, Kinds kinds) {
    for (std::string_view kind : kinds)
        if (kind == name) return true;
    return false;
}

std::string kinds_text(Kinds kinds) {
    std::string text;
    for (std::string_view kind : kinds) text += (text.empty() ? "" : "> or <") + std::string(kind);
    return text;
}

// Each link into a document that cannot be had says so.
void report_unread(Extraction& x, const std::string& path, std::string_view file, Location where) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error))
        x.diag.report(Code::LINK_EXTERNAL_UNREADABLE, where, file);
    else
        x.diag.report(Code::LINK_EXTERNAL_MISSING, where, file);
}

// The file that a link means: where its URI says, else one of that name beside the document.
std::string linked_path(Extraction& x, Link from, std::string_view file, Location where) {
    std::string path = path_of_uri(x.document(from.doc), file);
    std::error_code error;
    bool found = inside_tree(x, path) && std::filesystem::is_regular_file(path, error);
    std::string beside = x.document(from.doc).directory() + path.substr(path.find_last_of('/') + 1);
    if (found || beside == path || !inside_tree(x, beside) ||
        !std::filesystem::is_regular_file(beside, error))
        return path;
    x.diag.report(Code::FILE_FALLBACK, where, file, beside);
    return beside;
}

// The document that the part before '#' names; kNone and a finding if there is none.
uint32_t linked_document(Extraction& x, Link from, std::string_view file, Location where) {
    // The system is asked once a path: thousands of links may name one document.
    std::string written = path_of_uri(x.document(from.doc), file);
    auto linked = x.doc_by_link.find(written);
    if (linked != x.doc_by_link.end()) return linked->second;
    std::string path = linked_path(x, from, file, where);
    if (!inside_tree(x, path)) {
        x.diag.report(Code::LINK_OUTSIDE, where, file);
        return kNone;
    }
    std::error_code error;
    std::string real = real_path(path);
    auto known = x.doc_by_path.find(real);
    if (known != x.doc_by_path.end()) {
        if (known->second == kNone)
            report_unread(x, path, file, where);
        else
            x.doc_by_link.emplace(written, known->second);
        return known->second;
    }
    if (x.docs.size() >= x.options.max_documents) {
        x.diag.report(Code::LINK_TOO_MANY, where,
                      fmt::format("more than {} linked documents", x.options.max_documents));
        return kNone;
    }
    if (!std::filesystem::is_regular_file(path, error)) {
        report_unread(x, path, file, where);
        x.doc_by_path[real] = kNone;
        return kNone;
    }
    std::optional<Document> document = read_document(path, x.diag);
    if (!document) {
        report_unread(x, path, file, where);
        x.doc_by_path[real] = kNone;
        return kNone;
    }
    x.owned.push_back(std::make_unique<Document>(std::move(*document)));
    return x.doc_by_link[written] = add_document(x, *x.owned.back(), real);
}

dmat4 y_up_from(UpAxis axis) {
    switch (axis) {
        case UpAxis::X:  // right -y, up x, towards us z
            return dmat4({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
        case UpAxis::Y:
            return dmat4(1.0);
        case UpAxis::Z:  // right x, up z, towards us -y
            return dmat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1});
    }
    return dmat4(1.0);
}

dmat4 transposed(const dmat4& m) {
    dmat4 t;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) t[c][r] = m[r][c];
    return t;
}

}  // namespace

const Element* find_kind(const Document& document, std::string_view id, Kinds kinds) {
    const Element* element = document.find(id);
    for (size_t i = 0; element && i < kMostSameId; ++i, element = element->next_same_id)
        if (is_kind(element->name, kinds)) return element;
    return nullptr;
}

Link resolve(Extraction& x, Link from, std::string_view attribute, Kinds kinds) {
    const Element& element = *from.element;
    std::string_view url = trim(attribute.empty() ? element.text : element.value(attribute));
    Location where = attribute.empty() ? x.text_where(from) : x.where(from, attribute);
    if (url.empty()) {
        x.diag.report(Code::SCHEMA_MISSING_ATTRIBUTE, where, element.name,
                      attribute.empty() ? std::string_view("link") : attribute);
        return {};
    }
    uint32_t doc = from.doc;
    size_t hash = url.find('#');
    std::string id;
    if (hash == url.npos) {
        if (!x.document(doc).find(url)) {
            x.diag.report(Code::LINK_UNRESOLVED, where, url, kinds_text(kinds));
            return {};
        }
        x.diag.report(attribute == "source" ? Code::SRC_NO_HASH : Code::LINK_NO_HASH, where, url);
        id = url;
    } else {
        if (hash > 0) doc = linked_document(x, from, url.substr(0, hash), where);
        if (doc == kNone) return {};
        id = url.substr(hash + 1);
        if (!x.document(doc).find(id)) id = percent_decode(id);
    }
    if (const Element* found = find_kind(x.document(doc), id, kinds)) return {doc, found};
    if (const Element* other = x.document(doc).find(id))
        x.diag.report(Code::LINK_WRONG_TYPE, where, url, other->name, kinds_text(kinds));
    else
        x.diag.report(Code::LINK_UNRESOLVED, where, url, kinds_text(kinds));
    return {};
}

uint32_t add_document(Extraction& x, const Document& document, const std::string& real) {
    uint32_t index = uint32_t(x.docs.size());
    x.docs.push_back(&document);
    x.text_bytes += x.diag.files.text(document.file()).size();
    x.doc_by_path[real] = index;
    check_elements(document, x.diag, x.schema.value_or(document.version()));
    x.scene.documents.push_back({document.path(), read_asset(document, x.diag), document.file()});
    return index;
}

namespace {

bool within(Extraction& x, uint64_t& used, uint64_t more, uint64_t limit, Location where) {
    if (x.over_limit || used + more > limit) {
        if (!x.over_limit)
            x.diag.report(Code::LINK_TOO_MANY, where,
                          std::string("what the links share unfolds to too much data"));
        x.over_limit = true;
        return false;
    }
    used += more;
    return true;
}

}  // namespace

uint64_t most_made_bytes(const Extraction& x) {
    return (16 << 20) + 8 * x.text_bytes;
}

bool reserve_memory(Extraction& x, uint64_t bytes, Location where) {
    return within(x, x.made_bytes, bytes, most_made_bytes(x), where);
}

bool reserve_parsing_memory(Extraction& x, Link array) {
    return within(x, x.parsed_bytes, array.element->text.size(),
                  (uint64_t(256) << 20) + 32 * x.text_bytes, x.where(array));
}

uint32_t conversion(Extraction& x, uint32_t from, uint32_t to) {
    if (from == to) return kNone;
    auto [at, fresh] = x.conversion_of.emplace(uint64_t(from) << 32 | to, kNone);
    if (!fresh) return at->second;
    const Asset& user = x.scene.documents[from].asset;
    const Asset& used = x.scene.documents[to].asset;
    if (user.meter == used.meter && user.up_axis == used.up_axis) return kNone;
    dmat4 m = transposed(y_up_from(user.up_axis)) * y_up_from(used.up_axis);
    double scale = used.meter / user.meter;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) m[c][r] *= scale;
    return at->second = append(x.scene.conversions, m);
}

}  // namespace kinora::collada
