// collada/extract/links.cpp: url, source and target attributes lead to elements.
#include "collada/extract/extract_p.h"
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

}  // namespace

const Element* find_kind(const Document& document, std::string_view id, Kinds kinds) {
    const Element* element = document.find(id);
    for (size_t i = 0; element && i < kMostSameId; ++i, element = element->next_same_id)
        if (is_kind(element->name, kinds)) return element;
    return nullptr;
}

void report_ambiguous(Extraction& x, Link first, std::string_view id, Kinds kinds, Location where) {
    const Element* other = first.element->next_same_id;
    for (size_t i = 0; other && i < kMostSameId; ++i, other = other->next_same_id) {
        if (!is_kind(other->name, kinds)) continue;
        Finding& finding = x.diag.report(Code::LINK_AMBIGUOUS, where, id, kinds_text(kinds));
        finding.notes.push_back({x.where(first, "id"), "this one"});
        finding.notes.push_back({x.where({first.doc, other}, "id"), "and this one"});
        return;
    }
}

Link resolve(Extraction& x, Link from, std::string_view attribute, Kinds kinds) {
    const Element& element = *from.element;
    std::string_view url = trim(attribute.empty() ? element.text : element.value(attribute));
    Location where = attribute.empty() ? x.text_where(from) : x.where(from, attribute);
    if (url.empty() && element.name.starts_with("instance_")) {
        x.diag.report(Code::LINK_UNRESOLVED, where, url, kinds_text(kinds));
        return {};
    }
    if (url.empty()) {
        x.diag.report(Code::LINK_EMPTY, where, element.name,
                      attribute.empty() ? std::string_view("text") : attribute);
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
        if (hash > 0) doc = x.documents.linked(from.doc, url.substr(0, hash), where);
        if (doc == kNone) return {};
        id = url.substr(hash + 1);
        if (!x.document(doc).find(id)) id = percent_decode(id);
    }
    if (const Element* found = find_kind(x.document(doc), id, kinds)) {
        report_ambiguous(x, {doc, found}, url, kinds, where);
        return {doc, found};
    }
    if (const Element* other = x.document(doc).find(id))
        x.diag.report(Code::LINK_WRONG_TYPE, where, url, other->name, kinds_text(kinds));
    else if (x.document(doc).whole())  // an error may have cut the target off
        x.diag.report(Code::LINK_UNRESOLVED, where, url, kinds_text(kinds));
    return {};
}

}  // namespace kinora::collada
