// collada/document/document.h: a .dae as an element tree whose every part knows its bytes in the
// file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "collada/text/byte_range.h"
#include "runtime/base/arena.h"
#include "runtime/base/diagnostic.h"

namespace kinora::collada {

struct Attribute {
    std::string_view name;   // without its namespace prefix if that is COLLADA's
    std::string_view value;  // decoded
    ByteRange bytes;         // name="value"
    ByteRange value_bytes;   // between the quotes
};

// One element. `text` is the character data directly inside it, decoded and joined; it views the
// file itself where nothing had to be decoded.
struct Element {
    std::string_view name;
    std::string_view text;
    std::span<const Attribute> attributes;
    std::span<const SourceMap::Segment> text_map;  // text offset -> file offset, sorted
    const Element* parent = nullptr;
    const Element* first_child = nullptr;
    const Element* next = nullptr;          // the next sibling
    const Element* next_same_id = nullptr;  // the next element of the document with this id
    ByteRange bytes;                        // "<name" up to and with its end tag
    ByteRange start_tag;                    // "<name ...>"
    uint32_t index = 0;                     // its number in document order

    const Element* child(std::string_view child_name) const;            // first so named, or null
    const Element* next_named(std::string_view sibling_name) const;     // after this one, or null
    const Attribute* attribute(std::string_view attribute_name) const;  // or null
    std::string_view value(std::string_view attribute_name) const;      // "" when absent

    struct Iterator {
        const Element* at;
        const Element& operator*() const { return *at; }
        Iterator& operator++() {
            at = at->next;
            return *this;
        }
        bool operator!=(const Iterator& other) const { return at != other.at; }
    };
    struct Children {
        const Element* first;
        Iterator begin() const { return {first}; }
        Iterator end() const { return {nullptr}; }
    };
    Children children() const { return {first_child}; }
};

enum class Version : uint8_t { V1_4_0, V1_4_1, V1_5_0 };

// Views into the files of the Diagnostics it was read with, which must outlive it.
class Document {
  public:
    Document(Document&&) = default;
    Document& operator=(Document&&) = default;

    const Element& root() const { return *root_; }  // <COLLADA>
    FileId file() const { return file_; }
    const std::string& path() const { return path_; }            // as given to read_document
    const std::string& directory() const { return directory_; }  // of path, "" for the current one
    Version version() const { return version_; }
    void judge_as(Version version) { version_ = version; }  // by other rules than its own
    bool whole() const { return whole_; }  // false: an XML error cut it; an Error says so
    // Whether the error stands inside of the element, which may have had more children.
    bool cut(const Element& element) const {
        return !whole_ && element.bytes.end >= root_->bytes.end;
    }
    uint32_t element_count() const { return element_count_; }

    // The first element with this id in document order, or null; further ones by next_same_id.
    const Element* find(std::string_view id) const;

    // Locations: of the start tag, of an attribute's value (the start tag when absent), of a range
    // of the decoded text.
    Location location(const Element& element) const;
    Location location(const Element& element, std::string_view attribute_name) const;
    Location text_location(const Element& element, size_t begin, size_t end) const;
    Location text_location(const Element& element) const;
    SourceMap source_map(const Element& element) const;  // of element.text

  private:
    friend class DocumentBuilder;
    Document() = default;
    Arena arena_;
    const Element* root_ = nullptr;
    std::unordered_map<std::string_view, const Element*> ids_;
    FileId file_ = kNoFile;
    std::string path_;
    std::string directory_;
    Version version_ = Version::V1_4_1;
    bool whole_ = true;
    uint32_t element_count_ = 0;
};

// Reads the XML. Nothing is returned when there is no <COLLADA> root to speak of; otherwise an XML
// error (XML_SYNTAX with its line and column) leaves the elements that were whole before it.
// Also checks root, version and namespace. Reads .dae; UTF-8, UTF-16, Latin-1.
std::optional<Document> read_document(const std::string& path, Diagnostics& diag);

// The same from memory; `path` names it in findings and gives the folder for relative links.
std::optional<Document> read_document_text(const std::string& path, std::string bytes,
                                           Diagnostics& diag);

// Reports SCHEMA_* and INFO_UNSUPPORTED findings of a document against the element table:
// elements and attributes it does not know, required attributes that are missing, things the
// picture would need that are not rendered. Never an Error.
void check_elements(const Document& document, Diagnostics& diag);

}  // namespace kinora::collada
