// collada/document/document_builder.cpp: start tags, texts and end tags become the element tree.
#include "collada/document/document_builder_p.h"

#include <algorithm>
#include <cstring>

#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

constexpr uint32_t kMaxElements = 30'000'000;
// The tree may take this much for each byte of the file. A triangle a <p> needs 10.
constexpr uint64_t kBytesPerByte = 10, kFreeBytes = 16 << 20;

}  // namespace

DocumentBuilder::DocumentBuilder(const std::string& path, FileId file, std::string_view text)
    : text_(text), pool_(document_.arena_) {
    document_.path_ = path;
    size_t slash = path.find_last_of('/');
    if (slash != std::string::npos) document_.directory_ = path.substr(0, slash + 1);
    document_.file_ = file;
}

Room DocumentBuilder::room() const {
    if (open_.size() >= kMaxDepth) return Room::TooDeep;
    if (document_.element_count_ >= kMaxElements) return Room::TooManyElements;
    if (pool_.taken() > kFreeBytes + kBytesPerByte * text_.size()) return Room::TooMuchMemory;
    return Room::Enough;
}

// Prefixes of COLLADA's namespace, and others that hide them.
void DocumentBuilder::bind_prefixes(std::span<const Attribute> attributes) {
    constexpr std::string_view kXmlns = "xmlns:";
    for (const Attribute& a : attributes) {
        if (!a.name.starts_with(kXmlns)) continue;
        bool own = a.value == name_space_ && !name_space_.empty();
        if (own || !bindings_.empty())
            bindings_.push_back({a.name.substr(kXmlns.size()), own, open_.size()});
    }
}

std::string_view DocumentBuilder::local_name(std::string_view name) const {
    size_t colon = bindings_.empty() ? name.npos : name.find(':');
    if (colon == name.npos) return name;
    for (size_t i = bindings_.size(); i-- > 0;)
        if (bindings_[i].prefix == name.substr(0, colon))
            return bindings_[i].own ? name.substr(colon + 1) : name;
    return name;
}

// Its prefix is taken for COLLADA's, whatever it stands for: check_root speaks of that.
void DocumentBuilder::start_root(std::string_view file_name,
                                 std::span<const Attribute> attributes) {
    size_t colon = file_name.find(':');
    std::string xmlns = "xmlns";
    if (colon != std::string_view::npos) {
        prefix_ = file_name.substr(0, colon + 1);
        bindings_.push_back({file_name.substr(0, colon), true, 0});
        xmlns += ":" + std::string(file_name.substr(0, colon));
    }
    for (const Attribute& a : attributes)
        if (a.name == xmlns) name_space_ = a.value;
}

void DocumentBuilder::start_element(ByteRange tag, std::string_view file_name,
                                    std::span<const Attribute> attributes) {
    Element* element = new (pool_.take(sizeof(Element))) Element;
    if (!root_) {
        root_ = element;
        start_root(file_name, attributes);
    }
    bind_prefixes(attributes);
    auto* kept = static_cast<Attribute*>(pool_.take(attributes.size_bytes()));
    std::uninitialized_copy(attributes.begin(), attributes.end(), kept);
    for (size_t i = 0; i < attributes.size(); ++i) {
        kept[i].name = local_name(kept[i].name);
        // XML Schema's ID and NCName: white space around them is none of theirs.
        if (kept[i].name == "id" || kept[i].name == "sid") kept[i].value = trim(kept[i].value);
    }
    element->name = local_name(file_name);
    element->attributes = {kept, attributes.size()};
    element->start_tag = tag;
    element->bytes = tag;
    element->index = document_.element_count_++;
    if (!open_.empty()) {
        OpenElement& parent = open_.back();
        element->parent = parent.element;
        if (parent.last_child)
            parent.last_child->next = element;
        else
            parent.element->first_child = element;
        parent.last_child = element;
    }
    open_.push_back({element, nullptr, file_name, pieces_.size(), scratch_.size()});
}

