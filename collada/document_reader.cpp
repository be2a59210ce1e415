// collada/document_reader.cpp: expat's events become the element tree.
#include "collada/document_reader_p.h"

#include <cstring>

#include "collada/encoding_p.h"

namespace kinora::collada {

namespace {

constexpr size_t kMaxDepth = 256;
constexpr size_t kChunk = 256 << 10;  // expat copies what it is given: keep that small
constexpr uint32_t kMaxElements = 30'000'000;
// The tree may take this much for each byte of the file. A triangle a <p> needs 10.
constexpr uint64_t kBytesPerByte = 10, kFreeBytes = 16 << 20;
// A tag must be whole before its attributes are seen, and they take much memory in expat.
constexpr size_t kMaxTag = 1 << 20, kMaxComment = 64 << 20;

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

bool all_space(std::string_view text) {
    for (char c : text)
        if (!is_space(c)) return false;
    return true;
}

}  // namespace

std::string_view DocumentReader::local_name(std::string_view name) const {
    return !prefix_.empty() && name.starts_with(prefix_) ? name.substr(prefix_.size()) : name;
}

// The tag is well-formed (expat has seen it), so a plain scan finds names and quotes.
std::span<const Attribute> DocumentReader::read_attributes(ByteRange tag,
                                                           const XML_Char** decoded) {
    attributes_.clear();
    const char* base = text_.data();
    const char* p = base + tag.begin + 1;
    const char* end = base + tag.end;
    while (p < end && !is_space(*p) && *p != '>' && *p != '/') ++p;
    for (; decoded[0]; decoded += 2) {
        while (p < end && is_space(*p)) ++p;
        const char* name = p;
        while (p < end && *p != '=' && !is_space(*p)) ++p;
        const char* name_end = p;
        while (p < end && *p != '"' && *p != '\'') ++p;
        if (p >= end) break;  // an attribute that a DTD added
        const char* value = p + 1;
        const char* value_end =
            static_cast<const char*>(std::memchr(value, *p, size_t(end - value)));
        if (!value_end) break;
        p = value_end + 1;
        std::string_view raw(value, size_t(value_end - value));
        bool plain = raw.find_first_of("&\t\r\n") == std::string_view::npos;
        attributes_.push_back({local_name({name, size_t(name_end - name)}),
                               plain ? raw : pool_.copy(std::string_view(decoded[1])),
                               {uint32_t(name - base), uint32_t(p - base)},
                               {uint32_t(value - base), uint32_t(value_end - base)}});
    }
    return pool_.copy(std::span<const Attribute>(attributes_));
}

void DocumentReader::start_element(const XML_Char* name, const XML_Char** attributes) {
    if (stopped_) return;
    if (open_.size() >= kMaxDepth) return stop(Code::XML_DEPTH, kMaxDepth);
    if (document_.element_count_ >= kMaxElements)
        return stop(Code::XML_LIMIT, std::string("more than 30 million elements"));
    if (pool_.taken() > kFreeBytes + kBytesPerByte * text_.size())
        return stop(Code::XML_LIMIT, std::string("elements without content"));
    uint32_t begin = offset();
    ByteRange tag{begin, begin + uint32_t(XML_GetCurrentByteCount(parser_))};
    Element* element = new (pool_.take(sizeof(Element))) Element;
    std::string_view file_name(text_.data() + tag.begin + 1, std::strlen(name));
    if (!root_) {
        root_ = element;
        size_t colon = file_name.find(':');
        if (colon != std::string_view::npos) prefix_ = file_name.substr(0, colon + 1);
    }
    element->name = local_name(file_name);
    element->attributes = read_attributes(tag, attributes);
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
    open_.push_back({element, nullptr, pieces_.size(), scratch_.size()});
}

void DocumentReader::add_text(const char* text, size_t length) {
    if (stopped_ || open_.empty()) return;
    if (open_.back().last_child && all_space({text, length})) return;
    uint32_t begin = offset();
    // Bytes that are the same in the file need no copy, whatever markup stands around them.
    bool verbatim = begin + length <= text_.size() && !std::memcmp(&text_[begin], text, length);
    if (verbatim && pieces_.size() > open_.back().first_piece) {
        Piece& last = pieces_.back();
        if (last.scratch < 0 && last.file_begin + last.length == begin) {
            last.length += uint32_t(length);
            return;
        }
    }
    pieces_.push_back({begin, uint32_t(length), verbatim ? -1 : int64_t(scratch_.size())});
    if (!verbatim) scratch_.append(text, length);
}

void DocumentReader::finish_text(const OpenElement& open) {
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
        only_space = only_space && all_space(piece_text(p));
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

void DocumentReader::register_id(Element& element) {
    std::string_view id = element.value("id");
    if (id.empty()) return;
    auto [first, fresh] = document_.ids_.emplace(id, &element);
    if (fresh) return;
    auto at = last_with_id_.emplace(id, const_cast<Element*>(first->second)).first;
    at->second->next_same_id = &element;
    at->second = &element;
}

void DocumentReader::end_element() {
    if (stopped_) return;
    OpenElement open = open_.back();
    open.element->bytes.end = offset() + uint32_t(XML_GetCurrentByteCount(parser_));
    // An empty tag <a/> gives both events at the same place.
    open.element->bytes.end = std::max(open.element->bytes.end, open.element->start_tag.end);
    finish_text(open);
    pieces_.resize(open.first_piece);
    scratch_.resize(open.first_scratch);
    open_.pop_back();
}

// Elements that were not closed are dropped, unless they are mere containers of whole ones.
void DocumentReader::close_after_error() {
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

void DocumentReader::report_syntax() {
    XML_Error error = XML_GetErrorCode(parser_);
    Location where = here();
    bool high_byte = where.begin < text_.size() && uint8_t(text_[where.begin]) >= 0x80;
    if (error == XML_ERROR_INVALID_TOKEN && high_byte && !valid_utf8(text_)) {
        bad_utf8_ = true;
        return;
    }
    Finding& finding = diag_.report(Code::XML_SYNTAX, where, std::string(XML_ErrorString(error)));
    bool unclosed = error == XML_ERROR_TAG_MISMATCH || error == XML_ERROR_NO_ELEMENTS;
    if (!open_.empty() && (unclosed || where.begin >= text_.size()))
        finding.notes.push_back({document_.location(*open_.back().element),
                                 "<" + std::string(open_.back().element->name) + "> opened here"});
}

struct VersionRow {
    std::string_view text;
    Version version;
    std::string_view name_space;
};
constexpr std::string_view kSchema14 = "http://www.collada.org/2005/11/COLLADASchema";
constexpr std::string_view kSchema15 = "http://www.collada.org/2008/03/COLLADASchema";
constexpr VersionRow kVersions[] = {{"1.4.0", Version::V1_4_0, kSchema14},
                                    {"1.4.1", Version::V1_4_1, kSchema14},
                                    {"1.5.0", Version::V1_5_0, kSchema15}};

void DocumentReader::check_root() {
    std::string_view text = root_->value("version");
    const VersionRow* row = nullptr;
    for (const VersionRow& r : kVersions)
        if (r.text == text) row = &r;
    if (!row) {
        diag_.report(Code::DOC_VERSION, document_.location(*root_, "version"), text);
        row = text.starts_with("1.5") ? &kVersions[2] : &kVersions[1];
    }
    document_.version_ = row->version;
    std::string xmlns = "xmlns";
    if (!prefix_.empty()) xmlns += ":" + std::string(prefix_.substr(0, prefix_.size() - 1));
    if (root_->value(xmlns) != row->name_space)
        diag_.report(Code::DOC_NAMESPACE, document_.location(*root_, xmlns), root_->value(xmlns),
                     row->text);
}

// What expat holds back until it is whole: false when that is too long.
bool DocumentReader::check_token(size_t fed) {
    size_t begin = here().begin;
    bool comment = text_.substr(begin, 2) == "<!" || text_.substr(begin, 2) == "<?";
    if (fed - begin <= (comment ? kMaxComment : kMaxTag)) return true;
    stop(Code::XML_LIMIT, std::string("a tag of more than a megabyte"));
    return false;
}

std::optional<Document> DocumentReader::read() {
    parser_ = XML_ParserCreate("UTF-8");
    if (!parser_) return std::nullopt;
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, on_start, on_end);
    XML_SetCharacterDataHandler(parser_, on_text);
    XML_SetEntityDeclHandler(parser_, on_entity);
    bool ok = true;
    for (size_t at = 0; ok && at < text_.size(); at += kChunk) {
        size_t length = std::min(kChunk, text_.size() - at);
        bool last = at + length == text_.size();
        ok = XML_Parse(parser_, text_.data() + at, int(length), last) == XML_STATUS_OK;
        if (ok && !last) ok = check_token(at + length);
    }
    if (!ok && !stopped_) report_syntax();
    if (!ok && root_) close_after_error();
    XML_ParserFree(parser_);
    if (bad_utf8_ || !root_) return std::nullopt;
    if (root_->name != "COLLADA") {
        diag_.report(Code::DOC_ROOT, document_.location(*root_), root_->name);
        return std::nullopt;
    }
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
    check_root();
    return std::move(document_);
}

}  // namespace kinora::collada
