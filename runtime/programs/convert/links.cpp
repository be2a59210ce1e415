// runtime/programs/convert/links.cpp: a document's relative links, as seen from another folder.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "collada/document/edit.h"
#include "collada/document/findings.h"
#include "collada/document/uri.h"
#include "collada/schema/links.h"
#include "runtime/base/picture_search.h"
#include "runtime/programs/convert/code_links_p.h"
#include "runtime/programs/convert/convert.h"
#include "runtime/programs/convert/links_p.h"
#include "runtime/programs/convert/rsl_files_p.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/rsl_literals.h"

namespace kinora {

namespace fs = std::filesystem;
using collada::Document;
using collada::Edit;
using collada::Element;

namespace {

constexpr std::string_view kSpace = " \t\r\n";

bool is_relative(std::string_view file) {
    return !file.empty() && file[0] != '/' && file[0] != '\\' && file.find(':') == file.npos;
}

bool is_file(const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error);
}

// Elements whose links are of files as a whole; others name an element behind '#'.
bool names_file(const Element& e) {
    return e.name == "init_from" || e.name == "ref" || e.name == "include";
}

class LinkMove {
  public:
    LinkMove(const Document& document, std::string_view text) : document_(document), text_(text) {}

    // Documents that share a folder keep their links.
    void between(const std::string& path, const std::string& new_path, const std::string& archive,
                 Diagnostics& diag) {
        std::error_code code;
        from_ = fs::weakly_canonical(fs::absolute(path), code).parent_path();
        to_ = fs::weakly_canonical(fs::absolute(new_path), code).parent_path();
        stays_ = from_ == to_;
        if (stays_ || archive.empty()) return;
        // Out of an archive everything comes along, into a folder beside the new document.
        archive_ = fs::weakly_canonical(archive, code);
        unpacked_ = fs::path(new_path).stem().string() + "_files";
        fs::create_directories(to_, code);
        fs::copy(archive, to_ / unpacked_,
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing, code);
        if (code)
            diag.report(Code::CONVERT_LOST, Location{}, "what the archive holds", code.message());
    }

    std::string run(Diagnostics& diag) {
        for (const collada::UriValue& uri : collada::uri_values(document_)) move_uri(uri, diag);
        if (stays_) return std::string(text_);
        visit_code(document_.root());
        for (const RslFileName& name : rsl_file_names(document_, text_)) move_name(name);
        // Links were taken as it says, and say so themselves now.
        if (const collada::Attribute* base = document_.root().attribute("xml:base"))
            edits_.push_back({base->bytes, ""});
        if (!outside_.empty())
            diag.report(Code::CONVERT_OUTSIDE, Location{}, outside_.size(), *outside_.begin());
        return collada::apply_edits(text_, std::move(edits_));
    }

  private:
    // Where a file of the old document is, as seen from the new one.
    std::string moved(const fs::path& file, bool picture = false) {
        fs::path path = archive_.empty()
                            ? file.lexically_relative(to_)
                            : (unpacked_ / file.lexically_relative(archive_)).lexically_normal();
        if (!picture && path.begin() != path.end() && *path.begin() == "..")
            outside_.insert(path.generic_string());
        return path.generic_string();
    }

    // The file of a relative path of path_of_uri.
    fs::path found(const std::string& path) const {
        fs::path folder = document_.directory().empty() ? "." : document_.directory();
        fs::path below = fs::path(path).lexically_relative(folder.lexically_normal());
        return (from_ / (below.empty() ? fs::path(path) : below)).lexically_normal();
    }

    void move_uri(const collada::UriValue& uri, Diagnostics& diag) {
        std::string_view link = link_of(uri.value);
        if (links_picture(*uri.element) && !link.empty() && find_picture(uri, link, diag)) return;
        size_t hash = std::min(link.find('#'), link.size());
        if (stays_ || !is_relative(link_of(link.substr(0, hash)))) return;
        fs::path file = found(collada::path_of_uri(document_, link.substr(0, hash)));
        // A fragment without its '#' is no file.
        if (hash == link.size() && !names_file(*uri.element) && !is_file(file)) return;
        if (take_in(*uri.element, file)) return;
        bool picture = links_picture(*uri.element);
        edits_.push_back(set_link(
            text_, uri, encoded_link(moved(file, picture)) + std::string(link.substr(hash))));
    }

