// collada/document/document_reader_p.h: a text becomes the element tree, by expat where it is not
// plain.
#pragma once

#include <expat.h>

#include "collada/document/document_builder_p.h"
#include "collada/document/findings.h"

namespace kinora::collada {

class DocumentReader {
  public:
    DocumentReader(std::string path, FileId file, Diagnostics& diag)
        : path_(std::move(path)), file_(file), diag_(diag), text_(diag.files.text(file)) {}

    std::optional<Document> read();
    std::optional<Document> read_by_expat();  // the same, whatever the text
    // What made it end without a finding: who mends that reads anew.
    bool bad_utf8() const { return bad_utf8_; }
    const std::vector<uint32_t>& bare_ampersands() const { return bare_ampersands_; }

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

    void start_element(const XML_Char* name, const XML_Char** attributes);
    void end_element();
    void add_text(const char* text, size_t length);
    void read_attributes(ByteRange tag, const XML_Char** decoded);
    bool has_room();
    void report_syntax();
    bool check_token(size_t fed);
    std::optional<Document> finish();
    bool is_too_old(const Document& document, const Element& root);
    void check_root(Document& document, const Element& root);

    template <class... Args>
    void stop(const FindingInfo& info, const Args&... args) {
        diag_.report(info, here(), args...);
        stopped_ = true;
        XML_StopParser(parser_, XML_FALSE);
    }
    uint32_t offset() const { return uint32_t(XML_GetCurrentByteIndex(parser_)); }
    uint32_t offset_behind() const { return offset() + uint32_t(XML_GetCurrentByteCount(parser_)); }
    Location here() const {
        uint32_t begin = uint32_t(std::min(size_t(offset()), text_.size()));
        return {file_, begin, begin};
    }

    std::string path_;
    FileId file_;
    Diagnostics& diag_;
    std::string_view text_;
    std::optional<DocumentBuilder> builder_;
    XML_Parser parser_ = nullptr;
    std::vector<Attribute> attributes_;
    bool stopped_ = false;
    bool bad_utf8_ = false;
    std::vector<uint32_t> bare_ampersands_;
};

}  // namespace kinora::collada
