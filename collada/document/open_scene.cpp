// collada/document/open_scene.cpp: manifest.xml, .kml and the order of members say which .dae is
// the scene.
#include "collada/document/open_scene.h"

#include <expat.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "collada/document/findings.h"
#include "collada/document/kml_p.h"
#include "collada/text/encoding_p.h"
#include "collada/text/entities_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/regular_file.h"

namespace kinora::collada {

namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kMaxIndexBytes = 4 << 20;  // of manifest.xml and .kml

bool ends_like(std::string_view name, std::string_view ending) {
    if (name.size() < ending.size()) return false;
    for (size_t i = 0; i < ending.size(); ++i)
        if (std::tolower(uint8_t(name[name.size() - ending.size() + i])) !=
            std::tolower(uint8_t(ending[i])))
            return false;
    return true;
}

// Expat's events of a manifest or .kml: the text of the first element so named that ends like
// `ending`. Its namespace prefix does not matter.
struct TextSearch {
    std::string_view name, ending;
    XML_Parser parser = nullptr;
    bool inside = false;
    std::string text, found;

    static void XMLCALL on_start(void* self, const XML_Char* name, const XML_Char**) {
        auto* search = static_cast<TextSearch*>(self);
        std::string_view local = name;
        local.remove_prefix(local.find(':') == local.npos ? 0 : local.find(':') + 1);
        search->inside = local == search->name;
        search->text.clear();
    }
    static void XMLCALL on_text(void* self, const XML_Char* text, int length) {
        auto* search = static_cast<TextSearch*>(self);
        if (search->inside) search->text.append(text, size_t(length));
    }
    static void XMLCALL on_end(void* self, const XML_Char*) {
        auto* search = static_cast<TextSearch*>(self);
        std::string_view text = trim(search->text);
        std::string_view file = text.substr(0, text.find('#'));
        if (search->inside && !text.empty() && ends_like(file, search->ending)) {
            search->found = text;
            XML_StopParser(search->parser, XML_FALSE);
        }
        search->inside = false;
    }
};

// "" where there is none; what such a file gets wrong is no finding, it is no COLLADA.
std::string first_text(const std::string& path, std::string_view name, std::string_view ending) {
    std::optional<std::string> bytes = read_regular_file(path, kMaxIndexBytes);
    if (!bytes) return {};
    DecodedText decoded = decode_text(std::move(*bytes));
    std::string_view xml = decoded.text;
    if (std::optional<ByteRange> use = find_entity_use(xml)) xml = xml.substr(0, use->begin);
    TextSearch search;
    search.name = name;
    search.ending = ending;
    search.parser = XML_ParserCreate("UTF-8");
    if (!search.parser) return {};
    XML_SetUserData(search.parser, &search);
    XML_SetElementHandler(search.parser, TextSearch::on_start, TextSearch::on_end);
    XML_SetCharacterDataHandler(search.parser, TextSearch::on_text);
    XML_Parse(search.parser, xml.data(), int(xml.size()), XML_TRUE);
    XML_ParserFree(search.parser);
    return std::move(search.found);
}

struct Root {
    std::string path, scene_id;
};

// What a link written in `index`, a member, means: another member, or nothing.
Root linked(const Archive& archive, std::string_view index, std::string_view uri) {
    Root root;
    size_t hash = uri.find('#');
    if (hash != uri.npos) root.scene_id = percent_decode(uri.substr(hash + 1));
    std::string file = percent_decode(trim(uri.substr(0, hash)));
    std::replace(file.begin(), file.end(), '\\', '/');
    file = (fs::path(index).parent_path() / file).lexically_normal().string();
    while (file.starts_with("/")) file.erase(0, 1);  // exporters mean the archive's top
    for (const std::string& member : archive.members)
        if (member == file) root.path = member;
    for (const std::string& member : archive.members)
        if (root.path.empty() && member.size() == file.size() && ends_like(member, file))
            root.path = member;
    return root;
}

const std::string* first_scene(const Archive& archive) {
    const std::string* best = nullptr;
    auto depth = [](const std::string& path) { return std::count(path.begin(), path.end(), '/'); };
    for (const std::string& member : archive.members)
        if (ends_like(member, ".dae") && (!best || depth(member) < depth(*best))) best = &member;
    return best;
}

// Of the models of a .kml those that are in the archive; the first one is the root.
struct Models {
    Root root;
    std::vector<PlacedModel> placed;
};
Models models_of(const Archive& archive, const std::string& index, Diagnostics& diag) {
    const std::string& folder = archive.folder->path();
    std::vector<KmlModel> listed = read_kml(folder + "/" + index);
    auto origin = std::ranges::find_if(listed, &KmlModel::has_place);
    Models models;
    for (const KmlModel& model : listed) {
        Root root = linked(archive, index, model.href);
        for (const std::string& fault : model.faults)
            diag.report(Code::ARCHIVE_PLACE, Location{}, index, fault, model.href);
        if (root.path.empty()) {
            diag.report(Code::ARCHIVE_MODEL, Location{}, index, model.href);
            continue;
        }
        dmat4 place = kml_place(model, origin == listed.end() ? model : *origin);
        models.placed.push_back({model.name, folder + "/" + root.path, root.scene_id, place});
        if (models.placed.size() == 1) models.root = root;
    }
    if (models.placed.size() == 1 && models.placed[0].place == dmat4(1.0)) models.placed.clear();
    return models;
}

// True when one of these members is an archive itself, with the finding.
bool report_nested(const std::string& path, const Archive& archive,
                   std::span<const std::string> members, Diagnostics& diag) {
    for (const std::string& member : members) {
        if (!is_archive(archive.folder->path() + "/" + member)) continue;
        diag.report(Code::ARCHIVE_NESTED, Location{}, member, path);
        return true;
    }
    return false;
}

std::optional<SceneFile> scene_of(const std::string& path, Archive archive, Diagnostics& diag) {
    const std::string& folder = archive.folder->path();
    std::string index, link;
    for (const std::string& member : archive.members)
        if (ends_like(member, "manifest.xml") && (index.empty() || member.size() < index.size()))
            index = member;
    if (!index.empty()) link = first_text(folder + "/" + index, "dae_root", "");
    Models models;
    for (const std::string& member : archive.members) {
        if (!link.empty() || !ends_like(member, ".kml")) continue;
        index = member;
        models = models_of(archive, member, diag);
        link = models.root.path.empty() ? first_text(folder + "/" + member, "href", ".dae")
                                        : models.root.path;
    }
    Root root = models.root;
    if (root.path.empty() && !link.empty()) root = linked(archive, index, link);
    if (root.path.empty()) {
        const std::string* first = first_scene(archive);
        if (!first) {
            if (!report_nested(path, archive, archive.members, diag))
                diag.report(Code::ARCHIVE_NO_SCENE, Location{}, path);
            return std::nullopt;
        }
        std::string what = link.empty()
                               ? "nothing in the archive names its scene"
                               : fmt::format("'{}' names '{}', which is not there", index, link);
        diag.report(Code::ARCHIVE_ROOT, Location{}, what, path + "!" + *first);
        root = {*first, {}};
    }
    if (report_nested(path, archive, {&root.path, 1}, diag)) return std::nullopt;
    return SceneFile{folder + "/" + root.path, folder, root.scene_id, std::move(models.placed),
                     std::move(archive.folder)};
}

}  // namespace

std::optional<SceneFile> open_scene(const std::string& path, Diagnostics& diag,
                                    const ArchiveLimits& limits) {
    if (!is_archive(path)) return SceneFile{path, {}, {}, {}, {}};
    std::optional<Archive> archive = unpack_archive(path, limits, diag);
    if (!archive) return std::nullopt;
    return scene_of(path, std::move(*archive), diag);
}

std::optional<SceneFile> open_scene_bytes(const std::string& path, std::string_view bytes,
                                          Diagnostics& diag, const ArchiveLimits& limits) {
    std::optional<Archive> archive = unpack_archive_bytes(path, bytes, limits, diag);
    if (!archive) return std::nullopt;
    return scene_of(path, std::move(*archive), diag);
}

}  // namespace kinora::collada
