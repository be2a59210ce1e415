// runtime/programs/convert/textures.cpp: --copy-textures: pictures beside the document.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "collada/document/edit.h"
#include "collada/document/uri.h"
#include "collada/schema/links.h"
#include "runtime/base/picture_search.h"
#include "runtime/base/regular_file.h"
#include "runtime/programs/convert/convert.h"
#include "runtime/programs/convert/links_p.h"
#include "runtime/programs/convert/rsl_files_p.h"

namespace kinora {

namespace fs = std::filesystem;
using collada::Document;
using collada::Edit;

namespace {

class TextureCopies {
  public:
    TextureCopies(const std::string& output, WrittenFiles& files)
        : files_(files), folder_(fs::path(output).parent_path()) {
        for (WrittenFile& file : files_) inner_[(folder_ / file.name).lexically_normal()] = &file;
    }

    // The new link of the file that a path of the old link leads to; "" where there is none.
    std::string link(const std::string& path, const std::string& document_folder) {
        if (auto inner = inner_.find(fs::path(path).lexically_normal()); inner != inner_.end()) {
            WrittenFile& file = *inner->second;
            if (!file.name.starts_with(kFolder)) file.name = unused(file.name, file.bytes);
            return file.name;
        }
        FoundPicture found = search_.find(path, document_folder, AllowedPaths());
        if (found.path.empty()) return "";
        std::error_code code;
        auto [known, fresh] = copied_.try_emplace(fs::weakly_canonical(found.path, code));
        if (!fresh) return known->second;
        std::optional<std::string> bytes = read_regular_file(found.path);
        if (!bytes) return "";
        known->second = unused(fs::path(found.path).filename().string(), *bytes);
        if (!fs::exists(folder_ / known->second, code))
            more_.push_back({known->second, std::move(*bytes)});
        return known->second;
    }

    void finish() {
        for (WrittenFile& file : more_) files_.push_back(std::move(file));
    }

  private:
    static constexpr std::string_view kFolder = "textures/";

    // A name in textures/ that no other picture has: what lies there and differs stays.
    std::string unused(const std::string& name, const std::string& bytes) {
        fs::path path(name);
        for (int n = 1;; ++n) {
            std::string tried =
                fmt::format("{}{}{}{}", kFolder, path.stem().string(),
                            n == 1 ? "" : fmt::format("-{}", n), path.extension().string());
            std::error_code code;
            bool free = !fs::exists(folder_ / tried, code) ||
                        read_regular_file((folder_ / tried).string()) == bytes;
            if (free && names_.insert(tried).second) return tried;
        }
    }

    WrittenFiles& files_;
    WrittenFiles more_;
    fs::path folder_;
    PictureSearch search_;
    std::map<fs::path, WrittenFile*> inner_;
    std::map<fs::path, std::string> copied_;
    std::set<std::string> names_;
};

}  // namespace

std::string copy_textures(const std::string& output, const std::string& text, WrittenFiles& files) {
    Diagnostics quiet;
    std::optional<Document> document = collada::read_document_text(output, text, quiet);
    if (!document || !document->whole()) return text;
    std::string_view own = quiet.files.text(document->file());
    TextureCopies copies(output, files);
    std::vector<Edit> edits;
    for (const collada::UriValue& uri : collada::uri_values(*document)) {
        if (!links_picture(*uri.element)) continue;
        std::string path = collada::path_of_uri(*document, link_of(uri.value));
        std::string name = copies.link(path, document->directory());
        if (!name.empty()) edits.push_back(set_link(own, uri, encoded_link(name)));
    }
    for (const RslFileName& named : rsl_file_names(*document, own)) {
        std::string path = fs::path(document->directory() + named.name).lexically_normal().string();
        std::error_code code;
        if (!fs::is_regular_file(path, code)) continue;
        std::string name = copies.link(path, document->directory());
        if (!name.empty()) edits.push_back(set_name(named, name));
    }
    copies.finish();
    return collada::apply_edits(own, std::move(edits));
}

}  // namespace kinora
