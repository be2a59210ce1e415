// collada/document/read_document.cpp: from a file or memory through its encoding to a document.
#include "collada/document/document_reader_p.h"
#include "collada/text/encoding_p.h"
#include "collada/text/entities_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

namespace {

constexpr size_t kMaxBytes = 0x7fffffff;                // byte offsets are 32 bits
constexpr uint64_t kMostFileBytes = uint64_t(1) << 34;  // in whatever encoding
constexpr size_t kMostAmpersands = 20;                  // that a finding names

// A late declaration and byte order marks before it become white space: the text is UTF-8 already,
// and the bytes behind them keep their offsets.
std::optional<ByteRange> blank_late_declaration(std::string& text) {
    std::optional<ByteRange> declaration = xml_declaration(text);
    if (!declaration || declaration->begin == 0) return std::nullopt;
    for (uint32_t i = declaration->begin; i < declaration->end; ++i)
        if (text[i] != '\n' && text[i] != '\r') text[i] = ' ';
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    for (size_t at; (at = text.find(kByteOrderMark)) < declaration->begin;)
        text.replace(at, kByteOrderMark.size(), "   ");
    return declaration;
}

std::optional<Document> read_mended(const std::string& path, FileId file, Diagnostics& diag) {
    DocumentReader reader(path, file, diag);
    std::optional<Document> document = reader.read();
    std::string_view text = diag.files.text(file);
    if (reader.bad_utf8()) {
        FileId recoded = diag.files.add(path, utf8_from_latin1(text));
        diag.report(Code::XML_RECODED, Location{recoded, 0, 0}, std::string("Latin-1, not UTF-8"));
        return read_mended(path, recoded, diag);
    }
    const std::vector<uint32_t>& bare = reader.bare_ampersands();
    if (bare.empty()) return document;
    for (size_t i = 0; i < std::min(bare.size(), kMostAmpersands); ++i)
        diag.report(Code::XML_AMPERSAND, Location{file, bare[i], bare[i] + 1});
    return read_mended(path, diag.files.add(path, escape_ampersands(text, bare)), diag);
}

}  // namespace

std::optional<Document> read_document_text(const std::string& path, std::string bytes,
                                           Diagnostics& diag) {
    auto no_text = [&] { return Location{diag.files.add(path, {}), 0, 0}; };
    DecodedText decoded = decode_text(std::move(bytes));
    if (!decoded.error.empty()) {
        diag.report(Code::XML_ENCODING, no_text(), decoded.error);
        return std::nullopt;
    }
    if (trim(decoded.text).empty()) {  // a byte order mark alone is nothing, either
        diag.report(Code::XML_EMPTY, no_text());
        return std::nullopt;
    }
    if (decoded.text.size() > kMaxBytes) {
        diag.report(Code::XML_LIMIT, no_text(), std::string("more than 2 GiB"));
        return std::nullopt;
    }
    std::optional<ByteRange> late = blank_late_declaration(decoded.text);
    FileId file = diag.files.add(path, std::move(decoded.text));
    if (!decoded.recoded.empty())
        diag.report(Code::XML_RECODED, Location{file, 0, 0}, decoded.recoded);
    if (late) diag.report(Code::XML_DECLARATION, Location{file, late->begin, late->end});
    return read_mended(path, file, diag);
}

std::optional<Document> read_document(const std::string& path, Diagnostics& diag) {
    std::string error;
    std::optional<std::string> bytes = read_regular_file(path, kMostFileBytes, &error);
    if (!bytes) {
        diag.report(Code::XML_OPEN, Location{}, path, error);
        return std::nullopt;
    }
    return read_document_text(path, std::move(*bytes), diag);
}

}  // namespace kinora::collada
