// collada/document/document_reader.cpp: a text becomes the element tree, by expat where it is not
// plain.
#include "collada/document/document_reader_p.h"

#include <cstring>

#include "collada/document/plain_xml_p.h"
#include "collada/text/encoding_p.h"
#include "collada/text/entities_p.h"

namespace kinora::collada {

namespace {

constexpr size_t kChunk = 256 << 10;  // expat copies what it is given: keep that small
// A tag must be whole before its attributes are seen, and they take much memory in expat.
constexpr size_t kMaxTag = 1 << 20, kMaxComment = 64 << 20;

// The finding says "not well-formed" itself; expat's "not well-formed (invalid token)" does, too.
std::string_view error_text(XML_Error error) {
    std::string_view text = XML_ErrorString(error);
    constexpr std::string_view kSaid = "not well-formed (";
    if (!text.starts_with(kSaid) || !text.ends_with(')')) return text;
    return text.substr(kSaid.size(), text.size() - kSaid.size() - 1);
}

}  // namespace

// The tag is well-formed (expat has seen it), so a plain scan finds names and quotes.
void DocumentReader::read_attributes(ByteRange tag, const XML_Char** decoded) {
    attributes_.clear();
    const char* base = text_.data();
    const char* p = base + tag.begin + 1;
    const char* end = base + tag.end;
    while (p < end && !is_xml_space(*p) && *p != '>' && *p != '/') ++p;
    for (; decoded[0]; decoded += 2) {
        while (p < end && is_xml_space(*p)) ++p;
        const char* name = p;
        while (p < end && *p != '=' && !is_xml_space(*p)) ++p;
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
        attributes_.push_back({{name, size_t(name_end - name)},
                               plain ? raw : builder_->pool().copy(std::string_view(decoded[1])),
                               {uint32_t(name - base), uint32_t(p - base)},
                               {uint32_t(value - base), uint32_t(value_end - base)}});
    }
}

bool DocumentReader::has_room() {
    switch (builder_->room()) {
        case Room::Enough:
            return true;
        case Room::TooDeep:
            stop(Code::XML_DEPTH, kMaxDepth);
            return false;
        case Room::TooManyElements:
            stop(Code::XML_LIMIT, std::string("more than 30 million elements"));
            return false;
        case Room::TooMuchMemory:
            stop(Code::XML_LIMIT, std::string("elements without content"));
            return false;
    }
    return false;
}

void DocumentReader::start_element(const XML_Char* name, const XML_Char** attributes) {
    if (stopped_ || !has_room()) return;
    ByteRange tag{offset(), offset_behind()};
    read_attributes(tag, attributes);
    builder_->start_element(tag, text_.substr(tag.begin + 1, std::strlen(name)), attributes_);
}

void DocumentReader::add_text(const char* text, size_t length) {
    if (!stopped_) builder_->add_text(offset(), {text, length});
}

void DocumentReader::end_element() {
    if (!stopped_) builder_->end_element(offset_behind());
}

void DocumentReader::report_syntax() {
    XML_Error error = XML_GetErrorCode(parser_);
    Location where = here();
    bool high_byte = where.begin < text_.size() && uint8_t(text_[where.begin]) >= 0x80;
    if (error == XML_ERROR_INVALID_TOKEN && high_byte && !valid_utf8(text_)) {
        bad_utf8_ = true;
        return;
    }
    // Expat stops at the first one, or at the tag that holds it.
    std::vector<uint32_t> bare = kinora::collada::bare_ampersands(text_);
    if (!bare.empty() && bare[0] <= std::min(text_.find('>', where.begin), text_.size())) {
        bare_ampersands_ = std::move(bare);
        return;
    }
    Finding& finding = diag_.report(Code::XML_SYNTAX, where, error_text(error));
    bool unclosed = error == XML_ERROR_TAG_MISMATCH || error == XML_ERROR_NO_ELEMENTS;
    if (builder_->open().empty() || (!unclosed && where.begin < text_.size())) return;
    const Element& open = *builder_->open().back().element;
    finding.notes.push_back({Location{file_, open.start_tag.begin, open.start_tag.end},
                             "<" + std::string(open.name) + "> opened here"});
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

// Documents of versions before 1.4 have <library type="GEOMETRY">. A wrong number alone is no harm.
bool DocumentReader::is_too_old(const Document& document, const Element& root) {
    const Element* library = root.child("library");
    if (!library || library->value("type").empty()) return false;
    std::string_view version = root.value("version");
    diag_.report(Code::DOC_TOO_OLD, document.location(root, "version"),
                 version.empty() ? std::string_view("1.3") : version);
    return true;
}

void DocumentReader::check_root(Document& document, const Element& root) {
    std::string_view text = root.value("version");
    const VersionRow* row = nullptr;
    for (const VersionRow& r : kVersions)
        if (r.text == text) row = &r;
    if (!row) {
        diag_.report(Code::DOC_VERSION, document.location(root, "version"), text);
        row = text.starts_with("1.5") ? &kVersions[2] : &kVersions[1];
    }
    document.judge_as(row->version);
    std::string xmlns = "xmlns";
    std::string_view prefix = builder_->prefix();
    if (!prefix.empty()) xmlns += ":" + std::string(prefix.substr(0, prefix.size() - 1));
    if (root.value(xmlns) != row->name_space)
        diag_.report(Code::DOC_NAMESPACE, document.location(root, xmlns), root.value(xmlns),
                     row->text);
}

std::optional<Document> DocumentReader::finish() {
    const Element* root = builder_->root();
    if (bad_utf8_ || !bare_ampersands_.empty() || !root) return std::nullopt;
    if (root->name != "COLLADA") {
        diag_.report(Code::DOC_ROOT, Location{file_, root->start_tag.begin, root->start_tag.end},
                     root->name);
        return std::nullopt;
    }
    Document document = builder_->finish();
    if (is_too_old(document, *root)) return std::nullopt;
    check_root(document, *root);
    return document;
}

// What expat holds back until it is whole: false when that is too long.
bool DocumentReader::check_token(size_t fed) {
    size_t begin = here().begin;
    bool comment = text_.substr(begin, 2) == "<!" || text_.substr(begin, 2) == "<?";
    if (fed - begin <= (comment ? kMaxComment : kMaxTag)) return true;
    stop(Code::XML_LIMIT, std::string("a tag of more than a megabyte"));
    return false;
}

std::optional<Document> DocumentReader::read_by_expat() {
    builder_.emplace(path_, file_, text_);
    parser_ = XML_ParserCreate("UTF-8");
    if (!parser_) return std::nullopt;
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, on_start, on_end);
    XML_SetCharacterDataHandler(parser_, on_text);
    std::optional<ByteRange> entity = find_entity_use(text_);
    size_t end = entity ? entity->begin : text_.size();
    bool ok = true;
    for (size_t at = 0; ok && at < end; at += kChunk) {
        size_t length = std::min(kChunk, end - at);
        bool last = at + length == text_.size();
        ok = XML_Parse(parser_, text_.data() + at, int(length), last) == XML_STATUS_OK;
        if (ok && !last) ok = check_token(at + length);
    }
    if (!ok && !stopped_) report_syntax();
    if (ok && entity)
        diag_.report(Code::XML_ENTITY, Location{file_, entity->begin, entity->end},
                     text_.substr(entity->begin, entity->end - entity->begin));
    if ((!ok || entity) && builder_->root()) builder_->close_after_error();
    XML_ParserFree(parser_);
    return finish();
}

std::optional<Document> DocumentReader::read() {
    builder_.emplace(path_, file_, text_);
    return read_plain_xml(text_, *builder_) ? finish() : read_by_expat();
}

}  // namespace kinora::collada
