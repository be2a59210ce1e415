// collada/document/open_scene.h: the .dae that a path means: itself, or the scene of a .zae or
// .kmz.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "collada/document/archive.h"
#include "collada/document/placed_model.h"
#include "runtime/base/diagnostic.h"

namespace kinora::collada {

struct SceneFile {
    std::string document;  // for read_document
    std::string folder;    // for ExtractOptions::folder: of the archive; "" for a plain file
    std::string scene_id;  // the visual scene that the archive's manifest names, or ""
    // Of a .kmz with several models, or with one that is turned or scaled: all of them, `document`
    // first. Its world is that document's.
    std::vector<PlacedModel> models;
    std::shared_ptr<const void> keep;  // as long as this lives, the files are there
};

// A file that is no zip is handed through, there or not. Of an archive the scene is what <dae_root>
// of manifest.xml names (.zae), else what the first <Model> of a .kml names (.kmz), else the first
// .dae nearest to the top (ARCHIVE_ROOT). Nothing, and an Error, when there is none.
std::optional<SceneFile> open_scene(const std::string& path, Diagnostics& diag,
                                    const ArchiveLimits& limits = {});
// The same of an archive in memory (is_archive_bytes); `path` names it in findings.
std::optional<SceneFile> open_scene_bytes(const std::string& path, std::string_view bytes,
                                          Diagnostics& diag, const ArchiveLimits& limits = {});

}  // namespace kinora::collada