void DocumentBuilder::add_text(uint32_t begin, std::string_view text) {
    if (open_.empty()) return;
    if (open_.back().last_child && is_xml_space(text)) return;
    // Bytes that are the same in the file need no copy, whatever markup stands around them.
    const char* here = text_.data() + begin;
    bool verbatim = text.data() == here || (begin + text.size() <= text_.size() &&
                                            !std::memcmp(here, text.data(), text.size()));
    if (verbatim && pieces_.size() > open_.back().first_piece) {
        Piece& last = pieces_.back();
        if (last.scratch < 0 && last.file_begin + last.length == begin) {
            last.length += uint32_t(text.size());
            return;
        }
    }
    pieces_.push_back({begin, uint32_t(text.size()), verbatim ? -1 : int64_t(scratch_.size())});
    if (!verbatim) scratch_.append(text);
}

void DocumentBuilder::finish_text(const OpenElement& open) {
    std::span<const Piece> pieces(pieces_.data() + open.first_piece,
                                  pieces_.size() - open.first_piece);
    Element& element = *open.element;
    auto piece_text = [&](const Piece& p) {
        return p.scratch < 0 ? text_.substr(p.file_begin, p.length)
                             : std::string_view(scratch_).substr(size_t(p.scratch), p.length);
    };
    bool only_space = true;
    size_t length = 0;
    for (const Piece& p : pieces) {
        length += p.length;
        only_space = only_space && is_xml_space(piece_text(p));
    }
    if (pieces.empty() || (only_space && element.first_child)) return;
    auto* map =
        static_cast<SourceMap::Segment*>(pool_.take(pieces.size() * sizeof(SourceMap::Segment)));
    char* text = nullptr;
    if (pieces.size() == 1 && pieces[0].scratch < 0)
        element.text = piece_text(pieces[0]);
    else
        element.text = {text = static_cast<char*>(pool_.take(length)), length};
    uint32_t at = 0;
    for (size_t i = 0; i < pieces.size(); ++i) {
        map[i] = {at, pieces[i].file_begin};
        if (text) std::memcpy(text + at, piece_text(pieces[i]).data(), pieces[i].length);
        at += pieces[i].length;
    }
    element.text_map = {map, pieces.size()};
}

void DocumentBuilder::end_element(uint32_t end) {
    OpenElement open = open_.back();
    // An empty tag <a/> may give both events at the same byte.
    open.element->bytes.end = std::max(end, open.element->start_tag.end);
    finish_text(open);
    pieces_.resize(open.first_piece);
    scratch_.resize(open.first_scratch);
    open_.pop_back();
    while (!bindings_.empty() && bindings_.back().depth >= open_.size() && !open_.empty())
        bindings_.pop_back();
}

void DocumentBuilder::close_after_error() {
    document_.whole_ = false;
    for (size_t i = 1; i < open_.size(); ++i) {
        if (open_[i].element->name.starts_with("library_")) continue;
        Element* parent = open_[i - 1].element;
        Element* cut = open_[i].element;
        Element* before = nullptr;
        for (Element* e = const_cast<Element*>(parent->first_child); e != cut;
             e = const_cast<Element*>(e->next))
            before = e;
        if (before)
            before->next = nullptr;
        else
            parent->first_child = nullptr;
        break;
    }
    for (OpenElement& open : open_) open.element->bytes.end = uint32_t(text_.size());
}

void DocumentBuilder::register_id(Element& element) {
    std::string_view id = element.value("id");
    if (id.empty()) return;
    auto [first, fresh] = document_.ids_.emplace(id, &element);
    if (fresh) return;
    auto at = last_with_id_.emplace(id, const_cast<Element*>(first->second)).first;
    at->second->next_same_id = &element;
    at->second = &element;
}

Document DocumentBuilder::finish() {
    document_.root_ = root_;
    // Ids in document order, without those of elements that an error cut off.
    std::vector<const Element*> todo{root_};
    while (!todo.empty()) {
        const Element* e = todo.back();
        todo.pop_back();
        register_id(*const_cast<Element*>(e));
        if (e->next) todo.push_back(e->next);
        if (e->first_child) todo.push_back(e->first_child);
    }
    return std::move(document_);
}

}  // namespace kinora::collada
