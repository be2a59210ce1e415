// runtime/programs/validate/foreign_schema.cpp: elements of other makers by libxml2. Elements are
// handed over as a tree, not as text, so that each complaint leads back to its element.
#include "runtime/programs/validate/foreign_schema.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "collada/document/findings.h"
#include "runtime/base/regular_file.h"
#include "runtime/programs/validate/libxml_p.h"

namespace kinora {

namespace {

using collada::Attribute;
using collada::Element;

constexpr uintmax_t kMostSchemaBytes = 4 << 20;  // of all files of one schema
constexpr uint32_t kMostElementBytes = 2 << 20;  // libxml2's tree takes 30 times as much
constexpr int kMostMessages = 100;               // of one schema in one document

struct Free {
    void operator()(xmlDoc* doc) const { xml().xmlFreeDoc(doc); }
    void operator()(xmlSchema* schema) const { xml().xmlSchemaFree(schema); }
    void operator()(xmlSchemaParserCtxt* context) const { xml().xmlSchemaFreeParserCtxt(context); }
    void operator()(xmlSchemaValidCtxt* context) const { xml().xmlSchemaFreeValidCtxt(context); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

const xmlChar* chars(const std::string& text) {
    return reinterpret_cast<const xmlChar*>(text.c_str());
}
const xmlChar* chars(std::string_view text, std::string& keep) {
    keep = text;
    return chars(keep);
}

// ---- reading of schemas -------------------------------------------------------------------------

// What may be read now; libxml2 has one loader for the process.
thread_local const AllowedPaths* readable = nullptr;
thread_local uintmax_t bytes_left = 0;

bool read_file(const std::string& path, std::string& text) {
    if (!readable || !readable->contains(path)) return false;
    std::optional<std::string> bytes = read_regular_file(path, bytes_left);
    if (!bytes) return false;
    bytes_left -= bytes->size();
    text = std::move(*bytes);
    return true;
}

// Files of the trees only, as they are: no other schemes, no compressed ones.
xmlParserInput* load(const char* url, const char*, xmlParserCtxt* context) {
    std::string path = url ? url : "", text;
    if (path.starts_with("file://")) path.erase(0, 7);
    if (!read_file(path, text)) {
        char* plain = xml().xmlURIUnescapeString(path.c_str(), 0, nullptr);  // "my%20types.xsd"
        std::string unescaped = plain ? plain : "";
        (*xml().xmlFree)(plain);
        if (unescaped.empty() || !read_file(unescaped, text)) return nullptr;
    }
    xmlParserInputBuffer* buffer =
        xml().xmlParserInputBufferCreateMem(text.data(), int(text.size()), XML_CHAR_ENCODING_NONE);
    if (!buffer) return nullptr;
    xmlParserInput* input = xml().xmlNewIOInputStream(context, buffer, XML_CHAR_ENCODING_NONE);
    if (input) input->filename = reinterpret_cast<const char*>(xml().xmlStrdup(chars(path)));
    return input;
}

void be_quiet(void*, const char*, ...) {}

void start_libxml() {
    static std::once_flag once;
    std::call_once(once, [] {
        xml().xmlInitParser();
        xml().xmlSetExternalEntityLoader(load);
    });
    xml().xmlSetGenericErrorFunc(nullptr, be_quiet);  // of this thread
}

std::string message_of(const xmlError& error) {
    std::string text = error.message ? error.message : "it cannot be read";
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    return text;
}

// The first complaint about the schema itself.
void keep_first(void* data, xmlError* error) {
    auto& first = *static_cast<std::string*>(data);
    if (!first.empty() || error->level < XML_ERR_ERROR) return;
    first = message_of(*error);
    if (error->line > 0) first += fmt::format(" (line {})", error->line);
}

// ---- the tree -----------------------------------------------------------------------------------

// A copy of an element as libxml2 has it; _private of each node is the element.
class Tree {
  public:
    Tree() : doc_(xml().xmlNewDoc(chars(version_))) {}

    xmlNode* add(const Element& element) {
        xmlNode* root = node(element);
        xml().xmlDocSetRootElement(doc_.get(), root);
        // What it and the elements around it declare, the inner ones first.
        for (const Element* e = &element; e; e = e->parent) declare(*e, root);
        fill(element, root);
        return root;
    }

  private:
    static xmlNode* node(const Element& element) {
        std::string name;
        xmlNode* made = xml().xmlNewNode(nullptr, chars(local(element.name), name));
        made->_private = const_cast<Element*>(&element);
        return made;
    }
    static std::string_view local(std::string_view name) {
        return name.substr(name.find(':') + 1);  // npos + 1 is 0
    }
    static std::string prefix(std::string_view name) {
        size_t colon = name.find(':');
        return colon == name.npos ? "" : std::string(name.substr(0, colon));
    }
    static bool is_declaration(std::string_view name) {
        return name == "xmlns" || name.starts_with("xmlns:");
    }

    // A second declaration of a prefix is refused by libxml2, as it should be.
    static void declare(const Element& element, xmlNode* at) {
        for (const Attribute& a : element.attributes) {
            if (!is_declaration(a.name)) continue;
            std::string uri, name(a.name == "xmlns" ? "" : a.name.substr(6));
            xml().xmlNewNs(at, chars(a.value, uri), name.empty() ? nullptr : chars(name));
        }
    }
    xmlNs* find(xmlNode* at, std::string_view name) {
        std::string wanted = prefix(name);
        return xml().xmlSearchNs(doc_.get(), at, wanted.empty() ? nullptr : chars(wanted));
    }

    void fill(const Element& element, xmlNode* at) {
        declare(element, at);
        xml().xmlSetNs(at, find(at, element.name));
        for (const Attribute& a : element.attributes) {
            if (is_declaration(a.name)) continue;
            std::string name, value;
            bool plain = a.name.find(':') == a.name.npos;
            xml().xmlNewNsProp(at, plain ? nullptr : find(at, a.name), chars(local(a.name), name),
                               chars(a.value, value));
        }
        if (!element.text.empty()) {
            std::string text;
            xml().xmlAddChild(at, xml().xmlNewText(chars(element.text, text)));
        }
        for (const Element& child : element.children()) {
            xmlNode* made = xml().xmlAddChild(at, node(child));
            fill(child, made);  // as deep as the document may be
        }
    }

    const std::string version_ = "1.0";
    Owned<xmlDoc> doc_;
};

// ---- complaints ---------------------------------------------------------------------------------

struct Complaints {
    const collada::ForeignElements& what;
    int count = 0;
};

// The attribute that the message names, else the element.
Location location_of(const collada::Document& document, const Element& element,
                     const std::string& message) {
    constexpr std::string_view kAttribute = ", attribute '";
    size_t at = message.find(kAttribute);
    if (at != message.npos) {
        size_t begin = at + kAttribute.size();
        std::string_view name =
            std::string_view(message).substr(begin, message.find('\'', begin) - begin);
        if (element.attribute(name)) return document.location(element, name);
    }
    return document.location(element);
}

void complain(void* data, xmlError* error) {
    auto& complaints = *static_cast<Complaints*>(data);
    if (++complaints.count > kMostMessages) return;
    auto* node = static_cast<xmlNode*>(error->node);
    while (node && node->type != XML_ELEMENT_NODE) node = node->parent;
    const Element* element = node ? static_cast<const Element*>(node->_private) : nullptr;
    if (!element) element = complaints.what.elements.front();
    std::string message = message_of(*error);
    Finding& finding =
        complaints.what.diag.add(collada::Code::SCHEMA_FOREIGN,
                                 location_of(complaints.what.document, *element, message), message);
    finding.severity = Severity::Warning;
}

Owned<xmlSchema> read_schema(const collada::ForeignElements& what, std::string& why) {
    readable = &what.files;
    bytes_left = kMostSchemaBytes;
    Owned<xmlSchema> schema;
    Owned<xmlSchemaParserCtxt> parser(xml().xmlSchemaNewParserCtxt(what.schema.c_str()));
    if (parser) {
        xml().xmlSchemaSetParserStructuredErrors(parser.get(), keep_first, &why);
        schema.reset(xml().xmlSchemaParse(parser.get()));
    }
    readable = nullptr;
    return schema;
}

}  // namespace

std::string check_foreign(const collada::ForeignElements& what) {
    // The types of schemas are made at first use, unguarded.
    static std::mutex mutex;
    std::lock_guard lock(mutex);
    if (!xml().error().empty()) return xml().error();
    start_libxml();
    std::string why;
    Owned<xmlSchema> schema = read_schema(what, why);
    std::string name = std::filesystem::path(what.schema).filename().string();
    if (!schema)
        return fmt::format("their schema '{}' cannot be used: {}", name,
                           why.empty() ? "it cannot be read" : why);
    Complaints complaints{what};
    Owned<xmlSchemaValidCtxt> validator(xml().xmlSchemaNewValidCtxt(schema.get()));
    if (!validator) return "not enough memory";
    xml().xmlSchemaSetValidStructuredErrors(validator.get(), complain, &complaints);
    for (const Element* element : what.elements) {
        if (complaints.count > kMostMessages) break;
        if (element->bytes.end - element->bytes.begin > kMostElementBytes) {
            why = fmt::format("some are larger than {} MB", kMostElementBytes >> 20);
            continue;
        }
        Tree tree;
        xml().xmlSchemaValidateOneElement(validator.get(), tree.add(*element));
    }
    return why;
}

}  // namespace kinora
