// collada/document/document_builder_p.h: start tags, texts and end tags become the element tree.
#pragma once

#include <string>

#include "collada/document/document.h"
#include "collada/text/pool_p.h"

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
    std::string_view file_name;  // with its prefix
    size_t first_piece;
    size_t first_scratch;
};

// What a document may hold ends somewhere.
enum class Room : uint8_t { Enough, TooDeep, TooManyElements, TooMuchMemory };
inline constexpr size_t kMaxDepth = 256;

class DocumentBuilder {
  public:
    DocumentBuilder(const std::string& path, FileId file, std::string_view text);

    Room room() const;  // for one more element
    // `file_name` and the attributes view the file's text, but for values put into pool().
    void start_element(ByteRange tag, std::string_view file_name,
                       std::span<const Attribute> attributes);
    // What stands at `begin` in the file and reads `text`: the file's own bytes or others.
    void add_text(uint32_t begin, std::string_view text);
    void end_element(uint32_t end);
    // Elements that were not closed are dropped, unless they are mere containers of whole ones.
    void close_after_error();
    Document finish();  // with its ids; of a builder that has a root

    const Element* root() const { return root_; }
    const std::vector<OpenElement>& open() const { return open_; }
    const Document& document() const { return document_; }
    // The prefix of the root's name with its colon: "collada:" of <collada:COLLADA>.
    std::string_view prefix() const { return prefix_; }
    Pool& pool() { return pool_; }

  private:
    // What a prefix stands for inside an element.
    struct Binding {
        std::string_view prefix;
        bool own;      // the root's namespace
        size_t depth;  // of the element that declares it
    };
    void start_root(std::string_view file_name, std::span<const Attribute> attributes);
    void bind_prefixes(std::span<const Attribute> attributes);
    std::string_view local_name(std::string_view name) const;
    void finish_text(const OpenElement& open);
    void register_id(Element& element);

    Document document_;
    std::string_view text_;
    Pool pool_;
    std::vector<OpenElement> open_;
    std::vector<Piece> pieces_;
    std::string scratch_;
    std::unordered_map<std::string_view, Element*> last_with_id_;  // of those used more than once
    Element* root_ = nullptr;
    std::string_view prefix_;
    std::string_view name_space_;    // the root's
    std::vector<Binding> bindings_;  // of the open elements
};

inline bool is_xml_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}
inline bool is_xml_space(std::string_view text) {
    for (char c : text)
        if (!is_xml_space(c)) return false;
    return true;
}

}  // namespace kinora::collada
