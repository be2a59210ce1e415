// runtime/programs/convert/links.cpp: a document's relative links, as seen from another folder.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include "collada/document/edit.h"
#include "collada/document/findings.h"
#include "collada/document/uri.h"
#include "collada/schema/links.h"
#include "runtime/base/picture_search.h"
#include "runtime/base/regular_file.h"
#include "runtime/description/findings.h"
#include "runtime/description/rsl_literals.h"
#include "runtime/programs/convert/convert.h"
#include "runtime/programs/convert/links_p.h"
#include "runtime/programs/convert/rsl_files_p.h"

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

// Names between quotes of #include lines, as ranges of `code`.
std::vector<collada::ByteRange> included_names(std::string_view code) {
    std::vector<collada::ByteRange> names;
    for (size_t at = 0; (at = code.find('#', at)) != code.npos;) {
        size_t word = code.find_first_not_of(" \t", ++at);
        if (word == code.npos || !code.substr(word).starts_with("include")) continue;
        size_t open = code.find_first_not_of(" \t", word + 7);
        if (open == code.npos || code[open] != '"') continue;
        size_t close = code.find_first_of("\"\n", open + 1);
        if (close == code.npos || code[close] != '"') continue;
        names.push_back({uint32_t(open + 1), uint32_t(close)});
    }
    return names;
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
        if (*file.lexically_relative(from_).begin() == "..") return false;  // no one reads that
        std::optional<std::string> code = read_regular_file(file.string());
        if (!code) return false;
        std::map<size_t, std::pair<size_t, std::string>> names;  // begin -> end, new name
        for (LiteralRange name : string_literals(*code)) {
            std::string text = code->substr(name.begin, name.end - name.begin);
            fs::path named = (from_ / text).lexically_normal();
            if (may_name_file(text) && is_file(named))
                names[name.begin] = {name.end, moved(named, true)};
        }
        if (names.empty()) return false;
        for (collada::ByteRange name : included_names(*code)) {
            fs::path header =
                (file.parent_path() / code->substr(name.begin, name.end - name.begin));
            if (is_file(header)) names[name.begin] = {name.end, moved(header.lexically_normal())};
        }
        for (auto at = names.rbegin(); at != names.rend(); ++at)
            code->replace(at->first, at->second.first - at->first, at->second.second);
        edits_.push_back({include.bytes, "<code>" + collada::cdata(*code) + "</code>"});
        return true;
    }

    // A shader's code includes files beside the document.
    void visit_code(const Element& e) {
        if (e.name == "code")
            for (collada::ByteRange name : included_names(e.text)) move_include(e, name);
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

    void move_include(const Element& code, collada::ByteRange range) {
        std::string name(code.text.substr(range.begin, range.end - range.begin));
        fs::path file = (from_ / name).lexically_normal();
        if (!is_relative(name) || !is_file(file)) return;  // one of -I, or Kinora's own
        Location where = document_.text_location(code, range.begin, range.end);
        std::string new_name = moved(file);
        std::string_view before =
            text_.substr(code.start_tag.end, where.begin - code.start_tag.end);
        size_t section = before.rfind("<![CDATA[");
        bool escaped = section == before.npos || before.find("]]>", section) != before.npos;
        edits_.push_back(
            {{where.begin, where.end}, escaped ? collada::escape_text(new_name) : new_name});
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
