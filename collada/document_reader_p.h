// collada/document_reader_p.h: expat's events become the element tree.
#pragma once

#include <expat.h>

#include "collada/document.h"
#include "collada/findings.h"
#include "collada/pool_p.h"

namespace kinora::collada {

// A run of text that stands in the file as it is, or (scratch >= 0) was decoded.
struct Piece {
    uint32_t file_begin;
    uint32_t length;
    int64_t scratch;
};

struct OpenElement {
    Element* element;
    Element* last_child;
    size_t first_piece;
    size_t first_scratch;
};

class DocumentReader {
  public:
    DocumentReader(std::string path, FileId file, Diagnostics& diag)
        : diag_(diag), text_(diag.files.text(file)), pool_(document_.arena_) {
        document_.path_ = std::move(path);
        size_t slash = document_.path_.find_last_of('/');
        if (slash != std::string::npos) document_.directory_ = document_.path_.substr(0, slash + 1);
        document_.file_ = file;
    }

    std::optional<Document> read();
    bool bad_utf8() const { return bad_utf8_; }

  private:
    static void XMLCALL on_start(void* self, const XML_Char* name, const XML_Char** attributes) {
        static_cast<DocumentReader*>(self)->start_element(name, attributes);
    }
    static void XMLCALL on_end(void* self, const XML_Char*) {
        static_cast<DocumentReader*>(self)->end_element();
    }
    static void XMLCALL on_text(void* self, const XML_Char* text, int length) {
        static_cast<DocumentReader*>(self)->add_text(text, size_t(length));
    }
    static void XMLCALL on_entity(void* self, const XML_Char* name, int, const XML_Char*, int,
                                  const XML_Char*, const XML_Char*, const XML_Char*,
                                  const XML_Char*) {
        auto* reader = static_cast<DocumentReader*>(self);
        reader->stop(Code::XML_ENTITY, std::string(name));
    }

    void start_element(const XML_Char* name, const XML_Char** attributes);
    void end_element();
    void add_text(const char* text, size_t length);
    std::span<const Attribute> read_attributes(ByteRange tag, const XML_Char** decoded);
    std::string_view local_name(std::string_view name) const;
    void finish_text(const OpenElement& open);
    void register_id(Element& element);
    void close_after_error();
    void report_syntax();
    bool check_token(size_t fed);
    void check_root();

    template <class... Args>
    void stop(const FindingInfo& info, const Args&... args) {
        diag_.report(info, here(), args...);
        stopped_ = true;
        XML_StopParser(parser_, XML_FALSE);
    }
    uint32_t offset() const { return uint32_t(XML_GetCurrentByteIndex(parser_)); }
    Location here() const {
        uint32_t begin = uint32_t(std::min(size_t(offset()), text_.size()));
        return {document_.file_, begin, begin};
    }

    Diagnostics& diag_;
    Document document_;
    std::string_view text_;
    Pool pool_;
    XML_Parser parser_ = nullptr;
    std::vector<OpenElement> open_;
    std::vector<Piece> pieces_;
    std::string scratch_;
    std::vector<Attribute> attributes_;
    std::unordered_map<std::string_view, Element*> last_with_id_;  // of those used more than once
    Element* root_ = nullptr;
    std::string_view prefix_;  // "collada:" when the root is written <collada:COLLADA>
    bool stopped_ = false;
    bool bad_utf8_ = false;
};

}  // namespace kinora::collada
