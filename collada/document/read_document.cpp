// collada/document/read_document.cpp: from a file or memory through its encoding to a document.
#include "collada/document/document_reader_p.h"
#include "collada/text/encoding_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

namespace {

constexpr size_t kMaxBytes = 0x7fffffff;                // byte offsets are 32 bits
constexpr uint64_t kMostFileBytes = uint64_t(1) << 34;  // in whatever encoding

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
    FileId file = diag.files.add(path, std::move(decoded.text));
    if (!decoded.recoded.empty())
        diag.report(Code::XML_RECODED, Location{file, 0, 0}, decoded.recoded);
    DocumentReader reader(path, file, diag);
    std::optional<Document> document = reader.read();
    if (!reader.bad_utf8()) return document;
    file = diag.files.add(path, utf8_from_latin1(diag.files.text(file)));
    diag.report(Code::XML_RECODED, Location{file, 0, 0}, std::string("Latin-1, not UTF-8"));
    return DocumentReader(path, file, diag).read();
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
