// runtime/player/session/scene_edits.h: what was changed of a scene since it was read.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/kinora/open_scene.h"

namespace kinora {

// Undo keeps the edits of before.
struct SceneEdits {
    struct Text {
        std::string material, file, text;  // `material`: ShaderPlace::id
        uint64_t version = 0;              // of ShaderDocument
        bool alone = false;                // others that wear the text as it was read keep that
        bool operator==(const Text&) const = default;
    };
    std::vector<std::pair<std::string, std::string>> shaders;  // MATERIAL, FILE.sl or one of ours
    std::vector<Text> texts;                                   // one a shader place
    std::vector<std::pair<std::string, std::string>> params;   // MATERIAL.NAME, VALUE
    std::vector<std::string> hidden;                           // nodes, by id

    bool operator==(const SceneEdits&) const = default;
};

// Shaders of edited texts, so that a text which has not changed is the same shader again.
struct EditedShaders {
    struct Row {
        SceneEdits::Text text;
        FileId file = kNoFile;
        std::vector<std::shared_ptr<const rsl::Shader>> shaders;
    };
    std::vector<Row> rows;
};

// The edits on a scene as read. Findings; false after an error. `known` has the last call's.
bool apply_edits(ImportedScene& imported, const SceneEdits& edits, const SceneRequest& request,
                 Diagnostics& diagnostics, EditedShaders* known = nullptr);

// The shader of a material's last layer, which is seen; null: none.
const rsl::Shader* shown_surface(const MaterialDefinition& material);

}  // namespace kinora