    // True: the picture was found elsewhere than its link says (beside the document, in
    // textures/), where no reader looks once the document is in another folder.
    bool find_picture(const collada::UriValue& uri, std::string_view link, Diagnostics& diag) {
        FoundPicture picture = search_.find(collada::path_of_uri(document_, link),
                                            document_.directory(), AllowedPaths());
        if (picture.match == PictureMatch::Missing)
            diag.report(collada::Code::FILE_MISSING, {}, link);
        bool elsewhere =
            picture.match == PictureMatch::Case || picture.match == PictureMatch::Elsewhere;
        if (!elsewhere || stays_) return false;
        std::error_code code;
        fs::path file = fs::absolute(picture.path, code);
        file = fs::weakly_canonical(file.parent_path(), code) / file.filename();
        edits_.push_back(set_link(text_, uri, encoded_link(moved(file, true))));
        return true;
    }

    // What code in a file names lies beside the document, wherever the file is. An <include> of
    // code that names files is therefore written out as <code> with their new names. True if so.
    bool take_in(const Element& include, const fs::path& file) {
        const Element* owner = include.parent ? include.parent->parent : nullptr;
        if (include.name != "include" || !owner || owner->name != "profile_RSL") return false;
        std::optional<std::string> code = code_links().moved_code(file);
        if (code) edits_.push_back({include.bytes, "<code>" + collada::cdata(*code) + "</code>"});
        return code.has_value();
    }

    CodeLinks code_links() {
        return {from_, [this](const fs::path& file, bool picture) { return moved(file, picture); }};
    }

    // A shader's code includes files beside the document.
    void visit_code(const Element& e) {
        if (e.name == "code")
            for (const IncludeLine& line : include_lines(e.text)) move_include(e, line);
        for (const Element& child : e.children()) visit_code(child);
    }

    // Textures, maps and points that shaders name.
    void move_name(const RslFileName& name) {
        for (const fs::path& folder : {from_, archive_}) {
            fs::path file = (folder / name.name).lexically_normal();
            if (folder.empty() || !is_file(file)) continue;
            edits_.push_back(set_name(name, moved(file, true)));
            return;
        }
    }

    // A header that names files is written out in place of its line, as an <include> is.
    void move_include(const Element& code, const IncludeLine& include) {
        std::string name(
            code.text.substr(include.name.begin, include.name.end - include.name.begin));
        fs::path file = (from_ / name).lexically_normal();
        if (!is_relative(name) || !is_file(file)) return;  // one of -I, or Kinora's own
        std::optional<std::string> header = code_links().moved_code(file);
        LiteralRange range = header ? include.line : include.name;
        Location where = document_.text_location(code, range.begin, range.end);
        collada::ByteRange bytes{where.begin, where.end};
        std::string text = header ? *header : moved(file);
        edits_.push_back({bytes, code_text(text, in_section(text_, code, where.begin))});
    }

    const Document& document_;
    std::string_view text_;
    fs::path from_, to_, archive_, unpacked_;
    std::set<std::string> outside_;
    PictureSearch search_;
    bool stays_ = false;
    std::vector<Edit> edits_;
};

}  // namespace

bool links_picture(const Element& e) {
    const Element* owner = e.parent;
    if (!owner) return false;
    if (e.name == "ref") return links_picture(*owner);
    return e.name == "init_from" && (owner->name == "image" || owner->name.starts_with("create_"));
}

std::string_view link_of(std::string_view value) {
    size_t begin = value.find_first_not_of(kSpace);
    if (begin == value.npos) return {};
    return value.substr(begin, value.find_last_not_of(kSpace) + 1 - begin);
}

std::string encoded_link(const std::string& name) {
    std::string link;
    for (char c : name)
        link += uint8_t(c) <= ' ' || std::string_view("%#?\"<>").find(c) != std::string_view::npos
                    ? fmt::format("%{:02X}", uint8_t(c))
                    : std::string(1, c);
    return link;
}

Edit set_link(std::string_view text, const collada::UriValue& uri, const std::string& link) {
    if (uri.attribute) return collada::set_attribute(text, *uri.element, uri.attribute->name, link);
    return {{uri.element->start_tag.end, uint32_t(text.rfind("</", uri.element->bytes.end - 1))},
            collada::escape_text(link)};
}

std::string move_links(const std::string& path, const std::string& text,
                       const std::string& new_path, const std::string& archive, Diagnostics& diag) {
    Diagnostics quiet;
    std::optional<Document> document = collada::read_document_text(path, text, quiet);
    if (!document || !document->whole()) return text;
    LinkMove move(*document, quiet.files.text(document->file()));
    move.between(path, new_path, archive, diag);
    return move.run(diag);
}

}  // namespace kinora
