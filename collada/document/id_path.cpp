// collada/document/id_path.cpp: from byte offsets to elements to paths.
#include "collada/document/id_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace kinora::collada {

namespace {

void list_elements(const Element& root, std::vector<const Element*>& list) {
    for (const Element* at = &root; at;) {
        list.push_back(at);
        if (at->first_child) {
            at = at->first_child;
            continue;
        }
        while (at != &root && !at->next) at = at->parent;
        at = at == &root ? nullptr : at->next;
    }
}

std::string in_quotes(std::string_view value) {
    char quote = value.find('\'') == value.npos ? '\'' : '"';
    return fmt::format("{}{}{}", quote, value, quote);
}

}  // namespace

ElementIndex::ElementIndex(const Document& document) {
    elements_.reserve(document.element_count());
    list_elements(document.root(), elements_);
}

const Element& ElementIndex::at(uint32_t offset) const {
    auto after = std::upper_bound(
        elements_.begin(), elements_.end(), offset,
        [](uint32_t wanted, const Element* element) { return wanted < element->bytes.begin; });
    if (after == elements_.begin()) return *elements_.front();
    const Element* element = after[-1];
    // What an XML error cut off has no end of its own and reaches to the end of the file.
    auto holds = [&](const Element& e) {
        return offset < e.bytes.end || e.bytes.end <= e.bytes.begin;
    };
    while (element->parent && !holds(*element)) element = element->parent;
    return *element;
}

void ElementIndex::number_children(const Element& parent) {
    if (!numbered_.insert(&parent).second) return;
    std::unordered_map<std::string_view, std::pair<const Element*, uint32_t>> last;
    for (const Element& child : parent.children()) {
        auto [known, is_first] = last.try_emplace(child.name, &child, 1);
        if (is_first) continue;
        numbers_.try_emplace(known->second.first, 1);  // the first of several
        numbers_[&child] = ++known->second.second;
    }
}

std::string ElementIndex::step(const Element& element) {
    // An element of many attributes may be asked for at each of their findings.
    constexpr size_t kMany = 16;
    if (element.attributes.size() <= kMany) return new_step(element);
    auto [at, fresh] = steps_.try_emplace(&element);
    if (fresh) at->second = new_step(element);
    return at->second;
}

std::string ElementIndex::new_step(const Element& element) {
    if (const Attribute* id = element.attribute("id"))
        return fmt::format("{}[@id={}]", element.name, in_quotes(id->value));
    if (const Attribute* sid = element.attribute("sid"))
        return fmt::format("{}[@sid={}]", element.name, in_quotes(sid->value));
    number_children(*element.parent);
    auto number = numbers_.find(&element);
    return number == numbers_.end() ? std::string(element.name)
                                    : fmt::format("{}[{}]", element.name, number->second);
}

std::string ElementIndex::path(const Element& element) {
    if (!element.parent) return std::string(element.name);
    std::vector<const Element*> way;
    for (const Element* at = &element; at->parent; at = at->parent) way.push_back(at);
    std::string path;
    for (auto at = way.rbegin(); at != way.rend(); ++at)
        path += (path.empty() ? "" : "/") + step(**at);
    return path;
}

namespace {

void add_paths_of_file(const Document& document, FileId file, std::vector<Finding>& findings) {
    ElementIndex index(document);
    for (Finding& finding : findings)
        if (finding.where.file == file && finding.id_path.empty())
            finding.id_path = index.path(index.at(finding.where.begin));
}

}  // namespace

void add_id_paths(const Document& document, const SourceFiles& files,
                  std::vector<Finding>& findings) {
    std::map<FileId, bool> wanted;
    for (const Finding& finding : findings)
        if (finding.where.file != kNoFile) wanted[finding.where.file] = true;
    for (auto [file, is_wanted] : wanted) {
        if (file == document.file()) {
            add_paths_of_file(document, file, findings);
            continue;
        }
        // Another document that a link led to. Shader files are no documents.
        std::string_view text = files.text(file);
        if (text.find("<COLLADA") == text.npos) continue;
        Diagnostics known;  // its findings were reported when it was first read
        if (auto other = read_document_text(files.name(file), std::string(text), known))
            add_paths_of_file(*other, file, findings);
    }
}

}  // namespace kinora::collada
